// The space that grains may be in, and what its periodic sides do to distances.
#pragma once

#include <array>
#include <cmath>

#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

/// The space that grains may be in. A grain beyond a side that isn't periodic is lost, which stops a run: walls are
/// planes or meshes that the run adds, they are not implied.
struct Domain {
  Vec3 lower{-1e6, -1e6, -1e6}, upper{1e6, 1e6, 1e6};  ///< [m]
  std::array<bool, 3> periodic{false, false, false};

  bool operator==(const Domain&) const = default;

  /// Whether a point is inside; not where it is not finite.
  bool contains(const Vec3& at) const {
    return at.x >= lower.x && at.y >= lower.y && at.z >= lower.z && at.x <= upper.x && at.y <= upper.y &&
           at.z <= upper.z;
  }
};

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
