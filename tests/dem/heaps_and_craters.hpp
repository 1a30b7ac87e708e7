// Beds of a few thousand grains: the slope that sand comes to rest at, and how deep a ball falls into it. Tens of
// seconds each, so these are no part of `soilbin verify`.
#pragma once

#include <cstdint>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// What a bed is made of; grains of radii within a tenth of `radius`.
struct BedMaterial {
  Material material{"sand", 2500, 1e7, 0.25};
  Interaction contact{.restitution = 0.5, .sliding_friction = 0.5, .rolling_friction = 0.1, .rolling_damping = 0.3};
  RollingLaw rolling = RollingLaw::elastic_plastic;
  double radius = 0.01;  ///< [m]
};

/// Slope [rad] of what stays in a box once one of its walls is gone and what can has run out over the edge of the floor
/// (the drained angle of repose). The box is 40 radii long and 24 high, periodic across.
double drained_angle(const BedMaterial& of, std::uint64_t seed, int threads = 1);

/// A ball, of triangles, dropped on a bed.
struct Drop {
  double height = 0;  ///< of the fall before it touches [m]
  double depth = 0;   ///< of its lowest point below the level of the bed, at rest [m]
  double law = 0;     ///< 0.14/mu (rho_b/rho_g)^(1/2) D^(2/3) H^(1/3), H = height + depth [m]
};

/// A ball and the heights that it falls from.
struct BallDrops {
  double diameter, density;     ///< D [m], rho_b [kg/m^3]
  std::vector<double> heights;  ///< [m]
};

struct Craters {
  double bulk_density = 0;  ///< rho_g [kg/m^3]
  double level = 0;         ///< of the bed's surface [m]
  std::vector<Drop> drops;
  double exponent = 0;  ///< of depth over H, least squares in logarithms
};

/// Drops a ball on a bed from several heights, each on the same bed. mu: the tangent of the bed's angle of repose.
Craters craters(const BedMaterial& of, double mu, const BallDrops& drops, std::uint64_t seed, int threads = 1);

}  // namespace soilbin::dem
