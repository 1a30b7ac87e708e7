// soilbin explain: the budget of forces, the equations with the values put in, closed forms to check by, sources.
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/sources.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/answer_report.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

int explain(const Question& inputs, const TireFlags& tire, const OutputFlags& asked, const Session& session) {
  Case question = inputs.ask(session.place);
  constexpr std::size_t most = 20;
  if (question.study.conditions.size() > most)
    throw InputError(fmt::format("{} conditions are too many to explain; pick one with --load, --slip, ...",
                                 question.study.conditions.size()));
  compare::Doubts notes = tire.apply(question, inputs.switches_effects_off());
  const std::string heading =
      fmt::format("{} on {}", compare::tire_in_words(question), compare::in_words(question.scenario.soil));
  compare::Report report{"Why: " + heading, question.description, heading};
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::vector<compare::ModelAnswers> answered;
  for (const ModelChoice& choice : question.study.models) {
    if (choice.model != ModelKind::bekker_wong) compare::make_model(choice.model);
    const Scenario scenario = seen_by(choice, question.scenario);
    for (const OperatingCondition& at : question.study.conditions) {
      const compare::Explanation explanation = compare::explain(scenario, at);
      rows.push_back(to_json(explanation, choice, at));
      for (compare::ReportPart& part : compare::explanation_parts(choice, at, explanation))
        report.parts.push_back(std::move(part));
      answered.push_back({choice, {{at, explanation.result, ""}}});
    }
  }
  report.add(compare::WarningsHere());
  Table sources = compare::sources_table(question.scenario);
  sources.caption = "Where the values come from";
  report.add(std::move(sources));
  report.resolved_case = write_case(question, session.place.effects);
  report.data = [&] {
    nlohmann::ordered_json document = document_of("soilbin-explain/1", question, rows, session.place.effects);
    document["sources"] = compare::sources_json(question.scenario);
    return document;
  };
  return publish(report, asked, joined_doubts(std::move(notes), question, answered), session).status(done);
}

}  // namespace

void add_explain(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "explain", "why: the budget of forces, the equations with their values, and where the values come from");
  const auto inputs = std::make_shared<Question>(*command);
  const auto tire = std::make_shared<TireFlags>();
  tire->add_to(*command);
  const auto outputs = std::make_shared<OutputFlags>();
  outputs->add_to(*command, {.json = "as JSON"});
  command->footer("Example: soilbin explain --soil dry-sand --tire rover-wheel --load 65N --slip 20%");
  command->callback(
      [=, &session] { session.action = [=, &session] { return explain(*inputs, *tire, *outputs, session); }; });
}

}  // namespace soilbin::cli
