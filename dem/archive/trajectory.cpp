#include "dem/archive/trajectory.hpp"

#include <fmt/core.h>

#include "dem/archive/h5md.hpp"
#include "dem/archive/restart_layout.hpp"
#include "dem/archive/sealed_file.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;

const FileKind frame_kind{"frame", 1};
constexpr std::string_view prefix = "frame-", suffix = ".h5";

/// Bodies are particles too. Velocities belong to the half step before, forces to the step before.
template <class Archive, class T>
void describe_bodies(const Archive& a, T& bodies, std::int64_t step, double time, double dt) {
  a.element(
      "position", bodies, [](auto& body) -> auto& { return body.position; }, step, time, "m");
  a.element(
      "orientation", bodies, [](auto& body) -> auto& { return body.rotation; }, step, time);
  a.element(
      "velocity", bodies, [](auto& body) -> auto& { return body.velocity; }, step, time - dt / 2, "m s-1");
  a.element(
      "angular_velocity", bodies, [](auto& body) -> auto& { return body.spin; }, step, time - dt / 2, "rad s-1");
  a.element(
      "force", bodies, [](auto& body) -> auto& { return body.force; }, step - 1, time - dt, "N");
  a.element(
      "torque", bodies, [](auto& body) -> auto& { return body.torque; }, step - 1, time - dt, "N m");
  for (std::size_t k = 0; k < bodies.size(); ++k) a.text("name_" + std::to_string(k), bodies[k].name);
}

}  // namespace

fs::path frame_path(const fs::path& folder, std::int64_t step) {
  return folder / fmt::format("{}{:012}{}", prefix, step, suffix);
}

void write_frame(const fs::path& folder, const Setup& setup, const State& state) {
  const fs::path path = frame_path(folder, state.step);
  hdf5::OutputFile file(path.string());
  write_h5md(file.root());
  const Saver particles(file.root().create("particles")), grains = particles.inner("grains"),
                                                          bodies = particles.inner("bodies");
  write_box(grains.group(), setup.domain);
  write_box(bodies.group(), setup.domain);
  const double dt = setup.numerics.dt;
  describe_particles(grains, state.grains, state.step, state.time, dt);
  std::vector<FrameBody> poses;
  for (const Body& b : state.bodies)
    poses.push_back({b.name, b.position, b.rotation, b.velocity, b.spin, b.force, b.torque});
  describe_bodies(bodies, poses, state.step, state.time, dt);
  const Saver ours(file.root().create("soilbin"));
  ours.value("step", state.step);
  ours.value("time", state.time);
  ours.length("grains", state.grains.id);
  ours.length("bodies", poses);
  write_sealed(path, frame_kind, file.finish(), Keep::nothing);
}

std::vector<fs::path> frames_of(const fs::path& folder) {
  std::vector<fs::path> frames;
  if (!fs::is_directory(folder)) return frames;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(suffix)) frames.push_back(entry.path());
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

Frame read_frame(const fs::path& path) {
  const SealedFile sealed(path, frame_kind);
  const hdf5::InputFile file(sealed.content(), path.string());
  const Loader ours(file.root().open("soilbin")), particles(file.root().open("particles"));
  Frame frame;
  ours.value("step", frame.step);
  ours.value("time", frame.time);
  ours.length("grains", frame.grains.id);
  ours.length("bodies", frame.bodies);
  frame.grains.motion.resize(frame.grains.count());
  frame.grains.material.resize(frame.grains.count());
  describe_particles(particles.inner("grains"), frame.grains, 0, 0, 0);
  describe_bodies(particles.inner("bodies"), frame.bodies, 0, 0, 0);
  return frame;
}

}  // namespace soilbin::dem
