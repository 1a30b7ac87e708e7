// soilbin explain: the budget of forces, the equations with the values put in, closed forms to check by, sources.
#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "cli/commands.hpp"
#include "cli/question.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/answer_tables.hpp"
#include "compare/sweep/explanation.hpp"
#include "compare/sweep/sources.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

using compare::Explanation;

void print_text(const ModelChoice& choice, const Explanation& explanation, const OperatingCondition& at) {
  fmt::print("{}", compare::answer_text({choice, {}}, {at, explanation.result, ""}));
  fmt::print("\nBudget of forces along the drawbar pull\n{}", as_text(compare::forces_table(explanation.result)));
  fmt::print("{}", compare::in_words(explanation));
}

int explain(const Question& inputs, const TireFlags& tire, bool json, const Session& session) {
  Case question = inputs.ask(session.place);
  constexpr std::size_t most = 20;
  if (question.study.conditions.size() > most)
    throw InputError(fmt::format("{} conditions are too many to explain; pick one with --load, --slip, ...",
                                 question.study.conditions.size()));
  std::vector<std::string> doubts = tire.apply(question, inputs.switches_effects_off());
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  if (!json) fmt::print("{} on {}\n\n", compare::tire_in_words(question), compare::in_words(question.scenario.soil));
  bool first = true;
  std::vector<compare::ModelAnswers> answered;
  for (const ModelChoice& choice : question.study.models) {
    if (choice.model != ModelKind::bekker_wong) compare::make_model(choice.model);
    const Scenario scenario = seen_by(choice, question.scenario);
    for (const OperatingCondition& at : question.study.conditions) {
      const Explanation explanation = compare::explain(scenario, at);
      if (json)
        rows.push_back(to_json(explanation, choice, at));
      else
        fmt::print("{}", first ? "" : "\n"), print_text(choice, explanation, at);
      first = false;
      answered.push_back({choice, {{at, explanation.result, ""}}});
    }
  }
  if (!json) fmt::print("\nWhere the values come from\n{}", as_text(compare::sources_table(question.scenario)));
  std::ranges::copy(compare::doubts(question, answered), std::back_inserter(doubts));
  print_warnings(doubts);
  if (!json) return done;
  nlohmann::ordered_json document = document_of("soilbin-explain/1", question, rows, session.place.effects);
  document["sources"] = compare::sources_json(question.scenario);
  print_json(document, doubts);
  return done;
}

}  // namespace

void add_explain(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "explain", "why: the budget of forces, the equations with their values, and where the values come from");
  const auto inputs = std::make_shared<Question>(*command);
  const auto tire = std::make_shared<TireFlags>();
  tire->add_to(*command);
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  command->footer("Example: soilbin explain --soil dry-sand --tire rover-wheel --load 65N --slip 20%");
  command->callback(
      [=, &session] { session.action = [=, &session] { return explain(*inputs, *tire, *json, session); }; });
}

}  // namespace soilbin::cli
