#include "dem/rig/step_criteria.hpp"

#include <algorithm>
#include <numbers>

#include "dem/engine/time_step.hpp"

namespace soilbin::dem {

double step_of(const BedRecipe& recipe, const Rig& rig) {
  if (rig.dt > 0) return rig.dt;
  return recipe.dt > 0 ? recipe.dt : longest_step(recipe.soil);
}

StepCriteria step_criteria(const BedRecipe& recipe, const Rig& rig, double rim_speed) {
  const GranularSoil& soil = recipe.soil;
  Materials materials;
  materials.add({"grains", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio});
  Grains grains;
  const double radius = soil.radius_min,
               mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * soil.grain_density;
  grains.add(0, {}, {}, {}, radius, mass, 0);
  return {.step = step_of(recipe, rig),
          .rayleigh = rayleigh_time(materials, grains),
          .speed = rim_speed,
          .hertz = hertz_time(materials, grains, rim_speed)};
}

double rim_speed(const Tire& tire, const OperatingCondition& at) {
  const WheelMotion motion = wheel_motion(at, tire.radius);
  return std::max(motion.rotation * (tire.radius + tire.lugs.height), motion.speed);
}

}  // namespace soilbin::dem
