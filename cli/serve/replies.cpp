#include "cli/serve/replies.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "bekker_wong/model.hpp"
#include "cli/command_words.hpp"
#include "cli/flag_values.hpp"
#include "cli/question.hpp"
#include "cli/serve/controls.hpp"
#include "cli/serve/live_page.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/report/sheet_json.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;
using Study = std::vector<compare::ModelAnswers>;

constexpr int curve_points = 61;

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

/// The ends of the curves' slips; takes the flag out.
std::pair<double, double> take_slips(std::vector<Flag>& flags) {
  std::string text = "0%..100%";
  std::erase_if(flags, [&](const Flag& flag) {
    if (flag.first == "slips") text = flag.second;
    return flag.first == "slips";
  });
  return read_range("slips", text, Measure{"-", {.lower = -1.0, .upper = 1.0}});
}

Case swept_over(Case question, const std::pair<double, double>& slips) {
  OperatingCondition at = question.study.conditions.front();
  question.study.conditions.clear();
  for (int i = 0; i < curve_points; ++i) {
    at.slip = std::lerp(slips.first, slips.second, static_cast<double>(i) / (curve_points - 1));
    question.study.conditions.push_back(at);
  }
  return question;
}

/// The curves, the point that is asked for marked on each.
Json curves_json(const Case& question, const Study& point, const Case& swept, const Study& curves) {
  compare::Sheet sheet = compare::study_sheet(swept, curves, compare::Panels::all);
  const compare::Sheet here = compare::study_sheet(question, point, compare::Panels::all);
  for (std::size_t i = 0; i < sheet.plots.size(); ++i)
    for (compare::Series series : here.plots[i].series) {
      series.mark = compare::Mark::points;
      series.label = "this point";
      series.color = 1;
      sheet.plots[i].series.push_back(std::move(series));
    }
  return compare::to_json(sheet);
}

Json stresses_json(const Study& point) {
  std::vector<compare::LabelledPatch> patches;
  for (const compare::ModelAnswers& model : point)
    if (const auto& result = model.answers.front().result)
      patches.push_back({point.size() > 1 ? model.choice.label : "", static_cast<int>(patches.size()), result->patch});
  return compare::to_json(compare::patch_sheet("Stresses along the contact", patches));
}

Json readings_json(const Study& point) {
  Json all = Json::array();
  if (const auto& result = point.front().answers.front().result)
    for (const Reading& reading : readings(*result))
      all.push_back({{"name", reading.name}, {"value", reading.value}, {"unit", reading.unit}});
  return all;
}

/// "what\n  hint: how" in two.
std::pair<std::string, std::string> error_and_hint(const std::string& what) {
  std::vector<std::string> parts = split(what, "\n  hint: ");
  return {parts.front(), parts.size() > 1 ? parts[1] : ""};
}

/// A curve shows four numbers a slip, and no stresses.
std::unique_ptr<const Model> make_curve_model(ModelKind kind) {
  if (kind != ModelKind::bekker_wong) return compare::make_model(kind);
  return std::make_unique<const bekker_wong::BekkerWong>(bekker_wong::Detail{.errors = true, .patch = false});
}

Reply estimate_reply(const Setup& setup, const std::string& query) {
  std::vector<Flag> flags = flags_of(query);
  const auto slips = take_slips(flags);
  const Asked asked = setup.ask(flags);
  const Case swept = swept_over(asked.question, slips);
  const Study point = compare::run_study(asked.question), curves = compare::run_study(swept, {}, make_curve_model);
  Json document = answers_json(asked.question, point, compare::doubts(asked.question, point));
  document["command"] = command_line(asked.words);
  document["in_words"] = in_words(asked.question.scenario.tire) + " on " +
                         compare::in_words(asked.question.scenario.soil) + ", " +
                         compare::in_words(asked.question.study.conditions.front());
  document["readings"] = readings_json(point);
  document["numbers"] = numbers_json(asked.question);
  document["effects"] = effect_values_json(asked.question);
  document["curves"] = curves_json(asked.question, point, swept, curves);
  document["stresses"] = stresses_json(point);
  const bool solved = compare::any_result(point);
  if (!solved) {
    document["error"] = "no solution: " + error_and_hint(point.front().answers.front().error).first;
    document["hint"] = compare::any_result(curves) ? "the curves show the slips that have one"
                                                   : "less load, another soil or other effects may have one";
  }
  return {solved ? 200U : 422U, "application/json", document.dump(-1, ' ', false, Json::error_handler_t::replace)};
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
  } catch (const InputError& error) {
    return refusal(400, error.what());
  }
  return refusal(404, fmt::format("there is no '{}' here\n  hint: there are /, /case and /estimate?load=80N&slip=20%25",
                                  clipped(std::string(path))));
}

}  // namespace soilbin::cli
