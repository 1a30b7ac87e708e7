// soilbin run: a study, by each of its models at each of its conditions.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/experiments/convergence.hpp"
#include "compare/experiments/run_plan.hpp"
#include "compare/experiments/study_results.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/answer_report.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  OutputFlags outputs;
  std::string study, model, output;
  bool converge = false, dry_run = false;
  ConditionFlags conditions;
  ErrorFlag errors;
  TireFlags tire;
  compare::Doubts notes;  ///< of the tire's flexibility and lugs
  SoilBinFlags soil_bin;
};

/// The report's case, table and data in a folder.
void save(Outputs& outputs, const RunOptions& options, const compare::Report& report) {
  outputs.write(options.output, [&] {
    const fs::path folder = options.output;
    write_file_atomically(folder / "case.yaml", report.resolved_case);
    write_file_atomically(folder / "results.csv", options.outputs.csv.in_dialect(report.csv()));
    write_file_atomically(folder / "results.json", compare::json_text(report.data()));
  });
}

/// Throws InputError for a flag that means nothing beside --converge.
void check_flags_of_converge(const RunOptions& options) {
  const SoilBinFlags& bin = options.soil_bin;
  const std::pair<const char*, bool> given[] = {
      {"--shard", !bin.shard.empty()},
      {"--known", !bin.known.empty()},
      {"--recorded", !bin.recorded.empty()},
      {"--packings", bin.packings != 1},
      {"--half-step", !bin.half_step.empty()},
      {"--coarser-twin", bin.coarser_twin},
      {"--replay", !bin.replay.empty()},
      {"--paraview", !bin.paraview.empty()},
      {"--plot", !options.outputs.plot.empty()},
      {"--report", !options.outputs.report.empty()},
      {"--markdown", !options.outputs.markdown.empty()},
      {"--csv", !options.outputs.csv.file.empty()},
      {"--output", !options.output.empty()},
      {"--json", options.outputs.json && options.dry_run},
  };
  for (const auto& [flag, is_given] : given)
    if (is_given)
      throw InputError(fmt::format(
          "{0} has no effect with --converge{1}, which repeats one condition on one bed and prints what changes\n  "
          "hint: leave out {0}, or --converge",
          flag, options.outputs.json && options.dry_run ? " --dry-run" : ""));
}

/// Throws InputError for a flag that means nothing beside the others.
void check_flags(const RunOptions& options, const CLI::App& command, const Case& question) {
  const SoilBinFlags& bin = options.soil_bin;
  GrainsAsked grains{.asked = asks(question.study, ModelKind::dem)};
  if (asks(question.study, ModelKind::rft)) grains.read_without_them = {wheel_mesh_flag};
  check_flags_of_grains(bin, command, question, grains);
  if (!bin.shard.empty() && !options.dry_run && bin.record.empty())
    throw InputError("--shard needs a record of its own for what it makes\n  hint: --record FILE.json");
}

/// Shows what goes on inside a run behind its name, which the watch is told.
compare::Watch shown_runs(dem::DemSettings& settings) {
  const auto at = std::make_shared<std::string>();
  settings.how.progress = [at](const dem::Progress& progress) { show_progress_of(*at, progress); };
  return [at](const dem::Progress& run) {
    if (interrupt_asked()) throw Interrupted();
    *at = run.stage;
  };
}

/// Calls `work`; what an interrupted one has recorded stays, and the command says how to go on.
auto recording(const RunOptions& options, const auto& work) {
  try {
    return work();
  } catch (const Interrupted&) {
    if (const fs::path file = options.soil_bin.record; !file.empty()) {
      clear_progress_line();
      const std::size_t there = fs::exists(file) ? compare::read_record(file).runs.size() : 0;
      fmt::print(stderr, "{} in {}{}\n", compare::counted(there, "run"), file.string(), compare::stopped_and_kept);
    }
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const compare::TimeStepMatters&) {
    throw;
  } catch (const std::runtime_error& error) {  // a record or a replay that can't be written
    throw std::runtime_error(fmt::format("{}\n  hint: {}", error.what(), finished_runs_stay));
  }
}

