#include "bekker_wong/agreed_points.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

Tire wheel(double radius, double width) {
  Tire tire;
  tire.radius = radius, tire.width = width;
  return tire;
}

OperatingCondition driven(double load, double slip) {
  OperatingCondition at;
  at.load = load, at.slip = slip;
  return at;
}

AgreedPoint light_wheel() {
  return {.name = "a light wheel at 60 % slip",
          .published = "",
          .tire = wheel(0.1, 0.1),
          .soil = {.exponent = 1,
                   .k_c = 1.4e3,
                   .k_phi = 8.2e5,
                   .cohesion = 170,
                   .friction_angle = 46 * degree,
                   .shear_modulus = 0.018,
                   .c1 = 0.4,
                   .c2 = 0.2},
          .effects = {},
          .at = driven(40, 0.6),
          .sinkage = {17.789e-3, 5e-7},
          .drawbar_pull = {11.7861, 5e-5},
          .torque = {2.3489, 5e-5}};
}

AgreedPoint ishigami() {
  return {.name = "a rover's wheel at 20 % slip",
          .published = "inputs of Ishigami and others 2007",
          .tire = wheel(0.09, 0.11),
          .soil = {.exponent = 1,
                   .k_c = 1370,
                   .k_phi = 8.14e5,
                   .cohesion = 800,
                   .friction_angle = 37.2 * degree,
                   .shear_modulus = 0.036,
                   .c1 = 0.4,
                   .c2 = 0.15},
          .effects = {},
          .at = driven(64.68, 0.2),
          .sinkage = {23.7341e-3, 5e-8},
          .drawbar_pull = {-9.11318, 5e-6},
          .torque = {1.275805, 5e-7}};
}

AgreedPoint ishigami_with_rebound() {
  AgreedPoint point = ishigami();
  point.name = "the rover's wheel on soil that rebounds";
  point.effects = {{"exit_angle", "rebound", {{"lambda", 0.9}}}};
  point.sinkage = {15.5711e-3, 5e-8}, point.drawbar_pull = {10.05743, 5e-6}, point.torque = {1.471679, 5e-7};
  return point;
}

AgreedPoint azimi() {
  return {.name = "a heavier wheel at 20 % slip",
          .published = "inputs of Azimi and others 2013",
          .tire = wheel(0.15, 0.1),
          .soil = {.exponent = 0.8,
                   .k_c = 0,
                   .k_phi = 4.1e5,
                   .cohesion = 234,
                   .friction_angle = 30 * degree,
                   .shear_modulus = 0.013,
                   .c1 = 0.18,
                   .c2 = 0.32},
          .effects = {},
          .at = driven(165, 0.2),
          .sinkage = {31.7033e-3, 5e-8},
          .drawbar_pull = {15.6228, 5e-5},
          .torque = {9.42284, 5e-6}};
}

/// Reece's form p = (k1 + k2 b)(z/b)^n is Bekker's with k = (k1 + k2 b)/b^n.
AgreedPoint wong_reece() {
  constexpr double psi = 6894.757293168361, inch = 0.0254, pound = 4.4482216152605;
  const double b = 6 * inch, n = 0.47;
  return {.name = "a tractor's wheel on compact sand",
          .published = "inputs of Wong and Reece 1967",
          .tire = wheel(24.7 * inch, b),
          .soil = {.exponent = n,
                   .k_c = 0,
                   .k_phi = (20 * psi + 2.5 * psi / inch * b) / std::pow(b, n),
                   .cohesion = 0.1 * psi,
                   .friction_angle = 33.3 * degree,
                   .shear_modulus = 1.5 * inch,
                   .c1 = 0.43,
                   .c2 = 0.32},
          .effects = {},
          .at = driven(2006 * pound, 0.221),
          .sinkage = {123.318e-3, 5e-7},
          .drawbar_pull = {1292.51, 5e-3},
          .torque = {2553.46, 5e-3}};
}

}  // namespace

const std::vector<AgreedPoint>& agreed_points() {
  static const std::vector<AgreedPoint> all = {light_wheel(), ishigami(), ishigami_with_rebound(), azimi(),
                                               wong_reece()};
  return all;
}

Reading reading_at(const AgreedPoint& point) {
  return RollingWheel(point.tire, point.soil, make_effects(point.effects)).roll(point.at).reading;
}

double worst_difference(const AgreedPoint& point, const Reading& reading) {
  const auto off = [](double value, const RoundedValue& rounded) {
    return std::abs(value - rounded.value) / rounded.half_unit;
  };
  return std::max({off(reading.sinkage, point.sinkage), off(reading.drawbar_pull, point.drawbar_pull),
                   off(reading.torque, point.torque)});
}

}  // namespace soilbin::bekker_wong
