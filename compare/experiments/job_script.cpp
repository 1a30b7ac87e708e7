// The script that makes the jobs of a sweep (jobs.hpp).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "compare/experiments/jobs.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/shell_words.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::compare {
namespace {

std::string quoted(const std::vector<std::string>& words) { return shell_words(words); }
std::string quoted(const std::filesystem::path& path) { return shell_words({path.string()}); }

double longest_shard(const Jobs& jobs) {
  double longest = 0;
  for (int k = 1; k <= jobs.shards; ++k) {
    double seconds = 0;
    for (const std::size_t i : runs_of_shard(jobs.plan, {k, jobs.shards})) seconds += jobs.plan.runs[i].seconds;
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
      fmt::arg("study", plan.study), fmt::arg("runs", counted(plan.runs.size(), "run")),
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

std::string merge_job(const Jobs& jobs) {
  return fmt::format(
      "  merge)\n"
      "    \"$soilbin\" record merge \"$folder/record.json\" \"$folder\"/shards/*.json{}\n"
      "    \"$soilbin\" sweep status \"$folder\"\n"
      "    ;;\n",
      jobs.known.empty() ? "" : " " + quoted(jobs.known));
}

std::string slurm_script(const Jobs& jobs) {
  return script_head(jobs) +
         fmt::format(
             R"(# A job that is stopped before its time limit ends with 3 and goes to the queue again.
again() {{
  srun --cpus-per-task={threads} "$@"
  status=$?
  [ $status -ne 3 ] || scontrol requeue "$SLURM_JOB_ID"
  exit $status
}}

case "${{1-submit}}" in
  bed) again "$soilbin" bed "${{bed[@]}}" --shard "$SLURM_ARRAY_TASK_ID/{beds}" ;;
  run)
    part=$SLURM_ARRAY_TASK_ID
    again "$soilbin" run "${{run[@]}}" --shard "$part/{shards}" --record "$folder/shards/$part-of-{shards}.json"
    ;;
{merge}  submit)
    job() {{
      sbatch --parsable --requeue --signal=TERM@60 --open-mode=append --ntasks=1 --cpus-per-task={threads} --mem={memory}M "$@"
    }}
    beds=$(job --job-name={name}-beds --array=1-{beds} --time={bed_minutes} --output="$folder/logs/bed-%a.log" \
      "$folder/sweep.sh" bed) &&
      runs=$(job --job-name={name}-runs --array=1-{shards} --time={run_minutes} --output="$folder/logs/run-%a.log" \
        --dependency="afterany:$beds" "$folder/sweep.sh" run) &&
      merge=$(job --job-name={name}-merge --time=10 --output="$folder/logs/merge.log" \
        --dependency="afterany:$runs" "$folder/sweep.sh" merge) || exit
    echo "$beds $runs $merge" >"$folder/jobs"
    echo "submitted: beds $beds, runs $runs, merge $merge"
    ;;
esac
)",
             fmt::arg("beds", jobs.plan.beds), fmt::arg("shards", jobs.shards), fmt::arg("merge", merge_job(jobs)),
             fmt::arg("threads", jobs.plan.threads), fmt::arg("memory", std::ceil(1.5 * jobs.plan.memory / 1e6) + 100),
             fmt::arg("name", quoted(std::vector{jobs.plan.study})),
             fmt::arg("bed_minutes", minutes_for(jobs.plan.bed_seconds)),
             fmt::arg("run_minutes", minutes_for(longest_shard(jobs))));
}

std::string local_script(const Jobs& jobs) {
  return script_head(jobs) + fmt::format(
                                 R"(# The job KIND for each of 1 .. COUNT, {at_once} at once.
each() {{ seq "$2" | xargs -P {at_once} -I NUMBER bash "$folder/sweep.sh" "$1" NUMBER; }}

case "${{1-all}}" in
  bed) exec "$soilbin" bed "${{bed[@]}}" --shard "$2/{beds}" >>"$folder/logs/bed-$2.log" 2>&1 ;;
  run)
    echo $$ >"$folder/running/$2"  # this process, which soilbin becomes
    exec "$soilbin" run "${{run[@]}}" --shard "$2/{shards}" --record "$folder/shards/$2-of-{shards}.json" \
      >>"$folder/logs/run-$2.log" 2>&1
    ;;
{merge}  all)
    each bed {beds}
    each run {shards}
    bash "$folder/sweep.sh" merge
    ;;
esac
)",
                                 fmt::arg("at_once", jobs.at_once), fmt::arg("beds", jobs.plan.beds),
                                 fmt::arg("shards", jobs.shards), fmt::arg("merge", merge_job(jobs)));
}

}  // namespace

int shards_for(const RunPlan& plan, double at_least) {
  double seconds = 0;
  for (const PlannedRun& run : plan.runs) seconds += run.seconds;
  const int most = std::max(1, static_cast<int>(plan.runs.size()));
  return std::clamp(static_cast<int>(std::min<double>(most, seconds / std::max(at_least, 1e-3))), 1, most);
}

std::vector<std::size_t> runs_of_shard(const RunPlan& plan, const Shard& shard) {
  std::vector<AskedRun> list;
  for (const PlannedRun& run : plan.runs) list.push_back(run.run);
  std::vector<std::size_t> places;
  std::size_t from = 0;
  for (int k = 1; k <= shard.number; ++k) {  // shards are stretches of the list, one behind the other
    const std::size_t size = shard_of(list, {k, shard.of}).size();
    if (k == shard.number)
      for (std::size_t i = from; i < from + size; ++i) places.push_back(i);
    from += size;
  }
  return places;
}

std::filesystem::path shard_record(const std::filesystem::path& folder, const Shard& shard) {
  return folder / "shards" / fmt::format("{}-of-{}.json", shard.number, shard.of);
}

std::string job_script(const Jobs& jobs) { return jobs.on == JobsOn::slurm ? slurm_script(jobs) : local_script(jobs); }

void write_jobs(const Jobs& jobs) {
  for (const char* part : {"shards", "logs", "running"}) make_folder(jobs.folder / part);
  Json document = plan_json(jobs.plan);
  document["format"] = jobs_format;
  document["on"] = jobs.on == JobsOn::slurm ? "slurm" : "local";
  document["shards"] = jobs.shards;
  write_file_atomically(jobs.folder / "sweep.json", json_text(document));
  write_file_atomically(jobs.folder / "sweep.sh", job_script(jobs));
}

}  // namespace soilbin::compare
