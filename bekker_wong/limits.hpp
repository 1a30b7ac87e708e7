// What a wheel can do at best in a steady state: largest pull, slip for a given pull, largest load, steepest slope; the
// slip at which it rolls freely.
//
//   const RollingWheel wheel(tire, values_of(soil));
//   const PullPeak peak = largest_pull(wheel, {.load = 4000});           // peak.drawbar_pull [N] at peak.slip
//   const auto slip = slip_for_pull(wheel, {.load = 4000}, 500);         // at which it pulls 500 N; none: it can't
//   const auto slope = steepest_slope(wheel, {.load = 4000});            // [rad]
#pragma once

#include <optional>

#include "bekker_wong/rolling_wheel.hpp"

namespace soilbin::bekker_wong {

/// The largest drawbar pull and the slip that gives it.
struct PullPeak {
  double slip = 0.0;
  double drawbar_pull = 0.0;  ///< [N], less the slope's share of the load
};

/// Largest drawbar pull over 0 <= slip <= max_slip (up to 1) at an otherwise given condition. Slips without a balance
/// are passed over; throws NoSolution where there is no other.
PullPeak largest_pull(const RollingWheel& wheel, const OperatingCondition& at, double max_slip = 1.0);

/// Smallest slip above -0.5 at which the wheel pulls `drawbar` [N] on the slope that `at` gives; one below where it
/// pulls more at -0.5, as steep downhill. None where it can't, or where it pulls more even when locked or at the lowest
/// slip at which the soil carries it.
std::optional<double> slip_for_pull(const RollingWheel& wheel, const OperatingCondition& at, double drawbar = 0.0);

/// The slip next to 0 at which the wheel takes no torque, on the slope that `at` gives: towed, it rolls freely. None
/// where there is none above -0.95, or where from 0 to it the soil does not carry the load at every slip.
std::optional<double> free_slip(const RollingWheel& wheel, OperatingCondition at);

/// The largest load [N] up to `beyond` that the soil carries under the wheel at the slip and on the slope of `at`, to
/// 1e-4 of it, by bisection; none where it carries no millionth of `beyond`.
std::optional<double> largest_load(const RollingWheel& wheel, OperatingCondition at, double beyond);

/// Steepest slope [rad] that the wheel climbs at a slip up to max_slip while it pulls `drawbar` [N]: there its largest
/// pull is just that. Between -60 and 80 deg; none where it does not even get down the one, or would climb the other.
/// At a max_slip of 1 that is a theoretical limit: a wheel that slips by 100 % does not travel.
std::optional<double> steepest_slope(const RollingWheel& wheel, const OperatingCondition& at, double drawbar = 0.0,
                                     double max_slip = 1.0);

}  // namespace soilbin::bekker_wong
