// How long a step may be.
#pragma once

#include "dem/engine/grains.hpp"
#include "dem/engine/materials.hpp"

namespace soilbin::dem {

/// T_R = pi r sqrt(rho/G)/(0.1631 nu + 0.8766), the smallest over all grains [s]; after Thornton's approximation of the
/// Rayleigh wave speed.
double rayleigh_time(const Materials& materials, const Grains& grains);

/// T_H = 2.87 (m*^2/(R* E*^2 v))^(1/5): how long the shortest impact of two equal grains at `speed` [m/s] lasts [s].
/// Infinite at rest.
double hertz_time(const Materials& materials, const Grains& grains, double speed);

}  // namespace soilbin::dem
