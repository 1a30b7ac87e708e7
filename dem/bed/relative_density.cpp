#include "dem/bed/relative_density.hpp"

#include <algorithm>

#include "scenario/estimate.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::dem {

std::array<BedRecipe, 2> limit_beds(const GranularSoil& soil) {
  BedRecipe recipe;
  recipe.soil = soil;
  recipe.gravity = gravity_on(soil);
  static_cast<LawFlags&>(recipe.laws) = laws_of(soil);
  const double d = mean_diameter(soil);
  recipe.size = {.length = 15 * d, .width = 10 * d, .depth = 10 * d};
  std::array<BedRecipe, 2> both = {recipe, recipe};
  both[0].settling_friction = 1, both[1].settling_friction = 0;
  return both;
}

DensityLimits density_limits(const GranularSoil& soil, BedStore& store, const WorkOptions& how) {
  const auto [loosest, densest] = limit_beds(soil);
  return {store.bed(loosest, how)->report.void_ratio, store.bed(densest, how)->report.void_ratio};
}

bool has_density_limits(const GranularSoil& soil, const BedStore& store) {
  return std::ranges::all_of(limit_beds(soil), [&](const BedRecipe& recipe) { return is_there(store.file(recipe)); });
}

std::optional<DensityLimits> known_density_limits(const GranularSoil& soil, BedStore& store) {
  if (!has_density_limits(soil, store)) return std::nullopt;
  return density_limits(soil, store);
}

double relative_density(double void_ratio, const DensityLimits& limits) {
  const double apart = limits.loosest - limits.densest;
  return apart > 0 ? (limits.loosest - void_ratio) / apart : not_a_number;
}

std::string_view beyond_limits(double relative_density) {
  if (relative_density < 0) return ", looser than the small bed that counts as 0 %";
  return relative_density > 1 ? ", denser than the small bed that counts as 100 %" : "";
}

}  // namespace soilbin::dem
