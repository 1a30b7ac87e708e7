// soilbin explain: the budget of forces, the equations with the values put in, closed forms to check by, sources.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "compare/sweep/explanation.hpp"
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
  const std::vector<compare::Explained> explained = compare::explain(question);
  compare::Report report = compare::report_on(question, explained);
  report.resolved_case = write_case(question, session.place.effects);
  report.data = [&] {
    nlohmann::ordered_json document =
        document_of("soilbin-explain/1", question, compare::rows_json(explained), session.place.effects);
    document["sources"] = compare::sources_json(question.scenario);
    return document;
  };
  std::vector<compare::ModelAnswers> answered;
  for (const compare::Explained& one : explained) answered.push_back({one.choice, {{one.at, one.why.result, ""}}});
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
