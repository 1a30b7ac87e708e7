#include "compare/experiments/replay_recorder.hpp"

#include <algorithm>
#include <map>

#include "dem/archive/note_text.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::compare {
namespace {

Point point_of(const dem::Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

/// Found by its argument's namespace (note_text.hpp).
template <class Notes>
void archive(Notes& notes, ReplayBin& bin) {
  notes(bin.lower, bin.upper, bin.periodic);
}

template <class Notes>
void ReplayRecorder::state(Notes& notes) {
  auto& [title, facts, radii, tire, triangles, surface, bin, frames] = replay_;  // title and facts come with write
  notes(ids_, radii, tire, triangles, surface, bin);
  std::size_t count = frames.size();
  notes(count);
  frames.resize(count);
  for (auto& [time, wheel, rotation, grains, pressing, force, torque] : frames)
    notes(time, wheel, rotation, grains, pressing, force, torque);
  if constexpr (Notes::reads) find_places();
}

dem::Onlooker ReplayRecorder::onlooker() {
  dem::Onlooker onlooker;
  onlooker.look = [this](const dem::Simulation& simulation, int wheel, double surface) {
    if (!written_) look(simulation, wheel, surface);
  };
  onlooker.keeper = std::make_shared<dem::OnlookerKeeper>(
      [this] {
        dem::NoteWriter writer;
        state(writer);
        return writer.text();
      },
      [this](const std::string& seen) {
        dem::NoteReader reader("replay", seen);
        state(reader);
      });
  return onlooker;
}

void ReplayRecorder::find_places() {
  place_.clear();
  for (std::size_t row = 0; row < ids_.size(); ++row) place_.emplace(ids_[row], row);
}

/// Grains that have come in take the places of those of the same radius that have left, else new ones at the end, where
/// earlier frames show them as they came. Those that have left are shown where they were last, until then.
void ReplayRecorder::make_places(const dem::Grains& grains) {
  std::vector<std::uint32_t> fresh;
  for (std::uint32_t row = 0; row < grains.count(); ++row)
    if (!place_.contains(grains.id[row])) fresh.push_back(row);
  if (fresh.empty()) return;
  std::ranges::sort(fresh, {}, [&](std::uint32_t row) { return grains.id[row]; });
  std::vector<bool> taken(ids_.size());
  for (const dem::GrainId id : grains.id)
    if (const auto place = place_.find(id); place != place_.end()) taken[place->second] = true;
  std::map<double, std::vector<std::size_t>> free;  // by radius
  for (std::size_t place = ids_.size(); place-- > 0;)
    if (!taken[place]) free[replay_.radii[place]].push_back(place);
  for (const std::uint32_t row : fresh) {
    const double radius = grains.motion[row].radius;
    std::vector<std::size_t>& places = free[radius];
    if (places.empty()) {
      ids_.push_back(grains.id[row]), replay_.radii.push_back(radius);
      for (ReplayFrame& frame : replay_.frames)
        frame.grains.push_back(point_of(grains.motion[row].position)), frame.pressing.push_back(0);
      continue;
    }
    ids_[places.back()] = grains.id[row];
    places.pop_back();
  }
  find_places();
}

void ReplayRecorder::begin(const dem::Simulation& simulation, int wheel, double surface) {
  const dem::Grains& grains = simulation.state().grains;
  replay_.surface = surface;
  const dem::Domain& domain = simulation.setup().domain;
  replay_.bin = ReplayBin{point_of(domain.lower), point_of(domain.upper), domain.periodic};
  for (std::size_t row = 0; row < grains.count(); ++row) {
    ids_.push_back(grains.id[row]);
    replay_.radii.push_back(grains.motion[row].radius);
  }
  find_places();
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
  make_places(simulation.state().grains);
  const dem::Body& body = simulation.body(wheel);
  ReplayFrame frame;
  frame.time = simulation.time();
  frame.wheel = point_of(body.position);
  frame.rotation = {body.rotation.w, body.rotation.x, body.rotation.y, body.rotation.z};
  if (!replay_.frames.empty()) frame.grains = replay_.frames.back().grains;
  frame.grains.resize(replay_.radii.size());
  const dem::Grains& grains = simulation.state().grains;
  for (std::size_t row = 0; row < grains.count(); ++row)
    frame.grains[place_.at(grains.id[row])] = point_of(grains.motion[row].position);
  frame.force = point_of(body.force), frame.torque = point_of(body.torque);
  frame.pressing.assign(replay_.radii.size(), 0.0);
  const auto pressed = [&](dem::GrainId id, double force) {
    double& most = frame.pressing[place_.at(id)];
    most = std::max(most, force);
  };
  for (const dem::Contact& contact : simulation.contacts()) {
    pressed(contact.first, contact.pressing);
    if (contact.second >= 0) pressed(static_cast<dem::GrainId>(contact.second), contact.pressing);
  }
  replay_.frames.push_back(std::move(frame));
}

void ReplayRecorder::write(const ReplayKeeping& to, const std::string& title, std::uint64_t packing) {
  written_ = true;
  replay_.title = title;
  replay_.facts = {{"packing", std::to_string(packing)}, {"sources", to.source}};
  thin_out(replay_);
  write_file_atomically(to.file, replay_bytes(replay_));
  replay_ = {};
  ids_.clear(), place_.clear();
}

}  // namespace soilbin::compare
