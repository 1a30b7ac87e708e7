// Numbers as people read them: digits that mean something, errors beside values, units.
#pragma once

#include <string>
#include <string_view>

#include "scenario/estimate.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {

/// So many significant digits, zeros at their end included, never "-0", an exponent only beyond everyday sizes; "-" for
/// what is not a number.
std::string number(double value, int digits = 4);

/// "4.18 ± 0.31": the error to two digits, the value to the error's place; the value alone for an error of 0.
std::string number(const Estimate& estimate, double per_unit = 1.0);

/// A number for a table that people read, without zeros at its end: 15 for a slope of 15 deg, though its radians make
/// it 14.999999999999998. Nine digits are more than any answer knows; JSON has all of them. "" for what is not a
/// number.
std::string csv_number(double value, int digits = 9);

/// What a value in SI is multiplied by to be in a unit: 57.3 for "deg", 1 for "-". Throws as parse_unit.
double per_unit(const std::string& unit);

/// " kPa", to stand behind a number; "" of a plain one ("-").
std::string unit_behind(std::string_view unit);

/// A share as "12.3 %".
std::string percent(double share);

/// "1 model", "2 models".
std::string counted(std::size_t count, const std::string& noun);

/// A time [s] as "40 s", "12 min", "3.5 h".
std::string duration_text(double seconds);
/// Bytes as "600 kB", "72 MB", "1.2 GB".
std::string size_text(double bytes);

/// A name as people write it: "cross_slope" becomes "cross slope".
std::string spaced(std::string_view name);

/// A force to so many digits: "80 N", "4 kN", "-8.89 kN"; never with an exponent below 1e7 N.
std::string newtons(double force, int digits = 4);

/// "drawbar pull" as "Drawbar pull".
std::string capital(std::string text);

/// "friction_angle [deg]"; the name alone for a plain number ("-").
std::string heading(const std::string& name, const std::string& unit);
/// "Drawbar pull [N]".
std::string heading(const TractionChannel& channel);

/// "12.3 N", "4.1 mm" of a number in SI of one of traction_channels.
std::string in_unit(std::size_t channel, double si);

}  // namespace soilbin::compare