/// Doubts about a question that nobody has answered yet, and about the bed that its runs would begin on.
compare::Doubts doubts_before_runs(const RunOptions& options, const Case& question) {
  compare::Doubts doubts = compare::doubts(question);
  append(doubts, bed_doubts(options.soil_bin, question));
  return doubts;
}

/// The study's only condition, again with each numerical choice changed.
int converge(const RunOptions& options, const Case& question, const Session& session) {
  print_warnings(doubts_before_runs(options, question));
  const std::string heading =
      fmt::format("{}: {}\n\n", question.study.name, compare::in_words(question.study.conditions.front()));
  if (options.dry_run) {
    const auto plan = compare::plan_variants(settings_of(options.soil_bin), question, keeping_of(options.soil_bin));
    fmt::print("{}{}", heading, compare::plan_text(plan));
    return done;
  }
  const auto runs = compare::run_variants(settings_of(options.soil_bin), question, session.place.effects,
                                          keeping_of(options.soil_bin));
  if (options.outputs.json) {
    print_json(compare::convergence_json(runs));
  } else {
    fmt::print("{}{}", heading, as_text(compare::convergence_table(runs)));
    for (const auto& [name, run] : runs)
      if (!run.answer.result) fmt::print("{}: {}\n", name, run.answer.error);
  }
  std::vector<compare::RecordedRun> finished;
  for (const auto& [name, run] : runs) finished.push_back(run);
  delete_restarts(finished, {});
  return finished.front().answer.result ? done : failed;
}

/// Makes nothing: the list of runs, which are recorded, and what the others will cost.
int plan(const RunOptions& options, const Case& question) {
  const SoilBinFlags& bin = options.soil_bin;
  const compare::RunPlan plan = compare::plan_of(question, settings_of(bin), bin.runs(question), keeping_of(bin));
  const compare::Doubts doubts = doubts_before_runs(options, question);
  print_warnings(doubts);
  if (options.outputs.json)
    print_json(compare::plan_json(plan), doubts);
  else
    fmt::print("{}", compare::plan_text(plan));
  return done;
}

/// Makes the runs of a shard that the record lacks, and asks nothing.
int make_shard(const RunOptions& options, const Case& question, const Case& whole, const Session& session) {
  const SoilBinFlags& bin = options.soil_bin;
  try {
    recording(options, [&] {
      const std::vector<compare::RunSpec> list = bin.runs(question);
      compare::StudyGrains grains = grains_of(bin);
      const compare::Watch watch = shown_runs(grains.settings);
      compare::RunStore store = compare::store_of(grains.settings, whole, session.place.effects, grains.keeping);
      compare::SoilBinRuns runs(grains.settings, grains.keeping);
      for (std::size_t k = 0; k < list.size(); ++k) {
        if (store.knows(list[k])) continue;
        const std::string name = fmt::format("run {} of {}", k + 1, list.size());
        compare::tell(watch, name, k, list.size());
        print_beside_progress(fmt::format("{}: {}{}", name, compare::in_words(list[k]),
                                          store.find(list[k]) != nullptr ? ", recorded before" : ""));
        obtain(list[k], whole.scenario, store, runs);
      }
      fmt::print("{}: shard {} is done, {} recorded\n", bin.record, bin.shard, compare::counted(list.size(), "run"));
    });
    return done;
  } catch (const Interrupted&) {
    return unfinished;
  }
}

/// Asks every model, and says what it answers.
int answer(const RunOptions& options, const Case& question, const Case& whole,
           const std::optional<dem::StepCriteria>& step, const Session& session) {
  compare::StudyResults answered = recording(options, [&] {
    const SoilBinFlags& bin = options.soil_bin;
    const bool asks_grains = asks(question.study, ModelKind::dem);
    compare::StudyGrains grains;
    compare::Watch watch;
    grains.keeping = keeping_of(bin);
    grains.settings.rig.meshing.drawn = bin.text(wheel_mesh_flag);  // read by resistive force theory too
    if (asks_grains) grains = grains_of(bin);
    if (asks_grains && (!bin.record.empty() || bin.coarser_twin))
      grains.list = bin.runs(question), watch = shown_runs(grains.settings);
    return compare::answer_study(question, whole, grains, session.place.effects, watch, shown_progress());
  });
  answered.step = step;
  answered.doubts.insert(answered.doubts.begin(), options.notes.begin(), options.notes.end());
  compare::Report report = compare::report_on(
      question, answered,
      answered.runs.empty() ? ""
                            : compare::relative_density_of(answered.runs, question.scenario.soil, folder_of_beds()));
  report.resolved_case = write_case(question, session.place.effects);
  report.data = [&] {
    compare::Json document = to_json(question, answered);
    document["case"] = report.resolved_case;
    return document;
  };
  report.csv = [&] { return compare::study_csv(answered.study, compare::remarks_about(question.scenario, answered)); };
  Outputs outputs = publish(report, options.outputs, answered.doubts, session);
  save(outputs, options, report);
  delete_restarts(answered.runs, outputs);
  return outputs.status(done);
}

