// soilbin estimate: one tire, one soil, one condition (or a case's), answered in plain text.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/answer_tables.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::cli {
namespace {

void print_text(const Case& question, const std::vector<compare::ModelAnswers>& study) {
  fmt::print("{} on {}\n{}\n\n", in_words(question.scenario.tire), compare::in_words(question.scenario.soil),
             compare::errors_in_words(question));
  if (question.study.conditions.size() > 1) {
    fmt::print("{}", compare::study_text(study));
  } else {
    for (const compare::ModelAnswers& model : study)
      fmt::print("{}\n", compare::answer_text(model, model.answers.front()));
  }
}

int estimate(const Question& inputs, bool json, const Session& session) {
  const Case question = inputs.ask(session.place);
  require_semi_empirical(question, session.place.library);
  const std::vector<compare::ModelAnswers> study = compare::run_study(question, shown_progress());
  const std::vector<std::string> doubts = compare::doubts(question, study);
  print_warnings(doubts);
  if (json)
    print_json(document_of("soilbin-estimate/1", question, compare::rows_json(study), session.place.effects), doubts);
  else if (compare::any_result(study))
    print_text(question, study);
  if (compare::any_result(study)) return done;
  fmt::print(stderr, "soilbin: no solution: {}\n", study.front().answers.front().error);
  return failed;
}

}  // namespace

void add_estimate(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("estimate", "drawbar pull, torque, sinkage and side force, from flags or a case");
  const auto inputs = std::make_shared<Question>(*command);
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "the answers as JSON, in SI");
  command->footer("Example: soilbin estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20%");
  command->callback([=, &session] { session.action = [=, &session] { return estimate(*inputs, *json, session); }; });
}

}  // namespace soilbin::cli
