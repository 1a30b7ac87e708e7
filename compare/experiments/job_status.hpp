// How far the jobs of a sweep are (job_script.hpp): read from their records, their logs and what Slurm says.
//
//   const JobStatus status = job_status("sweep-paper-straight");
//   if (!status.complete()) fmt::print("{}", in_words(status));
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"

namespace soilbin::compare {

/// How far a shard is.
struct ShardStatus {
  std::size_t runs = 0, recorded = 0, without_result = 0;
  double seconds_left = 0, seconds_planned = 0, seconds_taken = 0;  ///< planned and taken: of what is recorded
  std::string state;  ///< "done", "running", "waiting", "failed", or "missing": it was never begun
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
