// soilbin sweep: a study's runs of grains as jobs of a cluster, or as processes of this machine.
#include <fmt/core.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "cli/command_words.hpp"
#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/question.hpp"
#include "cli/sweep_script.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/json_file.hpp"
#include "compare/sweep/result_json.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* sweep_format = "soilbin-sweep/1";

struct SweepOptions {
  std::string study, folder, on, output, at_least;
  int shards = 0, at_once = 0;
  bool submit = false, json = false;
  ConditionFlags conditions;
  SoilBinFlags soil_bin;
};

/// Flags as they were typed, of those that `understood` has too, or, without it, of all but the sweep's own.
std::vector<std::string> typed_again(const CLI::App& command, const CLI::App* understood) {
  const std::set<std::string> own = {"--on", "--output", "--at-least", "--shards", "--at-once", "--submit", "--json"};
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (understood != nullptr ? understood->get_option_no_throw(name) == nullptr : own.contains(name)) continue;
    for (const std::string& value : option->results()) words.push_back(name + "=" + value);
  }
  return words;
}

/// What the sweep is: the script is written from it, and status reads it again.
Json sweep_json(const SweepJobs& jobs) {
  Json document = plan_json(jobs.plan);
  document["format"] = sweep_format;
  document["on"] = jobs.on == SweepOn::slurm ? "slurm" : "local";
  document["shards"] = jobs.shards;
  return document;
}

struct Sweep {
  bool slurm = false;
  int shards = 1;
  RunPlan plan;
};

Sweep read_sweep(const fs::path& folder) {
  const fs::path file = folder / "sweep.json";
  const std::string hint = "a sweep is written by 'soilbin sweep STUDY --on slurm'; its status is told by its folder";
  if (!fs::exists(file)) throw InputError(fmt::format("{} holds no sweep\n  hint: {}", folder.string(), hint));
  const Json document = compare::parse_json(read_source_text(file, compare::largest_json), hint);
  return compare::read_json_at(file.string(), [&] {
    if (document.at("format") != sweep_format)
      throw InputError(fmt::format("{}: expected the format '{}'", file.string(), sweep_format));
    Sweep sweep{document.at("on") == "slurm", document.at("shards").get<int>(), {document.at("study"), {}}};
    for (const Json& row : document.at("runs"))
      sweep.plan.runs.push_back({{compare::condition_from_json(row, file.string()),
                                  row.at("packing").get<std::uint64_t>(), row.at("half_step").get<bool>()},
                                 row.at("recorded").get<bool>(),
                                 row.at("seconds").get<double>()});
    return sweep;
  });
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The last line of a log that begins a message; "" where there is none.
std::string last_line(const fs::path& file) {
  std::istringstream lines(text_of(file));
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty() && line.front() != ' ') last = line;
  return last;
}

