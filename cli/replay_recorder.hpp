// A run of the soil bin as a replay: what an onlooker of the rig sees, written as soilbin-replay/1.
#pragma once

#include <filesystem>
#include <unordered_map>

#include "compare/replay/replay.hpp"
#include "dem/rig/wheel_run.hpp"

namespace soilbin::cli {

/// Collects the first run that it looks at.
class ReplayRecorder {
 public:
  /// A frame of the run.
  void look(const dem::Simulation& simulation, int wheel, double surface);
  bool has_frames() const { return !replay_.frames.empty(); }
  /// Writes the file, and lets go of the frames. `facts`: shown beside the title.
  void write(const std::filesystem::path& file, const std::string& title,
             std::vector<std::pair<std::string, std::string>> facts);

 private:
  void begin(const dem::Simulation& simulation, int wheel, double surface);

  compare::Replay replay_;
  std::unordered_map<dem::GrainId, std::size_t> place_;  ///< in the frames: rows change, ids stay
};

}  // namespace soilbin::cli
