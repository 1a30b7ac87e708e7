// A soil whose values were measured at several densities, and what they are at another one.
//
//   Soil sand = find_soil("cullinan-sand", library);  // beds of 1390, 1511 and 1538 kg/m^3
//   set_density(sand, 1450);                          // sand.semi_empirical: between the first two
//
// Between neighbouring beds each value is interpolated linearly in ln rho, rho the dry density [kg/m^3]: n, ln k_phi,
// k_c/k_phi, c, tan phi, ln K, c1 and c2. Then ln p = ln(k_c/b + k_phi) + n ln z of one size of plate is linear in ln
// rho at every depth z: a power of the dry density, the form that Ayers and Perumpral (1982, Trans. ASAE 25:1169) found
// for the cone index. That it goes through each bed, and holds for the other values, is ours.
//
// Variance of such a value g between beds a and b, with x = ln rho and w = (x - x_a)/(x_b - x_a):
//   (1 - w)^2 s_a^2 + w^2 s_b^2 + r (x_b - x_a) w (1 - w),   r = mean over neighbours of (g_b - g_a)^2/(x_b - x_a).
// The last term is what a Wiener process with the scatter r does between two places where it is known (a Brownian
// bridge); its best predictor is the straight line. It is 0 at the beds. Beyond the beds the value of the nearest one
// holds, and its variance grows by r |x - x_a|, as far again as the beds reach; there is no value farther out. A value
// that all beds share, its standard deviation included, is one measurement and changes in nothing.
//
// Beds with a reference sinkage z_i, at which n and k_phi z_i^n err apart: k_phi z_0^n is interpolated in place of
// k_phi, in its logarithm, and z_0 is declared of the bed between them. ln z_0 = sum w_i^2 s_i^2 ln z_i/sum w_i^2
// s_i^2, with s_i the errors of n and w_i the weights above: there the errors of n add nothing to that of the pressure.
#pragma once

#include <span>

#include "scenario/soil.hpp"

namespace soilbin {

/// Densities [kg/m^3].
struct DensityRange {
  double lowest = 0.0, highest = 0.0;
  bool holds(double density) const { return lowest <= density && density <= highest; }
};

/// From the loosest bed to the densest. `beds`: two or more, loosest first, each with a density.
DensityRange tested(std::span<const SemiEmpiricalSoil> beds);

/// From where on there are values, beyond the beds too: as far again as they reach, by ratio.
DensityRange reached(std::span<const SemiEmpiricalSoil> beds);

/// The values at a density; those of a bed, to the bit, at its density. Throws InputError out of reach.
SemiEmpiricalSoil bed_at(std::span<const SemiEmpiricalSoil> beds, double density);

/// Asks about another bed of the soil; its name then tells the density. Throws InputError out of reach, and for a soil
/// without beds or with beds that no file may hold.
void set_density(Soil& soil, double density);

}  // namespace soilbin
