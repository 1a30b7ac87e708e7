// The script that makes the jobs of a sweep (jobs.hpp).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "compare/experiments/jobs.hpp"
#include "compare/report/javascript.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/shell_words.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::compare {

/// The files of compare/experiments/scripts; made by the build.
std::vector<EmbeddedFile> job_scripts();

namespace {

std::string quoted(const std::vector<std::string>& words) { return shell_words(words); }
std::string quoted(const std::filesystem::path& path) { return shell_words({path.string()}); }

double longest_shard(const Jobs& jobs) {
  double longest = 0;
  for (int k = 1; k <= jobs.shards; ++k) {
    double seconds = 0;
    for (const PlannedRun& run : shard_of(jobs.plan.runs, {k, jobs.shards})) seconds += run.seconds;
    longest = std::max(longest, seconds);
  }
  return longest;
}

/// Twice what it should take and ten minutes: estimates are rough, and a job that needs more goes to the queue again.
int minutes_for(double seconds) { return static_cast<int>(std::ceil(2 * seconds / 60)) + 10; }

std::string script_head(const Jobs& jobs) {
  const RunPlan& plan = jobs.plan;
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "# {study}: {runs} of grains on {beds} in {shards}, about {hours:.2g} core-hours. Written by soilbin sweep.\n"
      "# start it, or go on with it: bash {script}\n"
      "# how far it is:             soilbin sweep status {folder}\n"
      "# It may be stopped at any moment and started again: what is recorded is not made again.\n"
      "set -u\n"
      "cd {here}\n"
      "export SOILBIN_BEDS={bed_folder}\n",
      fmt::arg("study", quoted(std::vector{plan.study})), fmt::arg("runs", counted(plan.runs.size(), "run")),
      fmt::arg("beds", counted(plan.beds, "bed")),
      fmt::arg("shards", counted(static_cast<std::size_t>(jobs.shards), "shard")),
      fmt::arg("hours", plan.core_hours_left()), fmt::arg("script", quoted(jobs.folder / "sweep.sh")),
      fmt::arg("folder", quoted(jobs.folder)), fmt::arg("here", quoted(jobs.here)),
      fmt::arg("bed_folder", quoted(jobs.beds)));
  if (const char* cases = std::getenv("SOILBIN_CASES"))
    text += fmt::format("export SOILBIN_CASES={}\n", quoted(std::vector<std::string>{cases}));
  return text + fmt::format("soilbin={}\nfolder={}\nbed=({})\nrun=({})\n\n", quoted(jobs.program), quoted(jobs.folder),
                            quoted(jobs.bed_words), quoted(jobs.run_words));
}

/// A file of compare/experiments/scripts, its places "@name@" filled in; places in a value stay as they are.
std::string filled(const char* script, const std::map<std::string, std::string>& places) {
  const std::string text = embedded(job_scripts(), script);
  std::string all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = std::min(text.find('@', at), text.size()), end = text.find('@', begin + 1);
    all += text.substr(at, begin - at);
    const auto place = end == text.npos ? places.end() : places.find(text.substr(begin + 1, end - begin - 1));
    all += place != places.end() ? place->second : text.substr(begin, 1);
    at = place != places.end() ? end + 1 : begin + 1;
  }
  return all;
}

std::string script_of(const Jobs& jobs) {
  const auto text_of = [](const auto& number) { return fmt::format("{}", number); };
  const std::string merge = filled("merge.sh", {{"known", jobs.known.empty() ? "" : " " + quoted(jobs.known)}});
  const std::string beds = text_of(jobs.plan.beds), shards = text_of(jobs.shards);
  if (jobs.on == JobsOn::local)
    return filled("local.sh",
                  {{"at_once", text_of(jobs.at_once)}, {"beds", beds}, {"shards", shards}, {"merge", merge}});
  return filled("slurm.sh", {{"beds", beds},
                             {"shards", shards},
                             {"merge", merge},
                             {"threads", text_of(jobs.plan.threads)},
                             {"memory", text_of(std::ceil(1.5 * jobs.plan.memory / 1e6) + 100)},
                             {"name", quoted(std::vector{jobs.plan.study})},
                             {"bed_minutes", text_of(minutes_for(jobs.plan.bed_seconds))},
                             {"run_minutes", text_of(minutes_for(longest_shard(jobs)))}});
}

}  // namespace

int shards_for(const RunPlan& plan, double at_least) {
  double seconds = 0;
  for (const PlannedRun& run : plan.runs) seconds += run.seconds;
  const int most = std::max(1, static_cast<int>(plan.runs.size()));
  return std::clamp(static_cast<int>(std::min<double>(most, seconds / std::max(at_least, 1e-3))), 1, most);
}

std::filesystem::path shard_record(const std::filesystem::path& folder, const Shard& shard) {
  return folder / "shards" / fmt::format("{}-of-{}.json", shard.number, shard.of);
}

void write_jobs(const Jobs& jobs) {
  for (const char* part : {"shards", "logs", "running"}) make_folder(jobs.folder / part);
  Json document = plan_json(jobs.plan);
  document["format"] = jobs_format;
  document["on"] = jobs.on == JobsOn::slurm ? "slurm" : "local";
  document["shards"] = jobs.shards;
  write_file_atomically(jobs.folder / "sweep.json", json_text(document));
  write_file_atomically(jobs.folder / "sweep.sh", script_head(jobs) + script_of(jobs));
}

}  // namespace soilbin::compare
