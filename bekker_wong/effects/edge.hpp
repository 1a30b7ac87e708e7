// How deep the wheel's rim lies under the surface, node by node.
#pragma once

#include <algorithm>
#include <cmath>

#include "bekker_wong/effect.hpp"

namespace soilbin::bekker_wong {

/// The rim at a node of the tread.
struct Edge {
  double cosine;  ///< of theta
  double depth;   ///< under the surface [m]
};

/// entry_cosine: of theta_1, the same for all nodes.
inline Edge edge(const Rolling& r, int i, double entry_cosine) {
  const double cosine = std::cos(r.patch.theta[i]);
  return {cosine, std::max(0.0, r.outline.radius * (cosine - entry_cosine))};
}

}  // namespace soilbin::bekker_wong
