#include "bekker_wong/closed_forms.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {

double contact_length(double sinkage, double radius) {
  return radius * std::acos(1.0 - std::clamp(sinkage / radius, 0.0, 1.0));
}

double bekker_static_sinkage(const SoilValues& soil, double radius, double width, double load) {
  const double n = soil.exponent;
  if (!(n < 3.0)) throw InputError("Bekker's static sinkage holds for n < 3 only");
  const double k = soil.pressure_modulus(width);
  return std::pow(3 * load / ((3 - n) * width * k * std::sqrt(2 * radius)), 2 / (2 * n + 1));
}

double compaction_resistance(const SoilValues& soil, double width, double sinkage) {
  const double m = soil.exponent + 1;
  return width * soil.pressure_modulus(width) * std::pow(sinkage, m) / m;
}

double rolling_resistance(const SoilValues& soil, double radius, double width, double load) {
  return compaction_resistance(soil, width, bekker_static_sinkage(soil, radius, width, load));
}

double critical_ground_pressure(const SoilValues& soil, double radius, double width, double load) {
  const double z = bekker_static_sinkage(soil, radius, width, load);
  return soil.pressure_modulus(width) * std::pow(z, soil.exponent);
}

std::optional<double> infinite_slope_angle(double cohesion, double friction_angle, double unit_weight, double depth) {
  const double sine = std::sin(friction_angle) + 2 * cohesion / (unit_weight * depth) * std::cos(friction_angle);
  if (sine > 1.0) return std::nullopt;
  return 0.5 * (friction_angle + std::asin(sine));
}

std::optional<double> sliding_slope(const Soil& soil, const Tire& tire) {
  const SemiEmpiricalSoil& values = soil.semi_empirical.value();
  return infinite_slope_angle(values.cohesion.value, values.friction_angle.value,
                              bulk_density(values) * gravity_of(values), tire.radius);
}

namespace paper {

double sinkage(const SoilValues& soil, double radius, double width, double load, double slip, double theta_m) {
  return bekker_static_sinkage(soil, radius, width, load) + radius * (1 - slip) * theta_m;
}

}  // namespace paper
}  // namespace soilbin::bekker_wong
