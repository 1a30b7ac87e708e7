// What a wheel can do at best in a steady state, slope by slope: the largest pull, the slip that climbs, the steepest
// slope.
//
//   for (const WheelLimits& limits : limits_of(question)) limits.steepest;
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/limits.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// A wheel that takes no torque, on level ground: what pulls it along.
struct TowedWheel {
  Estimate slip{};
  Estimate resistance{};  ///< [N]; neither has an error where a value of the soil has no derivative
};

/// What a wheel can do on one slope.
struct SlopeRow {
  double slope = 0.0;          ///< [rad]
  std::optional<double> slip;  ///< at which it travels without a load behind it
  bekker_wong::PullPeak best;
  double slip_error =
      not_a_number;         ///< of `slip`; none on the steepest slope, where that slip is best.slip, and where
                            ///< it may not climb at all: near the pull's peak a slip has no error to first order
  double pull_error = 0.0;  ///< standard error of best.drawbar_pull [N]
  double best_spin = not_a_number;  ///< angular speed at the largest pull [rad/s]; none where it spins on the spot

  /// Whether one standard error of the soil's values makes the slope one that it does not climb.
  bool perhaps_not_at_all() const { return slip && best.drawbar_pull > 0.0 && best.drawbar_pull < pull_error; }

  bool operator==(const SlopeRow& other) const {
    return slope == other.slope && slip == other.slip && best.slip == other.best.slip &&
           best.drawbar_pull == other.best.drawbar_pull;
  }
};

/// One model at one load.
struct WheelLimits {
  ModelChoice model;
  OperatingCondition at;
  std::optional<double> steepest;         ///< [rad]
  double steepest_error = 0.0;            ///< its standard error [rad]
  double max_slip = 0.2;                  ///< up to which the wheel slips in `steepest_within`
  std::optional<double> steepest_within;  ///< [rad]; nothing also where there is no balance at such slips
  double within_error = 0.0;              ///< its standard error [rad]
  std::vector<SlopeRow> slopes;
  std::optional<TowedWheel> towed{};  ///< none where the torque is 0 at no slip that is looked at
  std::string error;                  ///< why there is no answer; empty where there is one
  bool at_every_speed = false;        ///< of the question's: the same answer
};

/// Limits by each analytic model at each condition of the question, slip and incline left aside; conditions that
/// differ in nothing else count once, and those that differ in a speed that changes nothing too. With standard errors
/// to first order, from those of soil and effects. max_slip, 0 .. 1: of the slope that is climbed with so little slip,
/// beside the theoretical one, at which the wheel may slip by 100 %. Throws InputError for another model.
std::vector<WheelLimits> limits_of(const Case& question, double max_slip = 0.2);

/// Steepest slope [rad] that the wheel climbs while it pulls `drawbar` [N], with its standard error to first order;
/// none as of bekker_wong::steepest_slope. The slip and the incline of `at` are not read. Throws InputError for a soil
/// without semi_empirical values, NoSolution.
std::optional<Estimate> steepest_slope(const Scenario& scenario, OperatingCondition at, double drawbar = 0.0);

/// The largest drawbar pull over 0 <= slip <= 1 [N] with its standard error to first order, and the slip that gives it.
struct LargestPull {
  double slip = 0.0;
  Estimate drawbar_pull;
};
/// The slip and the force frame of `at` are not read. Throws InputError for a soil without semi_empirical values, and
/// NoSolution where no slip has a balance.
LargestPull largest_pull(const Scenario& scenario, OperatingCondition at);

/// The smallest slip at which the wheel pulls `drawbar` [N], as bekker_wong::slip_for_pull, with its standard error to
/// first order; that is not a number near the pull's peak, where the wheel may not pull so much at all. Throws as
/// largest_pull.
std::optional<Estimate> slip_for_pull(const Scenario& scenario, OperatingCondition at, double drawbar = 0.0);

/// The wheel where it pulls most on each slope: what there may be doubts about.
std::vector<ModelAnswers> answers_at_limits(const Case& question, const std::vector<WheelLimits>& answers);

/// The largest load [N], up to the one that is asked for, that the soil carries at the question's first condition under
/// the wheel of its first model; nothing where it carries none, is known by its grains alone, or is asked of another
/// model than bekker_wong.
std::optional<double> carried_load(const Case& question);

/// The steepest slope [rad] that the wheel of the question's first model climbs under its first condition, at whatever
/// slip; nothing where there is none, the soil is known by its grains alone, or another model than bekker_wong is
/// asked.
std::optional<double> steepest_slope(const Case& question);

/// The wheel where it climbs slopes with its rim slower than its travel: what there may be doubts about.
std::vector<ModelAnswers> answers_below_no_slip(const Case& question, const std::vector<WheelLimits>& answers);

/// The answers at more slopes, for a drawing; one without an answer stays as it is.
std::vector<WheelLimits> at_more_slopes(const Scenario& scenario, const std::vector<WheelLimits>& answers);

}  // namespace soilbin::compare
