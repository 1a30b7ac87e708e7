// The Rayleigh time, of which a time step may be a share (Numerics::safe_share).
#pragma once

#include <cmath>
#include <numbers>

#include "dem/engine/grains.hpp"
#include "dem/engine/materials.hpp"

namespace soilbin::dem {

/// T_R of a grain of this radius [s].
inline double rayleigh_time(const Material& m, double radius) {
  const double shear = m.young / (2 * (1 + m.poisson));
  return std::numbers::pi * radius * std::sqrt(m.density / shear) / (0.1631 * m.poisson + 0.8766);
}

/// T_R = pi r sqrt(rho/G)/(0.1631 nu + 0.8766), the smallest over all grains [s]; after Thornton's approximation of the
/// Rayleigh wave speed.
double rayleigh_time(const Materials& materials, const Grains& grains);

}  // namespace soilbin::dem
