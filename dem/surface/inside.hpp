// Whether a point lies inside a closed surface, on it or outside: for bodies of a drawing that hide each other.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// Where a straight line meets a triangle.
struct LineHit {
  double along;      ///< from the line's point, in lengths of its direction
  double clearance;  ///< the least of the three shares of the corners: 0 on an edge, 1/3 in the middle
};
std::optional<LineHit> line_through(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b, const Vec3& c);

enum class Place { inside, on, outside };

/// A closed surface, sorted for many questions. Triangles may face either way.
class Solid {
 public:
  /// A point closer than `tolerance` lies on the surface.
  Solid(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles, double tolerance);

  /// By the number of triangles that a line from the point meets.
  Place place_of(const Vec3& point) const;

 private:
  struct Triangle {
    std::array<Vec3, 3> corners;  ///< in a frame turned askew, so that no edge of a drawing lies along a line
  };
  std::array<int, 2> cell_of(double y, double z) const;

  double tolerance_;
  std::vector<Triangle> triangles_;
  Box box_;                               ///< in that frame
  int cells_ = 1;                         ///< along y and z each
  std::vector<std::vector<int>> listed_;  ///< triangles over each cell
};

}  // namespace soilbin::dem
