#pragma once

#include <cmath>

#include "dem/engine/domain.hpp"

namespace soilbin::dem {

/// Lengths of the periodic sides [m], 0 for the others.
struct Periods {
  Vec3 length, inverse;

  explicit Periods(const Domain& domain) {
    const Vec3 side = domain.upper - domain.lower;
    if (domain.periodic[0]) length.x = side.x, inverse.x = 1 / side.x;
    if (domain.periodic[1]) length.y = side.y, inverse.y = 1 / side.y;
    if (domain.periodic[2]) length.z = side.z, inverse.z = 1 / side.z;
  }

  /// The image of a difference of two positions that is nearest to zero.
  Vec3 shortest(Vec3 d) const {
    if (length.x > 0) d.x -= length.x * std::nearbyint(d.x * inverse.x);
    if (length.y > 0) d.y -= length.y * std::nearbyint(d.y * inverse.y);
    if (length.z > 0) d.z -= length.z * std::nearbyint(d.z * inverse.z);
    return d;
  }
};

}  // namespace soilbin::dem
