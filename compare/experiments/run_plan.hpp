// What a study asks of grains before any run is made: the list of runs, which are recorded, what the rest will cost.
// `soilbin run --dry-run` shows it, `soilbin sweep` divides it among jobs.
//
//   const RunPlan plan = plan_of(question, settings, specs(question, settings, 3), {});
//   fmt::print("{} of {} are recorded\n", plan.recorded(), plan.runs.size());
#pragma once

#include <string>
#include <vector>

#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/report/json_fields.hpp"

namespace soilbin::compare {

struct PlannedRun : RunSpec {
  bool recorded = false;
  double seconds = 0;     ///< that it will take, as far as one can say
  std::string refused{};  ///< why it will have no answer, where that is known beforehand
  std::string of_tire{};  ///< "lugs of 12 mm", where runs differ in their tire
};

struct RunPlan {
  std::string study;
  std::vector<PlannedRun> runs;            ///< the whole list, or that of a shard
  std::vector<std::uint64_t> unsettled{};  ///< packings whose beds are not in the folder of beds yet
  std::size_t beds = 0;                    ///< packings of the list
  bool density_limits = true;              ///< the two small beds that a density is told by are there
  int threads = 1;                         ///< of a process; in LAMMPS, of one thread each, processes of a run
  bool in_lammps = false;                  ///< grains are moved by LAMMPS
  std::size_t from_runs = 0;               ///< recorded runs that the seconds were taken from; 0: from a trial
  double speed = 0, grains = 0;            ///< grain-steps a second; grains in a run
  double bed_seconds = 0, memory = 0, bed_bytes = 0, record_bytes = 0;  ///< of one bed, one process, one bed, one run

  std::size_t recorded() const;
  double seconds_left() const;  ///< of all runs that are not recorded, one after the other; without beds
  double core_hours_left() const;
};

/// The plan of the runs of specs. Reads keeping.known, and keeping.record where it is there. Throws
/// InputError for a soil without values of grains, for a record of other inputs, and for what no run could begin with
/// (DemModel::check).
RunPlan plan_of(const Case& question, const dem::DemSettings& settings, const std::vector<RunSpec>& specs,
                const RunKeeping& keeping);

/// How the last line ends of a command that was stopped, by a person or a job's time limit, and kept what it had made.
inline constexpr const char* stopped_and_kept = ": the same command goes on from there";

std::string plan_text(const RunPlan& plan);
/// soilbin-plan/1, in SI.
Json plan_json(const RunPlan& plan);

}  // namespace soilbin::compare
