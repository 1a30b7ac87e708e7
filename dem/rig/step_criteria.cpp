#include "dem/rig/step_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/bed/grain_shape.hpp"
#include "dem/engine/rayleigh_time.hpp"
#include "dem/surface/mass_properties.hpp"

namespace soilbin::dem {
namespace {

/// T_H = 2.87 (m*^2/(R* E*^2 v))^(1/5): how long the shortest impact of two equal grains at `speed` [m/s] lasts [s].
/// Infinite at rest.
double hertz_time(const Materials& materials, const Grains& grains, double speed) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Material& m = materials.all[grains.material[k]];
    const double young = reduced_young(m, m), radius = grains.motion[k].radius / 2;
    const double mass = 0.5 / grains.motion[k].inverse_mass;
    shortest = std::min(shortest, 2.87 * std::pow(mass * mass / (radius * young * young * speed), 0.2));
  }
  return shortest;
}

}  // namespace

double step_of(const BedRecipe& recipe, const Rig& rig) {
  if (rig.dt > 0) return rig.dt;
  return recipe.dt > 0 ? recipe.dt : longest_step(recipe.soil);
}

StepCriteria step_criteria(const BedRecipe& recipe, const Rig& rig, double rim_speed) {
  const GranularSoil& soil = recipe.soil;
  Materials materials;
  materials.add({"grains", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio});
  Grains grains;
  const double radius = proportions_of(soil).sphere * soil.radius_min;
  grains.add({.radius = radius, .mass = sphere_volume(soil.radius_min) * soil.grain_density});
  return {.step = step_of(recipe, rig),
          .rayleigh = rayleigh_time(materials, grains),
          .speed = rim_speed,
          .hertz = hertz_time(materials, grains, rim_speed)};
}

double rim_speed(const Tire& tire, const OperatingCondition& at) {
  const WheelMotion motion = wheel_motion(at, tire.radius);
  return std::max(motion.rotation * outer_radius(tire), motion.speed);
}

}  // namespace soilbin::dem
