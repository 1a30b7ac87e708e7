#include "scenario/quantity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin {
namespace {

constexpr std::size_t longest_quantity = 200;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// A decimal number at the front of a text: its digits as text, and the power of ten behind an 'e'.
struct Decimal {
  std::string mantissa;    ///< sign, digits, at most one '.'; empty: no number there
  int exponent = 0;        ///< of ten
  std::size_t length = 0;  ///< characters used
};

Decimal scan_decimal(std::string_view text) {
  constexpr int largest_exponent = 100000;  // beyond any double, and safe to add to
  Decimal found;
  std::size_t at = (!text.empty() && (text[0] == '+' || text[0] == '-')) ? 1 : 0;
  const std::size_t begin = at;
  at = skip_digits(text, at);
  std::size_t digits = at - begin;
  if (at < text.size() && text[at] == '.') {
    const std::size_t end = skip_digits(text, at + 1);
    digits += end - at - 1;
    at = end;
  }
  if (digits == 0) return found;
  found.mantissa = std::string(text.substr(text[0] == '+' ? 1 : 0, at - (text[0] == '+' ? 1 : 0)));
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t power = at + 1;
    if (power < text.size() && text[power] == '+') ++power;
    const auto [end, error] = std::from_chars(text.data() + power, text.data() + text.size(), found.exponent);
    if (error == std::errc::result_out_of_range) found.exponent = largest_exponent;
    if (error != std::errc::invalid_argument) at = static_cast<std::size_t>(end - text.data());
  }
  found.exponent = std::clamp(found.exponent, -largest_exponent, largest_exponent);
  found.length = at;
  return found;
}

/// The decimal times ten to a power, correctly rounded; no value where it is beyond a double.
std::optional<double> to_double(const Decimal& decimal, int power) {
  const std::string text = fmt::format("{}e{}", decimal.mantissa, decimal.exponent + power);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  return std::nullopt;
}

std::optional<double> in_base_units(const Decimal& decimal, const Unit& unit) {
  const std::optional<double> shifted = to_double(decimal, unit.decimal);
  if (!shifted) return std::nullopt;
  const double value = *shifted * unit.numerator / unit.denominator;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

[[noreturn]] void refuse(const Unit& expected, std::string_view text, const std::string& why) {
  throw InputError(fmt::format("expected {}, such as '{}', not '{}'{}{}", dimension_name(expected),
                               dimension_example(expected), clipped(text), why.empty() ? "" : ": ", why));
}

std::string no_number(std::string_view text) {
  const auto begins = [&](std::string_view word) {
    return text.size() >= word.size() &&
           std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) { return a == (b | ' '); });
  };
  if (begins("nan") || begins(".nan") || begins("inf") || begins(".inf") || begins("-inf") || begins("-.inf"))
    return "a number must be finite";
  return "";
}

Unit unit_as_written(std::string_view text, std::string_view rest, const Unit& expected, std::optional<double> n) {
  if (!rest.empty() && rest.front() == ',')
    refuse(expected, text, "a decimal point is '.', and thousands are not separated");
  try {
    return parse_unit(rest, n, &expected.dimension);
  } catch (const InputError& error) {
    refuse(expected, text, error.what());
  }
}

/// ", which weighs 19.61 kN on Earth" of a mass where a force was expected.
std::string weight_of(const Decimal& decimal, const Unit& written, const Unit& expected) {
  const bool of_mass = same_dimension(written.dimension, parse_unit("kg").dimension) &&
                       same_dimension(expected.dimension, parse_unit("N").dimension);
  const std::optional<double> mass = of_mass ? in_base_units(decimal, written) : std::nullopt;
  return mass ? fmt::format(", which weighs {:.4g} kN on Earth", *mass * standard_gravity / 1e3) : "";
}

/// ", which as a grade is 5.711 deg" of a percentage where an angle was expected.
std::string angle_of(const Decimal& decimal, const Unit& written, const Unit& expected) {
  const bool of_grade = written.text == "%" && same_dimension(expected.dimension, parse_unit("deg").dimension);
  const std::optional<double> grade = of_grade ? in_base_units(decimal, written) : std::nullopt;
  return grade ? fmt::format(", which as a grade is {:.4g} deg", std::atan(*grade) / degree) : "";
}

std::string wrong_dimension(const Unit& written) {
  if (written.text == "-") return "it has no unit";
  if (written.text == "lb") return "'lb' is a mass; a pound-force is written 'lbf'";
  const std::string name = dimension_name(written);
  const bool nameless = name.find(written.text) != name.npos;
  return fmt::format("'{}' is {}", written.text, nameless ? base_unit(written.dimension) + " in base units" : name);
}

/// Decimal digits d1 d2 ... of |value| and the power of ten of d1, shortest that read back to the same bits.
std::pair<std::string, int> shortest_digits(double value) {
  std::array<char, 40> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value), std::chars_format::scientific).ptr;
  const std::string text(buffer.data(), end);
  const std::size_t e = text.find('e');
  std::string digits;
  for (const char c : text.substr(0, e))
    if (c != '.') digits += c;
  return {digits, std::stoi(text.substr(e + 1))};
}

