// What a study asks of grains before any run is made: the list of runs, which are recorded, what the rest will cost.
// `soilbin run --dry-run` shows it, `soilbin sweep` divides it among jobs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/soil_bin.hpp"
#include "compare/experiments/run_costs.hpp"

namespace soilbin::cli {

struct PlannedRun {
  compare::AskedRun run;
  bool recorded = false;
  double seconds = 0;  ///< that it will take, as far as one can say
};

struct RunPlan {
  std::string study;
  std::vector<PlannedRun> runs;            ///< the whole list, or that of the shard that the flags name
  std::vector<std::uint64_t> unsettled{};  ///< packings whose beds are not in the folder of beds yet
  std::size_t beds = 0;                    ///< packings of the list
  int threads = 1;                         ///< of a process
  std::size_t from_runs = 0;               ///< recorded runs that the seconds were taken from; 0: from a trial
  double speed = 0, grains = 0;            ///< grain-steps a second; grains of a bed
  double bed_seconds = 0, memory = 0, bed_bytes = 0, record_bytes = 0;  ///< of one bed, one process, one bed, one run

  std::size_t recorded() const;
  double seconds_left() const;  ///< of all runs that are not recorded, one after the other; without beds
  double core_hours_left() const;
};

/// `question`: its conditions are those that are asked. Reads flags.record and flags.known where they are there. Throws
/// what runs_of and RunCosts throw, and InputError for a record of other inputs.
RunPlan plan_of(const Case& question, const SoilBinFlags& flags, compare::TestStep test);

std::string plan_text(const RunPlan& plan);
/// soilbin-plan/1, in SI.
nlohmann::ordered_json plan_json(const RunPlan& plan);

/// "40 s", "12 min", "3.5 h".
std::string duration_text(double seconds);
/// "600 kB", "72 MB", "1.2 GB".
std::string size_text(double bytes);

}  // namespace soilbin::cli
