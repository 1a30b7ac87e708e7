// Units as a person writes them ('kN/m^(n+1)', 'km/h', '%'), and the dimension behind them.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace soilbin {

inline constexpr double degree = std::numbers::pi / 180;  ///< [rad]
inline constexpr double standard_gravity = 9.80665;       ///< g_n of the SI brochure [m/s^2]

/// An exponent that may depend on the soil's exponent n: constant + per_n n. (k_c is in kN/m^(n+1).)
struct Exponent {
  double constant = 0.0;
  double per_n = 0.0;
};

/// Powers of the base units. An angle counts as a dimension of its own, so that '5 mm' is never taken for an angle.
struct Dimension {
  Exponent metre, kilogram, second, radian;
};

/// A unit: 1 unit = numerator/denominator 10^decimal base units. The power of ten stays apart so that '11 mm' is read
/// as 11e-3, rounded once, and not as 11 times 0.001.
struct Unit {
  std::string text;
  Dimension dimension;
  int decimal = 0;
  double numerator = 1.0;
  double denominator = 1.0;
};

/// Reads a unit: symbols joined by '*', '/', a blank or a middle dot, each with an exponent after '^', brackets
/// allowed. An exponent is a number, n, superscripts or an expression in n in round or curly brackets: '(n+1)'. '' and
/// '-' are the plain number 1.
/// `n` is the soil's exponent; a unit such as 'mm^(n+1)' can't be read without it.
/// Throws InputError (without a position) for an unknown symbol, with the nearest right one.
/// `meant`: a dimension whose units a misspelt one is first compared with; in a compound unit that it leaves no other
/// reading for, 'lb' is a pound-force: 'lb/in^(n+2)' of a modulus, 'lb/in^2' of a pressure.
Unit parse_unit(std::string_view text, std::optional<double> n = std::nullopt, const Dimension* meant = nullptr);

/// Whether two dimensions agree: as expressions in n or, where n is given, at that n.
bool same_dimension(const Dimension& a, const Dimension& b, std::optional<double> n = std::nullopt);

/// What a person would call a quantity of this unit, with its article: "a length", "a pressure".
std::string dimension_name(const Unit& unit);

/// A quantity of this dimension as an example: "11 mm".
std::string dimension_example(const Unit& unit);

/// The base units of this dimension, spelled so that parse_unit reads them back: "kg*m^(1-n)*s^-2", "rad", "-".
std::string base_unit(const Dimension& dimension);

}  // namespace soilbin
