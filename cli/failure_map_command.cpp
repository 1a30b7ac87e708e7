// soilbin failure-map: where two models part, over load, lug height, an incline and slip.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/batch_flags.hpp"
#include "cli/commands.hpp"
#include "cli/described_flags.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "cli/versions.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/experiments/failure_map_grains.hpp"
#include "compare/experiments/run_plan.hpp"
#include "compare/failure_map/incline_map.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/atomic_file.hpp"

namespace soilbin::cli {
namespace {

/// Beyond that learning takes hours: its time grows as the cube of the conditions (gaussian_process.hpp), and each
/// statement's rounds learn anew.
constexpr long long most_conditions_of_map = 1000;

struct FailureMapFlags {
  std::string study, soil, incline = "longitudinal", of = "bekker_wong", against = "dem", store, tolerance = "10%";
  std::string load, lug_height, angle, slip;
  std::vector<std::string> effects;
  int first = 24, at_boundary = 12, fresh = 0, rounds = 4;
  unsigned seed = 1;
  OutputFlags outputs;
  bool rows = false, stored = false, dry_run = false;
  SoilBinFlags soil_bin;
  BatchFlags batch;
};

compare::Factor range_of(const std::string& flag, const std::string& text, const std::string& name,
                         const Measure& measure) {
  const auto [lower, upper] = read_range(flag, text, measure);
  return {name, lower, upper, measure.unit};
}

/// Flags that a store tells for who asks its map again: what its runs follow from, and how they were chosen.
compare::ExperimentStore::Asked flags_of_runs(const CLI::App& command, const std::string& study) {
  const std::set<std::string> of_runs = {"--soil",  "--incline",  "--load",   "--lug-height", "--angle", "--slip",
                                         "--first", "--boundary", "--rounds", "--check",      "--seed"};
  compare::ExperimentStore::Asked flags{{"study", study}};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool of_grains = option->get_group() == grains_heading && name != "--threads" && name != "--dry-run";
    if (option->count() > 0 && (of_grains || of_runs.contains(name))) flags[name] = option->results().front();
  }
  return flags;
}

/// The library's store of a study's map; `incline`: empty for any. Throws InputError where there is none.
std::string library_store(const Workplace& place, const std::string& study, const std::string& incline) {
  for (const std::filesystem::path& folder : place.folders) {
    if (!std::filesystem::is_directory(folder / "failure_maps")) continue;
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "failure_maps"))
      if (entry.path().extension() == ".json") files.insert(entry.path());
    for (const std::filesystem::path& file : files) {
      const compare::ExperimentStore store(file);
      const auto is = [&](const char* flag, const std::string& text) {
        const auto told = store.asked().find(flag);
        return told != store.asked().end() && told->second == text;
      };
      if (is("study", study) && (incline.empty() || is("--incline", incline))) return file.string();
    }
  }
  throw InputError(fmt::format("--stored: the library has no map of '{}'\n  hint: --store FILE.json", clipped(study)));
}

/// Sets the flags that were not given to what the store tells, as if they had been; those of grains where they are
/// asked.
void take_flags(CLI::App& command, const compare::ExperimentStore& store, bool grains) {
  for (const auto& [name, text] : store.asked())
    if (CLI::Option* option = command.get_option_no_throw(name);
        option != nullptr && option->count() == 0 && (grains || option->get_group() != grains_heading)) {
      option->add_result(text);
      option->run_callback();
    }
}

/// Effects of the analytic wheel: those of --effect, or, without one, of the study's first analytic model.
std::vector<EffectChoice> effects_of(const FailureMapFlags& asked, const Case& question, const Workplace& place) {
  std::vector<EffectChoice> effects;
  if (asked.effects == std::vector<std::string>{"none"}) return effects;
  for (const std::string& text : asked.effects) add_effect(effects, text, place.effects, question.scenario.soil);
  if (!asked.effects.empty()) return effects;
  const auto analytic = std::ranges::find(question.study.models, ModelKind::bekker_wong, &ModelChoice::model);
  return analytic == question.study.models.end() ? effects : analytic->effects;
}

