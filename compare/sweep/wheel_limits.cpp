#include "compare/sweep/wheel_limits.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "bekker_wong/model.hpp"
#include "bekker_wong/standard_errors.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/sweep/wheel_power.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// Slopes from level ground to the steepest one, at whole degrees that make about ten rows.
std::vector<double> slopes_up_to(double steepest) {
  double step = 1.0;
  for (const double wider : {2.0, 5.0, 10.0})
    if (steepest / degree / step > 10.0) step = wider;
  std::vector<double> slopes = {0.0};
  while ((static_cast<double>(slopes.size()) * step) * degree < steepest)
    slopes.push_back(static_cast<double>(slopes.size()) * step * degree);
  if (steepest > 0.0) slopes.push_back(steepest);
  return slopes;
}

bekker_wong::RollingWheel wheel_of(const Scenario& scenario, const ModelChoice& model) {
  return {scenario.tire, bekker_wong::values_of(*scenario.soil.semi_empirical),
          bekker_wong::make_effects(model.effects), scenario.bin};
}

bekker_wong::RollingWheel wheel_of(const Scenario& scenario) {
  if (!scenario.soil.semi_empirical) throw InputError("soil '" + scenario.soil.name + "' has no semi_empirical values");
  ModelChoice choice;
  choice.effects = scenario.effects;
  return wheel_of(scenario, choice);
}

/// Slopes for a smooth line: closer together towards the steepest one, where the slip turns up.
std::vector<double> many_slopes_up_to(double steepest) {
  constexpr int points = 41;
  if (steepest <= 0.0) return {0.0};
  std::vector<double> slopes;
  for (int i = 0; i < points; ++i) {
    const double left = 1.0 - static_cast<double>(i) / (points - 1);
    slopes.push_back(i + 1 == points ? steepest : steepest * (1.0 - left * left));
  }
  return slopes;
}

const bekker_wong::BekkerWong& with_errors() {
  static const bekker_wong::BekkerWong model({.errors = true, .patch = false});
  return model;
}

/// A slip or slope x, up to `most`, at which the pull F has a given value: to first order its error is that of F there
/// over |dF/dx|.
double error_of_root(const Scenario& scenario, const OperatingCondition& at, double OperatingCondition::*x,
                     double most) {
  constexpr double step = 1e-4;
  const bekker_wong::BekkerWong values({.errors = false, .patch = false});
  const Answer here = ask(with_errors(), scenario, at);
  OperatingCondition below = at, above = at;
  below.*x -= step, above.*x = std::min(at.*x + step, most);
  const Answer less = ask(values, scenario, below), more = ask(values, scenario, above);
  if (!here.result || !less.result || !more.result) return not_a_number;
  const double rise = more.result->drawbar_pull.value - less.result->drawbar_pull.value;
  return here.result->drawbar_pull.std_error * (above.*x - below.*x) / std::abs(rise);
}

/// Standard error of the steepest slope, at the slip of the largest pull there or of the largest that is allowed.
double error_of_steepest(const Scenario& scenario, const OperatingCondition& at) {
  return error_of_root(scenario, at, &OperatingCondition::longitudinal_incline, at.longitudinal_incline + 1.0);
}

/// Its errors to first order: with the torque M held at none, what changes pull F and torque by dF and dM changes the
/// slip by -dM/M_s and the pull by dF - F_s dM/M_s.
TowedWheel towed_at(const Scenario& scenario, OperatingCondition at, double slip) {
  constexpr double step = 1e-4;
  const bekker_wong::RollingWheel wheel = wheel_of(scenario);
  at.slip = slip - step;
  const bekker_wong::Reading less = wheel.roll(at).reading;
  at.slip = slip + step;
  const bekker_wong::Reading more = wheel.roll(at).reading;
  at.slip = slip;
  const bekker_wong::RolledWheel free = wheel.roll(at);
  const double torque_rise = (more.torque - less.torque) / (2 * step),
               pull_rise = (more.drawbar_pull - less.drawbar_pull) / (2 * step);
  const bekker_wong::ChannelErrors errors(free, scenario, bekker_wong::make_effects(scenario.effects));
  const auto error_of = [&](double by_pull, double by_torque) {
    return errors.without().empty() ? errors.of({by_pull, by_torque}) : not_a_number;
  };
  return {{slip, error_of(0.0, -1.0 / torque_rise)},
          {-free.reading.drawbar_pull, error_of(1.0, -pull_rise / torque_rise)}};
}

std::optional<TowedWheel> towed(const bekker_wong::RollingWheel& wheel, const Scenario& scenario,
                                OperatingCondition at) {
  at.force_frame = ForceFrame::travel;
  const std::optional<double> slip = bekker_wong::free_slip(wheel, at);
  if (!slip) return std::nullopt;
  try {
    return towed_at(scenario, at, *slip);
  } catch (const NoSolution&) {  // just beside it the soil does not carry the load
    return std::nullopt;
  }
}

