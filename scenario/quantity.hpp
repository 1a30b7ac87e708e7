// Numbers with units, to SI and back. What is written reads back to the same bits.
//
//   read_quantity("11 mm", {"m", above_zero})                // 0.011 [m]
//   read_quantity("0.99 kN/m^(n+1)", {"kN/m^(n+1)"}, 1.1)    // 990 [N/m^2.1]; 1.1: the soil's exponent n
//   write_quantity(0.011, "mm")                              // "11 mm"
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "scenario/unit.hpp"

namespace soilbin {

/// Admissible values [SI]; an open end is not admissible itself.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  constexpr bool holds(double x) const {
    return (lower_open ? x > lower : x >= lower) && (upper_open ? x < upper : x <= upper);
  }
};

/// Two points about a value of the range, a step below and a step above it. A point that would pass a bound lies on the
/// bound, or on the value itself where the bound is open: a difference over the two is then one-sided.
struct Neighbours {
  double below, above;
};
constexpr Neighbours neighbours(double x, double step, const Range& range) {
  return {.below = range.holds(x - step) ? x - step
                   : range.lower_open    ? x
                                         : range.lower,
          .above = range.holds(x + step) ? x + step
                   : range.upper_open    ? x
                                         : range.upper};
}

inline constexpr Range any_value{};
inline constexpr Range above_zero{.lower = 0.0, .lower_open = true};
inline constexpr Range zero_or_more{.lower = 0.0};

/// What a number in a file measures: the unit in which it is written, and the values it may take.
struct Measure {
  std::string unit = "-";  ///< "-": a plain number
  Range range;
};

/// A number as written and in SI.
struct Quantity {
  double value = 0.0;  ///< [SI]
  Unit unit;           ///< as written
};

/// Reads '11 mm', '0.99 kN/m^(n+1)', '20 %'. `n` is the soil's exponent, for units that depend on it.
/// Throws InputError (without a position) that says what was expected: for no unit, a wrong dimension, an unknown
/// unit, trailing rubbish, a value that is not finite, and a value outside the measure's range.
Quantity parse_quantity(std::string_view text, const Measure& measure, std::optional<double> n = std::nullopt);

/// The value alone, in SI.
double read_quantity(std::string_view text, const Measure& measure, std::optional<double> n = std::nullopt);

/// Writes a finite value [SI] in the unit named, with the fewest digits that read_quantity turns into the same bits.
/// Where no number in that unit does, the base units are used. A plain number ("-") has no unit behind it.
std::string write_quantity(double value, const std::string& unit, std::optional<double> n = std::nullopt);

/// A range in words, in the measure's unit: "above 0 mm", "-1 .. 1".
std::string describe_range(const Measure& measure, std::optional<double> n = std::nullopt);

/// A plain number without a unit: the shortest decimal text that reads back to the same bits.
std::string write_number(double value);

/// A plain number (no unit); nothing but the number may stand in the text. No value for anything else, and none for
/// NaN, infinity, and numbers beyond the range of a double.
std::optional<double> read_number(std::string_view text);

}  // namespace soilbin
