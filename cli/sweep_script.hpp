// A sweep as a script that a person can read: beds first, then the runs in shards, then their records made one. The
// jobs are Slurm's, or processes of this machine; the work is done by `soilbin bed`, `run --shard` and `record merge`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/run_plan.hpp"

namespace soilbin::cli {

enum class SweepOn { slurm, local };

/// A sweep divided among jobs, and where it lies.
struct SweepJobs {
  SweepOn on = SweepOn::local;
  RunPlan plan;                                   ///< of the whole study
  std::vector<std::string> run_words, bed_words;  ///< study and flags of `soilbin run` and `soilbin bed`
  std::vector<std::string> known;                 ///< records whose runs are not made again
  std::filesystem::path program, folder, here;    ///< soilbin; the sweep's folder; where it was called; absolute
  std::filesystem::path beds;                     ///< folder of beds, absolute
  int shards = 1, at_once = 1;                    ///< at_once: processes of a local sweep side by side
};

/// So many shards that each makes runs for at least `at_least` seconds, as far as one can say; 1 at least, and no more
/// than there are runs.
int shards_for(const RunPlan& plan, double at_least);

/// Indices into plan.runs of a shard's runs.
std::vector<std::size_t> runs_of_shard(const RunPlan& plan, const compare::Shard& shard);

/// The record of a shard, below the sweep's folder.
std::filesystem::path shard_record(const std::filesystem::path& folder, const compare::Shard& shard);

/// The script, for bash. Without arguments it submits or runs all; with 'bed', 'run' or 'merge' it is a job.
std::string sweep_script(const SweepJobs& jobs);

}  // namespace soilbin::cli
