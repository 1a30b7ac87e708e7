#include "cli/replay_recorder.hpp"

#include "scenario/atomic_file.hpp"

namespace soilbin::cli {
namespace {

compare::Point point_of(const dem::Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

void ReplayRecorder::begin(const dem::Simulation& simulation, int wheel, double surface) {
  const dem::Grains& grains = simulation.state().grains;
  replay_.surface = surface;
  for (std::size_t row = 0; row < grains.count(); ++row) {
    place_.emplace(grains.id[row], row);
    replay_.radii.push_back(grains.motion[row].radius);
  }
  for (const dem::Surface& part : simulation.body(wheel).surfaces) {
    const auto* mesh = std::get_if<dem::MeshSurface>(&part.shape);
    if (mesh == nullptr) continue;
    const auto first = static_cast<std::uint32_t>(replay_.tire.size());
    for (const dem::Vec3& vertex : mesh->mesh->vertices()) replay_.tire.push_back(point_of(vertex));
    for (const auto& corners : mesh->mesh->triangles())
      replay_.triangles.push_back({first + static_cast<std::uint32_t>(corners[0]),
                                   first + static_cast<std::uint32_t>(corners[1]),
                                   first + static_cast<std::uint32_t>(corners[2])});
  }
}

void ReplayRecorder::look(const dem::Simulation& simulation, int wheel, double surface) {
  if (replay_.frames.empty()) begin(simulation, wheel, surface);
  const dem::Body& body = simulation.body(wheel);
  compare::ReplayFrame frame;
  frame.time = simulation.time();
  frame.wheel = point_of(body.position);
  frame.rotation = {body.rotation.w, body.rotation.x, body.rotation.y, body.rotation.z};
  frame.grains.resize(replay_.radii.size());
  const dem::Grains& grains = simulation.state().grains;
  for (std::size_t row = 0; row < grains.count(); ++row)
    frame.grains[place_.at(grains.id[row])] = point_of(grains.motion[row].position);
  replay_.frames.push_back(std::move(frame));
}

void ReplayRecorder::write(const std::filesystem::path& file, const std::string& title,
                           std::vector<std::pair<std::string, std::string>> facts) {
  replay_.title = title;
  replay_.facts = std::move(facts);
  write_file_atomically(file, compare::replay_bytes(replay_));
  replay_ = {};
  place_.clear();
}

}  // namespace soilbin::cli