/// 'digits' with the first one worth 10^power, as plain decimals where that is not long, else with an exponent.
std::string place_point(bool negative, const std::string& digits, int power) {
  const std::string_view sign = negative ? "-" : "";
  if (power < -5 || power > 15) {
    const std::string_view point = digits.size() > 1 ? "." : "";
    return fmt::format("{}{}{}{}e{}", sign, digits[0], point, digits.substr(1), power);
  }
  const auto zeros = [](std::size_t count) { return std::string(count, '0'); };
  if (power < 0) return fmt::format("{}0.{}{}", sign, zeros(static_cast<std::size_t>(-power - 1)), digits);
  const auto whole = static_cast<std::size_t>(power) + 1;
  if (digits.size() <= whole) return fmt::format("{}{}{}", sign, digits, zeros(whole - digits.size()));
  return fmt::format("{}{}.{}", sign, digits.substr(0, whole), digits.substr(whole));
}

std::string shifted_decimal(double value, int decimal) {
  const auto [digits, power] = shortest_digits(value);
  return place_point(std::signbit(value), digits, value == 0.0 ? 0 : power - decimal);
}

/// The fewest digits in the unit that give the value back, for a factor that is no power of ten.
std::optional<std::string> searched_decimal(double value, const Unit& unit) {
  const double inverse = value * unit.denominator / unit.numerator / std::pow(10.0, unit.decimal);
  for (int digits = 1; digits <= 17; ++digits) {
    const Decimal rounded = scan_decimal(fmt::format("{:.{}e}", inverse, digits - 1));
    if (in_base_units(rounded, unit) != value) continue;
    const std::optional<double> short_number = to_double(rounded, 0);
    if (!short_number) return std::nullopt;
    const std::string text = shifted_decimal(*short_number, 0);
    if (in_base_units(scan_decimal(text), unit) == value) return text;
  }
  return std::nullopt;
}

/// ", did you mean '20%'?" of a plain number that is too large for a share and is one as a percentage. Below 2 it is
/// rather a coefficient that is a little too large: a Poisson ratio of 0.6, a restitution of 1.5. What may be above 1
/// is no share: the exponent.
std::string meant_percent(const Decimal& decimal, const Unit& unit, double value, const Range& range) {
  if (unit.text != "-" || range.upper > 1.0 || std::abs(value) < 2.0 || !range.holds(value / 100)) return "";
  return fmt::format(", did you mean '{}%'?", decimal.mantissa);
}

}  // namespace

Quantity parse_quantity(std::string_view text, const Measure& measure, std::optional<double> n) {
  const Unit expected = parse_unit(measure.unit, n);
  const std::string_view whole = trim(text);
  if (whole.size() > longest_quantity) refuse(expected, whole, "too long for a number");
  const Decimal decimal = scan_decimal(whole);
  if (decimal.mantissa.empty()) refuse(expected, whole, no_number(whole));
  Quantity found;
  found.unit = unit_as_written(whole, trim(whole.substr(decimal.length)), expected, n);
  if (!same_dimension(found.unit.dimension, expected.dimension, n))
    refuse(expected, whole,
           wrong_dimension(found.unit) + weight_of(decimal, found.unit, expected) +
               angle_of(decimal, found.unit, expected));
  const std::optional<double> value = in_base_units(decimal, found.unit);
  if (!value) refuse(expected, whole, "the number is too large or too small");
  if (!measure.range.holds(*value))
    throw InputError(fmt::format("'{}' is out of range: must be {}{}", clipped(whole), describe_range(measure, n),
                                 meant_percent(decimal, found.unit, *value, measure.range)));
  found.value = *value;
  return found;
}

double read_quantity(std::string_view text, const Measure& measure, std::optional<double> n) {
  return parse_quantity(text, measure, n).value;
}

std::string write_quantity(double value, const std::string& unit_text, std::optional<double> n) {
  if (!std::isfinite(value)) throw std::invalid_argument("a quantity that is not finite can't be written");
  const Unit unit = parse_unit(unit_text, n);
  if (unit.text == "-") return write_number(value);
  if (unit.numerator == 1.0 && unit.denominator == 1.0) return shifted_decimal(value, unit.decimal) + " " + unit.text;
  if (const auto text = searched_decimal(value, unit)) return *text + " " + unit.text;
  return write_number(value) + " " + base_unit(unit.dimension);
}

std::string describe_range(const Measure& measure, std::optional<double> n) {
  const auto bound = [&](double x) {
    const Unit unit = parse_unit(measure.unit, n);
    const double shown_value = x * unit.denominator / unit.numerator / std::pow(10.0, unit.decimal);
    return fmt::format("{:.6g}{}", shown_value, unit.text == "-" ? "" : " " + unit.text);
  };
  const Range& range = measure.range;
  const bool has_lower = std::isfinite(range.lower), has_upper = std::isfinite(range.upper);
  if (has_lower && has_upper && !range.lower_open && !range.upper_open)
    return fmt::format("{} .. {}", bound(range.lower), bound(range.upper));
  const std::string_view from = range.lower_open ? "above" : "at least", to = range.upper_open ? "below" : "at most";
  if (has_lower && has_upper) return fmt::format("{} {} and {} {}", from, bound(range.lower), to, bound(range.upper));
  if (has_lower) return fmt::format("{} {}", from, bound(range.lower));
  return has_upper ? fmt::format("{} {}", to, bound(range.upper)) : "any finite number";
}

std::string write_number(double value) { return shifted_decimal(value, 0); }

std::optional<double> read_number(std::string_view text) {
  const std::string_view whole = trim(text);
  const Decimal decimal = scan_decimal(whole);
  if (decimal.mantissa.empty() || decimal.length != whole.size() || whole.size() > longest_quantity)
    return std::nullopt;
  return to_double(decimal, 0);
}

}  // namespace soilbin
