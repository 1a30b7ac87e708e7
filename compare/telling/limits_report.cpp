// What a wheel can do at best, as it is told; the rows of soilbin-limits/1.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/doubts/doubts.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/telling/answer_report.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/csv.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// At a slip of 100 % a wheel pulls and stands: it climbs nothing.
bool spins_on_the_spot(double slip) { return slip > 1.0 - 1e-6; }

/// Whether the wheel would pull most at a slip at which one in soil digs itself in, and the model knows nothing of it.
bool only_bounds(const WheelLimits& answer) {
  constexpr double digs_in = 0.6;  // by Lyasko's factor the sinkage has doubled there
  return std::ranges::any_of(answer.slopes, [](const SlopeRow& row) { return row.best.slip > digs_in; }) &&
         std::ranges::find(answer.model.effects, "slip_sinkage", &EffectChoice::id) == answer.model.effects.end();
}

/// With what it errs by, or that this is not known.
std::string with_error(const Estimate& estimate, double per_unit = 1.0) {
  return number(estimate, per_unit) + (std::isfinite(estimate.std_error) ? "" : " (± unknown)");
}

std::string slip_in_words(const SlopeRow& row) {
  if (!row.slip) return "none";
  if (spins_on_the_spot(*row.slip)) return "100 (no travel)";
  if (row.perhaps_not_at_all()) return number(100 * *row.slip) + ", or not at all";
  if (*row.slip == row.best.slip) return number(100 * *row.slip);  // the steepest slope's has no error
  return with_error({*row.slip, row.slip_error}, 100);
}

std::string steepest_in_words(const Estimate& steepest, double slip) {
  if (steepest.value >= 0.0 && spins_on_the_spot(slip))
    return fmt::format("Theoretical limit {} deg (100 % slip).", with_error(steepest, 1 / degree));
  if (steepest.value >= 0.0) return fmt::format("Steepest slope {} deg.", with_error(steepest, 1 / degree));
  return fmt::format("It does not move on level ground: it needs a downhill slope of {} deg or more.",
                     with_error({-steepest.value, steepest.std_error}, 1 / degree));
}

/// The slope that a vehicle climbs in practice, with little slip.
std::string within_in_words(const WheelLimits& answer) {
  const std::string slip = fmt::format("{:.3g}", 100 * answer.max_slip);
  if (!answer.steepest_within) return fmt::format("At up to {} % slip it climbs no slope.", slip);
  const Estimate slope{*answer.steepest_within, answer.within_error};
  if (slope.value < 0.0)
    return fmt::format("At up to {} % slip it needs a downhill slope of {} deg.", slip,
                       with_error({-slope.value, slope.std_error}, 1 / degree));
  return fmt::format("At up to {} % slip: {} deg.", slip, with_error(slope, 1 / degree));
}

/// The condition, without what limits look for and a speed that changes nothing.
OperatingCondition limited_at(const WheelLimits& answer) {
  OperatingCondition at = answer.at;
  at.slip = at.longitudinal_incline = 0.0;
  if (answer.at_every_speed) at.speed = OperatingCondition().speed;
  return at;
}

Table slopes_table(const WheelLimits& answer) {
  Table table{fmt::format("{}, {}", model_in_words(answer.model.label), shared_in_words({limited_at(answer)}, false)),
              {"slope [deg]", "slip to climb it [%]", "largest pull [N]", "slip of the largest pull [%]"}};
  for (const SlopeRow& row : answer.slopes)
    table.add({number(row.slope / degree), slip_in_words(row), with_error({row.best.drawbar_pull, row.pull_error}),
               number(100 * row.best.slip)});
  return table;
}

