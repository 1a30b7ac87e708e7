#include "scenario/unit.hpp"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin {
namespace {

struct Symbol {
  std::string_view text;
  double metre, kilogram, second, radian;
  int decimal;
  double factor;
};

// Factors: SI brochure, 9th edition; inch, foot, mile, pound exact by the 1959 agreement; g_n 9.80665 m/s^2 in lbf,
// kgf; a horsepower is 550 ft lbf/s.
constexpr double pi = std::numbers::pi;
constexpr std::array symbols = {
    Symbol{"1", 0, 0, 0, 0, 0, 1},
    Symbol{"%", 0, 0, 0, 0, -2, 1},
    Symbol{"m", 1, 0, 0, 0, 0, 1},
    Symbol{"km", 1, 0, 0, 0, 3, 1},
    Symbol{"dm", 1, 0, 0, 0, -1, 1},
    Symbol{"cm", 1, 0, 0, 0, -2, 1},
    Symbol{"mm", 1, 0, 0, 0, -3, 1},
    Symbol{"um", 1, 0, 0, 0, -6, 1},
    Symbol{"\u00b5m", 1, 0, 0, 0, -6, 1},
    Symbol{"\u03bcm", 1, 0, 0, 0, -6, 1},
    Symbol{"in", 1, 0, 0, 0, -4, 254},
    Symbol{"ft", 1, 0, 0, 0, -4, 3048},
    Symbol{"mi", 1, 0, 0, 0, -3, 1609344},
    Symbol{"kg", 0, 1, 0, 0, 0, 1},
    Symbol{"g", 0, 1, 0, 0, -3, 1},
    Symbol{"t", 0, 1, 0, 0, 3, 1},
    Symbol{"lb", 0, 1, 0, 0, 0, 0.45359237},
    Symbol{"s", 0, 0, 1, 0, 0, 1},
    Symbol{"ms", 0, 0, 1, 0, -3, 1},
    Symbol{"min", 0, 0, 1, 0, 0, 60},
    Symbol{"h", 0, 0, 1, 0, 0, 3600},
    Symbol{"Hz", 0, 0, -1, 0, 0, 1},
    Symbol{"mph", 1, 0, -1, 0, -5, 44704},
    Symbol{"N", 1, 1, -2, 0, 0, 1},
    Symbol{"mN", 1, 1, -2, 0, -3, 1},
    Symbol{"kN", 1, 1, -2, 0, 3, 1},
    Symbol{"MN", 1, 1, -2, 0, 6, 1},
    Symbol{"lbf", 1, 1, -2, 0, 0, 4.4482216152605},
    Symbol{"kgf", 1, 1, -2, 0, 0, standard_gravity},
    Symbol{"Nm", 2, 1, -2, 0, 0, 1},
    Symbol{"kNm", 2, 1, -2, 0, 3, 1},
    Symbol{"J", 2, 1, -2, 0, 0, 1},
    Symbol{"kJ", 2, 1, -2, 0, 3, 1},
    Symbol{"MJ", 2, 1, -2, 0, 6, 1},
    Symbol{"W", 2, 1, -3, 0, 0, 1},
    Symbol{"kW", 2, 1, -3, 0, 3, 1},
    Symbol{"hp", 2, 1, -3, 0, 0, 745.6998715822702},
    Symbol{"Pa", -1, 1, -2, 0, 0, 1},
    Symbol{"hPa", -1, 1, -2, 0, 2, 1},
    Symbol{"kPa", -1, 1, -2, 0, 3, 1},
    Symbol{"MPa", -1, 1, -2, 0, 6, 1},
    Symbol{"GPa", -1, 1, -2, 0, 9, 1},
    Symbol{"bar", -1, 1, -2, 0, 5, 1},
    Symbol{"psi", -1, 1, -2, 0, 0, 6894.757293168361},
    Symbol{"rad", 0, 0, 0, 1, 0, 1},
    Symbol{"mrad", 0, 0, 0, 1, -3, 1},
    Symbol{"deg", 0, 0, 0, 1, 0, pi / 180},
    Symbol{"\u00b0", 0, 0, 0, 1, 0, pi / 180},
    Symbol{"rpm", 0, 0, -1, 1, 0, pi / 30},
};

struct Named {
  std::string_view unit, name, example;
};

/// Units that are written with a joule: where a force would give the quantity another name.
constexpr std::array energy_names = {
    Named{"J", "an energy", "12 J"},
    Named{"J/m^2", "an energy per area", "0.1 J/m^2"},
    Named{"J/m^3", "an energy density", "20 kJ/m^3"},
};

constexpr std::array names = {
    Named{"-", "a plain number or a percentage", "0.2' or '20 %"},
    Named{"m", "a length", "11 mm"},
    Named{"m^2", "an area", "0.2 m^2"},
    Named{"kg", "a mass", "12 kg"},
    Named{"s", "a time", "10 s"},
    Named{"rad", "an angle", "5 deg"},
    Named{"rad/s", "a rotational speed", "10 rpm"},
    Named{"m/s", "a speed", "0.1 m/s"},
    Named{"N", "a force", "4 kN"},
    Named{"N*m", "a torque", "120 N m"},
    Named{"W", "a power", "90 kW"},
    Named{"kg*m^2", "a moment of inertia", "0.02 kg m^2"},
    Named{"Pa", "a pressure", "20 kPa"},
    Named{"N/m", "a stiffness", "300 N/m"},
    Named{"kg/m^3", "a density", "1600 kg/m^3"},
    Named{"N/m^(n+1)", "a cohesive modulus", "0.99 kN/m^(n+1)"},
    Named{"N/m^(n+2)", "a frictional modulus", "1528 kN/m^(n+2)"},
};

const Symbol* find_symbol(std::string_view text) {
  for (const Symbol& symbol : symbols)
    if (symbol.text == text) return &symbol;
  return nullptr;
}

bool is_of(const Symbol& symbol, const Dimension& dimension) {
  const auto is = [](const Exponent& e, double constant) { return e.per_n == 0.0 && e.constant == constant; };
  return is(dimension.metre, symbol.metre) && is(dimension.kilogram, symbol.kilogram) &&
         is(dimension.second, symbol.second) && is(dimension.radian, symbol.radian);
}

/// Suggests a unit of the dimension that is meant before any other: 'lbs' of a force is 'lbf'.
[[noreturn]] void unknown_symbol(std::string_view text, const Dimension* meant) {
  std::vector<std::string> right, any;
  for (const Symbol& symbol : symbols) {
    any.emplace_back(symbol.text);
    if (meant != nullptr && is_of(symbol, *meant)) right.emplace_back(symbol.text);
  }
  const std::string of_dimension = did_you_mean(std::string(text), right);
  throw InputError(fmt::format("unknown unit '{}'{}", text,
                               of_dimension.empty() ? did_you_mean(std::string(text), any) : of_dimension));
}

void add(Exponent& to, const Exponent& e, double times) {
  to.constant += e.constant * times;
  to.per_n += e.per_n * times;
}

/// What 'lb' is.
enum class Pound { mass, force };

/// Recursive descent over a unit's text; the depth of brackets is bounded by `deepest`.
class UnitParser {
 public:
  UnitParser(std::string_view text, std::optional<double> n, const Dimension* meant, Pound pound = Pound::mass)
      : text_(text), n_(n), meant_(meant), pound_(pound) {}

