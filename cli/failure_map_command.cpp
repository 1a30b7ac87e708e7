// soilbin failure-map: where the analytic model parts from grains, over load, lug height, an incline and slip.
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "cli/batch_flags.hpp"
#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/soil_bin.hpp"
#include "cli/text_output.hpp"
#include "cli/versions.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/failure_map/map_report.hpp"
#include "compare/report/json_fields.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

struct FailureMapOptions {
  std::string study, soil, incline = "longitudinal", store, report, tolerance = "10%";
  std::string load, lug_height, angle, slip;
  std::vector<std::string> effects;
  int first = 24, at_boundary = 12, fresh = 0, rounds = 4;
  unsigned seed = 1;
  bool json = false, rows = false, stored = false;
  SoilBinFlags soil_bin;
  BatchFlags batch;
};

/// "LOW..HIGH" of a flag, in SI.
compare::Factor range_of(const std::string& flag, const std::string& text, const std::string& name,
                         const Measure& measure) {
  const auto [lower, upper] = read_range(flag, text, measure);
  return {name, lower, upper, measure.unit};
}

compare::Incline incline_of(const std::string& text) {
  if (const auto incline = value_named<compare::Incline>(text)) return *incline;
  const std::vector<std::string> right = all_words<compare::Incline>();
  throw InputError("--incline: unknown kind '" + clipped(text) + "'" + did_you_mean(text, right) +
                   "\n  hint: there are " + listed(right));
}

compare::InclineMap map_of(const FailureMapOptions& asked, const Case& question, const Workplace& place) {
  compare::InclineMap map;
  map.scenario = question.scenario;
  map.base = question.study.conditions.front();
  map.base.pass = 1;
  map.incline = incline_of(asked.incline);
  map.factors = {range_of("--load", asked.load, "load", {"N", above_zero}),
                 range_of("--lug-height", asked.lug_height, "lug height", {"mm", zero_or_more}),
                 range_of("--angle", asked.angle, "angle", {"deg", inclines}),
                 range_of("--slip", asked.slip, "slip", {"%", {.lower = -1.0, .upper = 0.99}})};
  if (map.factors[compare::map_load].upper >= 1000) map.factors[compare::map_load].unit = "kN";
  for (const std::string& text : asked.effects)
    map.scenario.effects.push_back(parse_effect(text, place.effects, question.scenario.soil));
  return map;
}

/// Runs of grains as experiments: everything that they follow from beside factors and packing is their identity.
compare::VirtualTest grains_test(const FailureMapOptions& asked, const compare::InclineMap& map, const Case& question,
                                 const Workplace& place) {
  const dem::DemSettings settings = settings_of(asked.soil_bin);
  compare::VirtualTest test;
  test.identity = fmt::format("soil bin, {}, speed {}", name_of(map.incline), map.base.speed);
  for (const auto& [name, value] : compare::inputs_of(settings, map.scenario))
    if (name != "tire.lug_height") test.identity += fmt::format("\n{} {}", name, value);
  test.factors = map.factors;
  test.targets = compare::grain_channels();
  if (asked.stored) return test;
  const auto last = std::make_shared<compare::RecordedRun>();
  test.when_safe = [last] {
    if (last->when_safe) last->when_safe();
  };
  test.run = [map, last,
              run =
                  compare::run_once(settings, question, place.effects, {{}, {}, {}, SOILBIN_VERSION, source_state()})](
                 const Eigen::VectorXd& values, std::uint64_t seed) {
    Scenario grains = scenario_at(map, values);
    grains.effects.clear();
    *last = run(grains, condition_at(map, values), seed);
    if (!last->answer.result) throw NoSolution(last->answer.error);
    std::vector<Estimate> measured;
    for (const TractionChannel& channel : traction_channels)
      measured.push_back((*last->answer.result).*channel.predicted);
    return measured;
  };
  return test;
}

void show_run(int done, int total) {
  if (interrupt_asked()) throw Interrupted();
  show_progress_line(fmt::format("condition {} of {}", done + 1, total));
}

