// How deep the wheel's rim lies under the surface, node by node.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

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
    const auto i = static_cast<std::size_t>(node);
    const double sine = entry_sine_ - rolling_.patch.sine_drop[i];
    const double below_axle = std::numbers::pi / 2 - std::abs(rolling_.patch.theta[i]);
    const double cosine = std::copysign(std::sqrt(std::max(0.0, 1 - sine * sine)), below_axle);
    return {sine, cosine, std::max(0.0, rolling_.outline.radius * (cosine - entry_cosine_))};
  }

 private:
  const Rolling& rolling_;
  double entry_sine_, entry_cosine_;
};

}  // namespace soilbin::bekker_wong
