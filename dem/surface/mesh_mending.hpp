// Mends what drawing programs leave in a mesh, so that its surface is that of closed bodies as grains meet them.
//
//   MeshMends mends;
//   MeshSoup wheel = mended(read_triangles("wheel.stl"), "wheel.stl", mends);
//   const TriangleMesh mesh(wheel.vertices, wheel.triangles, {.closed = true, .as_given = true});
//   mends.in_words("mm")  // {"1 sliver lower than 0.00018 mm taken out", ...}; empty: nothing had to be mended
#pragma once

#include <string>
#include <vector>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// What was found and changed. Numbers of triangles, but for those that say something else.
struct MeshMends {
  double tolerance = 0;      ///< 1e-6 of the diagonal of the drawing's box, in its unit
  int given = 0;             ///< in the file
  int slivers = 0;           ///< lower than the tolerance, taken out; their neighbours are split at their tip
  int doubled = 0;           ///< with the corners of another, left out
  int split = 0;             ///< with a vertex on an edge that had no neighbour: split there
  int turned = 0;            ///< that faced inward
  int unreachable = 0;       ///< walls inside, left out: no grain comes to either side of them
  int bodies = 0;            ///< closed bodies that are kept
  int bodies_inside = 0;     ///< bodies, cavities and sheets inside another body, left out
  int edges_parted = 0;      ///< edges at which more than two triangles met, and still do with the walls left out
  std::vector<Vec3> places;  ///< where slivers, doubled and split triangles were, a hundred at most
  bool any() const { return slivers + doubled + split + turned + unreachable + bodies_inside + edges_parted > 0; }
  /// A sentence for each change; lengths in this unit, the drawing's.
  std::vector<std::string> in_words(const std::string& unit) const;
};

/// The outer surfaces of the bodies in the soup, every triangle facing outward. What is clean stays as it is, to the
/// bit and in its order.
/// - Vertices closer than the tolerance are one. Slivers are taken out, doubled triangles too, and triangles split at a
///   vertex that lies on an open edge of theirs.
/// - How triangles face in the file does not matter: the surface is followed from the outside, across each edge to the
///   next triangle that is met there. So walls inside are left out, and triangles that face inward are turned.
/// - Bodies that touch along an edge or at a vertex come apart there; bodies with flush faces stay as they are. A body,
///   a cavity or an open sheet that lies inside another body, its faces flush with that body's or not, is left out.
/// Throws InputError for no triangles, coordinates that are not finite, and an open surface that no body hides; places
/// are told in the drawing's unit. Surfaces that cross each other stay: a grain meets the outer ones.
MeshSoup mended(MeshSoup soup, const std::string& name, MeshMends& mends);

}  // namespace soilbin::dem