  Unit parse() {
    product({1.0, 0.0}, 0);
    if (at_ < text_.size()) refuse();
    Unit unit{std::string(text_), dimension_};
    resolve(unit);
    return unit;
  }

 private:
  static constexpr int deepest = 8;
  static constexpr double largest_exponent = 24.0;

  [[noreturn]] void refuse() const {
    throw InputError(fmt::format("'{}' is no unit: trouble at '{}'", text_, text_.substr(at_)));
  }

  bool eat(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  void blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  /// factor (('*' | '/' | ' ' | dot) factor)*, the whole raised to `outer`.
  void product(const Exponent& outer, int depth) {
    if (depth > deepest) refuse();
    blanks();
    factor(outer, +1.0, depth);
    while (true) {
      blanks();
      if (at_ >= text_.size() || text_[at_] == ')') return;
      const bool divide = eat("/");
      if (!divide && !eat("*")) eat("\u00b7");
      blanks();
      factor(outer, divide ? -1.0 : +1.0, depth);
    }
  }

  void factor(const Exponent& outer, double sign, int depth) {
    if (eat("(")) return bracket(outer, sign, depth);
    const std::size_t begin = at_;
    while (const std::size_t bytes = symbol_bytes()) at_ += bytes;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (name.empty()) refuse();
    const Symbol* symbol = find_symbol(pound_ == Pound::force && name == "lb" ? "lbf" : name);
    if (symbol == nullptr) unknown_symbol(name, meant_);
    apply(*symbol, times(exponent(), outer, sign));
  }

  void bracket(const Exponent& outer, double sign, int depth) {
    // The exponent stands behind the bracket: look ahead for it, read the inside with it, then skip it.
    const std::size_t inside = at_;
    int open = 1;
    while (at_ < text_.size() && open > 0) {
      if (text_[at_] == '(') ++open;
      if (text_[at_] == ')') --open;
      ++at_;
    }
    if (open > 0) refuse();
    const Exponent own = times(exponent(), outer, sign);
    const std::size_t after = at_;
    at_ = inside;
    product(own, depth + 1);
    if (!eat(")")) refuse();
    at_ = after;
  }

  /// Bytes of a unit's symbol that start here: a letter, '%', '1', a degree sign or a micro sign; 0 for none.
  std::size_t symbol_bytes() const {
    if (at_ >= text_.size()) return 0;
    const char c = text_[at_];
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || c == '1') return 1;
    for (const std::string_view sign : {"\u00b0", "\u00b5", "\u03bc"})
      if (text_.substr(at_, sign.size()) == sign) return sign.size();
    return 0;
  }

