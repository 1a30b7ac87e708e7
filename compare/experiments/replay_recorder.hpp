// A run of the soil bin as a replay: what an onlooker of the rig sees, written as soilbin-replay/1.
#pragma once

#include <filesystem>
#include <unordered_map>
#include <vector>

#include "compare/replay/replay.hpp"
#include "dem/rig/wheel_run.hpp"

namespace soilbin::compare {

/// A replay's file and the source that it names.
struct ReplayKeeping {
  std::filesystem::path file;  ///< empty: none is kept
  std::string source;          ///< state of the sources that the program was built from, shown beside the title
};

/// Collects the first run that it looks at.
class ReplayRecorder {
 public:
  /// Looks at a run, and keeps what it has seen for one that is stopped and gone on with. Refers to this recorder.
  dem::Onlooker onlooker();
  bool has_frames() const { return !replay_.frames.empty(); }
  /// Writes the file; from then on it collects nothing. `title`: the condition or the drive.
  void write(const ReplayKeeping& to, const std::string& title, std::uint64_t packing);

 private:
  void look(const dem::Simulation& simulation, int wheel, double surface);
  template <class Notes>
  void state(Notes& notes);
  void find_places();
  void make_places(const dem::Grains& grains);
  void begin(const dem::Simulation& simulation, int wheel, double surface);

  Replay replay_;
  bool written_ = false;
  std::vector<dem::GrainId> ids_;                        ///< of the grains in the frames
  std::unordered_map<dem::GrainId, std::size_t> place_;  ///< by id: rows change, ids stay
};

}  // namespace soilbin::compare