compare::InclineMap map_of(const FailureMapFlags& asked, const Case& question, const Workplace& place) {
  compare::InclineMap map;
  map.of = read_word<ModelKind>("--of", asked.of), map.against = read_word<ModelKind>("--against", asked.against);
  map.scenario = question.scenario;
  map.base = question.study.conditions.front();
  map.base.pass = 1;
  map.incline = read_word<compare::Incline>("--incline", asked.incline);
  map.factors = {range_of("--load", asked.load, "load", {"N", above_zero}),
                 range_of("--lug-height", asked.lug_height, "lug height", {"mm", zero_or_more}),
                 range_of("--angle", asked.angle, "angle", {"deg", inclines}),
                 range_of("--slip", asked.slip, "slip", {"%", {.lower = -1.0, .upper = 0.99}})};
  if (map.factors[compare::map_load].upper >= 1000) map.factors[compare::map_load].unit = "kN";
  map.scenario.effects = effects_of(asked, question, place);
  return map;
}

void stop_map_when_asked() {
  if (interrupt_asked()) throw Interrupted();
}

void show_run(const dem::Progress& at) {
  stop_map_when_asked();
  show_progress_line(std::string(at.stage));
}

/// Experiments that are to be made: with the soil's grains, and with coarser ones.
struct PlannedExperiments {
  const std::vector<compare::ExperimentSpec>&usual, &coarser;
};

/// The experiments that the map would make first, as runs and their cost; more are chosen by their answers.
int plan(const FailureMapFlags& asked, Case question, const compare::InclineMap& map,
         const PlannedExperiments& experiments) {
  std::vector<compare::RunSpec> list;
  std::vector<std::string> lugs;
  question.scenario.tire.lugs.height = map.factors[compare::map_lug_height].upper;
  question.study.conditions.clear();
  const auto add = [&](const std::vector<compare::ExperimentSpec>& made, compare::RunKind kind) {
    for (const compare::ExperimentSpec& one : made) {
      list.push_back({compare::condition_at(map, one.values), one.seed, kind});
      question.study.conditions.push_back(list.back().at);
      lugs.push_back(fmt::format("lugs of {:.3g} mm", 1000 * one.values[compare::map_lug_height]));
    }
  };
  add(experiments.usual, compare::RunKind::usual), add(experiments.coarser, compare::RunKind::coarser);
  if (list.empty()) {
    fmt::print("nothing is left to make\n");
    return done;
  }
  compare::RunPlan plan = compare::plan_of(question, settings_of(asked.soil_bin), list, {});
  for (std::size_t k = 0; k < plan.runs.size(); ++k) plan.runs[k].of_tire = lugs[k];
  question.study.models = {{ModelKind::bekker_wong, map.scenario.effects, ""}, {ModelKind::dem, {}, ""}};
  compare::Doubts doubts = compare::doubts(question);
  append(doubts, bed_doubts(asked.soil_bin, question));
  print_warnings(doubts);
  if (asked.outputs.json)
    print_json(compare::plan_json(plan), doubts);
  else
    fmt::print("{}then      more where the models may part (--boundary {}, --rounds {}) or to check (--check {})\n",
               compare::plan_text(plan), asked.at_boundary, asked.rounds, asked.fresh);
  return done;
}

int tell(const compare::FailureMapResult& result, const compare::MapGrains& grains, const FailureMapFlags& asked,
         const Case& question, const Session& session) {
  const compare::FailureMapAbout about{"Failure map: " + name_of(result.asked.incline),
                                       write_case(question, session.place.effects), asked.rows};
  return publish(compare::report_on(result, about), asked.outputs, doubts_of(result, grains), session).status(done);
}