  Exponent times(const Exponent& e, const Exponent& outer, double sign) const {
    if (e.per_n != 0.0 && outer.per_n != 0.0) refuse();
    const Exponent product{sign * e.constant * outer.constant,
                           sign * (e.per_n * outer.constant + e.constant * outer.per_n)};
    if (std::abs(product.constant) > largest_exponent || std::abs(product.per_n) > largest_exponent) refuse();
    return product;
  }

  /// '^2', '**2', '^-2', '^n', '^(n+1)', '^{n+1}', '^-(n+2)', superscripts, a digit of 2 or more alone as in 'kg/m3',
  /// or nothing (1).
  Exponent exponent() {
    if (const std::string raised = superscripts(); !raised.empty()) {
      UnitParser inside(raised, n_, meant_);
      const Exponent found = inside.sum();
      if (inside.at_ < raised.size()) refuse();
      return found;
    }
    if (const double digit = lone_digit(); digit > 0.0) return {digit, 0.0};
    if (!eat("^") && !eat("**")) return {1.0, 0.0};
    const double sign = eat("-") ? -1.0 : 1.0;
    if (eat("n")) return {0.0, sign};
    const char* const close = eat("(") ? ")" : eat("{") ? "}" : nullptr;
    if (close == nullptr) {
      if (at_ < text_.size() && text_[at_] == '-') refuse();
      return {sign * signed_number(), 0.0};
    }
    const Exponent found = sum();
    if (!eat(close)) refuse();
    return {sign * found.constant, sign * found.per_n};
  }

  /// The digit of 2 or more that starts here with no other number behind it; else 0.
  double lone_digit() {
    const auto is_digit = [&](std::size_t at, char least) {
      return at < text_.size() && text_[at] >= least && text_[at] <= '9';
    };
    if (!is_digit(at_, '2') || is_digit(at_ + 1, '0') || (at_ + 1 < text_.size() && text_[at_ + 1] == '.')) return 0.0;
    return text_[at_++] - '0';
  }

  Exponent sum() {
    Exponent found = term();
    while (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) add(found, term(), 1.0);
    blanks();
    return found;
  }

  /// The superscripts that start here, as they are written on the line.
  std::string superscripts() {
    constexpr std::array<std::pair<std::string_view, char>, 13> raised = {{{"\u2070", '0'},
                                                                           {"\u00b9", '1'},
                                                                           {"\u00b2", '2'},
                                                                           {"\u00b3", '3'},
                                                                           {"\u2074", '4'},
                                                                           {"\u2075", '5'},
                                                                           {"\u2076", '6'},
                                                                           {"\u2077", '7'},
                                                                           {"\u2078", '8'},
                                                                           {"\u2079", '9'},
                                                                           {"\u207a", '+'},
                                                                           {"\u207b", '-'},
                                                                           {"\u207f", 'n'}}};
    std::string text;
    for (bool found = true; found;) {
      found = false;
      for (const auto& [sign, plain] : raised)
        if (eat(sign)) text += plain, found = true;
    }
    return text;
  }

  /// One term of a sum: '+2', '-n', '2*n', '2n'; blanks around it are skipped.
  Exponent term() {
    blanks();
    const double sign = eat("-") ? -1.0 : (eat("+"), +1.0);
    blanks();
    const bool digit_first = at_ < text_.size() && text_[at_] != 'n';
    const double number = digit_first ? sign * signed_number() : sign;
    eat("*");
    const bool in_n = eat("n");
    if (!in_n && !digit_first) refuse();
    blanks();
    return in_n ? Exponent{0.0, number} : Exponent{number, 0.0};
  }

