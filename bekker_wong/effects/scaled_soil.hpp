// A soil made stiffer or stronger by a factor. A factor of 1 leaves it as it is, to the bit.
#pragma once

#include <algorithm>
#include <cmath>

#include "bekker_wong/contact_patch.hpp"

namespace soilbin::bekker_wong {

/// No effect takes away more than this leaves of a soil's stiffness or strength.
inline constexpr double least_share = 0.05;

/// A factor, held at least_share where a linear law would make it smaller or negative.
inline double at_least_share(double factor) { return std::max(factor, least_share); }

/// exp(x), held between least_share and 150 so that a fit's wild guess still has an answer.
inline double bounded_exp(double x) { return std::exp(std::clamp(x, std::log(least_share), 5.0)); }

/// k_c and k_phi times the factor: sigma at a given depth grows by it.
inline void scale_stiffness(SoilValues& soil, double factor) {
  soil.k_c *= factor;
  soil.k_phi *= factor;
}

/// tan(phi) times the factor.
inline void scale_friction(SoilValues& soil, double factor) {
  if (factor != 1.0) soil.friction_angle = std::atan(factor * std::tan(soil.friction_angle));
}

/// c and tan(phi) times the factor: the shear strength at a given sigma grows by it.
inline void scale_strength(SoilValues& soil, double factor) {
  soil.cohesion *= factor;
  scale_friction(soil, factor);
}

}  // namespace soilbin::bekker_wong
