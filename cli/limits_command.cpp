// soilbin limits: what a wheel can do at best in a steady state: the largest pull, the steepest slope, the slip for
// each.

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::cli {
namespace {

struct LimitsOptions {
  OutputFlags outputs;
  std::string max_slip;
  TireFlags tire;
};

double max_slip_of(const LimitsOptions& options) {
  if (options.max_slip.empty()) return compare::WheelLimits().max_slip;
  return read_flag("--max-slip", options.max_slip, {"-", {.lower = 0.0, .upper = 1.0}});
}

int limits(const Question& inputs, const LimitsOptions& options, const Session& session) {
  Case question = inputs.ask(session.place);
  require_semi_empirical(question, session.place.library);
  compare::Doubts notes = options.tire.apply(question, inputs.switches_effects_off());
  const std::vector<compare::WheelLimits> answers = compare::limits_of(question, max_slip_of(options));
  const std::vector<compare::ModelAnswers> at_limits = compare::answers_at_limits(question, answers);
  compare::Report report = compare::report_on(question, answers, at_limits);
  report.data = [&] {
    return document_of("soilbin-limits/1", question, compare::limits_rows(answers), session.place.effects);
  };
  report.resolved_case = write_case(question, session.place.effects);
  std::vector<compare::ModelAnswers> doubtful = at_limits;
  for (compare::ModelAnswers& one : compare::answers_below_no_slip(question, answers))
    doubtful.push_back(std::move(one));
  notes = joined_doubts(std::move(notes), question, doubtful);
  if (answers.size() == 1)
    compare::append(notes, compare::doubts_of_climb(notes, "the wheel", answers.front().steepest, [&] {
                      return compare::steepest_slope(compare::as_in_grains(question));
                    }));
  return publish(report, options.outputs, notes, session).status(done);
}

}  // namespace

void add_limits(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("limits", "the largest pull and the steepest slope, and the slip for each");
  const auto inputs = std::make_shared<Question>(*command, std::vector<std::string>{"load"},
                                                 std::vector<std::string>{"slip", "longitudinal_incline"});
  const auto options = std::make_shared<LimitsOptions>();
  options->tire.add_to(*command);
  add_value(*command, "--max-slip", options->max_slip, "%",
            "slip up to which the wheel may climb, beside the theoretical limit (20 %)");
  options->outputs.add_to(*command, {.json = "soilbin-limits/1, in SI",
                                     .plot = "draw the largest pull and the slips against the slope",
                                     .csv = "save the table"});
  command->footer(
      "Where a load has no solution, its line gives the reason; the status is 1 where none has one.\n"
      "Example: soilbin limits --tire rover-wheel --soil dry-sand --load 64.68N");
  command->callback([=, &session] { session.action = [=, &session] { return limits(*inputs, *options, session); }; });
}

}  // namespace soilbin::cli