/// What limits the table's numbers, the steepest slope, the one with little slip.
std::vector<std::string> words_on_slopes(const WheelLimits& answer) {
  std::vector<std::string> words;
  if (std::ranges::any_of(answer.slopes, &SlopeRow::perhaps_not_at_all))
    words.emplace_back("or not at all: with the soil one standard error weaker it does not climb this slope.");
  if (only_bounds(answer))
    words.emplace_back(
        "Without slip sinkage the largest pull and the steepest slope are upper bounds. Add --effect slip_sinkage.");
  if (!answer.steepest) {
    words.emplace_back("The steepest slope lies beyond -60 .. 80 deg.");
    return words;
  }
  words.push_back(steepest_in_words({*answer.steepest, answer.steepest_error}, answer.slopes.back().best.slip));
  words.push_back(within_in_words(answer));
  if (const SlopeRow& level = answer.slopes.front(); std::isfinite(level.best_spin))
    words.push_back(fmt::format("Where it pulls most on level ground it turns with {} rad/s at {} m/s.",
                                number(level.best_spin), number(answer.at.speed, 3)));
  if (answer.towed)
    words.push_back(fmt::format("Towed over level ground, without torque, it slips by {} % and is pulled with {} N.",
                                with_error(answer.towed->slip, 100), with_error(answer.towed->resistance)));
  return words;
}

Json limits_row(const WheelLimits& answer) {
  Json row = {{"label", answer.model.label}};
  row.update(to_json(answer.at));
  row.erase("slip");
  row.erase("longitudinal_incline");
  if (answer.at_every_speed) row.erase("speed");
  if (!answer.error.empty()) {
    row["error"] = answer.error;
    return row;
  }
  row["steepest_slope"] = or_null(answer.steepest);
  row["std_error"]["steepest_slope"] = finite(answer.steepest_error);
  row["max_slip"] = answer.max_slip;
  row["steepest_slope_within_max_slip"] = or_null(answer.steepest_within);
  row["std_error"]["steepest_slope_within_max_slip"] = finite(answer.within_error);
  row["towed"] = answer.towed ? Json{{"slip", estimate_json(answer.towed->slip)},
                                     {"resistance", estimate_json(answer.towed->resistance)}}
                              : Json();
  row["slopes"] = list_of(answer.slopes, [](const SlopeRow& slope) {
    return Json{{"longitudinal_incline", slope.slope},
                {"slip", or_null(slope.slip)},
                {"largest_pull", slope.best.drawbar_pull},
                {"slip_of_largest_pull", slope.best.slip},
                {"spin_of_largest_pull", finite(slope.best_spin)},
                {"std_error", {{"slip", finite(slope.slip_error)}, {"largest_pull", finite(slope.pull_error)}}}};
  });
  return row;
}

/// A row a slope, with the remark on its answer.
std::string limits_csv(const std::vector<WheelLimits>& answers, const std::vector<ModelAnswers>& at_limits,
                       const Remark& remark) {
  const bool with_pressure =
      std::ranges::any_of(answers, [](const WheelLimits& a) { return a.at.inflation_pressure.has_value(); });
  std::string text = std::string("model,load_N,speed_m_s,transverse_incline_deg,yaw_deg,pass,") +
                     (with_pressure ? "inflation_pressure_kPa," : "") +
                     "slope_deg,slip,slip_se,largest_pull_N,largest_pull_se_N,slip_of_largest_pull,max_slip,"
                     "steepest_slope_within_max_slip_deg,steepest_slope_within_max_slip_se_deg,error,remark\n";
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const WheelLimits& answer = answers[i];
    const OperatingCondition& at = answer.at;
    const std::string pressure = at.inflation_pressure ? csv_number(*at.inflation_pressure / 1000) : "";
    const std::string asked =
        fmt::format("{},{},{},{},{},{}", csv_cell(answer.model.label), csv_number(at.load),
                    answer.at_every_speed ? "" : csv_number(at.speed), csv_number(at.transverse_incline / degree),
                    csv_number(at.yaw / degree), at.pass) +
        (with_pressure ? "," + pressure : "");
    if (!answer.error.empty()) text += asked + ",,,,,,,,,," + csv_cell(answer.error) + ",\n";
    const std::string within = csv_number(answer.max_slip) + "," +
                               (answer.steepest_within ? csv_number(*answer.steepest_within / degree) + "," +
                                                             csv_number(answer.within_error / degree)
                                                       : ",");
    for (std::size_t k = 0; k < answer.slopes.size(); ++k) {
      const SlopeRow& row = answer.slopes[k];
      text += fmt::format("{},{},{},{},{},{},{},,{}\n", asked, csv_number(row.slope / degree),
                          row.slip ? csv_number(*row.slip) + "," + csv_number(row.slip_error) : ",",
                          csv_number(row.best.drawbar_pull), csv_number(row.pull_error), csv_number(row.best.slip),
                          within, csv_cell(remark(answer.model, at_limits[i].answers[k])));
    }
  }
  return text;
}

