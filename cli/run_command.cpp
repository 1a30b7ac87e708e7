// soilbin run: a study, by each of its models at each of its conditions.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/experiments/convergence.hpp"
#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string study, model, plot, csv, output, half_step;
  bool json = false, converge = false;
  ConditionFlags conditions;
  ErrorFlag errors;
  SoilBinFlags soil_bin;
};

void keep_model(Case& question, const std::string& name) {
  if (name.empty()) return;
  std::vector<std::string> right;
  std::optional<ModelKind> kind;
  for (const Word<ModelKind>& word : words_of(std::type_identity<ModelKind>{})) {
    if (word.text == name) kind = word.value;
    right.emplace_back(word.text);
  }
  if (!kind) throw InputError("--model: unknown model '" + clipped(name) + "'" + did_you_mean(name, right));
  std::vector<ModelChoice> kept;
  for (const ModelChoice& choice : question.study.models)
    if (choice.model == *kind) kept.push_back(choice);
  if (kept.empty()) kept.push_back({*kind, {}, name});
  question.study.models = std::move(kept);
}

/// A record answers beside the study's own models.
void add_dem(Case& question) {
  for (const ModelChoice& choice : question.study.models)
    if (choice.model == ModelKind::dem) return;
  question.study.models.push_back({ModelKind::dem, {}, "dem"});
}

/// What the models answered, and what is doubtful in it.
struct Answered {
  std::vector<compare::ModelAnswers> study;
  std::vector<std::string> doubts;
  std::optional<dem::StepCriteria> step;  ///< of grains
};

nlohmann::ordered_json document_of(const Case& question, const Answered& answered) {
  nlohmann::ordered_json document = {{"format", "soilbin-run/1"},
                                     {"study", question.study.name},
                                     {"tire", question.scenario.tire.name},
                                     {"soil", question.scenario.soil.name},
                                     {"rows", compare::rows_json(answered.study)}};
  compare::tell_doubts(document, answered.doubts);
  if (answered.step) document["dem"] = compare::to_json(*answered.step);
  return document;
}

void save(Outputs& outputs, const RunOptions& options, const Case& question, const Answered& answered,
          const Workplace& place) {
  const std::vector<compare::ModelAnswers>& study = answered.study;
  outputs.file(options.csv, [&] { return compare::study_csv(study); });
  outputs.drawing(options.plot, [&] { return compare::study_sheet(question, study); });
  outputs.write(options.output, [&] {
    const fs::path folder = options.output;
    write_file_atomically(folder / "case.yaml", write_case(question, place.effects));
    write_file_atomically(folder / "results.csv", compare::study_csv(study));
    write_file_atomically(folder / "results.json", compare::json_text(document_of(question, answered)));
  });
}

bool tests_step(const RunOptions& options, const Case& question) {
  const auto& models = question.study.models;
  const SoilBinFlags& bin = options.soil_bin;
  if (bin.record.empty() || std::none_of(models.begin(), models.end(),
                                         [](const ModelChoice& choice) { return choice.model == ModelKind::dem; }))
    return false;
  if (!options.half_step.empty()) return options.half_step == "yes";
  return question.study.conditions.size() * static_cast<std::size_t>(bin.packings) >= compare::runs_that_pay_a_test;
}