/// What Slurm says of the tasks of a job array that it still knows: "RUNNING", "PENDING", ...
std::map<int, std::string> tasks_of(const std::string& job) {
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
std::map<int, std::string> shards_at_work(const fs::path& folder, const Sweep& sweep) {
  if (sweep.slurm) {
    std::string beds, runs;
    std::istringstream(text_of(folder / "jobs")) >> beds >> runs;
    return tasks_of(runs);
  }
  std::map<int, std::string> states;
  for (int k = 1; k <= sweep.shards; ++k) {
    int process = 0;
    if (std::istringstream(text_of(folder / "running" / std::to_string(k))) >> process && ::kill(process, 0) == 0)
      states[k] = "RUNNING";
  }
  return states;
}

/// How far a shard is.
struct ShardStatus {
  std::size_t runs = 0, recorded = 0, without_result = 0;
  double seconds_left = 0, seconds_planned = 0, seconds_taken = 0;  ///< planned and taken: of what is recorded
  std::string state, words;
};

ShardStatus status_of(const fs::path& folder, const Sweep& sweep, int number,
                      const std::map<int, std::string>& at_work) {
  ShardStatus status;
  const fs::path file = shard_record(folder, {number, sweep.shards});
  compare::Record record;
  if (fs::exists(file)) record = compare::read_record(file);
  for (const std::size_t i : runs_of_shard(sweep.plan, {number, sweep.shards})) {
    const PlannedRun& planned = sweep.plan.runs[i];
    const compare::RecordedRun* run = compare::find_run(record, planned.run);
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
    status.state = fs::exists(log) ? "failed" : "missing";
    status.words = said;
  }
  return status;
}

int show_status(const fs::path& folder, bool json) {
  const Sweep sweep = read_sweep(folder);
  const std::map<int, std::string> at_work = shards_at_work(folder, sweep);
  TextTable table({"shard", "runs", "recorded", "state", "last said"});
  Json rows = Json::array();
  std::map<std::string, int> states;
  std::size_t runs = 0, recorded = 0, without_result = 0;
  double left = 0, planned = 0, taken = 0;
  for (int k = 1; k <= sweep.shards; ++k) {
    const ShardStatus shard = status_of(folder, sweep, k, at_work);
    table.add(
        {std::to_string(k), std::to_string(shard.runs), std::to_string(shard.recorded), shard.state, shard.words});
    rows.push_back({{"shard", k}, {"runs", shard.runs}, {"recorded", shard.recorded}, {"state", shard.state}});
    ++states[shard.state];
    runs += shard.runs, recorded += shard.recorded, without_result += shard.without_result;
    left += shard.seconds_left, planned += shard.seconds_planned, taken += shard.seconds_taken;
  }
  if (planned > 0) left *= taken / planned;
  const double wall = left / std::max(1, states["running"]);
  if (json) {
    print_json({{"format", "soilbin-sweep-status/1"},
                {"study", sweep.plan.study},
                {"runs", runs},
                {"recorded", recorded},
                {"without_result", without_result},
                {"seconds_left", left},
                {"shards", rows}});
    return recorded == runs ? done : unfinished;
  }
  fmt::print("{}: {} of {} recorded{}; shards: {} done, {} running, {} waiting, {} failed, {} missing",
             sweep.plan.study, recorded, compare::counted(runs, "run"),
             without_result > 0 ? fmt::format(", {} without a result", without_result) : "", states["done"],
             states["running"], states["waiting"], states["failed"], states["missing"]);
  if (recorded < runs)
    fmt::print("; {} of work left{}", duration_text(left),
               states["running"] > 1 ? fmt::format(", {} for {} at once", duration_text(wall), states["running"]) : "");
  fmt::print("\n\n{}", table.text());
  if (recorded == runs) return done;
  if (states["running"] + states["waiting"] == 0)
    fmt::print("\ngo on: bash {}\n", command_line({(folder / "sweep.sh").string()}).substr(8));
  return unfinished;
}

SweepJobs jobs_of(const SweepOptions& asked, const Case& question, const CLI::App& command) {
  SweepJobs jobs;
  jobs.on = asked.on == "slurm" ? SweepOn::slurm : SweepOn::local;
  SoilBinFlags flags = asked.soil_bin;
  if (flags.threads == 0) flags.threads = 1;  // many processes, a core each
  jobs.plan = plan_of(question, flags, flags.tests_step(question));
  const double at_least = asked.at_least.empty() ? (jobs.on == SweepOn::slurm ? 1800 : 60)
                                                 : read_flag("--at-least", asked.at_least, {"s", zero_or_more});
  jobs.shards = asked.shards > 0 ? asked.shards : shards_for(jobs.plan, at_least);
  jobs.at_once = asked.at_once > 0 ? asked.at_once : std::max(1, all_cores() / flags.threads);
  jobs.program = this_program(), jobs.here = fs::current_path();
  jobs.folder = fs::absolute(asked.output.empty() ? "sweep-" + question.study.name : asked.output).lexically_normal();
  jobs.beds = fs::absolute(folder_of_beds()).lexically_normal();
  CLI::App bed;
  SoilBinFlags of_bed;
  of_bed.add_rig_to(bed), of_bed.add_packings_to(bed);
  jobs.known = flags.known;
  jobs.run_words = {asked.study, "--model=dem"}, jobs.bed_words = {asked.study};
  for (std::string& word : typed_again(command, nullptr)) jobs.run_words.push_back(std::move(word));
  for (std::string& word : typed_again(command, &bed)) jobs.bed_words.push_back(std::move(word));
  if (asked.soil_bin.threads == 0)
    for (auto* words : {&jobs.run_words, &jobs.bed_words}) words->push_back("--threads=1");
  return jobs;
}

int sweep(const SweepOptions& asked, const CLI::App& command, const Session& session) {
  if (asked.study == "status") {
    if (asked.folder.empty()) throw InputError("sweep status: which?\n  hint: soilbin sweep status sweep-NAME");
    return show_status(asked.folder, asked.json);
  }
  if (!asked.folder.empty()) throw InputError("sweep: one study, not also '" + clipped(asked.folder) + "'");
  if (asked.on.empty())
    throw InputError("sweep: where?\n  hint: --on slurm, or --on local for processes of this machine");
  Case question = find_study(session.place, asked.study);
  asked.conditions.pick(question.study, question.scenario.tire);
  print_warnings(compare::doubts(question));
  const SweepJobs jobs = jobs_of(asked, question, command);
  for (const char* part : {"shards", "logs", "running"}) make_folder(jobs.folder / part);
  const fs::path script = jobs.folder / "sweep.sh";
  write_file_atomically(jobs.folder / "sweep.json", compare::json_text(sweep_json(jobs)));
  write_file_atomically(script, sweep_script(jobs));
  fmt::print("wrote {}: {} in {}, about {:.2g} core-hours\n", script.string(),
             compare::counted(jobs.plan.runs.size(), "run"),
             compare::counted(static_cast<std::size_t>(jobs.shards), "shard"), jobs.plan.core_hours_left());
  const std::string start = "bash " + command_line({script.string()}).substr(8);
  if (!asked.submit) {
    fmt::print("start it: {}\n", start);
    return done;
  }
  std::fflush(stdout);
  const int status = std::system(start.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : failed;
}

}  // namespace

void add_sweep(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("sweep", "make a study's runs of grains as jobs, of Slurm or on this machine");
  const auto asked = std::make_shared<SweepOptions>();
  command->add_option("study", asked->study, "a study of the library, or a case file; or the word status")
      ->type_name("STUDY|status")
      ->required();
  command->add_option("folder", asked->folder, "with status: folder of the sweep")->type_name("DIR");
  command->add_option("--on", asked->on, "who runs the jobs")
      ->type_name("slurm|local")
      ->check(CLI::IsMember({"slurm", "local"}));
  add_folder(*command, "--output", asked->output, "folder for script, records and logs; sweep-NAME");
  command->add_option("--at-least", asked->at_least, "time that a job should take; 30 min on Slurm, 1 min here")
      ->type_name("TIME");
  command->add_option("--shards", asked->shards, "number of jobs, in place of --at-least")
      ->type_name("N")
      ->check(whole_number(1));
  command->add_option("--at-once", asked->at_once, "local: processes side by side; as many as cores")
      ->type_name("N")
      ->check(whole_number(1));
  command->add_flag("--submit", asked->submit, "start it now");
  command->add_flag("--json", asked->json, "status: as JSON, in SI");
  asked->conditions.add_to(*command);
  asked->soil_bin.add_rig_to(*command);
  asked->soil_bin.add_starting_to(*command);
  asked->soil_bin.add_packings_to(*command);
  asked->soil_bin.add_known_to(*command);
  asked->soil_bin.add_half_step_to(*command);
  command->footer(
      "Writes a script that settles the beds, makes the runs in shards and merges their records; whoever starts it "
      "again\n"
      "goes on with it. The other flags are those of soilbin run. Without --threads a process takes one.\n"
      "Example: soilbin sweep paper-straight --settling-friction 0 --packings 3 --on slurm --submit\n"
      "         soilbin sweep status sweep-paper-straight");
  command->callback([=, &session] { session.action = [=, &session] { return sweep(*asked, *command, session); }; });
}

}  // namespace soilbin::cli
