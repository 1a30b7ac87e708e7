// What TriangleMesh does to vertices and triangles before it takes them, step by step; mesh_mending.hpp takes some of
// the steps too. Those that refuse throw InputError.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// One side of one triangle, ends in ascending order.
struct Side {
  int low, high, triangle, edge;
  bool forward;  ///< the triangle runs from low to high
};

/// All sides, those of one edge next to each other.
std::vector<Side> sorted_sides(const std::vector<TriangleMesh::Corners>& triangles);

/// "name: message" and a hint.
[[noreturn]] void refuse_mesh(const std::string& name, const std::string& message, const std::string& hint);

/// Some triangles, all corners are vertices, all coordinates finite.
void check_numbers(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles,
                   const std::string& name);

/// The box of the vertices that triangles have.
Box box_of(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles);

/// Makes vertices closer than `distance` to an earlier one that stays that one; leaves out those of no triangle.
void weld(std::vector<Vec3>& vertices, std::vector<TriangleMesh::Corners>& triangles, double distance);

/// Each triangle has three corners and is at least `distance` high; none is there twice.
void check_triangles(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles,
                     double distance, const std::string& name);

/// Links triangles across each edge: at most one triangle, of the same orientation.
std::vector<std::array<EdgeLink, 3>> link_edges(const std::vector<Vec3>& vertices,
                                                const std::vector<TriangleMesh::Corners>& triangles,
                                                const std::string& name);

/// No vertex is within `distance` of an edge that it does not end.
void check_t_joints(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles,
                    double distance, const std::string& name);

/// No borders, one fan of triangles round each vertex, positive volume.
void check_closed(const std::vector<Vec3>& vertices, const std::vector<TriangleMesh::Corners>& triangles,
                  const std::vector<std::array<EdgeLink, 3>>& links, const std::string& name);

}  // namespace soilbin::dem