int failure_map(FailureMapFlags& asked, CLI::App& command, const Session& session) {
  Case question = find_study(session.place, asked.study);
  const bool grains_asked = read_word<ModelKind>("--of", asked.of) == ModelKind::dem ||
                            read_word<ModelKind>("--against", asked.against) == ModelKind::dem;
  read_word<compare::Incline>("--incline", asked.incline);  // refused before a map of that incline is looked for
  if (asked.stored) {
    if (asked.store.empty())
      asked.store = library_store(session.place, asked.study, command.count("--incline") > 0 ? asked.incline : "");
    if (!std::filesystem::exists(asked.store))
      throw InputError(asked.store + ": no such file\n  hint: without --stored it is begun");
    take_flags(command, compare::ExperimentStore(asked.store), grains_asked);
  }
  for (const auto& [flag, text] : {std::pair("--load", &asked.load), std::pair("--lug-height", &asked.lug_height),
                                   std::pair("--angle", &asked.angle), std::pair("--slip", &asked.slip)})
    if (text->empty())
      throw InputError(
          fmt::format("{} is missing: LOW..HIGH\n  hint: --stored takes it from a store that tells it", flag));
  const AnalyticSoil values(asked.soil, session.place.library, question.scenario.soil);
  const compare::InclineMap map = map_of(asked, question, session.place);
  check_flags_of_grains(asked.soil_bin, command, question, {.asked = grains_asked, .hint = "--against dem"});
  const compare::MapLearning how{.runs = {.first = asked.first,
                                          .at_boundary = asked.at_boundary,
                                          .at_once = std::max(asked.dry_run ? asked.at_boundary : 1, asked.batch.ask),
                                          .seed = asked.seed,
                                          .watch = show_run},
                                 .rounds = asked.rounds,
                                 .fresh = asked.fresh,
                                 .tolerance = read_flag("--tolerance", asked.tolerance, {"%", above_zero}),
                                 .look = stop_map_when_asked};
  if (!grains_asked) {
    const compare::FailureMapResult result = compare::learn_map(map, {}, how);
    clear_progress_line();
    return tell(result, {}, asked, question, session);
  }
  if (!asked.stored && !asked.store.empty())  // what is only read may lie anywhere
    if (const std::string why = why_not_writable(asked.store); !why.empty()) throw InputError("--store: " + why);
  asked.batch.check(asked.store);
  compare::ExperimentStore store(asked.store, asked.batch.writers());
  tell_unsealed(store, asked.store);
  if (!asked.stored && !asked.dry_run && !asked.batch.asks() && !asked.batch.answers())
    store.tell_asked(flags_of_runs(command, asked.study));
  asked.batch.learn(store);
  const dem::DemSettings settings = settings_of(asked.soil_bin);
  const compare::RunKeeping keeping{.version = SOILBIN_VERSION, .source = source_state()};
  compare::VirtualTest runs = compare::map_grains(map, settings, keeping);
  compare::VirtualTest coarser = compare::coarser_map_grains(map, settings, keeping);
  if (asked.stored) runs.run = coarser.run = {};
  if (asked.batch.answers()) return asked.batch.answer(runs, store);
  if (asked.batch.asks() || asked.dry_run)
    for (compare::VirtualTest* test : {&runs, &coarser})
      test->asked = std::make_shared<std::vector<compare::ExperimentSpec>>();
  const compare::MapGrains grains{&runs, asked.soil_bin.coarser_twin ? &coarser : nullptr, &store,
                                  static_cast<std::uint64_t>(asked.soil_bin.packing)};
  try {
    compare::FailureMapResult result = compare::learn_map(map, grains, how);
    clear_progress_line();
    if (asked.dry_run) return plan(asked, question, map, {*runs.asked, *coarser.asked});
    if (grains.waits()) return asked.batch.write(runs);
    result.asked.scenario.soil.name = values.title(true);
    return tell(result, grains, asked, question, session);
  } catch (const Interrupted&) {
    if (!asked.store.empty())
      fmt::print(stderr, "\n{} runs are in {}: the same command goes on from there", store.size(), asked.store);
    throw;
  }
}

}  // namespace