/// Where the models agree: without lugs at any slip, else also up to a slip; with any lugs; and the largest box of all.
std::vector<compare::AgreementClause> clauses_of(const compare::FailureQuestion& question, compare::FailureMap& rows,
                                                 int rounds) {
  using compare::Role;
  std::vector<compare::AgreementClause> clauses;
  const auto tell = [&](const std::vector<Role>& roles) {
    if (const auto clause = compare::agreement(question, rows, roles, 9, rounds)) clauses.push_back(*clause);
    return !clauses.empty();
  };
  if (!tell({Role::limited, Role::held, Role::limited, Role::whole}))
    tell({Role::limited, Role::held, Role::limited, Role::limited});
  tell({Role::limited, Role::limited, Role::limited, Role::whole});
  tell({Role::bounded, Role::bounded, Role::bounded, Role::bounded});
  return clauses;
}

compare::MapStory learn(const FailureMapOptions& asked, const Case& question, const Workplace& place,
                        compare::ExperimentStore& store, compare::VirtualTest& grains) {
  compare::MapStory story;
  story.map = map_of(asked, question, place);
  grains = grains_test(asked, story.map, question, place);
  if (asked.batch.asks()) grains = compare::only_asking(std::move(grains));
  story.question =
      compare::failure_question(story.map, grains, store, static_cast<std::uint64_t>(asked.soil_bin.packing),
                                read_flag("--tolerance", asked.tolerance, {"%", above_zero}));
  story.rows = compare::map_failures(story.question, {.first = asked.first,
                                                      .at_boundary = asked.at_boundary,
                                                      .at_once = std::max(1, asked.batch.ask),
                                                      .seed = asked.seed,
                                                      .progress = show_run});
  story.clauses = clauses_of(story.question, story.rows, asked.rounds);
  story.coordinates = compare::compare_coordinates(story.map, story.rows);
  story.checks = compare::check_fresh(story.question, story.rows, asked.fresh, asked.seed);
  clear_progress_line();
  return story;
}

void print_story(const compare::MapStory& story, bool rows) {
  for (const auto& [name, text] : compare::opening(story)) fmt::print("{}: {}\n", name, text);
  for (const std::string& sentence : compare::details(story)) fmt::print("{}\n", sentence);
  if (rows) fmt::print("\n{}", as_text(compare::rows_table(story)));
  fmt::print("\n{}", as_text(compare::coordinates_table(story)));
  if (!story.checks.empty()) fmt::print("\n{}", as_text(compare::checks_table(story)));
}

/// Of the analytic model and the grains at the conditions that were run, with the highest lugs.
std::vector<std::string> doubts_of(const compare::MapStory& story) {
  Case question;
  std::vector<Eigen::VectorXd> rows;
  for (const compare::FailureRow& row : story.rows.rows) {
    rows.push_back(row.values);
    question.study.conditions.push_back(compare::condition_at(story.map, row.values));
  }
  if (rows.empty()) return {};
  const auto height = [](const Eigen::VectorXd& values) { return values[compare::map_lug_height]; };
  question.scenario = compare::scenario_at(story.map, *std::ranges::max_element(rows, {}, height));
  question.study.models = {{ModelKind::bekker_wong, question.scenario.effects, ""}};
  question.scenario.effects.clear();
  const std::vector<compare::ModelAnswers> study = compare::run_study(question);
  question.study.models.push_back({ModelKind::dem, {}, ""});
  return compare::doubts(question, study);
}

