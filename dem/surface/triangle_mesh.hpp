// A surface of triangles: checked once, then ready for distance queries. Lengths in metres, in the frame of its body.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

struct MeshOptions {
  /// The mesh bounds a body: no border edges, triangles counter-clockwise seen from outside. Else it is a sheet with
  /// two sides (a plate, or a container that is filled from inside).
  bool closed = false;
  /// Two vertices closer than this share of the bounding box's diagonal are one; so close, a vertex lies on an edge
  /// and a triangle has no height. Far above the rounding of a file in single precision.
  double weld = 1e-6;
  /// Vertices stay as they are, and parts of the surface may touch: nothing is welded, and T-joints are not looked for.
  /// For what was welded or mended before (mesh_mending.hpp, restarts).
  bool as_given = false;
  std::string name = "mesh";  ///< what messages call it, a file's path say
};

struct Box {
  Vec3 low, high;
  bool operator==(const Box&) const = default;
};

/// The plane of a triangle and the three planes through its edges, square to it. All normals are units.
struct TriangleFrame {
  Vec3 normal;                  ///< out of the body
  double offset = 0;            ///< normal . x = offset on the triangle [m]
  std::array<Vec3, 3> sides{};  ///< in the triangle's plane, out of it across edge i (from corner i to corner i + 1)
  std::array<double, 3> side_offsets{};
};

/// A ball round a triangle, rounded up, small enough for many to lie in the cache.
struct BoundingBall {
  float x = 0, y = 0, z = 0, radius = 0;
  /// False only where the triangle is no closer than `reach` to c.
  bool may_be_within(double reach, const Vec3& c) const {
    const double dx = x - c.x, dy = y - c.y, dz = z - c.z, sum = reach + radius;
    return dx * dx + dy * dy + dz * dz < sum * sum;
  }
};

/// Where a triangle's edge is met: edge `edge` of triangle `triangle`; triangle -1 is no triangle, a border.
struct EdgeLink {
  int triangle = -1, edge = 0;
  bool operator==(const EdgeLink&) const = default;
};

class TriangleMesh {
 public:
  using Corners = std::array<int, 3>;

  /// Vertices [m] and, counter-clockwise seen from outside, the corners of each triangle. Triangles keep their numbers;
  /// vertices are welded (the first of each cluster stays) and those of no triangle left out.
  /// Throws InputError for: no triangles, a corner that is no vertex, a coordinate that is not finite, a triangle
  /// without area, a triangle given twice, an edge of more than two triangles, neighbours of opposite orientation, a
  /// vertex that lies inside an edge (a T-joint), and where `closed`: a border edge, two parts that share but a vertex,
  /// triangles that face inward. Surfaces that cross themselves are not searched for.
  TriangleMesh(std::vector<Vec3> vertices, std::vector<Corners> triangles, const MeshOptions& options = {});

  int size() const { return static_cast<int>(triangles_.size()); }  ///< number of triangles
  bool closed() const { return closed_; }                           ///< as demanded by MeshOptions
  const std::string& name() const { return name_; }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Corners>& triangles() const { return triangles_; }
  const Box& bounds() const { return bounds_; }
  double area() const { return area_; }  ///< [m^2]

  const Vec3& corner(int triangle, int i) const { return vertices_[triangles_[triangle][i]]; }
  const TriangleFrame& frame(int triangle) const { return frames_[triangle]; }
  const BoundingBall& ball(int triangle) const { return balls_[triangle]; }
  /// The triangle on the other side of edge i.
  const EdgeLink& across(int triangle, int i) const { return links_[triangle][i]; }
  /// Unit vectors from a vertex into its triangles: along all edges, and half-way where a corner is wider than a right
  /// angle. So no direction into the surface is farther than 45 degrees from one of them.
  std::span<const Vec3> directions(int vertex) const {
    return {directions_.data() + first_direction_[vertex], directions_.data() + first_direction_[vertex + 1]};
  }
  /// Out of the body: the triangles' normals weighted by their angles at the vertex (Baerentzen and Aanaes 2005), not
  /// of unit length.
  const Vec3& vertex_normal(int vertex) const { return vertex_normals_[vertex]; }
  /// Bound on what rounding does to a distance from the surface [m].
  double rounding() const { return rounding_; }

 private:
  void set_frames();
  void set_vertex_data();

  std::vector<Vec3> vertices_;
  std::vector<Corners> triangles_;
  std::vector<TriangleFrame> frames_;
  std::vector<BoundingBall> balls_;
  std::vector<std::array<EdgeLink, 3>> links_;
  std::vector<int> first_direction_;
  std::vector<Vec3> directions_, vertex_normals_;
  Box bounds_;
  double area_ = 0, rounding_ = 0;
  bool closed_ = false;
  std::string name_;
};

/// Vertices and triangles of which nothing is checked. Lengths in any unit.
struct MeshSoup {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
};

}  // namespace soilbin::dem
