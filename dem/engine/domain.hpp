#pragma once

#include <array>

#include "dem/engine/vec3.hpp"

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

}  // namespace soilbin::dem
