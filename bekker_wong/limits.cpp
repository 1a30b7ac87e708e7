#include "bekker_wong/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bekker_wong/gsl.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr double slip_step = 0.025;

/// Drawbar pull at a slip; minus infinity where no sinkage carries the load.
double pull_at(const RollingWheel& wheel, OperatingCondition at, double slip) {
  at.slip = slip;
  at.force_frame = ForceFrame::travel;
  try {
    return wheel.roll(at).reading.drawbar_pull;
  } catch (const NoSolution&) {
    return nothing;
  }
}

/// The lowest slip at which f is finite, between one without and one with a value, to 1e-9.
double first_with_value(gsl::FunctionRef f, double without, double with) {
  while (with - without > 1e-9) {
    const double middle = 0.5 * (without + with);
    (std::isfinite(f(middle)) ? with : without) = middle;
  }
  return with;
}

/// Highest point of f in [low, high], where it rises and then falls, by golden section.
double summit(gsl::FunctionRef f, double low, double high) {
  constexpr double golden = 0.6180339887498949, narrow = 1e-7;
  double a = high - golden * (high - low), b = low + golden * (high - low), fa = f(a), fb = f(b);
  while (high - low > narrow) {
    if (fa > fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

PullPeak largest_pull(const RollingWheel& wheel, const OperatingCondition& at, double max_slip) {
  const auto f = [&](double slip) { return pull_at(wheel, at, slip); };
  PullPeak best{0.0, nothing};
  for (double slip = 0.0; slip < max_slip + 0.5 * slip_step; slip += slip_step)
    if (const double pull = f(std::min(slip, max_slip)); pull > best.drawbar_pull)
      best = {std::min(slip, max_slip), pull};
  if (best.drawbar_pull == nothing) throw NoSolution("at no slip does the soil carry the load");
  const double top = summit(f, std::max(0.0, best.slip - slip_step), std::min(max_slip, best.slip + slip_step));
  if (const double pull = f(top); pull > best.drawbar_pull) best = {top, pull};
  return best;
}

std::optional<double> slip_for_pull(const RollingWheel& wheel, const OperatingCondition& at, double drawbar) {
  const auto spare = [&](double slip) { return pull_at(wheel, at, slip) - drawbar; };
  constexpr double lowest = -0.5;
  double before = lowest, at_before = spare(lowest);
  while (at_before >= 0.0) {  // steep downhill: braked further
    if (before <= -1.0) return {};
    before = std::max(before - slip_step, -1.0), at_before = spare(before);
  }
  for (double slip = before + slip_step; slip < 1.0 + 0.5 * slip_step; slip += slip_step) {
    const double here = std::min(slip, 1.0), value = spare(here);
    if (value >= 0.0) {
      if (!std::isfinite(at_before)) {
        before = first_with_value(spare, before, here), at_before = spare(before);
        if (at_before > 0.0) return {};
      }
      return gsl::bracketed_root(spare, {before, at_before}, {here, value}, 1e-12, 1e-10 * at.load,
                                 "the slip for a pull");
    }
    before = here, at_before = value;
  }
  const PullPeak peak = largest_pull(wheel, at);  // a summit between two slips of the scan
  if (peak.drawbar_pull < drawbar) return {};
  return gsl::bracketed_root(spare, std::max(lowest, peak.slip - slip_step), peak.slip, 1e-12, 1e-10 * at.load,
                             "the slip for a pull");
}

std::optional<double> free_slip(const RollingWheel& wheel, OperatingCondition at) {
  constexpr double most_braked = -0.95;
  const auto torque = [&](double slip) {
    at.slip = slip;
    return wheel.roll(at).reading.torque;
  };
  try {
    double before = 0.0, at_before = torque(before);
    const double step = at_before > 0.0 ? -slip_step : slip_step;
    while (at_before != 0.0) {
      const double here = std::clamp(before + step, most_braked, 1.0), value = torque(here);
      if (here == before) return {};
      if ((value > 0.0) != (at_before > 0.0))
        return gsl::bracketed_root(torque, {before, at_before}, {here, value}, 1e-12,
                                   1e-10 * at.load * wheel.tire().radius, "the slip of a free wheel");
      before = here, at_before = value;
    }
    return before;
  } catch (const NoSolution&) {
    return {};
  }
}

std::optional<double> largest_load(const RollingWheel& wheel, OperatingCondition at, double beyond) {
  const auto carries = [&](double load) {
    at.load = load;
    return pull_at(wheel, at, at.slip) != nothing;
  };
  double low = 1e-6 * beyond, high = beyond;
  if (!carries(low)) return {};
  if (carries(high)) return high;
  while (high - low > 1e-4 * low) {
    const double middle = std::sqrt(low * high);
    (carries(middle) ? low : high) = middle;
  }
  return low;
}

std::optional<double> steepest_slope(const RollingWheel& wheel, const OperatingCondition& at, double drawbar,
                                     double max_slip) {
  constexpr double low = -60 * degree, high = 80 * degree;
  const auto spare = [&](double slope) {
    OperatingCondition there = at;
    there.longitudinal_incline = slope;
    return (largest_pull(wheel, there, max_slip).drawbar_pull - drawbar) / at.load;
  };
  if (spare(low) < 0.0 || spare(high) > 0.0) return {};
  return gsl::bracketed_root(spare, low, high, 1e-9, 1e-10, "the steepest slope");
}

}  // namespace soilbin::bekker_wong
