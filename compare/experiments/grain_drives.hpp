// A case's drive on grains: on each packing that is asked for, stopped and gone on with.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "compare/drives/drive_sides.hpp"
#include "compare/experiments/replay_recorder.hpp"
#include "dem/rig/dem_model.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

class GrainDrives {
 public:
  /// On `packings` beds, of the seeds from settings.packing on; the first may be kept to look at. The case must outlive
  /// it. Progress goes to settings.how, with the packing before its stage where there are several.
  GrainDrives(dem::DemSettings settings, const Case& question, int samples, int packings, ReplayKeeping replay);

  /// Drives. What is finished is kept until it is forgotten, so that a stopped command goes on behind it. Throws what
  /// DemModel::drive throws; of several packings the error names the one.
  void run();
  const std::vector<DriveSide>& sides() const { return sides_; }
  /// Bed and cost, a line a packing.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Once its answer has been told.
  void forget();

 private:
  std::uint64_t packing(int k) const { return settings_.packing + static_cast<std::uint64_t>(k); }
  dem::DemModel model(int k);
  void drive(int k);
  void note(const dem::GrainDriveRecord& record, std::uint64_t packing, double seconds);
  void show(int k, dem::Progress progress) const;

  dem::DemSettings settings_;
  const Case& question_;
  int samples_, packings_;
  ReplayKeeping replay_;
  ReplayRecorder recorder_;
  std::vector<DriveSide> sides_;
  std::vector<std::string> notes_;
  std::chrono::steady_clock::time_point began_;
};

}  // namespace soilbin::compare
