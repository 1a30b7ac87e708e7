// Grains of several sizes, by their shares of the mass, as a sieve analysis gives them.
//
//   set_sizes(soil, {{0.5e-3, 0.3}, {1e-3, 0.5}, {2e-3, 0.2}});  // radius [m], share; radius_min and radius_max follow
//   mean_diameter(soil)                                          // 2.1e-3 m, by mass
#pragma once

#include <vector>

#include "scenario/soil.hpp"

namespace soilbin {

/// Gives a soil these sizes, and radius_min and radius_max that fit them.
void set_sizes(GranularSoil& soil, std::vector<GrainFraction> sizes);

/// Multiplies all radii.
void scale_sizes(GranularSoil& soil, double factor);

/// Mean of the cube of the radius over all grains, by number [m^3]: (4/3) pi times it is a grain's mean volume.
double mean_cube(const GranularSoil& soil);

/// What is wrong in `sizes`: an order that does not rise, shares that do not add up to 100 % within 0.5 %, other bounds
/// than radius_min and radius_max; or that there are neither sizes nor radii. "" for nothing.
std::string wrong_in_sizes(const GranularSoil& soil);

}  // namespace soilbin