  double signed_number() {
    double value = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(value)) refuse();
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }

  void apply(const Symbol& symbol, const Exponent& power) {
    add(dimension_.metre, power, symbol.metre);
    add(dimension_.kilogram, power, symbol.kilogram);
    add(dimension_.second, power, symbol.second);
    add(dimension_.radian, power, symbol.radian);
    add(decimal_, power, symbol.decimal);
    if (symbol.factor == 1.0) return;
    const double p = at_n(power);
    (p < 0.0 ? denominator_ : numerator_) *= std::pow(symbol.factor, std::abs(p));
  }

  double at_n(const Exponent& e) const {
    if (e.per_n == 0.0) return e.constant;
    if (!n_) throw InputError(fmt::format("the unit '{}' needs the soil's exponent n, and there is none here", text_));
    return e.constant + e.per_n * *n_;
  }

  void resolve(Unit& unit) const {
    const double decimal = at_n(decimal_);
    const double whole = std::round(decimal);
    const bool exact = std::abs(decimal - whole) < 1e-9;
    unit.decimal = exact ? static_cast<int>(whole) : 0;
    unit.numerator = exact ? numerator_ : numerator_ * std::pow(10.0, decimal);
    unit.denominator = denominator_;
    if (!std::isfinite(unit.numerator / unit.denominator) || unit.numerator / unit.denominator == 0.0) refuse();
  }

  std::string_view text_;
  std::optional<double> n_;
  const Dimension* meant_;
  Pound pound_;
  std::size_t at_ = 0;
  Dimension dimension_;
  Exponent decimal_;
  double numerator_ = 1.0;
  double denominator_ = 1.0;
};

bool same_exponent(const Exponent& a, const Exponent& b, std::optional<double> n) {
  constexpr double tolerance = 1e-9;
  const Exponent gap{a.constant - b.constant, a.per_n - b.per_n};
  if (std::abs(gap.constant) < tolerance && std::abs(gap.per_n) < tolerance) return true;
  return n && std::abs(gap.constant + gap.per_n * *n) < tolerance;
}

const Named* find_name(const Unit& unit) {
  if (unit.text.find('J') != unit.text.npos)
    for (const Named& named : energy_names)
      if (same_dimension(parse_unit(named.unit).dimension, unit.dimension)) return &named;
  for (const Named& named : names)
    if (same_dimension(parse_unit(named.unit).dimension, unit.dimension)) return &named;
  return nullptr;
}

void spell(std::string& text, std::string_view symbol, const Exponent& e) {
  if (e.constant == 0.0 && e.per_n == 0.0) return;
  if (!text.empty()) text += "*";
  text += symbol;
  if (e.per_n != 0.0)
    text += fmt::format("^({}{:+}*n)", e.constant, e.per_n);
  else if (e.constant != 1.0)
    text += fmt::format("^{}", e.constant);
}

}  // namespace

Unit parse_unit(std::string_view text, std::optional<double> n, const Dimension* meant) {
  constexpr std::size_t longest = 100;
  if (text.size() > longest) throw InputError("a unit of more than 100 characters");
  if (text.empty() || text == "-") return Unit{"-", {}};
  const Unit unit = UnitParser(text, n, meant).parse();
  if (meant == nullptr || unit.text == "lb" || same_dimension(unit.dimension, *meant, n)) return unit;
  const Unit with_force = UnitParser(text, n, meant, Pound::force).parse();
  return same_dimension(with_force.dimension, *meant, n) ? with_force : unit;
}

bool same_dimension(const Dimension& a, const Dimension& b, std::optional<double> n) {
  return same_exponent(a.metre, b.metre, n) && same_exponent(a.kilogram, b.kilogram, n) &&
         same_exponent(a.second, b.second, n) && same_exponent(a.radian, b.radian, n);
}

std::string dimension_name(const Unit& unit) {
  const Named* named = find_name(unit);
  return named != nullptr ? std::string(named->name) : fmt::format("a quantity in '{}'", unit.text);
}

std::string dimension_example(const Unit& unit) {
  const Named* named = find_name(unit);
  return named != nullptr ? std::string(named->example) : "1 " + unit.text;
}

std::string base_unit(const Dimension& dimension) {
  std::string text;
  spell(text, "kg", dimension.kilogram);
  spell(text, "m", dimension.metre);
  spell(text, "s", dimension.second);
  spell(text, "rad", dimension.radian);
  return text.empty() ? "-" : text;
}

}  // namespace soilbin
