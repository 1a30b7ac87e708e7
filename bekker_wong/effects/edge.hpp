// How deep the wheel's rim lies under the surface, node by node.
#pragma once

#include <algorithm>
#include <cmath>

#include "bekker_wong/effect.hpp"

namespace soilbin::bekker_wong {

/// The rim at a node of the tread.
struct Edge {
  double sine, cosine;  ///< of theta
  double depth;         ///< under the surface [m]
};

/// The rim over a contact: a circle, also where the tread flattens.
class Rim {
 public:
  explicit Rim(const Rolling& r)
      : rolling_(r), entry_sine_(std::sin(r.patch.angles.entry)), entry_cosine_(std::cos(r.patch.angles.entry)) {}
  Edge at(int node) const {
    const double sine = entry_sine_ - rolling_.patch.sine_drop[static_cast<std::size_t>(node)];
    const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));  // |theta| < 90 deg
    return {sine, cosine, std::max(0.0, rolling_.outline.radius * (cosine - entry_cosine_))};
  }

 private:
  const Rolling& rolling_;
  double entry_sine_, entry_cosine_;
};

}  // namespace soilbin::bekker_wong
