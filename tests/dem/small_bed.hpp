// A bed small and soft enough for tests: a few hundred grains of about 20 mm.
#pragma once

#include "dem/bed/settled_bed.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem::test {

inline GranularSoil soft_soil() {
  GranularSoil soil;
  soil.radius_min = 0.008, soil.radius_max = 0.012;
  soil.grain_density = 2500, soil.youngs_modulus = 5e6, soil.poisson_ratio = 0.2;
  soil.grain_grain = {.restitution = 0.4, .sliding_friction = 0.5, .rolling_friction = 0.1};
  soil.grain_tire = {.restitution = 0.4, .sliding_friction = 0.5, .rolling_friction = 0.1};
  return soil;
}

inline BedRecipe small_recipe(const BedSize& size = {0.2, 0.15, 0.1}) {
  BedRecipe recipe;
  recipe.soil = soft_soil();
  recipe.size = size;
  return recipe;
}

inline WorkOptions with_threads(int threads) {
  WorkOptions how;
  how.threads = threads;
  return how;
}

/// A smooth wheel for these beds.
inline Tire small_wheel() {
  Tire tire;
  tire.name = "small", tire.radius = 0.1, tire.width = 0.08;
  return tire;
}

}  // namespace soilbin::dem::test
