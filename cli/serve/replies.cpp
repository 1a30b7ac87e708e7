#include "cli/serve/replies.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "cli/command_words.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/serve/controls.hpp"
#include "cli/serve/served_answer.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/telling/answer_report.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/csv.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The ends of the curves' slips; takes the flag out.
std::pair<double, double> take_slips(std::vector<Flag>& flags) {
  return read_range("slips", take(flags, "slips").value_or("0%..100%"), Measure{"-", {.lower = -1.0, .upper = 1.0}});
}

bool is_effect_flag(const std::string& key) { return key == "effect"; }

/// The question of a query and, where it says beside-soil=NAME, beside-tire=NAME or beside-model=NAME,
/// a second one with that soil, tire or model.
std::vector<ServedAnswer> answers_to(const Setup& setup, const std::string& query) {
  std::vector<Flag> flags = flags_of(query);
  const auto slips = take_slips(flags);
  const std::optional<std::string> soil = take(flags, "beside-soil"), tire = take(flags, "beside-tire"),
                                   model = take(flags, "beside-model");
  std::vector<ServedAnswer> sides = {answer_to(setup.ask(flags), slips)};
  if (!soil && !tire && !model) return sides;
  const auto replaced = [&](const std::optional<std::string>& name, const char* key, bool (*own)(const std::string&)) {
    if (!name) return;
    std::erase_if(flags, [&](const Flag& flag) { return flag.first == key || own(flag.first); });
    flags.emplace_back(key, *name);
  };
  replaced(soil, "soil", is_soil_flag);
  replaced(tire, "tire", is_tire_flag);
  replaced(model, "model", is_effect_flag);
  sides.push_back(answer_to(setup.ask(flags), slips));
  for (ServedAnswer& one : sides) {
    const Scenario& scenario = one.asked.question.scenario;
    if (tire) one.label = scenario.tire.name;
    if (soil) one.label += (one.label.empty() ? "" : " on ") + compare::in_words(scenario.soil);
    if (model) one.label += (one.label.empty() ? "" : ", ") + model_of(one.asked.question);
  }
  if (sides[0].label == sides[1].label) sides[1].label += " (beside)";
  return sides;
}

std::string title_of(const Case& question) { return in_words(question.scenario.tire); }

std::string question_in_words(const Case& question) {
  const ModelChoice& model = question.study.models.front();
  const bool base = model.model == ModelKind::bekker_wong && model.effects.empty();
  return compare::asked_in_words(question) + ", " + compare::in_words(question.study.conditions.front()) +
         (base ? "" : ", " + compare::model_in_words(model.label));
}

/// What is said of a point without solution.
void add_refusal(Json& document, const ServedAnswer& one) {
  const std::optional<double> carried = compare::carried_load(one.asked.question);
  document["error"] = "no solution: " + error_and_hint(one.point.front().answers.front().error).first;
  document["carried_load"] = compare::or_null(carried);
  if (carried)
    document["hint"] = "at this slip the soil carries up to " + compare::newtons(*carried) + " under this wheel";
  else
    document["hint"] = compare::any_result(one.curves)
                           ? "the curves show the slips that have one"
                           : "less load, another soil, other effects or another model may have one";
}

Reply estimate_reply(const Setup& setup, const std::string& query) {
  const std::vector<ServedAnswer> sides = answers_to(setup, query);
  const ServedAnswer& first = sides.front();
  const Case& question = first.asked.question;
  Json document = document_of("soilbin-estimate/1", question, compare::rows_json(question.scenario.tire, first.point),
                              setup.place().effects);
  compare::add_warnings(document, joined_doubts(first.notes, question, first.point));
  document["command"] = command_line(first.asked.words);
  document["in_words"] = question_in_words(question);
  document["title"] = title_of(question);
  document["errors_in_words"] = compare::errors_in_words(question);
  document["readings"] = readings_json(first);
  document["numbers"] = numbers_json(question, setup.force_unit());
  document["effects"] = effect_values_json(question.study.models.front().effects);
  document["curves"] = curves_json(sides);
  document["budget"] = budget_json(sides);
  document["stresses"] = stresses_json(sides);
  document["wheels"] = compare::list_of(sides, wheel_json);
  if (sides.size() > 1) {
    document["beside"] = {{"label", sides[1].label},
                          {"command", command_line(sides[1].asked.words)},
                          {"in_words", question_in_words(sides[1].asked.question)},
                          {"readings", readings_json(sides[1])}};
    if (!compare::any_result(sides[1].point)) add_refusal(document["beside"], sides[1]);
  }
  const bool solved = compare::any_result(first.point);
  if (!solved) add_refusal(document, first);
  return json_reply(document, solved ? 200U : 422U);
}

/// The curves' question as a case file, and their answers as `soilbin run` of that file saves them.
Reply case_reply(const Setup& setup, const std::string& query) {
  std::vector<Flag> flags = flags_of(query);
  const auto slips = take_slips(flags);
  for (const char* beside : {"beside-soil", "beside-tire", "beside-model"}) take(flags, beside);
  Asked asked = setup.ask(flags);
  asked.tire.apply(asked.question, asked.base_model);
  return {200, "application/yaml", write_case(swept_over(std::move(asked.question), slips), setup.place().effects)};
}

Reply curves_reply(const Setup& setup, std::string query) {
  const std::string comma = "decimal-comma=true";
  const std::size_t asked = query.find(comma);
  if (asked != std::string::npos) query.erase(asked, comma.size());
  std::vector<compare::ModelAnswers> all;
  std::map<std::string, Scenario> scenario_of;
  for (ServedAnswer& one : answers_to(setup, query))
    for (compare::ModelAnswers& model : one.curves) {
      if (!one.label.empty()) model.choice.label += ", " + one.label;
      scenario_of[model.choice.label] = one.swept.scenario;
      all.push_back(std::move(model));
    }
  const auto remark = [&](const ModelChoice& model, const compare::Answer& answer) {
    return compare::remark_on(scenario_of.at(model.label), model, answer);
  };
  const std::string csv = compare::study_csv(all, remark);
  return {200, "text/csv; charset=utf-8", asked == std::string::npos ? csv : with_decimal_commas(csv)};
}

}  // namespace

Reply reply_to(const Setup& setup, std::string_view target, const StillWanted& /*wanted*/) {
  const Answers answers = {{"/",
                            [&](const std::string&) {
                              return page_reply(
                                  title_of(setup.ask({}).question),
                                  "The answers of soilbin estimate: move a number, and everything follows.",
                                  {"wheel.html", {"drawing.js", "wheel.js", "wheel_page.js"}});
                            }},
                           {"/case",
                            [&](const std::string&) {
                              return Reply{200, "application/json", compare::json_text(setup.document())};
                            }},
                           {"/estimate", [&](const std::string& query) { return estimate_reply(setup, query); }},
                           {"/case.yaml", [&](const std::string& query) { return case_reply(setup, query); }},
                           {"/curves.csv", [&](const std::string& query) { return curves_reply(setup, query); }}};
  return answered(answers, target, "there are /, /case, /estimate?load=80N&slip=20%25, /case.yaml and /curves.csv");
}

}  // namespace soilbin::cli