int run(RunOptions options, const CLI::App& command, const Session& session) {
  SoilBinFlags& bin = options.soil_bin;
  if (options.converge) check_flags_of_converge(options);
  if (!bin.recorded.empty()) bin.recorded = find_record(session.place, options.study, bin.recorded);
  Case question = find_study(session.place, options.study);
  options.errors.apply(question);
  if (!options.model.empty()) check_model(options.model, all_words<ModelKind>());
  compare::choose_models(question.study, value_named<ModelKind>(options.model), !bin.recorded.empty());
  if (bin.recorded.empty()) require_grains(question, session.place.library);
  if (bin.engine == "lammps") compare::name_lammps(question);
  const Case whole = question;  // a record that is begun holds all conditions
  options.conditions.pick(question);
  options.notes = options.tire.apply(question);
  check_flags(options, command, question);
  if (options.converge) return converge(options, question, session);
  if (options.dry_run) return plan(options, question);
  const std::optional<dem::StepCriteria> step = compare::step_of(settings_of(bin), question, bin.recorded);
  if (asks(question.study, ModelKind::dem) && bin.recorded.empty()) tell_grain_doubts(bin, question);
  return bin.shard.empty() ? answer(options, question, whole, step, session)
                           : make_shard(options, question, whole, session);
}

}  // namespace

void add_run(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("run", "a study: every model at every condition, as tables, plots and files");
  const auto options = std::make_shared<RunOptions>();
  add_value(*command, "study", options->study, "STUDY", "a study of the library, or a case file")->required();
  add_value(*command, "--model", options->model, "NAME", "only this model: bekker_wong, dem, rft or cone_index");
  options->outputs.add_to(*command, {.json = "the results as JSON, in SI",
                                     .plot = "draw the curves over slip, or over another condition that varies",
                                     .csv = "save the table"});
  add_folder(*command, "--output", options->output, "save the resolved case and the results", {"case.yaml"});
  command->parse_complete_callback([options] {
    const OutputFlags& outputs = options->outputs;
    outputs.csv.needs_a_file(!options->output.empty() || !outputs.markdown.empty(), "--output");
  });
  command
      ->add_flag("--converge", options->converge,
                 "run one condition again with each numerical choice halved or doubled")
      ->group(grains_heading);
  options->conditions.add_to(*command);
  options->errors.add_to(*command);
  options->tire.add_to(*command);
  options->soil_bin.add_to(*command);
  options->soil_bin.add_half_step_to(*command);
  options->soil_bin.add_coarser_twin_to(*command);
  options->soil_bin.add_engine_to(*command);
  command
      ->add_flag("--dry-run", options->dry_run,
                 "make nothing; list the runs, which are recorded, and what the others will cost")
      ->group(grains_heading);
  options->soil_bin.add_shard_to(*command);
  options->soil_bin.add_known_to(*command);
  add_file(*command, "--replay", options->soil_bin.replay, "FILE",
           "keep the motion of the first run that is made, for the page of compare --replay")
      ->group(grains_heading);
  add_folder(*command, "--paraview", options->soil_bin.paraview,
             "keep the motion of each run that is made, for ParaView")
      ->group(grains_heading);
  command->footer(
      "Each condition flag keeps the study's conditions that agree with it; where none does, it overrides them. Where\n"
      "the study gives 'rotation' it stays, and the speed follows.\n"
      "Example: soilbin run paper-straight --load 4kN --plot pull.svg");
  command->callback([=, &session] { session.action = [=, &session] { return run(*options, *command, session); }; });
}

}  // namespace soilbin::cli
