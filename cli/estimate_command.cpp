// soilbin estimate: one tire, one soil, one condition (or a case's), answered in plain text.
#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/answer_tables.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

/// "load 65 N" where all conditions have one load, "" for several, which the rows and curves tell apart.
std::string only_load(const std::vector<OperatingCondition>& conditions) {
  const double load = conditions.front().load;
  return std::ranges::all_of(conditions, [&](const OperatingCondition& at) { return at.load == load; })
             ? fmt::format("load {:.6g} N", load)
             : "";
}

void print_text(const Case& question, const std::vector<compare::ModelAnswers>& study) {
  fmt::print("{} on {}\n{}\n\n", compare::tire_in_words(question), compare::in_words(question.scenario.soil),
             compare::errors_in_words(question));
  if (question.study.conditions.size() > 1) {
    if (const std::string load = only_load(question.study.conditions); !load.empty()) fmt::print("{}\n\n", load);
    fmt::print("{}", compare::study_text(study));
  } else {
    for (const compare::ModelAnswers& model : study)
      fmt::print("{}\n", compare::answer_text(model, model.answers.front()));
  }
}

struct EstimateOptions {
  bool json = false;
  CsvOutput csv;
  std::string plot;
  TireFlags tire;
};

compare::Sheet sheet_of(const Case& question, const std::vector<compare::ModelAnswers>& study) {
  compare::Sheet sheet = compare::plot_of_study(question, study);
  sheet.title = fmt::format("{} on {}", question.scenario.tire.name, compare::in_words(question.scenario.soil));
  const std::vector<OperatingCondition>& all = question.study.conditions;
  if (const std::string load = only_load(all); !load.empty()) sheet.title += ", " + load;
  const double slip = all.front().slip;
  if (std::ranges::all_of(all, [&](const OperatingCondition& at) { return at.slip == slip; }))
    sheet.title += fmt::format(", slip {:.4g} %", 100 * slip);
  return sheet;
}

int estimate(const Question& inputs, const EstimateOptions& options, const Session& session) {
  Case question = inputs.ask(session.place);
  if (!options.plot.empty() && compare::curves_run_over(question.study.conditions) == nullptr)
    throw InputError(
        "--plot draws curves: it takes several values of slip or of another condition\n"
        "  hint: --slip 0%..60%, or --load 50N..200N; the steepest slope: soilbin limits --plot slope.svg");
  require_semi_empirical(question, session.place.library);
  std::vector<std::string> doubts = options.tire.apply(question, inputs.switches_effects_off());
  const std::vector<compare::ModelAnswers> study = compare::run_study(question, shown_progress());
  std::ranges::copy(compare::doubts(question, study), std::back_inserter(doubts));
  print_warnings(doubts);
  Outputs outputs;
  outputs.csv(options.csv, [&] { return compare::study_csv(study, compare::remarks_about(question.scenario)); });
  outputs.drawing(options.plot, [&] { return sheet_of(question, study); });
  if (options.json)
    print_json(document_of("soilbin-estimate/1", question, compare::rows_json(study), session.place.effects), doubts);
  else if (compare::any_result(study))
    print_text(question, study);
  if (compare::any_result(study)) return outputs.status(done);
  fmt::print(stderr, "soilbin: no solution: {}\n", study.front().answers.front().error);
  return failed;
}

}  // namespace

void add_estimate(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("estimate", "drawbar pull, torque, sinkage and side force, from flags or a case");
  const auto inputs = std::make_shared<Question>(*command);
  const auto options = std::make_shared<EstimateOptions>();
  options->tire.add_to(*command);
  add_plot(*command, options->plot, "draw the curves over slip, or over another condition that varies");
  add_csv(*command, options->csv, "save the table");
  command->add_flag("--json", options->json, "the answers as JSON, in SI");
  command->footer(
      "Several values of a condition give a table: a list, a range of seven values (0%..60%), or one in steps\n"
      "(0%..60%:5%).\n"
      "Example: soilbin estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20%\n"
      "         soilbin estimate --soil dry-sand --tire rover-wheel --load 65N --slip 0%..60% --plot slip.svg");
  command->callback([=, &session] { session.action = [=, &session] { return estimate(*inputs, *options, session); }; });
}

}  // namespace soilbin::cli