int failure_map(const FailureMapOptions& asked, const Session& session) {
  Case question = find_study(session.place, asked.study);
  if (!asked.soil.empty())
    question.scenario.soil.semi_empirical = find_soil(asked.soil, session.place.library).semi_empirical;
  if (asked.first < 6) throw InputError("--first: 6 conditions or more");
  if (asked.at_boundary < 0 || asked.fresh < 0) throw InputError("--boundary and --check: 0 or more");
  if (!asked.stored && !asked.store.empty())  // what is only read may lie anywhere
    if (const std::string why = why_not_writable(asked.store); !why.empty()) throw InputError("--store: " + why);
  asked.batch.check(asked.store);
  compare::ExperimentStore store(asked.store, asked.batch.writers());
  tell_unsealed(store, asked.store);
  asked.batch.learn(store);
  if (asked.batch.answers())
    return asked.batch.answer(grains_test(asked, map_of(asked, question, session.place), question, session.place),
                              store);
  Outputs outputs;
  compare::VirtualTest grains;
  try {
    const compare::MapStory story = learn(asked, question, session.place, store, grains);
    compare::PageAbout about{"Failure map: " + name_of(story.map.incline), session.command, versions(),
                             doubts_of(story)};
    if (const std::size_t older = store.of_other_engines(grains); older > 0)
      about.doubts.push_back(
          fmt::format("{} of the experiments were made by an earlier engine, whose shear springs did "
                      "not turn with the spin of a pair: this one's answers differ",
                      older));
    print_warnings(about.doubts);
    outputs.file(asked.report,
                 [&] { return compare::failure_map_page(story, about, write_case(question, session.place.effects)); });
    if (asked.json)
      print_json(compare::failure_map_json(story), about.doubts);
    else
      print_story(story, asked.rows);
  } catch (const compare::ExperimentsAsked& more) {
    return asked.batch.write(grains, more.experiments);
  } catch (const Interrupted&) {
    if (!asked.store.empty())
      fmt::print(stderr, "\n{} runs are in {}: the same command goes on from there", store.size(), asked.store);
    throw;
  }
  return outputs.status(done);
}

}  // namespace

void add_failure_map(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "failure-map", "where the analytic model and grains disagree, over load, lugs, slip and slope");
  const auto asked = std::make_shared<FailureMapOptions>();
  command->add_option("study", asked->study, "the study whose wheel, soil, bin and speed are taken")
      ->type_name("STUDY")
      ->required();
  command->add_option("--soil", asked->soil, "the analytic model's values from this soil, as bevameter writes one")
      ->type_name("SOIL");
  command->add_option("--incline", asked->incline, "longitudinal (default), transverse or yaw")->type_name("KIND");
  command->add_option("--load", asked->load, "range of loads")->type_name("LOW..HIGH")->required();
  command->add_option("--lug-height", asked->lug_height, "range of lug heights")->type_name("LOW..HIGH")->required();
  command->add_option("--angle", asked->angle, "range of the incline or the yaw")->type_name("LOW..HIGH")->required();
  command->add_option("--slip", asked->slip, "range of slips")->type_name("LOW..HIGH")->required();
  command->add_option("--first", asked->first, "conditions that fill the ranges evenly; 24")->type_name("N");
  command
      ->add_option("--boundary", asked->at_boundary,
                   "further ones, each where the difference may cross the tolerance; 12")
      ->type_name("N");
  command
      ->add_option("--rounds", asked->rounds, "further ones for each statement, each where it is most likely wrong; 4")
      ->type_name("N");
  command->add_option("--check", asked->fresh, "predict, then run so many conditions that the map has not seen")
      ->type_name("N");
  command
      ->add_option("--tolerance", asked->tolerance,
                   "share of the load beyond which the models count as different; 10 %")
      ->type_name("SHARE");
  command->add_option("--effect", asked->effects, "effect of the analytic model; repeatable")
      ->type_name("ID[:FORM][,PARAMETER=VALUE...]")
      ->allow_extra_args(false);
  command->add_option("--store", asked->store, "keep each run in this file, and go on with what is there")
      ->type_name("FILE.json");
  command->add_flag("--stored", asked->stored, "answer from the store alone, without running");
  asked->batch.add_to(*command);
  add_file(*command, "--report", asked->report, "FILE.html", "write the report as one page");
  command->add_option("--seed", asked->seed, "seed of the design; 1")->type_name("N");
  command->add_flag("--show-rows", asked->rows, "print every condition run");
  command->add_flag("--json", asked->json, "soilbin-failure-map/1, in SI");
  asked->soil_bin.add_to(*command);
  command->get_option("--record")->group("");
  command->get_option("--recorded")->group("");
  command->get_option("--packings")->group("");
  command->footer(
      "Example: soilbin failure-map paper-longitudinal --soil paper-sand-virtual --incline longitudinal --load "
      "2kN..8kN\n"
      "         --lug-height 0mm..30mm --angle 0deg..15deg --slip 5%..50% --store map.json --report map.html --check "
      "5");
  command->callback([=, &session] { session.action = [=, &session] { return failure_map(*asked, session); }; });
}

}  // namespace soilbin::cli