/// To first order. The largest pull changes with the soil as the pull at its slip does (the envelope theorem).
void add_errors(const Scenario& scenario, WheelLimits& answer) {
  OperatingCondition at = answer.at;
  const bekker_wong::RollingWheel wheel = wheel_of(scenario, answer.model);
  const auto error_at = [&](double steepest, double max_slip) {
    at.longitudinal_incline = steepest;
    at.slip = bekker_wong::largest_pull(wheel, at, max_slip).slip;
    return error_of_steepest(scenario, at);
  };
  if (answer.steepest_within) answer.within_error = error_at(*answer.steepest_within, answer.max_slip);
  if (answer.steepest && *answer.steepest < 0.0) answer.steepest_error = error_at(*answer.steepest, 1.0);  // of no row
  for (SlopeRow& row : answer.slopes) {
    at.longitudinal_incline = row.slope, at.slip = row.best.slip;
    if (const Answer best = ask(with_errors(), scenario, at); best.result)
      row.pull_error = best.result->drawbar_pull.std_error;
    if (row.slope == answer.steepest) {
      answer.steepest_error = error_of_steepest(scenario, at);
    } else if (row.slip && !row.perhaps_not_at_all()) {
      at.slip = *row.slip;
      row.slip_error = error_of_root(scenario, at, &OperatingCondition::slip, 1.0);
    }
  }
}

std::optional<double> steepest_within(const bekker_wong::RollingWheel& wheel, const OperatingCondition& at,
                                      double max_slip) {
  try {
    return bekker_wong::steepest_slope(wheel, at, 0.0, max_slip);
  } catch (const NoSolution&) {  // at larger slips alone does the soil carry the load
    return {};
  }
}

WheelLimits limits_at(const Scenario& scenario, const ModelChoice& model, const OperatingCondition& at, double max_slip,
                      std::vector<double> (*slopes)(double steepest)) {
  WheelLimits answer;
  answer.model = model, answer.at = at, answer.max_slip = max_slip;
  if (model.model != ModelKind::bekker_wong) throw InputError("limits asks the model bekker_wong alone");
  const bekker_wong::RollingWheel wheel = wheel_of(scenario, model);
  try {
    OperatingCondition there = at;
    there.longitudinal_incline = 0.0;
    answer.steepest = bekker_wong::steepest_slope(wheel, there);
    for (const double slope : slopes(answer.steepest.value_or(0.0))) {
      there.longitudinal_incline = slope;
      SlopeRow row{slope, bekker_wong::slip_for_pull(wheel, there), bekker_wong::largest_pull(wheel, there)};
      if (row.slip && std::abs(*row.slip) < 1e-9) row.slip = 0.0;  // closer than the root is found
      if (slope == answer.steepest)
        row.slip = row.best.slip, row.best.drawbar_pull = 0.0;  // that is what steepest means
      TractionResult best;
      best.at = there, best.at.slip = row.best.slip;
      if (const auto turns = power_of(scenario.tire, best)) row.best_spin = turns->spin;
      answer.slopes.push_back(row);
    }
    there.longitudinal_incline = 0.0;
    answer.towed = towed(wheel, seen_by(model, scenario), there);
    answer.steepest_within = steepest_within(wheel, there, max_slip);
    add_errors(seen_by(model, scenario), answer);
  } catch (const NoSolution& error) {
    answer.error = error.what();
  }
  return answer;
}

/// Whether two answers differ in nothing but the speed at which they were asked: most models hear nothing of it.
bool same_but_speed(const WheelLimits& a, const WheelLimits& b) {
  OperatingCondition at = b.at;
  at.speed = a.at.speed;
  return a.model.label == b.model.label && alike(a.at, at) && a.error == b.error && a.steepest == b.steepest &&
         a.steepest_within == b.steepest_within && a.slopes == b.slopes;
}

/// The conditions of a question, slip left aside, each once.
std::vector<OperatingCondition> without_slip(const std::vector<OperatingCondition>& conditions) {
  std::vector<OperatingCondition> kept;
  std::set<std::string> seen;
  for (OperatingCondition at : conditions) {
    at.slip = 0.0;
    at.longitudinal_incline = 0.0;
    if (seen.insert(to_json(at).dump()).second) kept.push_back(at);
  }
  return kept;
}

}  // namespace

LargestPull largest_pull(const Scenario& scenario, OperatingCondition at) {
  at.force_frame = ForceFrame::travel;
  const bekker_wong::PullPeak peak = bekker_wong::largest_pull(wheel_of(scenario), at);
  at.slip = peak.slip;
  const Answer best = ask(with_errors(), scenario, at);
  return {peak.slip, {peak.drawbar_pull, best.result ? best.result->drawbar_pull.std_error : not_a_number}};
}

