// soilbin estimate: one tire, one soil, one condition (or a case's), answered in plain text.

#include <memory>

#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/answer_report.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

struct EstimateOptions {
  OutputFlags outputs;
  QuickModelFlag model;
  TireFlags tire;
};

int estimate(const Question& inputs, const EstimateOptions& options, const Session& session) {
  Case question = inputs.ask(session.place);
  if (!options.outputs.plot.empty() && compare::curves_run_over(question.study.conditions) == nullptr)
    throw InputError(
        "--plot draws curves: it takes several values of slip or of another condition\n"
        "  hint: --slip 0%..60%, or --load 50N..200N; the steepest slope: soilbin limits --plot slope.svg");
  options.model.apply(question, inputs.names_effects());
  require_semi_empirical(question, session.place.library);
  compare::Doubts notes = options.tire.apply(question, inputs.switches_effects_off());
  const std::vector<compare::ModelAnswers> study = compare::run_study(question, shown_progress());
  compare::Report report = compare::report_on(question, study);
  report.data = [&] {
    return document_of("soilbin-estimate/1", question, compare::rows_json(question.scenario.tire, study),
                       session.place.effects);
  };
  report.resolved_case = write_case(question, session.place.effects);
  return publish(report, options.outputs, joined_doubts(std::move(notes), question, study), session).status(done);
}

}  // namespace

void add_estimate(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("estimate", "drawbar pull, torque, sinkage and side force, from flags or a case");
  const auto inputs = std::make_shared<Question>(*command);
  const auto options = std::make_shared<EstimateOptions>();
  options->model.add_to(*command);
  options->tire.add_to(*command);
  options->outputs.add_to(*command, {.json = "the answers as JSON, in SI",
                                     .plot = "draw the curves over slip, or over another condition that varies",
                                     .csv = "save the table"});
  command->footer(
      "Several values of a condition give a table: a list, a range of seven values (0%..60%), or one in steps\n"
      "(0%..60%:5%).\n"
      "Example: soilbin estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20%\n"
      "         soilbin estimate --soil dry-sand --tire rover-wheel --load 65N --slip 0%..60% --plot slip.svg");
  command->callback([=, &session] { session.action = [=, &session] { return estimate(*inputs, *options, session); }; });
}

}  // namespace soilbin::cli
