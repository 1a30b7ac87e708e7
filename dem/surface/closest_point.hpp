// The point of one triangle that is closest to a given one, and on which of its features it lies.
#pragma once

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// What a closest point lies on: edge i (from corner i to i + 1) is i, corner i is 3 + i.
struct ClosestPoint {
  static constexpr int corner = 3, face = 6;
  Vec3 point;
  double squared_distance;  ///< [m^2]
  int feature;
};

/// True where triangle `t` is closer than `reach` to c; `closest` is then set. By distances from the planes of the
/// triangle and its edges instead of barycentric coordinates (Ericson 2004, 5.1.5): as exact on slivers.
inline bool closest_within(const TriangleMesh& mesh, int t, const Vec3& c, double reach, ClosestPoint& closest) {
  const TriangleFrame& f = mesh.frame(t);
  const double height = dot(f.normal, c) - f.offset;
  if (!(std::abs(height) < reach)) return false;
  const double beyond[] = {dot(f.sides[0], c) - f.side_offsets[0], dot(f.sides[1], c) - f.side_offsets[1],
                           dot(f.sides[2], c) - f.side_offsets[2]};
  if (!(beyond[0] < reach && beyond[1] < reach && beyond[2] < reach)) return false;
  if (beyond[0] <= 0 && beyond[1] <= 0 && beyond[2] <= 0) {
    closest = {c - height * f.normal, height * height, ClosestPoint::face};
    return true;
  }
  // Outside, the closest point lies on an edge that c is beyond.
  closest.squared_distance = reach * reach;
  bool found = false;
  for (int i = 0; i < 3; ++i) {
    if (beyond[i] <= 0) continue;
    const int next = i == 2 ? 0 : i + 1;
    const Vec3 &a = mesh.corner(t, i), &b = mesh.corner(t, next);
    const double along = dot(c - a, b - a), whole = squared(b - a);
    const bool before = along <= 0, after = along >= whole;
    const Vec3 p = before ? a : after ? b : a + (along / whole) * (b - a);
    const double d2 = squared(c - p);
    if (!(d2 < closest.squared_distance)) continue;
    closest = {p, d2, before ? ClosestPoint::corner + i : after ? ClosestPoint::corner + next : i};
    found = true;
  }
  return found;
}

}  // namespace soilbin::dem
