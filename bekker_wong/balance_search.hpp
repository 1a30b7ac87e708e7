// Where the soil carries the load: the smallest root of the wheel's balance, fast where it is easy and found where it
// is not. The function searched is f(x) = ln(carried load/load) of x = ln(theta_1), nearly a line.
#pragma once

#include <optional>

#include "bekker_wong/gsl.hpp"

namespace soilbin::bekker_wong {

/// A root, with the slope of f on the way to it.
struct RisingRoot {
  double x = 0.0, slope = 0.0;
};

/// Root through which f rises, by the secant method from `start` with a first guess of the slope: done where
/// |f| <= tolerance, and then f was last called at the root. Empty where that is not reached in 12 calls, where f does
/// not rise (a braked wheel beyond the most that the soil carries) or where the root seems to lie beyond `upper`.
std::optional<RisingRoot> rising_root(gsl::FunctionRef f, double start, double slope, double upper, double tolerance);

/// What a search of the whole range found.
struct FirstRoot {
  std::optional<double> x;  ///< smallest root
  gsl::Sample highest;      ///< else: where f is greatest
};

/// Smallest x in (-40, upper] where f rises through 0: f is followed upward from where it is negative in steps of 0.05,
/// a hump between two steps included; then Brent's method to 1e-15. Empty too where f > 0 however small x.
FirstRoot first_rising_root(gsl::FunctionRef f, double upper);

/// The high point of f, x up to `upper`, that a climb from `about` leads to; x to 1e-5.
gsl::Sample climb(gsl::FunctionRef f, double about, double upper);

}  // namespace soilbin::bekker_wong
