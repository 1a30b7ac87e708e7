// A number with its standard error: the type of every result and of every measured input.
//
//   const Estimate pull = mean_of(std::array{812.0, 830.0, 821.0});  // [N] three repeats: 821, standard error 5.2
#pragma once

#include <limits>
#include <span>

namespace soilbin {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A number and its standard error (or, for an input, its standard deviation), both in the same unit.
/// std_error 0 means "taken as exact".
struct Estimate {
  double value = 0.0;
  double std_error = 0.0;
};

/// Sample standard deviation of repeats; 0 for fewer than two.
double spread_of(std::span<const double> repeats);

/// Mean of repeats and its standard error, 0 for one. NaN without any.
Estimate mean_of(std::span<const double> repeats);

}  // namespace soilbin
