#include "cli/serve/replies.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "cli/command_words.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/question.hpp"
#include "cli/serve/controls.hpp"
#include "cli/serve/served_answer.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/report/page.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/telling/answer_report.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {

/// The script, style and body of the page, from cli/serve/browser; made by the build.
std::vector<compare::EmbeddedFile> live_files();

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* icon =
    R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path d="M0 6h8v2H0z" fill="#c2500a"/>)"
    R"(<circle cx="4" cy="3.7" r="2.7" fill="none" stroke="#0b63a8" stroke-width="1.2"/></svg>)";

/// "a+b%20c" as "a b c". Throws InputError for a '%' without its two digits.
std::string decoded(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    unsigned code = 0;
    if (text[at] != '%') {
      out += text[at] == '+' ? ' ' : text[at];
      continue;
    }
    const char* digits = text.data() + at + 1;
    if (text.size() < at + 3 || std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2)
      throw InputError(fmt::format("'{}': a percent sign in an address is written %25", clipped(text)));
    out += static_cast<char>(code);
    at += 2;
  }
  return out;
}

std::vector<Flag> flags_of(const std::string& query) {
  std::vector<Flag> flags;
  for (const std::string& part : split(query, "&")) {
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals + 1 == part.size())
      throw InputError(fmt::format("'{}' has no value\n  hint: such as load=80N", clipped(decoded(part))));
    flags.emplace_back(decoded(part.substr(0, equals)), decoded(part.substr(equals + 1)));
  }
  return flags;
}

/// Takes the flags of this name out of the query; the last one counts.
std::optional<std::string> take(std::vector<Flag>& flags, const std::string& key) {
  std::optional<std::string> text;
  std::erase_if(flags, [&](const Flag& flag) {
    if (flag.first == key) text = flag.second;
    return flag.first == key;
  });
  return text;
}

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
  const bool analytic = question.study.models.front().model == ModelKind::bekker_wong;
  return compare::asked_in_words(question) + ", " + compare::in_words(question.study.conditions.front()) +
         (analytic ? "" : ", by " + model_of(question));
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

/// Self-contained HTML with the reports' style, charts and d3; where d3 isn't installed the page says so, and shows
/// numbers without curves.
std::string live_page(const Setup& setup) {
  compare::Page page(title_of(setup.ask({}).question),
                     "The answers of soilbin estimate: move a number, and everything follows.");
  const std::vector<compare::EmbeddedFile> own = live_files();
  page.raw("<style>\n" + compare::embedded(own, "live.css") + "</style>\n");
  if (!page.libraries().d3)
    page.raw(
        "<p class=\"warning\" role=\"note\">d3 is not installed on this machine (package node-d3): numbers without "
        "curves.</p>\n");
  page.raw(compare::embedded(own, "live.html"));
  page.script(compare::embedded(own, "wheel.js") + compare::embedded(own, "live.js"));
  return page.html();
}

Reply estimate_reply(const Setup& setup, const std::string& query) {
  const std::vector<ServedAnswer> sides = answers_to(setup, query);
  const ServedAnswer& first = sides.front();
  const Case& question = first.asked.question;
  Json document = document_of("soilbin-estimate/1", question, compare::rows_json(first.point), setup.place().effects);
  compare::add_warnings(document, joined_doubts(first.notes, question, first.point));
  document["command"] = command_line(first.asked.words);
  document["in_words"] = question_in_words(question);
  document["title"] = title_of(question);
  document["errors_in_words"] = compare::errors_in_words(question);
  document["readings"] = readings_json(first);
  document["numbers"] = numbers_json(question, setup.force_unit());
  document["effects"] = effect_values_json(question);
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
  return {solved ? 200U : 422U, "application/json", document.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

/// The curves' question as a case file, and their answers as `soilbin run` of that file saves them.
Reply case_reply(const Setup& setup, const std::string& query) {
  std::vector<Flag> flags = flags_of(query);
  const auto slips = take_slips(flags);
  for (const char* beside : {"beside-soil", "beside-tire", "beside-model"}) take(flags, beside);
  return {200, "application/yaml", write_case(swept_over(setup.ask(flags).question, slips), setup.place().effects)};
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

Reply refusal(unsigned status, const std::string& what) {
  const auto [error, hint] = error_and_hint(what);
  return {status, "application/json", compare::json_text({{"error", error}, {"hint", hint}})};
}

Reply reply_to(const Setup& setup, std::string_view target) {
  const std::size_t mark = std::min(target.find('?'), target.size());
  const std::string_view path = target.substr(0, mark);
  const std::string query(target.substr(std::min(mark + 1, target.size())));
  try {
    if (path == "/") return {200, "text/html; charset=utf-8", live_page(setup)};
    if (path == "/favicon.ico") return {200, "image/svg+xml", icon};
    if (path == "/case") return {200, "application/json", compare::json_text(setup.document())};
    if (path == "/estimate") return estimate_reply(setup, query);
    if (path == "/case.yaml") return case_reply(setup, query);
    if (path == "/curves.csv") return curves_reply(setup, query);
  } catch (const InputError& error) {
    return refusal(400, error.what());
  }
  return refusal(404, fmt::format("there is no '{}' here\n  hint: there are /, /case, /estimate?load=80N&slip=20%25, "
                                  "/case.yaml and /curves.csv",
                                  clipped(std::string(path))));
}

}  // namespace soilbin::cli
