// soilbin compare: a study's models, grains and measurements side by side, and why they differ.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "cli/versions.hpp"
#include "compare/telling/comparison_report.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

struct CompareOptions {
  OutputFlags outputs;
  std::string study, model, measured, replay, title, soil;
  std::vector<std::string> effects;
  bool no_loop = false;
  unsigned seed = 1;
  ConditionFlags conditions;
  SoilBinFlags soil_bin;
};

/// "slip_sinkage+lug_thrust:janosi" as its effects. A plus within a number ("1e+3") parts nothing.
std::vector<EffectChoice> effects_together(const std::string& text, const Session& session, const Soil& soil) {
  std::vector<EffectChoice> effects;
  for (std::size_t begin = 0; begin <= text.size();) {
    std::size_t end = text.find('+', begin);
    while (end != std::string::npos && end + 1 < text.size() &&
           !std::isalpha(static_cast<unsigned char>(text[end + 1])))
      end = text.find('+', end + 1);
    add_effect(effects, text.substr(begin, std::min(end, text.size()) - begin), session.place.effects, soil);
    begin = std::min(end, text.size()) + 1;
  }
  return effects;
}

std::vector<ModelChoice> choices_of(const Case& question, const CompareOptions& asked, const Session& session) {
  std::vector<ModelChoice> choices = compare::analytic_choices(question.study);
  for (const std::string& text : asked.effects)
    if (!compare::add_choice(choices, effects_together(text, session, question.scenario.soil)))
      fmt::print(stderr, "soilbin: --effect {}: is compared already\n", clipped(text));
  label_models(choices);
  return choices;
}

bool asks_grains(Study study, const CompareOptions& asked) {
  compare::choose_models(study, value_named<ModelKind>(asked.model), !asked.soil_bin.recorded.empty());
  return asks(study, ModelKind::dem);
}

/// Throws InputError for a flag that would change nothing beside the others.
void check_flags(const CompareOptions& asked, const CLI::App& command, const Case& question) {
  check_flags_of_grains(asked.soil_bin, command, question, {.asked = asks_grains(question.study, asked)});
  if (!asked.title.empty() && asked.outputs.report.empty() && asked.outputs.markdown.empty())
    throw InputError("--title is the title of a page\n  hint: --report FILE.html, or --markdown DIR");
  if (asked.no_loop && command.count("--seed") > 0)
    throw InputError("--seed is the loop's, and --no-loop leaves it out\n  hint: give one of the two");
}

std::optional<compare::LoopOfComparison> ask_loop(const compare::Comparison& comparison, unsigned seed) {
  compare::LoopOptions options;
  options.attribution.seed = seed;
  options.threads = all_cores();
  options.progress = shown_progress();
  try {
    return compare::ask_loop(comparison, options);
  } catch (const NoSolution& none) {
    fmt::print(stderr, "soilbin: the loop gives no answer: {}\n", none.what());
    return std::nullopt;
  }
}

