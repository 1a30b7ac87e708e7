#include "dem/bed/grain_shape.hpp"

#include <cmath>
#include <numbers>

#include "dem/bed/settled_bed.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// Corners of a rod, an equilateral triangle, a regular tetrahedron, 1 apart.
std::vector<Vec3> corners_of(GrainShape shape) {
  const double low = std::sqrt(1.0 / 12), high = std::sqrt(2.0 / 3);
  const std::vector<Vec3> all{{-0.5, -low, 0}, {0.5, -low, 0}, {0, 2 * low, 0}, {0, 0, high}};
  switch (shape) {
    case GrainShape::sphere:
      return {{}};
    case GrainShape::two_spheres:
      return {all.begin(), all.begin() + 2};
    case GrainShape::three_spheres:
      return {all.begin(), all.begin() + 3};
    case GrainShape::four_spheres:
      return all;
  }
  return {{}};
}

/// A turn that is as likely as any other (Shoemake 1992).
Rotation random_rotation(Random& random) {
  const double u = random.uniform(0, 1), a = random.uniform(0, 2 * std::numbers::pi);
  const double b = random.uniform(0, 2 * std::numbers::pi);
  return {std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
          std::sqrt(u) * std::sin(b)};
}

GrainProportions measured_against_spheres(const std::optional<ClumpShape>& shape) {
  if (!shape) return {};
  const double sphere = shape->spheres.front().radius;
  const double of_spheres = static_cast<double>(shape->spheres.size()) * std::pow(sphere, 3);
  return {.ball = shape->reach(), .sphere = sphere, .solid = 1 / of_spheres};
}

}  // namespace

std::optional<ClumpShape> shape_of(const GranularSoil& soil) {
  if (soil.shape == GrainShape::sphere) return std::nullopt;
  if (!(soil.sphere_spacing >= 0.1 && soil.sphere_spacing <= 2))
    throw InputError("sphere_spacing must lie in 0.1 .. 2 radii: farther apart, the spheres of a grain don't touch");
  std::vector<Sphere> spheres;
  for (const Vec3& corner : corners_of(soil.shape)) spheres.push_back({soil.sphere_spacing * corner, 1});
  const ClumpShape shape = clump_shape(std::move(spheres));
  return shape.scaled(std::cbrt(sphere_volume(1) / shape.volume));
}

GrainProportions proportions_of(const GranularSoil& soil) { return measured_against_spheres(shape_of(soil)); }

GrainMaker::GrainMaker(const GranularSoil& soil, std::uint64_t seed)
    : radii_{soil.radius_min, soil.radius_max, soil.sizes.size() > 1 ? soil.sizes : std::vector<GrainFraction>()},
      shape_(shape_of(soil)),
      proportions_(measured_against_spheres(shape_)),
      random_(seed ^ 0x74726e73) {}  // a sequence of its own: places and radii are those of spheres

RadiusRange GrainMaker::balls() const {
  RadiusRange balls{proportions_.ball * radii_.smallest, proportions_.ball * radii_.largest, radii_.fractions};
  for (GrainFraction& fraction : balls.fractions) fraction.radius *= proportions_.ball;
  return balls;
}

void GrainMaker::put(Simulation& simulation, const Vec3& centre, double ball) {
  if (!shape_) {
    simulation.add_grain(centre, ball, grain_material);
    return;
  }
  simulation.add_clump(shape_->scaled(ball / proportions_.ball),
                       {.position = centre, .rotation = random_rotation(random_)}, grain_material);
}

}  // namespace soilbin::dem