void add_failure_map(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "failure-map", "where two models disagree, the analytic wheel and grains, say, over load, lugs, slip and slope");
  const auto asked = std::make_shared<FailureMapFlags>();
  add_value(*command, "study", asked->study, "STUDY", "the study whose wheel, soil, bin and speed are taken")
      ->required();
  add_value(*command, "--soil", asked->soil, "SOIL",
            "the analytic model's values from this soil, as bevameter writes one");
  add_value(*command, "--of", asked->of, "MODEL", "the model that is judged: bekker_wong (default) or rft");
  add_value(*command, "--against", asked->against, "MODEL",
            "the model that it is judged by: dem (default), or another quick one, without grains");
  add_value(*command, "--incline", asked->incline, "KIND", "longitudinal (default), transverse or yaw");
  add_value(*command, "--load", asked->load, "LOW..HIGH", "range of loads");
  add_value(*command, "--lug-height", asked->lug_height, "LOW..HIGH", "range of lug heights");
  add_value(*command, "--angle", asked->angle, "LOW..HIGH", "range of the incline or the yaw");
  add_value(*command, "--slip", asked->slip, "LOW..HIGH", "range of slips");
  add_value(*command, "--first", asked->first, "N", "conditions that fill the ranges evenly; 24")
      ->check(whole_number(6, most_conditions_of_map));
  add_value(*command, "--boundary", asked->at_boundary, "N",
            "further ones, each where the difference may cross the tolerance; 12")
      ->check(whole_number(0, most_conditions_of_map));
  add_value(*command, "--rounds", asked->rounds, "N",
            "further ones for each statement, each where it is most likely wrong; 4")
      ->check(whole_number(0, most_conditions_of_map));
  add_value(*command, "--check", asked->fresh, "N", "predict, then run so many conditions that the map has not seen")
      ->check(whole_number(0, most_conditions_of_map));
  add_value(*command, "--tolerance", asked->tolerance, "SHARE",
            "share of the load beyond which the models count as different; 10 %");
  add_repeatable(*command, "--effect", asked->effects, "ID[:FORM][,PARAMETER=VALUE...]",
                 "effect of the analytic model; repeatable; without one those of the study's, none: the base model");
  add_value(*command, "--store", asked->store, "FILE.json", "keep each run in this file, and go on with what is there");
  command->add_flag("--stored", asked->stored,
                    "answer from the store alone, without running; ranges and flags of the grains are the store's "
                    "where they are not given. Without --store: from the library's map of the study");
  asked->batch.add_to(*command);
  add_value(*command, "--seed", asked->seed, "N", "seed of the design; 1");
  command->add_flag("--show-rows", asked->rows, "print every condition run");
  asked->outputs.add_to(*command, {.json = "soilbin-failure-map/1, in SI"});
  asked->soil_bin.add_to(*command);
  asked->soil_bin.add_coarser_twin_to(*command);
  for (const char* other : {"--ask", "--batch"}) command->get_option("--coarser-twin")->excludes(other);
  command->add_flag("--dry-run", asked->dry_run, "make nothing; list the runs that come next and what they will cost")
      ->group(grains_heading);
  for (const char* other : {"--ask", "--batch", "--stored", "--report", "--markdown"})
    command->get_option("--dry-run")->excludes(other);
  // A map keeps its runs in a store, each in one packing.
  for (const char* other : {"--record", "--recorded", "--packings"}) command->remove_option(command->get_option(other));
  command->footer(
      "Example: soilbin failure-map heavy-lugged-incline --stored --report map.html\n"
      "         soilbin failure-map paper-longitudinal --soil paper-sand-virtual --incline longitudinal --load "
      "2kN..8kN\n"
      "         --lug-height 0mm..30mm --angle 0deg..15deg --slip 5%..50% --store map.json --report map.html --check "
      "5");
  command->callback(
      [=, &session] { session.action = [=, &session] { return failure_map(*asked, *command, session); }; });
}

}  // namespace soilbin::cli
