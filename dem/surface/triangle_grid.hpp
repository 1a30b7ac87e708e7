// Which triangles are near a point: cells over the mesh's bounding box, each with the triangles in reach of it.
#pragma once

#include <span>
#include <vector>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// Holds the mesh by reference: the mesh must outlive it, where it is.
class TriangleGrid {
 public:
  /// `reach` [m] is the largest distance that will be asked for: the largest radius, plus a skin where there is one.
  /// Cells have about this edge, more where they would be more than two million. Throws std::invalid_argument unless
  /// reach is positive and finite.
  TriangleGrid(const TriangleMesh& mesh, double reach);

  double reach() const { return reach_; }

  /// All triangles within reach() of this point, and some farther ones of the same cell; ascending. One look-up,
  /// nothing is copied. Empty where none is near; a point that is not finite has none.
  std::span<const int> around(const Vec3& point) const {
    // Written so that a NaN is outside.
    const double x = (point.x - origin_.x) * per_metre_, y = (point.y - origin_.y) * per_metre_,
                 z = (point.z - origin_.z) * per_metre_;
    if (!(x >= 0 && y >= 0 && z >= 0 && x < nx_ && y < ny_ && z < nz_)) return {};
    const int cell = (static_cast<int>(z) * ny_ + static_cast<int>(y)) * nx_ + static_cast<int>(x);
    return {listed_.data() + first_[cell], listed_.data() + first_[cell + 1]};
  }

  /// The triangles closer than `reach` <= reach() to this point, ascending; exact but for rounding. `out` is
  /// overwritten and grows only where its capacity is short. Throws std::invalid_argument for a larger reach.
  void near(const Vec3& point, double reach, std::vector<int>& out) const;

 private:
  const TriangleMesh& mesh_;
  double reach_, cell_ = 0, per_metre_ = 0;
  Vec3 origin_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<int> first_, listed_;  // triangles of cell i: listed_[first_[i]] to listed_[first_[i + 1] - 1]
};

}  // namespace soilbin::dem
