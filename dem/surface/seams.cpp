#include "dem/surface/seams.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dem/surface/closest_point.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

constexpr double same_place = 1e-6;  ///< of a mesh's diagonal: closer is the same place, as where vertices are welded
const double nearly_parallel = std::cos(0.2);

double mesh_diagonal(const TriangleMesh& mesh) { return length(mesh.bounds().high - mesh.bounds().low); }

bool face_alike(const Vec3& a, const Vec3& b, bool both_sheets) {
  const double cosine = dot(a, b);
  return (both_sheets ? std::abs(cosine) : cosine) > nearly_parallel;
}

bool lies_in(const Box& box, const Vec3& p, double margin) {
  return p.x > box.low.x - margin && p.x < box.high.x + margin && p.y > box.low.y - margin &&
         p.y < box.high.y + margin && p.z > box.low.z - margin && p.z < box.high.z + margin;
}

bool boxes_meet(const Box& a, const Box& b, double margin) {
  return a.low.x < b.high.x + margin && b.low.x < a.high.x + margin && a.low.y < b.high.y + margin &&
         b.low.y < a.high.y + margin && a.low.z < b.high.z + margin && b.low.z < a.high.z + margin;
}

std::optional<Vec3> seam_of(const Plane& a, const Plane& b) {
  const double apart = std::abs(dot(b.point - a.point, a.normal)), size = length(a.point) + length(b.point);
  if (dot(a.normal, b.normal) < 1 - 1e-12 || apart > same_place * size) return std::nullopt;
  return b.point;
}

std::optional<Vec3> seam_of(const TriangleMesh& mesh, const Plane& plane) {
  const double near = same_place * mesh_diagonal(mesh);
  for (int t = 0; t < mesh.size(); ++t) {
    if (!face_alike(mesh.frame(t).normal, plane.normal, !mesh.closed())) continue;
    for (int i = 0; i < 3; ++i)
      if (std::abs(dot(mesh.corner(t, i) - plane.point, plane.normal)) < near) return mesh.corner(t, i);
  }
  return std::nullopt;
}

/// A vertex of `mesh` on `other`.
std::optional<Vec3> seam_of(const TriangleMesh& mesh, const TriangleMesh& other) {
  const double near = same_place * std::max(mesh_diagonal(mesh), mesh_diagonal(other));
  const bool both_sheets = !mesh.closed() && !other.closed();
  if (!boxes_meet(mesh.bounds(), other.bounds(), near)) return std::nullopt;
  const TriangleGrid grid(other, mesh_diagonal(other) / 20);
  for (int t = 0; t < mesh.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const Vec3& vertex = mesh.corner(t, i);
      if (!lies_in(other.bounds(), vertex, near)) continue;
      ClosestPoint closest;
      for (const int of_other : grid.around(vertex))
        if (face_alike(mesh.frame(t).normal, other.frame(of_other).normal, both_sheets) &&
            closest_within(other, of_other, vertex, near, closest))
          return vertex;
    }
  return std::nullopt;
}

std::optional<Vec3> seam_of(const Surface& a, const Surface& b) {
  const auto *plane_a = std::get_if<Plane>(&a.shape), *plane_b = std::get_if<Plane>(&b.shape);
  if (plane_a && plane_b) return seam_of(*plane_a, *plane_b);
  if (plane_a || plane_b)
    return seam_of(*std::get<MeshSurface>(plane_a ? b.shape : a.shape).mesh, plane_a ? *plane_a : *plane_b);
  const TriangleMesh &mesh_a = *std::get<MeshSurface>(a.shape).mesh, &mesh_b = *std::get<MeshSurface>(b.shape).mesh;
  const std::optional<Vec3> one_way = seam_of(mesh_a, mesh_b);
  return one_way ? one_way : seam_of(mesh_b, mesh_a);
}

}  // namespace

void check_seams(const Body& body) {
  for (std::size_t a = 0; a < body.surfaces.size(); ++a)
    for (std::size_t b = a + 1; b < body.surfaces.size(); ++b)
      if (const auto at = seam_of(body.surfaces[a], body.surfaces[b]))
        throw InputError(fmt::format(
            "body {}: its surfaces {} and {} meet in one plane at ({:.4g}, {:.4g}, {:.4g}) m, where a grain would be "
            "pressed by both\n  hint: make them one mesh; vertices in the same place are welded",
            body.name, a + 1, b + 1, at->x, at->y, at->z));
}

}  // namespace soilbin::dem
