// A study's runs of grains divided among jobs, as a script that a person can read: beds first, then the runs in shards,
// then their records made one. The jobs are Slurm's, or processes of this machine; the work is done by `soilbin bed`,
// `run --shard` and `record merge`. `soilbin sweep` writes them, and tells how far they are
// from their records, their logs and what Slurm says.
//
//   Jobs jobs{.on = JobsOn::slurm, .plan = plan};
//   jobs.shards = shards_for(plan, usual_seconds(jobs.on));
//   write_jobs(jobs);                       // then: bash FOLDER/sweep.sh
//   fmt::print("{}", in_words(job_status(jobs.folder)));
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/experiments/run_plan.hpp"

namespace soilbin::compare {

enum class JobsOn { slurm, local };

/// A plan divided among jobs, and where they lie.
struct Jobs {
  JobsOn on = JobsOn::local;
  RunPlan plan;                                   ///< of the whole study
  std::vector<std::string> run_words, bed_words;  ///< study and flags of `soilbin run` and `soilbin bed`
  std::vector<std::string> known;                 ///< records whose runs are not made again
  std::filesystem::path program, folder, here;    ///< soilbin; the jobs' folder; where it was called; absolute
  std::filesystem::path beds;                     ///< folder of beds, absolute
  int shards = 1, at_once = 1;                    ///< at_once: processes of this machine side by side
};

/// The format of sweep.json.
inline constexpr const char* jobs_format = "soilbin-sweep/1";

/// Seconds that a job should take, unless somebody asks otherwise: Slurm's jobs wait for their turn.
constexpr double usual_seconds(JobsOn on) { return on == JobsOn::slurm ? 1800 : 60; }

/// Processes side by side on a machine of so many cores, of so many threads each.
constexpr int side_by_side(int cores, int threads) { return cores > threads ? cores / threads : 1; }

/// So many shards that each makes runs for at least `at_least` seconds, as far as one can say; 1 at least, and no more
/// than there are runs.
int shards_for(const RunPlan& plan, double at_least);

/// The record of a shard, below the jobs' folder.
std::filesystem::path shard_record(const std::filesystem::path& folder, const Shard& shard);

/// Makes the folder, with the script (sweep.sh) and what it does for job_status to read (sweep.json).
void write_jobs(const Jobs& jobs);

/// How far a shard is.
struct ShardStatus {
  std::size_t runs = 0, recorded = 0, without_result = 0;
  double seconds_left = 0, seconds_planned = 0, seconds_taken = 0;  ///< planned and taken: of what is recorded
  std::string state;  ///< "done", "running", "waiting", "stopped", "failed", or "missing": it was never begun
  std::string words;  ///< the last that it said
};

struct JobStatus {
  std::filesystem::path folder;
  std::string study;
  std::vector<ShardStatus> shards{};
  std::size_t runs = 0, recorded = 0, without_result = 0;
  double seconds_left = 0;  ///< of all runs that are missing, one after the other, by what the recorded ones took
  bool complete() const { return recorded == runs; }
};

/// Throws InputError for a folder that holds no jobs.
JobStatus job_status(const std::filesystem::path& folder);

std::string in_words(const JobStatus& status);
/// soilbin-sweep-status/1.
Json to_json(const JobStatus& status);

}  // namespace soilbin::compare