/// Runs the study; what an interrupted one has recorded stays, and the command says how to go on.
std::vector<compare::ModelAnswers> answers_to(const Case& question, const compare::MakeModel& make,
                                              const RunOptions& options, const RunLog& log) {
  try {
    return compare::run_study(question, shown_progress(), make);
  } catch (const Interrupted&) {
    if (!options.soil_bin.record.empty())
      fmt::print(stderr, "\n{} runs are in {}: the same command goes on from there", log->size(),
                 options.soil_bin.record);
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {  // a record or a replay that can't be written
    throw std::runtime_error(fmt::format("{}\n  hint: {}", error.what(), finished_runs_stay));
  }
}

/// The study's only condition, again with each numerical choice changed.
int converge(const RunOptions& options, const Case& question, const Session& session) {
  const auto runs = compare::run_variants(settings_of(options.soil_bin), question, session.place.effects,
                                          keeping_of(options.soil_bin));
  if (options.json) {
    fmt::print("{}", compare::json_text(compare::convergence_json(runs)));
  } else {
    fmt::print("{}: {}\n\n{}", question.study.name, compare::in_words(question.study.conditions.front()),
               as_text(compare::convergence_table(runs)));
    for (const auto& [name, run] : runs)
      if (!run.answer.result) fmt::print("{}: {}\n", name, run.answer.error);
  }
  std::vector<compare::RecordedRun> finished;
  for (const auto& [name, run] : runs) finished.push_back(run);
  forget_runs(finished, {});
  return finished.front().answer.result ? done : failed;
}

int run(RunOptions options, const Session& session) {
  if (!options.soil_bin.recorded.empty())
    options.soil_bin.recorded = find_record(session.place, options.study, options.soil_bin.recorded);
  Case question = find_study(session.place, options.study);
  options.errors.apply(question.scenario.soil);
  keep_model(question, options.model);
  if (!options.soil_bin.recorded.empty() && options.model.empty()) add_dem(question);
  if (options.converge) {
    options.conditions.pick(question.study, question.scenario.tire);
    return converge(options, question, session);
  }
  const RunLog log = std::make_shared<std::vector<compare::RecordedRun>>();
  const compare::MakeModel make = models_with(options.soil_bin, question, session.place.effects, log);
  options.conditions.pick(question.study, question.scenario.tire);
  const std::optional<dem::StepCriteria> step =
      compare::step_of(settings_of(options.soil_bin), question, options.soil_bin.recorded);
  if (tests_step(options, question))
    compare::test_time_step(settings_of(options.soil_bin), question, session.place.effects,
                            keeping_of(options.soil_bin));
  Answered answered{.study = {}, .doubts = {}, .step = step};
  answered.study = answers_to(question, make, options, log);
  answered.doubts = compare::doubts(question, answered.study);
  if (!options.soil_bin.record.empty() && fs::exists(options.soil_bin.record))
    for (std::string& doubt : compare::step_doubts(compare::read_record(options.soil_bin.record)))
      answered.doubts.push_back(std::move(doubt));
  Outputs outputs;
  save(outputs, options, question, answered, session.place);
  print_warnings(answered.doubts);
  if (options.json) {
    fmt::print("{}", compare::json_text(document_of(question, answered)));
  } else {
    fmt::print("{}: {} on {}\n{}\n{}\n{}", question.study.name, in_words(question.scenario.tire),
               compare::in_words(question.scenario.soil), compare::errors_in_words(question.scenario.soil),
               answered.step ? compare::in_words(*answered.step) : "", study_text(answered.study));
    if (const std::string notes = compare::notes_on(*log); !notes.empty()) fmt::print("\n{}", notes);
  }
  forget_runs(*log, outputs);
  if (compare::any_result(answered.study)) return outputs.status(done);
  fmt::print(stderr, "soilbin: no condition of the study has a solution\n");
  return failed;
}

}  // namespace

void add_run(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("run", "a study: every model at every condition");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("study", options->study, "of the library, or a case file")->type_name("STUDY")->required();
  command->add_option("--model", options->model, "only this model: bekker_wong or dem")->type_name("NAME");
  command->add_option("--plot", options->plot, "draw the curves against slip")
      ->type_name("FILE.svg|png|pdf")
      ->check(drawing_file());
  add_file(*command, "--csv", options->csv, "FILE.csv", "save the table");
  command->add_option("--output", options->output, "save the resolved case and the results")
      ->type_name("DIR")
      ->check(writable_folder());
  command->add_flag("--json", options->json, "the results as JSON, in SI");
  command->add_flag("--converge", options->converge,
                    "dem: one condition, again with each numerical choice halved or doubled");
  options->conditions.add_to(*command);
  options->errors.add_to(*command);
  options->soil_bin.add_to(*command);
  command
      ->add_option("--half-step", options->half_step,
                   "dem with --record: first the hardest condition also at half the time step, and stop where its "
                   "answer differs; yes for a dozen runs or more")
      ->type_name("yes|no")
      ->check(CLI::IsMember({"yes", "no"}));
  add_file(*command, "--replay", options->soil_bin.replay, "FILE",
           "dem: keep the first run that is made, to look at it in 3D");
  command->add_option("--paraview", options->soil_bin.paraview, "dem: keep each run that is made, for ParaView")
      ->type_name("DIR")
      ->check(writable_folder());
  command->footer(
      "Each condition flag keeps the study's conditions that agree with it; where none does, it overrides them. Where\n"
      "the study gives 'rotation' it stays, and the speed follows.\n"
      "Example: soilbin run paper-straight --load 4kN --plot pull.svg");
  command->callback([=, &session] { session.action = [=, &session] { return run(*options, session); }; });
}

}  // namespace soilbin::cli