std::optional<Estimate> slip_for_pull(const Scenario& scenario, OperatingCondition at, double drawbar) {
  at.force_frame = ForceFrame::travel;
  const std::optional<double> slip = bekker_wong::slip_for_pull(wheel_of(scenario), at, drawbar);
  if (!slip) return std::nullopt;
  const Estimate most = largest_pull(scenario, at).drawbar_pull;
  if (!(most.value - drawbar >= most.std_error)) return Estimate{*slip, not_a_number};
  at.slip = *slip;
  return Estimate{*slip, error_of_root(scenario, at, &OperatingCondition::slip, 1.0)};
}

std::optional<Estimate> steepest_slope(const Scenario& scenario, OperatingCondition at, double drawbar) {
  at.force_frame = ForceFrame::travel;
  const bekker_wong::RollingWheel wheel = wheel_of(scenario);
  const std::optional<double> steepest = bekker_wong::steepest_slope(wheel, at, drawbar);
  if (!steepest) return std::nullopt;
  at.longitudinal_incline = *steepest;
  at.slip = bekker_wong::largest_pull(wheel, at).slip;
  return Estimate{*steepest, error_of_steepest(scenario, at)};
}

std::vector<WheelLimits> limits_of(const Case& question, double max_slip) {
  std::vector<WheelLimits> answers;
  for (const ModelChoice& model : question.study.models)
    for (const OperatingCondition& at : without_slip(question.study.conditions)) {
      WheelLimits answer = limits_at(question.scenario, model, at, max_slip, slopes_up_to);
      const auto known =
          std::ranges::find_if(answers, [&](const WheelLimits& other) { return same_but_speed(other, answer); });
      if (known == answers.end())
        answers.push_back(std::move(answer));
      else
        known->at_every_speed = true;
    }
  return answers;
}

std::vector<WheelLimits> at_more_slopes(const Scenario& scenario, const std::vector<WheelLimits>& answers) {
  std::vector<WheelLimits> more;
  for (const WheelLimits& one : answers)
    more.push_back(one.error.empty() ? limits_at(scenario, one.model, one.at, one.max_slip, many_slopes_up_to) : one);
  return more;
}

/// The wheel where it pulls most on each slope: what there is to doubt in the answer.
namespace {

/// The wheel on each slope at the slip that `slip_of` a row gives; none: not asked.
std::vector<ModelAnswers> answers_on_slopes(const Case& question, const std::vector<WheelLimits>& answers,
                                            const auto& slip_of) {
  const bekker_wong::BekkerWong model({.errors = false, .patch = false});
  std::vector<ModelAnswers> study;
  for (const WheelLimits& answer : answers) {
    const Scenario scenario = seen_by(answer.model, question.scenario);
    study.push_back({answer.model, {}});
    for (const SlopeRow& row : answer.slopes) {
      const std::optional<double> slip = slip_of(row);
      if (!slip) continue;
      OperatingCondition at = answer.at;
      at.longitudinal_incline = row.slope, at.slip = *slip;
      study.back().answers.push_back(ask(model, scenario, at));
    }
  }
  return study;
}

bool asks_analytic_wheel(const Case& question) {
  return question.scenario.soil.semi_empirical && question.study.models.front().model == ModelKind::bekker_wong;
}

}  // namespace

std::vector<ModelAnswers> answers_at_limits(const Case& question, const std::vector<WheelLimits>& answers) {
  return answers_on_slopes(question, answers, [](const SlopeRow& row) { return std::optional(row.best.slip); });
}

std::vector<ModelAnswers> answers_below_no_slip(const Case& question, const std::vector<WheelLimits>& answers) {
  return answers_on_slopes(question, answers, [](const SlopeRow& row) {
    return row.slip.value_or(0.0) < 0.0 && row.slope >= 0.0 ? row.slip : std::nullopt;
  });
}

std::optional<double> carried_load(const Case& question) {
  if (!asks_analytic_wheel(question)) return std::nullopt;
  const OperatingCondition& at = question.study.conditions.front();
  try {
    return bekker_wong::largest_load(wheel_of(question.scenario, question.study.models.front()), at, at.load);
  } catch (const std::exception&) {  // whatever keeps the model from an answer there, its own error says
    return std::nullopt;
  }
}

std::optional<double> steepest_slope(const Case& question) {
  if (!asks_analytic_wheel(question)) return std::nullopt;
  OperatingCondition at = question.study.conditions.front();
  at.longitudinal_incline = 0.0;
  try {
    return bekker_wong::steepest_slope(wheel_of(question.scenario, question.study.models.front()), at);
  } catch (const std::exception&) {  // whatever keeps the model from an answer there, its own error says
    return std::nullopt;
  }
}

}  // namespace soilbin::compare
