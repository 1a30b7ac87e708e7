#include "resistive_force/tread_elements.hpp"

#include <cmath>
#include <numbers>

#include "dem/surface/shapes.hpp"

namespace soilbin::resistive_force {
namespace {

/// Radii that differ by less than this share are one: what a polygon leaves of its circle, twice over.
constexpr double beyond_tread = 0.005;
/// A side's normal is nearer to the axle than this: cos 26 deg.
constexpr double to_the_side = 0.9;

/// Sides look along the axle, the tread base outward and lies on its radius; all else are lugs.
WheelPart part_of(const Vec3& place, const Vec3& normal, const Tire& tire) {
  const double radius = std::hypot(place.x, place.z);
  if (std::abs(normal.y) > to_the_side && std::abs(place.y) > 0.49 * tire.width) return WheelPart::sides;
  const bool outward = place.x * normal.x + place.z * normal.z > to_the_side * radius;
  return outward && radius < tire.radius * (1 + beyond_tread) ? WheelPart::tread : WheelPart::lugs;
}

/// The tread base's normal: a triangle's own leans by its place in its flat, which a spinning wheel would push with.
Vec3 radial(const Vec3& place) { return dem::unit({place.x, 0, place.z}); }

std::vector<Element> elements_of(const dem::TriangleMesh& mesh, const Tire& tire) {
  std::vector<Element> all;
  all.reserve(static_cast<std::size_t>(mesh.size()));
  for (int t = 0; t < mesh.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const Vec3 place = (a + b + c) / 3.0, normal = mesh.frame(t).normal;
    const WheelPart part = part_of(place, normal, tire);
    const double area = 0.5 * length(cross(b - a, c - a));
    all.push_back({place, part == WheelPart::tread ? radial(place) : normal, area, part});
  }
  return all;
}

/// Triangles of a cell are no mirror images, a tire's two halves are: those to the left and their images.
std::vector<Element> mirrored(const std::vector<Element>& all, const Tire& tire) {
  const double middle = 1e-9 * tire.width;
  std::vector<Element> both;
  both.reserve(all.size());
  for (const Element& e : all) {
    if (e.place.y < -middle) continue;
    both.push_back(e);
    if (e.place.y <= middle) continue;
    Element image = e;
    image.place.y = -e.place.y, image.normal.y = -e.normal.y;
    both.push_back(image);
  }
  return both;
}

bool has_alike_halves(const Tire& tire) {
  return !is_lugged(tire) || tire.lugs.pattern == LugPattern::straight || tire.lugs.pattern == LugPattern::chevron;
}

double pitch_of(const Tire& tire) {
  if (!is_lugged(tire)) return 0.0;
  return 2 * std::numbers::pi / tire.lugs.count.value_or(1);
}

}  // namespace

TreadElements tread_elements(const Tire& tire, double finer) {
  const dem::TireMeshing meshing{.edge = finer * edge_per_radius * tire.radius};
  std::vector<Element> all = elements_of(dem::tire_surface(tire, meshing), tire);
  return {has_alike_halves(tire) ? mirrored(all, tire) : all, pitch_of(tire)};
}

}  // namespace soilbin::resistive_force
