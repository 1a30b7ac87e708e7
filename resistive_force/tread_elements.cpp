#include "resistive_force/tread_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "dem/surface/drawn_wheel.hpp"
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

/// Elements of a triangle, halved across its longest edge until that is at most `edge`.
void add_elements(std::vector<Element>& all, std::array<Vec3, 3> corners, const Vec3& normal, const Tire& tire,
                  double edge) {
  const auto length_of = [&](int i) { return length(corners[(i + 1) % 3] - corners[i]); };
  const int longest =
      length_of(0) >= length_of(1) ? (length_of(0) >= length_of(2) ? 0 : 2) : (length_of(1) >= length_of(2) ? 1 : 2);
  std::ranges::rotate(corners, corners.begin() + longest);
  const auto& [a, b, c] = corners;
  if (length(b - a) > edge) {
    const Vec3 middle = 0.5 * (a + b);
    add_elements(all, {a, middle, c}, normal, tire, edge);
    add_elements(all, {middle, b, c}, normal, tire, edge);
    return;
  }
  const Vec3 place = (a + b + c) / 3.0;
  const WheelPart part = part_of(place, normal, tire);
  const double area = 0.5 * length(cross(b - a, c - a));
  all.push_back({place, part == WheelPart::tread ? radial(place) : normal, area, part});
}

std::vector<Element> elements_of(const dem::TriangleMesh& mesh, const Tire& tire, double edge = dem::any_edge) {
  std::vector<Element> all;
  all.reserve(static_cast<std::size_t>(mesh.size()));
  for (int t = 0; t < mesh.size(); ++t)
    add_elements(all, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, mesh.frame(t).normal, tire, edge);
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

constexpr double whole_turn = 2 * std::numbers::pi;
/// Positions over which forces are averaged: of one pitch, and of a whole turn where the lugs are not counted.
constexpr int turns_of_a_pitch = 8, turns_of_the_whole = 96;

}  // namespace

TreadElements tread_elements(const Tire& tire, double finer) {
  const dem::TireMeshing meshing{.edge = finer * edge_per_radius * tire.radius};
  std::vector<Element> all = elements_of(dem::tire_surface(tire, meshing), tire);
  if (has_alike_halves(tire)) all = mirrored(all, tire);
  if (!is_lugged(tire)) return {std::move(all)};
  return {std::move(all), whole_turn / tire.lugs.count.value_or(1), turns_of_a_pitch};
}

TreadElements drawn_elements(const std::string& file, const Tire& tire) {
  std::vector<Element> all = elements_of(dem::read_wheel(file, tire).mesh, tire, edge_per_radius * tire.radius);
  if (tire.lugs.count.value_or(0) > 0)
    return {std::move(all), whole_turn / tire.lugs.count.value_or(1), turns_of_a_pitch};
  return {std::move(all), whole_turn, turns_of_the_whole};
}

}  // namespace soilbin::resistive_force
