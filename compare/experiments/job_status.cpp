// How far the jobs of a sweep are (jobs.hpp).
#include <fmt/core.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "compare/experiments/jobs.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/sealed_json.hpp"
#include "compare/report/shell_words.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/result_json.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// The content of sweep.json.
struct WrittenJobs {
  bool slurm = false;
  int shards = 1;
  RunPlan plan;
};

WrittenJobs read_jobs(const fs::path& folder) {
  const fs::path file = folder / "sweep.json";
  const std::string hint = "a sweep is written by 'soilbin sweep STUDY --on slurm'; its status is told by its folder";
  if (!fs::exists(file)) throw InputError(fmt::format("{} holds no sweep\n  hint: {}", folder.string(), hint));
  const Json document = parse_json(read_source_text(file, largest_json), hint);
  return read_json_at(file.string(), [&] {
    if (document.at("format") != jobs_format)
      throw InputError(fmt::format("{}: expected the format '{}'", file.string(), jobs_format));
    WrittenJobs jobs{document.at("on") == "slurm", document.at("shards").get<int>(), {document.at("study"), {}}};
    if (jobs.shards < 1 || jobs.shards > static_cast<int>(std::max<std::size_t>(document.at("runs").size(), 1)))
      throw InputError(fmt::format("{}: {} shards of {} runs", file.string(), jobs.shards, document.at("runs").size()));
    for (const Json& row : document.at("runs"))
      jobs.plan.runs.push_back({{condition_from_json(row, file.string()), row.at("packing").get<std::uint64_t>(),
                                 row.at("half_step").get<bool>() ? RunKind::half_step
                                 : row.value("coarser", false)   ? RunKind::coarser
                                                                 : RunKind::usual},
                                row.at("recorded").get<bool>(),
                                row.at("seconds").get<double>()});
    return jobs;
  });
}

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The last line of a log that begins a message; "" where there is none.
std::string last_line(const fs::path& file) {
  std::istringstream lines(text_in(file));
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty() && line.front() != ' ') last = line;
  return last;
}

/// The states that Slurm gives to tasks of a job array that it still knows: "RUNNING", "PENDING", ...
std::map<int, std::string> slurm_tasks(const std::string& job) {
  std::map<int, std::string> tasks;
  if (job.empty() || job.find_first_not_of("0123456789") != job.npos) return tasks;
  const std::string line = "squeue --noheader --array --format='%K %T' --jobs=" + job + " 2>&1";
  FILE* pipe = ::popen(line.c_str(), "r");
  if (pipe == nullptr) return tasks;
  char state[64];
  int task = 0;
  while (std::fscanf(pipe, "%d %63s", &task, state) == 2) tasks[task] = state;
  ::pclose(pipe);
  return tasks;
}

/// By shard: what the system says of those that are at work or about to be.
std::map<int, std::string> shards_at_work(const fs::path& folder, const WrittenJobs& jobs) {
  if (jobs.slurm) {
    std::string beds, runs;
    std::istringstream(text_in(folder / "jobs")) >> beds >> runs;
    return slurm_tasks(runs);
  }
  std::map<int, std::string> states;
  for (int k = 1; k <= jobs.shards; ++k) {
    int process = 0;
    if (std::istringstream(text_in(folder / "running" / std::to_string(k))) >> process && ::kill(process, 0) == 0)
      states[k] = "RUNNING";
  }
  return states;
}

ShardStatus shard_status(const fs::path& folder, const WrittenJobs& jobs, int number,
                         const std::map<int, std::string>& at_work) {
  ShardStatus status;
  const fs::path file = shard_record(folder, {number, jobs.shards});
  Record record;
  if (fs::exists(file)) record = read_record(file);
  for (const PlannedRun& planned : shard_of(jobs.plan.runs, {number, jobs.shards})) {
    const RecordedRun* run = find_run(record, planned);
    ++status.runs;
    if (run == nullptr && !planned.recorded) {
      status.seconds_left += planned.seconds;
      continue;
    }
    ++status.recorded;
    if (run == nullptr) continue;
    status.without_result += !run->answer.result;
    status.seconds_planned += planned.seconds, status.seconds_taken += run->seconds;
  }
  const auto known = at_work.find(number);
  const fs::path log = folder / "logs" / fmt::format("run-{}.log", number);
  const std::string said = last_line(log);
  if (status.recorded == status.runs) {
    status.state = "done";
    if (said.starts_with("soilbin: ")) status.words = said;
  } else if (known != at_work.end()) {
    status.state = known->second == "RUNNING" || known->second == "COMPLETING" ? "running" : "waiting";
    status.words = said;
  } else {
    status.state = said.ends_with(stopped_and_kept) ? "stopped" : fs::exists(log) ? "failed" : "missing";
    status.words = said;
  }
  return status;
}

}  // namespace

JobStatus job_status(const fs::path& folder) {
  const WrittenJobs jobs = read_jobs(folder);
  const std::map<int, std::string> at_work = shards_at_work(folder, jobs);
  JobStatus status{.folder = folder, .study = jobs.plan.study};
  double planned = 0, taken = 0;
  for (int k = 1; k <= jobs.shards; ++k) {
    const ShardStatus& shard = status.shards.emplace_back(shard_status(folder, jobs, k, at_work));
    status.runs += shard.runs, status.recorded += shard.recorded, status.without_result += shard.without_result;
    status.seconds_left += shard.seconds_left, planned += shard.seconds_planned, taken += shard.seconds_taken;
  }
  if (planned > 0) status.seconds_left *= taken / planned;
  return status;
}

std::string in_words(const JobStatus& status) {
  Table table{"", {"shard", "runs", "recorded", "state", "last said"}};
  std::map<std::string, int> states;
  for (const ShardStatus& shard : status.shards) {
    table.add({std::to_string(table.rows.size() + 1), std::to_string(shard.runs), std::to_string(shard.recorded),
               shard.state, shard.words});
    ++states[shard.state];
  }
  const int running = states["running"];
  std::string text = fmt::format(
      "{}: {} of {} recorded{}; shards: {} done, {} running, {} waiting, {}{} failed, {} missing", status.study,
      status.recorded, counted(status.runs, "run"),
      status.without_result > 0 ? fmt::format(", {} without a result", status.without_result) : "", states["done"],
      running, states["waiting"], states["stopped"] > 0 ? fmt::format("{} stopped, ", states["stopped"]) : "",
      states["failed"], states["missing"]);
  if (!status.complete())
    text += fmt::format(
        "; {} of work left{}", duration_text(status.seconds_left),
        running > 1 ? fmt::format(", {} for {} at once", duration_text(status.seconds_left / running), running) : "");
  text += "\n\n" + as_text(table);
  if (!status.complete() && running + states["waiting"] == 0)
    text += fmt::format("\ngo on: bash {}\n", shell_words({(status.folder / "sweep.sh").string()}));
  return text;
}

Json to_json(const JobStatus& status) {
  Json rows = Json::array();
  for (const ShardStatus& shard : status.shards)
    rows.push_back(
        {{"shard", rows.size() + 1}, {"runs", shard.runs}, {"recorded", shard.recorded}, {"state", shard.state}});
  return {{"format", "soilbin-sweep-status/1"},
          {"study", status.study},
          {"runs", status.runs},
          {"recorded", status.recorded},
          {"without_result", status.without_result},
          {"seconds_left", status.seconds_left},
          {"shards", rows}};
}

}  // namespace soilbin::compare
