#include "bekker_wong/earth_pressure.hpp"

#include <cmath>
#include <numbers>

namespace soilbin::bekker_wong {

double specific_weight(const SoilValues& soil) { return soil.density * soil.gravity; }

double flow_value(const SoilValues& soil) {
  const double t = std::tan(std::numbers::pi / 4 + soil.friction_angle / 2);
  return t * t;
}

WallResistance passive_wall(const SoilValues& soil) {
  const double n = flow_value(soil);
  return {2 * soil.cohesion * std::sqrt(n), 0.5 * n * specific_weight(soil), n};
}

WallResistance hegedus_wall(const SoilValues& soil) {
  const double x = std::numbers::pi / 4 - soil.friction_angle / 2, cot = 1 / std::tan(x);
  const double d1 = cot + std::tan(x + soil.friction_angle);
  const double d2 = cot + cot * cot * std::tan(soil.friction_angle);
  return {d1 * soil.cohesion, 0.5 * d1 * d2 * specific_weight(soil), 0.0};
}

BearingFactors bearing_factors(double phi) {
  constexpr double pi = std::numbers::pi;
  // N_q = exp(2 (3 pi/4 - phi/2) tan phi)/(2 cos^2(45 deg + phi/2)), with 2 cos^2(45 deg + phi/2) = 1 - sin phi;
  // N_q - 1 without cancellation, so that N_c = (N_q - 1)/tan phi keeps its limit 1 + 3 pi/2 at phi = 0.
  const double t = std::tan(phi), s = std::sin(phi), cos2 = std::cos(phi) * std::cos(phi);
  const double n_q_less_1 = (std::expm1((1.5 * pi - phi) * t) + s) / (1 - s);
  const double n_c = t > 0 ? n_q_less_1 / t : 1 + 1.5 * pi;
  // N_gamma = 2 (N_q + 1) tan phi/(1 + 0.4 sin 4 phi)
  const double two_n_gamma_over_tan = 4 * (n_q_less_1 + 2) / (1 + 0.4 * std::sin(4 * phi));
  return {(n_c - t) * cos2, (two_n_gamma_over_tan + 1) * cos2};
}

}  // namespace soilbin::bekker_wong
