#include "compare/doubts/declared_doubts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using Warnings = std::vector<std::string>;

/// What a value usually is, in a unit.
struct UsualRange {
  double lower, upper;
  const char *unit, *why;
};

/// "n = 1.9 is outside 0.1 .. 1.8, ..." where it is.
void expect(Warnings& warnings, const char* name, double value, const UsualRange& usual) {
  if (value < usual.lower || value > usual.upper)
    warnings.push_back(fmt::format("{} = {:.4g}{}{} is outside {:.4g} .. {:.4g}: {}", name, value,
                                   *usual.unit ? " " : "", usual.unit, usual.lower, usual.upper, usual.why));
}

/// Standard deviations far beyond what a test leaves: of values that may well be 0, only where they decide what the
/// soil carries or holds.
void add_doubts_of_wide_errors(const SemiEmpiricalSoil& soil, Warnings& warnings) {
  constexpr double narrow = 0.1, firm = 1000.0;  // a wheel's width [m], a cohesion that hardly matters [Pa]
  constexpr double any_angle = 0.5;              // c1 and c2 are shares of the contact's angle
  const auto add = [&](const char* name, const Estimate& value, double most) {
    if (value.std_error <= most) return;
    const double times = value.std_error / std::abs(value.value);
    const std::string size = value.value == 0.0 ? "large beside a value of 0"
                                                : fmt::format("{:.{}f} times its value", times, times < 10 ? 1 : 0);
    warnings.push_back(
        fmt::format("the standard deviation of {} is {}: it is hardly known; is its unit right?", name, size));
  };
  const double modulus = std::abs(soil.k_c.value / narrow + soil.k_phi.value);
  add("k_phi", soil.k_phi, std::max(std::abs(soil.k_phi.value), modulus));
  add("k_c", soil.k_c, std::max(3 * std::abs(soil.k_c.value), narrow * modulus));
  add("c", soil.cohesion, std::max(3 * soil.cohesion.value, firm));
  add("c1", soil.stress_angle_c1, any_angle), add("c2", soil.stress_angle_c2, any_angle);
}

void add_gravity_doubt(const std::optional<double>& gravity, Warnings& warnings) {
  if (gravity) expect(warnings, "gravity", *gravity, {0.1, 25, "m/s^2", "the Moon has 1.62, Earth 9.81"});
}

void add_value_doubts(const SemiEmpiricalSoil& soil, Warnings& warnings) {
  if (!(soil.k_c.value > 0.0) && !(soil.k_phi.value > 0.0))
    warnings.emplace_back("neither k_c nor k_phi is positive: this soil carries nothing, at any width of wheel");
  const double phi = soil.friction_angle.value / degree, c = soil.cohesion.value / 1000;
  expect(warnings, "n", soil.exponent.value, {0.1, 1.8, "", "most plate tests give 0.1 .. 1.6"});
  expect(warnings, "c", c, {0, 100, "kPa", "soft soils have 0 .. 70 kPa"});
  expect(warnings, "phi", phi, {0, 50, "deg", "the densest sand has some 45 deg"});
  expect(warnings, "K", 1000 * soil.shear_modulus.value, {0.5, 120, "mm", "6 mm in firm clay, 25 mm in loose sand"});
  expect(warnings, "density", bulk_density(soil), {200, 2400, "kg/m^3", "fresh snow has some 250, dense gravel 2200"});
  for (const auto& [key, name, value] :
       {std::tuple{"stress_angle_c1", "c1", soil.stress_angle_c1}, {"stress_angle_c2", "c2", soil.stress_angle_c2}})
    if (const auto from = soil.sources.find(key);
        from != soil.sources.end() && from->second == usual_stress_angle_source)
      warnings.push_back(
          fmt::format("the soil declares no {}: {:g} with a standard deviation of {:g} is taken, a usual value", name,
                      value.value, value.std_error));
  if (c == 0.0 && phi == 0.0)
    warnings.push_back("c and phi are both 0: this soil has no strength and gives no traction");
  const double most = soil.stress_angle_c1.value + std::max(0.0, soil.stress_angle_c2.value);
  if (most > bekker_wong::max_stress_share)
    warnings.push_back(fmt::format("c1 + c2 = {:.3g}: at full slip theta_m is limited to {} theta_1", most,
                                   bekker_wong::max_stress_share));
  if (soil.stress_angle_c1.value + std::min(0.0, soil.stress_angle_c2.value) < 0.0)
    warnings.push_back("c1 + c2 is negative: at full slip the largest stress would lie behind the axle");
  for (const auto& [name, value] :
       {std::pair{"n", soil.exponent}, {"phi", soil.friction_angle}, {"K", soil.shear_modulus}})
    if (value.std_error > 0.6 * value.value)
      warnings.push_back((value.value > 0.0
                              ? fmt::format("the standard deviation of {} is {:.0f} % of its value", name,
                                            100 * value.std_error / value.value)
                              : fmt::format("{} is 0 with a standard deviation, and can only be larger", name)) +
                         ": first-order errors are rough");
  if (is_from_command_line(soil, "exponent") && !is_from_command_line(soil, "k_phi"))
    warnings.push_back(
        "n was changed and k_phi was not: their units and values belong together, as a plate test found them");
  add_doubts_of_wide_errors(soil, warnings);
}

}  // namespace

Warnings doubts(const Soil& soil) {
  Warnings warnings;
  if (soil.semi_empirical) add_value_doubts(*soil.semi_empirical, warnings);
  if (soil.semi_empirical || soil.granular)
    add_gravity_doubt(soil.semi_empirical ? soil.semi_empirical->gravity : soil.granular->gravity, warnings);
  return warnings;
}

Warnings doubts(const Tire& tire) {
  Warnings warnings;
  expect(warnings, "the wheel's radius", tire.radius * 1000, {20, 2000, "mm", "the model is tested from 50 mm to 2 m"});
  if (tire.width > 2 * tire.radius)
    warnings.push_back(fmt::format("the wheel is wider ({:.4g} mm) than its diameter ({:.4g} mm)", 1000 * tire.width,
                                   2000 * tire.radius));
  if (is_lugged(tire) && tire.lugs.height > 0.3 * tire.radius)
    warnings.push_back(fmt::format("the lugs ({:.4g} mm) are higher than 30 % of the radius", 1000 * tire.lugs.height));
  return warnings;
}

Warnings doubts(const Tire& tire, const Soil& soil) {
  Warnings warnings = doubts(tire);
  if (soil.semi_empirical && !(bekker_wong::values_of(*soil.semi_empirical).pressure_modulus(tire.width) > 0.0))
    warnings.push_back("k_c/b + k_phi is not positive for this width: the soil carries nothing");
  return warnings;
}

}  // namespace soilbin::compare
