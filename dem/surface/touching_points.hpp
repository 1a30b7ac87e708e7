// Where a sphere touches a surface of triangles.
//
// A touching point is a local minimum of the distance from the sphere's centre c to the surface as a whole, closer than
// the sphere's radius r. Each triangle is convex, so it has one closest point to c:
// - inside the triangle, it is such a minimum;
// - inside an edge, it is one unless the triangle across the edge has closer points beside it;
// - on a vertex, it is one unless any triangle round the vertex has closer points beside it.
// So a plane gives one point however it is meshed, a convex ridge or tip gives one whose normal turns continuously, a
// concave corner of two planes gives two and one of three planes three.
//
// 'Closer' forgives 1e-9 r and the rounding of the mesh; points as close to each other are one, the one of the lowest
// triangle.
//
// Sides. A sheet (a mesh that is not `closed`) has two: the normal points from the surface to c, and a centre that
// crosses the sheet is on the other side. A closed mesh has an inside:
// - c outside: the normal points from the surface to c. Minima seen through the body (the far face of a thin lug) are
//   none; they are told by the surface's outward normal at the point.
// - c inside, by the outward normal at the nearest point: that nearest point is the only one; its normal points
//   outward and its distance is negative. Overlap and normal are continuous while c goes in through a face.
// - c deeper inside than r is not noticed: no triangle is near.
//
// Nearly parallel points are one. A smooth concave surface, finely meshed, has several minima where the true surface
// has one. Points whose normals differ by less than the MergeAngle from the deepest one's are one with it, its normal
// the mean of theirs. The share of another in that mean is 1 where both are equally near, and 0 where that one ends:
// where it is no deeper than 0, and where its foot would pass the line in which the planes of both meet, d_deepest =
// d cos(angle between them). Its distance is d_deepest (mean normal . the deepest's). That is a concave edge with a
// fillet of the distance d: a grain that goes over it feels its normal turn and not jump, one that lies in it rests on
// both planes at once, and the distance falls along the normal, so that no work is made or lost by going round. A
// concave edge of two planes that meet at less than the angle is one contact, and a steeper one two.
#pragma once

#include <array>
#include <span>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

struct TouchingPoint {
  Vec3 point;           ///< centre - distance normal: on the surface, or beside it where several points are one
  Vec3 normal;          ///< unit, the way the sphere is pushed
  double distance = 0;  ///< [m] from surface to centre along the normal; negative for a centre inside a closed mesh
  int triangle = -1;    ///< the lowest that has the point
  /// How deep the sphere of this radius is in the surface [m], > 0.
  double overlap(double radius) const { return radius - distance; }
};

/// Deepest first; equally deep ones by triangle.
struct TouchingPoints {
  static constexpr int capacity = 8;
  int count = 0;
  int dropped = 0;  ///< how many more there were than fit; the deepest are kept
  std::array<TouchingPoint, capacity> points;

  const TouchingPoint* begin() const { return points.data(); }
  const TouchingPoint* end() const { return points.data() + count; }
  const TouchingPoint& operator[](int i) const { return points[i]; }
};

/// An angle that merges nearly parallel points, kept as its cosine.
class MergeAngle {
 public:
  /// [rad], from 0 (only points that coincide are one) to pi/2; throws std::invalid_argument beyond.
  explicit MergeAngle(double angle = 0.2);
  double cosine() const { return cosine_; }

 private:
  double cosine_;
};

/// The touching points of the sphere with this centre, in the mesh's frame, and radius [m]. `candidates` are triangles
/// in ascending order, among them all closer to the centre than the radius; more of them cost time and change no bit.
/// `out` is overwritten; nothing is allocated. The same input gives the same bits.
void find_touching_points(const TriangleMesh& mesh, std::span<const int> candidates, const Vec3& centre, double radius,
                          const MergeAngle& merge, TouchingPoints& out);

}  // namespace soilbin::dem