/// Largest pull against the slope with its standard error, and the slips, at more slopes than the answers hold: a
/// colour for each model and load.
Sheet limits_sheet(const Case& question, const std::vector<WheelLimits>& limits) {
  const std::vector<WheelLimits> answers = at_more_slopes(question.scenario, limits);
  const Axis slope{"slope [deg]"};
  const bool one_load = std::ranges::all_of(
      answers, [&](const WheelLimits& answer) { return answer.at.load == answers.front().at.load; });
  Case limited = question;
  limited.study.conditions.clear();
  for (const WheelLimits& answer : limits) limited.study.conditions.push_back(limited_at(answer));
  Sheet sheet{title_of_question(limited, false), {{"Largest pull [N]", slope, {}, {}}, {"Slip [%]", slope, {}, {}}}};
  sheet.note = "bands: one standard error of the largest pull, from the standard deviations of the soil's values";
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const WheelLimits& answer = answers[i];
    const std::string model = model_in_words(answer.model.label),
                      which = one_load ? model : fmt::format("{}, {:.6g} N", model, answer.at.load);
    const auto add = [&](std::size_t plot, const std::string& label, int dash, const auto& value) {
      sheet.plots[plot].series.push_back(over_samples(
          {.label = which + ": " + label, .color = static_cast<int>(i), .dash = dash}, answer.slopes,
          [](const SlopeRow& row) { return row.slope / degree; }, value));
    };
    add(0, "largest pull", 0, [](const SlopeRow& row) { return row.best.drawbar_pull; });
    for (const SlopeRow& row : answer.slopes) sheet.plots[0].series.back().error.push_back(row.pull_error);
    add(1, "slip at which it climbs the slope", 2,
        [](const SlopeRow& row) { return row.slip ? 100 * *row.slip : not_a_number; });
    add(1, "slip of the largest pull", 1, [](const SlopeRow& row) { return 100 * row.best.slip; });
    if (answer.steepest_within && *answer.steepest_within >= 0.0) {
      sheet.plots[1].series.push_back(
          {.label = fmt::format("{}: steepest slope at up to {:.3g} % slip", which, 100 * answer.max_slip),
           .x = {*answer.steepest_within / degree},
           .y = {100 * answer.max_slip},
           .mark = Mark::points,
           .color = static_cast<int>(i)});
    }
  }
  if (std::ranges::all_of(sheet.plots[0].series, [](const Series& series) {
        return std::ranges::all_of(series.error, [](double error) { return error == 0.0; });
      }))
    sheet.note.clear();
  return sheet;
}

}  // namespace

Json limits_rows(const std::vector<WheelLimits>& answers) { return list_of(answers, limits_row); }

Report report_on(const Case& question, const std::vector<WheelLimits>& answers,
                 const std::vector<ModelAnswers>& at_limits) {
  Report report{"Limits of " + question.scenario.tire.name,
                "The largest pull and the steepest slope in a steady state.",
                asked_in_words(question) + "\n" + errors_in_words(question)};
  for (const WheelLimits& answer : answers) {
    Table table = slopes_table(answer);
    if (answer.error.empty()) {
      report.add(std::move(table));
      report.add(Sentences(words_on_slopes(answer)));
    } else {
      report.add(Sentences(std::vector<BackedSentence>{{table.caption, "no solution: " + answer.error}}));
    }
  }
  if (const std::string errors = errors_in_words(question); !errors.empty())
    report.add(Prose{{errors}}, Told::to_look_at);
  report.add(WarningsHere());
  report.sheet = drawn_once([&] { return limits_sheet(question, answers); });
  if (std::ranges::none_of(answers, [](const WheelLimits& answer) { return answer.error.empty(); }))
    report.no_answer = "no solution: " + answers.front().error;
  report.add("Against the slope", Figure(report.sheet, "Bands: one standard error of the largest pull."));
  report.csv = [&] { return limits_csv(answers, at_limits, remarks_about(question.scenario)); };
  return report;
}

}  // namespace soilbin::compare