int compare_models(CompareOptions asked, const CLI::App& command, const Session& session) {
  if (!asked.model.empty()) check_model(asked.model, all_words<ModelKind>());
  if (asked.model == "bekker_wong" && !asked.soil_bin.recorded.empty())
    throw InputError(
        "--model bekker_wong leaves the grains out, and --recorded asks for them\n  hint: give one of the two");
  if (!asked.soil_bin.recorded.empty())
    asked.soil_bin.recorded = find_record(session.place, asked.study, asked.soil_bin.recorded);
  Case question = find_study(session.place, asked.study);
  asked.conditions.pick(question);
  check_flags(asked, command, question);
  compare::ComparisonAbout about;
  const AnalyticSoil values(asked.soil, session.place.library, question.scenario.soil);
  if (!asked.soil.empty()) about.facts.emplace_back("the analytic model's soil values", asked.soil);
  if (!asked.no_loop) compare::check_soil_for_loop(question.scenario.soil);  // refused before anything is run
  if (!asked.replay.empty()) {
    about.replay = compare::read_replay(asked.replay);
    if (asked.outputs.report.empty())
      throw InputError("--replay is shown on the page alone\n  hint: --report FILE.html");
  }
  const std::vector<ModelChoice> choices = choices_of(question, asked, session);
  std::vector<compare::Side> sides = compare::analytic_sides(question, choices, shown_progress());
  std::vector<compare::RecordedRun> runs;
  if (asks_grains(question.study, asked)) {
    if (asked.soil_bin.recorded.empty()) tell_grain_doubts(asked.soil_bin, question);
    compare::StudyGrains grains = grains_of(asked.soil_bin);
    if (asked.soil_bin.coarser_twin) grains.list = asked.soil_bin.runs(question);
    compare::GrainSideRuns of = compare::run_grain_side(question, grains, session.place.effects, shown_progress());
    about.facts.insert(about.facts.end(), of.grains.facts.begin(), of.grains.facts.end());
    sides.push_back(std::move(of.grains.side)), runs = std::move(of.runs);
  }
  compare::Doubts doubts = compare::doubts_of_sides(question, sides);
  append(doubts, compare::bed_density_doubts(question.scenario.soil, runs));
  question.scenario.soil.name = values.title(!runs.empty());
  if (!asked.measured.empty())
    sides.push_back(compare::side_of(find_campaign(session.place, asked.measured), question));
  const compare::Comparison comparison = compare::compare_sides(question, std::move(sides));
  if (!asked.no_loop) about.loop = ask_loop(comparison, asked.seed);
  about.title = asked.title.empty() ? "Comparison: " + question.study.name : asked.title;
  about.command = session.command, about.versions = versions();
  about.resolved_case = write_case(question, session.place.effects);
  const Outputs outputs = publish(compare::report_on(comparison, about), asked.outputs, doubts, session);
  delete_restarts(runs, outputs);
  return outputs.status(done);
}

}  // namespace

void add_compare(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("compare", "models, grains and measurements of a study side by side, and why they differ");
  const auto asked = std::make_shared<CompareOptions>();
  add_value(*command, "study", asked->study, "STUDY", "a study of the library, or a case file")->required();
  add_value(*command, "--model", asked->model, "NAME",
            "dem: run the grains now, without a record; bekker_wong: leave them out");
  add_value(*command, "--measured", asked->measured, "CAMPAIGN", "a campaign of the same wheel");
  add_value(*command, "--soil", asked->soil, "SOIL",
            "the analytic model's values from this soil, as bevameter writes one");
  add_value(*command, "--effect", asked->effects, "ID[:FORM][,PARAMETER=VALUE][+ID...]",
            "one more side: the analytic model with this effect, or with several joined by '+'; repeatable");
  asked->outputs.add_to(*command, {.json = "soilbin-compare/1, in SI", .csv = "save every row"});
  add_value(*command, "--replay", asked->replay, "FILE", "a replay of grains to put into the page");
  add_value(*command, "--title", asked->title, "TEXT", "title of the page");
  command->add_flag("--no-loop", asked->no_loop, "do not look for what the analytic model lacks");
  add_value(*command, "--seed", asked->seed, "N", "seed of the loop's simulations and folds");
  asked->conditions.add_to(*command);
  asked->soil_bin.add_to(*command);
  asked->soil_bin.add_coarser_twin_to(*command);
  command->footer(
      "A row counts as a difference beyond two standard errors of both sides (more where they rest on few re-runs) "
      "and\n"
      "beyond the scatter of one run.\n"
      "With neither grains nor measurements, the analytic models are set against each other.\n"
      "Example: soilbin compare paper-straight --recorded --report compare.html\n"
      "         soilbin compare paper-straight --effect slip_sinkage --effect slip_sinkage+lug_thrust");
  command->callback(
      [=, &session] { session.action = [=, &session] { return compare_models(*asked, *command, session); }; });
}

}  // namespace soilbin::cli
