// What runs of the virtual soil bin will take, before any is made: time, memory, disk.
//
//   const RunCosts costs(question.scenario, settings, records);
//   for (const AskedRun& run : list) seconds += costs.seconds(run);
#pragma once

#include <cstddef>
#include <vector>

#include "compare/recorded/run_list.hpp"
#include "dem/rig/dem_model.hpp"

namespace soilbin::compare {

/// Estimates for the runs of one scenario in one bin. Work counts in grain-steps: one step of the motion of one grain.
class RunCosts {
 public:
  /// The speed comes from the runs of `records` where they tell one: their seconds, as they were measured then, with
  /// however many threads and whatever ran beside them; else from a trial: a small bed of the same grains is settled
  /// for about a second of processor time on one thread, and more are taken to share the work evenly. Throws InputError
  /// without granular values.
  RunCosts(const Scenario& scenario, const dem::DemSettings& settings, const std::vector<Record>& records);

  /// That the bed will hold, about: six tenths of its volume in grains of the mean volume.
  double grains() const { return grains_; }
  /// Of the engine for a run [-].
  double steps(const AskedRun& run) const;
  /// On the clock on the wall, the bed already settled [s].
  double seconds(const AskedRun& run) const { return grains_ * steps(run) / speed_; }
  /// To settle a bed, about: as long as grains take to fall by its depth, thirty times [s].
  double bed_seconds() const;
  /// Grain-steps a second on the clock on the wall.
  double speed() const { return speed_; }
  /// Recorded runs behind the speed; 0: it was tried.
  std::size_t from_runs() const { return from_runs_; }

  /// Of a process: those of the settings, else one a core.
  int threads() const;
  /// Of a process, while pairs are searched, which needs the most [bytes].
  double memory() const;
  /// Of a bed's file [bytes].
  double bed_bytes() const;
  /// Of a run's line in the record [bytes].
  double record_bytes() const { return 40e3; }

 private:
  double trial(dem::DemSettings settings) const;

  Scenario scenario_;
  dem::DemSettings settings_;
  dem::BedRecipe recipe_;
  double grains_ = 0, speed_ = 0;
  std::size_t from_runs_ = 0;
};

}  // namespace soilbin::compare
