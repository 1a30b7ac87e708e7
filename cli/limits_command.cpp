// soilbin limits: what a wheel can do at best in a steady state: the largest pull, the steepest slope, the slip for
// each.
#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/sweep/wheel_limits.hpp"

namespace soilbin::cli {
namespace {

struct LimitsOptions {
  bool json = false;
  CsvOutput csv;
  std::string plot, max_slip;
  TireFlags tire;
};

double max_slip_of(const LimitsOptions& options) {
  if (options.max_slip.empty()) return compare::WheelLimits().max_slip;
  return read_flag("--max-slip", options.max_slip, {"-", {.lower = 0.0, .upper = 1.0}});
}

int limits(const Question& inputs, const LimitsOptions& options, const Session& session) {
  Case question = inputs.ask(session.place);
  require_semi_empirical(question, session.place.library);
  std::vector<std::string> doubts = options.tire.apply(question, inputs.switches_effects_off());
  const std::vector<compare::WheelLimits> answers = compare::limits_of(question, max_slip_of(options));
  const std::vector<compare::ModelAnswers> at_limits = compare::answers_at_limits(question, answers);
  std::ranges::copy(compare::doubts(question, at_limits), std::back_inserter(doubts));
  print_warnings(doubts);
  Outputs outputs;
  outputs.csv(options.csv,
              [&] { return compare::limits_csv(answers, at_limits, compare::remarks_about(question.scenario)); });
  outputs.drawing(options.plot, [&] { return compare::limits_sheet(question, answers); });
  if (options.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const compare::WheelLimits& answer : answers) rows.push_back(to_json(answer));
    print_json(document_of("soilbin-limits/1", question, rows, session.place.effects), doubts);
  } else {
    fmt::print("{} on {}\n{}\n", compare::tire_in_words(question), compare::in_words(question.scenario.soil),
               compare::errors_in_words(question));
    for (const compare::WheelLimits& answer : answers) fmt::print("\n{}", in_words(answer));
  }
  for (const compare::WheelLimits& answer : answers)
    if (answer.error.empty()) return outputs.status(done);
  fmt::print(stderr, "soilbin: no solution: {}\n", answers.front().error);
  return failed;
}

}  // namespace

void add_limits(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("limits", "the largest pull and the steepest slope, and the slip for each");
  const auto inputs = std::make_shared<Question>(*command, std::vector<std::string>{"load"},
                                                 std::vector<std::string>{"slip", "longitudinal_incline"});
  const auto options = std::make_shared<LimitsOptions>();
  options->tire.add_to(*command);
  add_plot(*command, options->plot, "draw the largest pull and the slips against the slope");
  add_csv(*command, options->csv, "save the table");
  command
      ->add_option("--max-slip", options->max_slip,
                   "slip up to which the wheel may climb, beside the theoretical limit (20 %)")
      ->type_name("%");
  command->add_flag("--json", options->json, "soilbin-limits/1, in SI");
  command->footer(
      "Where a load has no solution, its line gives the reason; the status is 1 where none has one.\n"
      "Example: soilbin limits --tire rover-wheel --soil dry-sand --load 64.68N");
  command->callback([=, &session] { session.action = [=, &session] { return limits(*inputs, *options, session); }; });
}

}  // namespace soilbin::cli
