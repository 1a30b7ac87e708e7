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
};

}  // namespace soilbin::dem
