#include <algorithm>
#include <cmath>
#include <tuple>

#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/model.hpp"
#include "compare/doubts/doubts.hpp"
#include "scenario/beds.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// Doubts a value outside of what is usual.
void expect(Doubts& all, DoubtKind unusual, double value, double lower, double upper) {
  if (value < lower || value > upper) all.push_back({unusual, {value, lower, upper}});
}

/// Standard deviations far beyond what a test leaves: of values that may well be 0, only where they decide what the
/// soil carries or holds.
void add_doubts_of_wide_errors(const SemiEmpiricalSoil& soil, Doubts& all) {
  constexpr double narrow = 0.1, firm = 1000.0;  // a wheel's width [m], a cohesion that hardly matters [Pa]
  constexpr double any_angle = 0.5;              // c1 and c2 are shares of the contact's angle
  const auto add = [&](const char* name, const Estimate& value, double most) {
    if (value.std_error <= most) return;
    if (value.value == 0.0)
      all.push_back({DoubtKind::hardly_known_at_zero, {name}});
    else
      all.push_back({DoubtKind::hardly_known, {name, value.std_error / std::abs(value.value)}});
  };
  const double modulus = std::abs(soil.k_c.value / narrow + soil.k_phi.value);
  add("k_phi", soil.k_phi, std::max(std::abs(soil.k_phi.value), modulus));
  add("k_c", soil.k_c, std::max(3 * std::abs(soil.k_c.value), narrow * modulus));
  add("c", soil.cohesion, std::max(3 * soil.cohesion.value, firm));
  add("c1", soil.stress_angle_c1, any_angle), add("c2", soil.stress_angle_c2, any_angle);
}

void add_value_doubts(const SemiEmpiricalSoil& soil, Doubts& all) {
  if (!(soil.k_c.value > 0.0) && !(soil.k_phi.value > 0.0)) all.push_back({DoubtKind::carries_nothing});
  const double phi = soil.friction_angle.value / degree, c = soil.cohesion.value / 1000;
  expect(all, DoubtKind::unusual_exponent, soil.exponent.value, 0.1, 1.8);
  constexpr double plate = 0.1, sunk = 0.05;  // [m]
  if (const double p = (soil.k_c.value / plate + soil.k_phi.value) * std::pow(sunk, soil.exponent.value) / 1000; p > 0)
    expect(all, DoubtKind::unusual_pressure, p, 0.5, 3000);
  expect(all, DoubtKind::unusual_cohesion, c, 0, 100);
  expect(all, DoubtKind::unusual_friction_angle, phi, 0, 50);
  expect(all, DoubtKind::unusual_shear_modulus, 1000 * soil.shear_modulus.value, 0.5, 120);
  expect(all, DoubtKind::unusual_density, bulk_density(soil), 200, 2400);
  for (const auto& [key, name, value] :
       {std::tuple{"stress_angle_c1", "c1", soil.stress_angle_c1}, {"stress_angle_c2", "c2", soil.stress_angle_c2}})
    if (const auto from = soil.sources.find(key);
        from != soil.sources.end() && from->second == usual_stress_angle_source)
      all.push_back({DoubtKind::usual_stress_angle, {name, value.value, value.std_error}});
  if (c == 0.0 && phi == 0.0) all.push_back({DoubtKind::no_strength});
  const double most = soil.stress_angle_c1.value + std::max(0.0, soil.stress_angle_c2.value);
  if (most > bekker_wong::max_stress_share)
    all.push_back({DoubtKind::stress_angles_limited, {most, bekker_wong::max_stress_share}});
  if (soil.stress_angle_c1.value + std::min(0.0, soil.stress_angle_c2.value) < 0.0)
    all.push_back({DoubtKind::stress_behind_axle});
  for (const auto& [name, value] :
       {std::pair{"n", soil.exponent}, {"phi", soil.friction_angle}, {"K", soil.shear_modulus}})
    if (value.std_error > 0.6 * value.value)
      all.push_back(value.value > 0.0 ? Doubt{DoubtKind::rough_errors, {name, 100 * value.std_error / value.value}}
                                      : Doubt{DoubtKind::rough_errors_at_zero, {name}});
  if (is_from_command_line(soil, "exponent") && !is_from_command_line(soil, "k_phi"))
    all.push_back({DoubtKind::exponent_changed_alone});
  add_doubts_of_wide_errors(soil, all);
}

}  // namespace

Doubts doubts(const Soil& soil) {
  Doubts all;
  if (soil.semi_empirical) add_value_doubts(*soil.semi_empirical, all);
  if (soil.bed_density && !soil.beds.empty())
    if (const DensityRange range = tested(soil.beds); !range.holds(*soil.bed_density))
      all.push_back({DoubtKind::beyond_densities_of_plates, {*soil.bed_density, range.lowest, range.highest}});
  std::optional<double> gravity;
  if (soil.semi_empirical || soil.granular)
    gravity = soil.semi_empirical ? soil.semi_empirical->gravity : soil.granular->gravity;
  if (gravity) expect(all, DoubtKind::unusual_gravity, *gravity, 0.1, 25);
  return all;
}

Doubts unusual_inflation(double pressure, const std::optional<OperatingCondition>& at) {
  constexpr double highest = 1.5e6;
  if (pressure <= highest) return {};
  return {Doubt{DoubtKind::unusual_inflation, {pressure / 1000, highest / 1000}, at}};
}

Doubts doubts(const Tire& tire) {
  Doubts all;
  expect(all, DoubtKind::unusual_radius, tire.radius * 1000, 20, 2000);
  if (tire.inflation_pressure) append(all, unusual_inflation(*tire.inflation_pressure));
  if (tire.width > 2 * tire.radius)
    all.push_back({DoubtKind::wider_than_high, {1000 * tire.width, 2000 * tire.radius}});
  if (is_lugged(tire) && tire.lugs.height > 0.3 * tire.radius)
    all.push_back({DoubtKind::high_lugs, {1000 * tire.lugs.height}});
  return all;
}

Doubts doubts(const Tire& tire, const Soil& soil) {
  Doubts all = doubts(tire);
  if (soil.semi_empirical && !(bekker_wong::values_of(*soil.semi_empirical).pressure_modulus(tire.width) > 0.0))
    all.push_back({DoubtKind::carries_nothing_at_width});
  return all;
}

}  // namespace soilbin::compare
