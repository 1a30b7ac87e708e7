// How dense a bed is between the loosest and the densest that the engine makes of its grains.
//
//   BedStore store(folder);
//   relative_density(bed.report.void_ratio, density_limits(soil, store))   // 0: loosest, 1: densest
//
// The laboratory finds both limits by standard tests (ASTM D4253, D4254); here they are the void ratios of two small
// beds, settled with the whole friction between grains and with none.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "dem/bed/bed_store.hpp"

namespace soilbin::dem {

/// A bed by name: the share of friction with which it settles (BedRecipe::settling_friction). What relative density
/// `medium` gives depends on the sand: 46 to 63 % in two (docs/lab/grain-size.md).
struct NamedDensity {
  std::string_view name;
  double settling_friction;
};
inline constexpr std::array<NamedDensity, 3> named_densities = {{{"loose", 1.0}, {"medium", 0.5}, {"dense", 0.0}}};

/// Void ratios: volume of voids over volume of grains.
struct DensityLimits {
  double loosest = 0, densest = 0;
};

/// The beds that give the limits: 15 x 10 x 10 mean diameters, packing 1, under the soil's own gravity; the
/// loosest, then the densest.
std::array<BedRecipe, 2> limit_beds(const GranularSoil& soil);

/// Settles both beds where the store lacks them. Throws what settle_bed throws.
DensityLimits density_limits(const GranularSoil& soil, BedStore& store, const WorkOptions& how = {});
/// Whether the store's folder has both.
bool has_density_limits(const GranularSoil& soil, const BedStore& store);
/// The limits as density_limits gives them, without settling anything: none where the store lacks one of the beds.
std::optional<DensityLimits> known_density_limits(const GranularSoil& soil, BedStore& store);

/// (e_loosest - e)/(e_loosest - e_densest): 0 loosest, 1 densest; beyond both for a bed that is looser or denser than
/// they are. NaN where the limits are not apart.
double relative_density(double void_ratio, const DensityLimits& limits);
/// What to add where it lies beyond both: ", looser than the small bed that counts as 0 %"; else "".
std::string_view beyond_limits(double relative_density);

}  // namespace soilbin::dem
