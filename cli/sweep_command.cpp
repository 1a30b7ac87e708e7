// soilbin sweep: a study's runs of grains as jobs of a cluster, or as processes of this machine.
#include <fmt/core.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/experiments/jobs.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/shell_words.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

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

/// The folder of a study's jobs, here, whatever the study is called.
std::string usual_folder(const Study& study) {
  std::string name = "sweep-" + study.name;
  std::ranges::replace(name, '/', '-');
  return name;
}

compare::Jobs jobs_of(const SweepOptions& asked, const Case& question, const CLI::App& command) {
  compare::Jobs jobs;
  jobs.on = asked.on == "slurm" ? compare::JobsOn::slurm : compare::JobsOn::local;
  SoilBinFlags flags = asked.soil_bin;
  if (flags.threads == 0) flags.threads = 1;  // many processes, a core each
  jobs.plan = compare::plan_of(question, settings_of(flags), flags.runs(question), keeping_of(flags));
  const double at_least = asked.at_least.empty() ? compare::usual_seconds(jobs.on)
                                                 : read_flag("--at-least", asked.at_least, {"s", zero_or_more});
  if (asked.shards > static_cast<int>(jobs.plan.runs.size()))
    throw InputError(fmt::format("--shards {}: a shard makes a run or more, and the study has {}", asked.shards,
                                 jobs.plan.runs.size()));
  jobs.shards = asked.shards > 0 ? asked.shards : compare::shards_for(jobs.plan, at_least);
  jobs.at_once = asked.at_once > 0 ? asked.at_once : compare::side_by_side(all_cores(), flags.threads);
  jobs.program = this_program(), jobs.here = fs::current_path();
  jobs.folder = fs::absolute(asked.output.empty() ? usual_folder(question.study) : asked.output).lexically_normal();
  jobs.beds = fs::absolute(folder_of_beds()).lexically_normal();
  CLI::App bed;
  SoilBinFlags of_bed;
  of_bed.add_bed_to(bed), of_bed.add_packings_to(bed);
  jobs.known = flags.known;
  jobs.run_words = {asked.study, "--model=dem"}, jobs.bed_words = {asked.study};
  for (std::string& word : typed_again(command, nullptr)) jobs.run_words.push_back(std::move(word));
  for (std::string& word : typed_again(command, &bed)) jobs.bed_words.push_back(std::move(word));
  if (asked.soil_bin.threads == 0)
    for (auto* words : {&jobs.run_words, &jobs.bed_words}) words->push_back("--threads=1");
  return jobs;
}

/// Throws InputError for flags that the way in which the command is called doesn't read.
void check_flags(const SweepOptions& asked, const CLI::App& command) {
  const bool status = asked.study == "status";
  for (const CLI::Option* option : command.get_options())
    if (status && option->count() > 0 && !option->get_lnames().empty() && option->get_lnames().front() != "json")
      throw InputError(
          fmt::format("--{} has no effect on a status\n  hint: leave it out", option->get_lnames().front()));
  if (asked.json && !status) throw InputError("--json is for the status\n  hint: soilbin sweep status DIR --json");
  if (asked.at_once > 0 && asked.on == "slurm")
    throw InputError("--at-once has no effect on Slurm's jobs, which start as there is room\n  hint: --on local");
}

int sweep(const SweepOptions& asked, const CLI::App& command, const Session& session) {
  check_flags(asked, command);
  if (asked.study == "status") {
    if (asked.folder.empty()) throw InputError("sweep status: which?\n  hint: soilbin sweep status sweep-NAME");
    const compare::JobStatus status = compare::job_status(asked.folder);
    asked.json ? print_json(to_json(status)) : fmt::print("{}", in_words(status));
    return status.complete() ? done : unfinished;
  }
  if (!asked.folder.empty()) throw InputError("sweep: one study, not also '" + clipped(asked.folder) + "'");
  if (asked.on.empty())
    throw InputError("sweep: where?\n  hint: --on slurm, or --on local for processes of this machine");
  Case question = find_study(session.place, asked.study);
  asked.conditions.pick(question);
  check_flags_of_grains(asked.soil_bin, command, question);
  print_warnings(compare::doubts(question)), print_warnings(bed_doubts(asked.soil_bin, question));
  const compare::Jobs jobs = jobs_of(asked, question, command);
  compare::write_jobs(jobs);
  const fs::path script = jobs.folder / "sweep.sh";
  fmt::print("wrote {}: {} in {}, about {:.2g} core-hours\n", script.string(),
             compare::counted(jobs.plan.runs.size(), "run"),
             compare::counted(static_cast<std::size_t>(jobs.shards), "shard"), jobs.plan.core_hours_left());
  const std::string start = "bash " + compare::shell_words({script.string()});
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
  add_value(*command, "study", asked->study, "STUDY|status",
            "a study of the library, or a case file; or the word status")
      ->required();
  add_value(*command, "folder", asked->folder, "DIR", "with status: folder of the sweep");
  add_value(*command, "--on", asked->on, "slurm|local", "who runs the jobs")->check(CLI::IsMember({"slurm", "local"}));
  add_folder(*command, "--output", asked->output, "folder for script, records and logs; sweep-NAME");
  add_value(*command, "--at-least", asked->at_least, "TIME",
            fmt::format("time that a job should take; {:.0f} min on Slurm, {:.0f} min here",
                        compare::usual_seconds(compare::JobsOn::slurm) / 60,
                        compare::usual_seconds(compare::JobsOn::local) / 60));
  add_value(*command, "--shards", asked->shards, "N", "number of jobs, in place of --at-least")
      ->check(whole_number(1))
      ->excludes("--at-least");
  add_value(*command, "--at-once", asked->at_once, "N", "local: processes side by side; as many as cores")
      ->check(whole_number(1, 1000));
  command->add_flag("--submit", asked->submit, "start it now");
  command->add_flag("--json", asked->json, "status: as JSON, in SI");
  asked->conditions.add_to(*command);
  asked->soil_bin.add_rig_to(*command);
  asked->soil_bin.add_starting_to(*command);
  asked->soil_bin.add_patch_to(*command);
  asked->soil_bin.add_packings_to(*command);
  asked->soil_bin.add_known_to(*command);
  asked->soil_bin.add_half_step_to(*command);
  asked->soil_bin.add_coarser_twin_to(*command);
  command->footer(
      "Writes a script that settles the beds, makes the runs in shards and merges their records; whoever starts it "
      "again\n"
      "goes on with it. The other flags are those of soilbin run. Without --threads a process takes one.\n"
      "Example: soilbin sweep paper-straight --settling-friction 0 --packings 3 --on slurm --submit\n"
      "         soilbin sweep status sweep-paper-straight");
  command->callback([=, &session] { session.action = [=, &session] { return sweep(*asked, *command, session); }; });
}

}  // namespace soilbin::cli
