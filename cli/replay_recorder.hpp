// A run of the soil bin as a replay: what an onlooker of the rig sees, written as soilbin-replay/1.
#pragma once

#include <filesystem>
#include <memory>
#include <unordered_map>
#include <vector>

#include "compare/replay/replay.hpp"
#include "dem/rig/wheel_run.hpp"

namespace soilbin::cli {

/// Collects the first run that it looks at.
class ReplayRecorder {
 public:
  /// A frame of the run.
  void look(const dem::Simulation& simulation, int wheel, double surface);
  bool has_frames() const { return !replay_.frames.empty(); }
  /// What it has seen, as bytes, and back: for a run that is stopped and gone on with (dem::Onlooker).
  std::shared_ptr<dem::OnlookerKeeper> keeper();
  /// Writes the file, and lets go of the frames. `facts`: shown beside the title.
  void write(const std::filesystem::path& file, const std::string& title,
             std::vector<std::pair<std::string, std::string>> facts);

 private:
  template <class Notes>
  void state(Notes& notes);
  void find_places();
  void begin(const dem::Simulation& simulation, int wheel, double surface);

  compare::Replay replay_;
  std::vector<dem::GrainId> ids_;                        ///< of the grains in the frames
  std::unordered_map<dem::GrainId, std::size_t> place_;  ///< by id: rows change, ids stay
};

}  // namespace soilbin::cli
