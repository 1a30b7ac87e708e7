#include "cone_index/relations.hpp"

#include <cmath>

namespace soilbin::cone_index {

double brixius_number(double cone_index, const TireMeasures& tire, double load) {
  return cone_index * tire.width * tire.diameter / load * (1.0 + 5.0 * tire.deflection / tire.section_height) /
         (1.0 + 3.0 * tire.width / tire.diameter);
}

Ratios brixius(double number, double slip, std::optional<Construction> construction) {
  const bool radial = construction == Construction::radial;
  const double by_slip = 0.88 * -std::expm1(-(radial ? 9.5 : 7.5) * slip);
  const double rolling = radial ? 0.0325 : 0.04, sinking = radial ? 0.9 : 1.0;
  return {.gross = by_slip * -std::expm1(-0.1 * number) + rolling,
          .resistance = sinking / number + rolling + 0.5 * slip / std::sqrt(number),
          .gross_slope = by_slip * 0.1 * std::exp(-0.1 * number),
          .resistance_slope = -sinking / (number * number) - 0.25 * slip / (number * std::sqrt(number))};
}

double turnage_number(double gradient, const TireMeasures& tire, double load) {
  return gradient * std::pow(tire.width * tire.diameter, 1.5) / load * tire.deflection / tire.section_height;
}

namespace {

/// A ratio and its slope by the mobility number.
struct Sloped {
  double value, slope;
};

/// X (N + 10)/(N + 10 + Y) with Y s = 4.71 s + 1.72, so that it holds at s = 0 too.
Sloped sand_traction(double number, double slip) {
  constexpr double most = 0.66;
  const double ys = 4.71 * slip + 1.72, bottom = (number + 10.0) * slip + ys;
  return {most * slip * (number + 10.0) / bottom, most * slip * ys / (bottom * bottom)};
}

}  // namespace

Ratios turnage(double number, double slip) {
  const Sloped gross = sand_traction(number, slip), at_20 = sand_traction(number, 0.2);
  const double below = number + 3.7;
  return {.gross = gross.value,
          .resistance = at_20.value - (0.53 - 4.5 / below),
          .gross_slope = gross.slope,
          .resistance_slope = at_20.slope - 4.5 / (below * below)};
}

}  // namespace soilbin::cone_index
