// How high a bed stands: what one would see from above, point by point.
#pragma once

#include <vector>

#include "dem/engine/grains.hpp"

namespace soilbin::dem {

/// A rectangle of the ground [m].
struct Footprint {
  double x_lower, x_upper, y_lower, y_upper;
};

/// Heights of the highest grain over points of a grid; 0, the floor, where
/// there is none.
struct SurfaceHeight {
  Footprint over;
  int nx = 0, ny = 0;
  std::vector<double> height;  ///< [m], x varying fastest

  double at(int ix, int iy) const { return height[static_cast<std::size_t>(iy) * nx + ix]; }
  double mean() const;
  double deviation() const;  ///< standard deviation from the mean: the roughness [m]
  double highest() const;
  /// Mean across, at each x.
  std::vector<double> along() const;
};

/// The floor over points in the middle of cells of about `spacing`; and one grain that lies on it.
SurfaceHeight bare_floor(const Footprint& over, double spacing);
void raise(SurfaceHeight& surface, const Vec3& centre, double radius);

/// The surface of all grains, seen from above; the points lie in the middle of
/// cells of about `spacing`.
SurfaceHeight surface_height(const Grains& grains, const Footprint& over, double spacing);

}  // namespace soilbin::dem
