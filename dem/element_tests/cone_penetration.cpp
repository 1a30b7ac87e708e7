#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "dem/element_tests/tool_bed.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

constexpr double half_angle = pi / 12;  ///< between the cone's side and its axis
constexpr double shaft_share = 0.5;     ///< diameter of the shaft over that of the cone's base

/// Height of a cone over the diameter of its base.
double slenderness() { return 0.5 / std::tan(half_angle); }

void check(const ConeSettings& s) {
  const Requirements require("cone penetration");
  require(s.diameter >= narrowest_tool,
          fmt::format("a cone of {:.3g} grains is too narrow: at least {:.3g}", s.diameter, narrowest_tool));
  require(s.depth > 0 && s.speed >= 1e-6 && s.speed <= 1, "depth above 0, speed in 1e-6 .. 1");
  require(s.friction >= 0 && s.friction <= 1, "friction in 0 .. 1");
  require(s.samples >= 10, "at least 10 samples");
  require(s.bed.depth >= s.depth + slenderness() + 0.5,
          fmt::format("a bed of {:.3g} diameters of the cone is too shallow: its tip goes down to {:.3g}", s.bed.depth,
                      s.depth + slenderness()));
}

/// The cone with its tip in the origin and its axis upright, and `length` [m] of its shaft above it: closed.
TriangleMesh cone_on_shaft(double diameter, double length) {
  constexpr int around = 48;
  const double height = slenderness() * diameter;
  const std::array<std::pair<double, double>, 3> rings = {
      {{diameter / 2, height}, {shaft_share * diameter / 2, height}, {shaft_share * diameter / 2, height + length}}};
  std::vector<Vec3> vertices{{0, 0, 0}};
  for (const auto& [radius, z] : rings)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around;
      vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  const int tip = 0, top = static_cast<int>(vertices.size());
  vertices.push_back({0, 0, height + length});
  const auto at = [](int ring, int k) { return 1 + ring * around + k % around; };
  std::vector<TriangleMesh::Corners> triangles;
  for (int k = 0; k < around; ++k) {
    triangles.push_back({tip, at(0, k + 1), at(0, k)});
    for (int ring = 0; ring + 1 < static_cast<int>(rings.size()); ++ring) {
      triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
      triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
    }
    triangles.push_back(
        {at(static_cast<int>(rings.size()) - 1, k), at(static_cast<int>(rings.size()) - 1, k + 1), top});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles), {.closed = true});
}

}  // namespace

ConeRun cone_penetration(const GranularSoil& soil, const ConeSettings& settings, const WorkOptions& how,
                         BedStore* beds) {
  check(settings);
  const double d = mean_diameter(soil), diameter = settings.diameter * d, height = slenderness() * diameter;
  const auto bed = bed_for_tool(soil, settings.bed, diameter, how, beds);
  const double middle = bed->recipe.size.length / 2, start = highest_within(*bed, d), surface = surface_of(*bed);
  Body cone;
  cone.name = "cone";
  cone.surfaces.push_back({surface_at(cone_on_shaft(diameter, settings.depth * diameter + 4 * d), {}), 1});
  cone.position = {middle, middle, start};
  const Pressing pressing{.tool = std::move(cone),
                          .base = height,
                          .diameter = diameter,
                          .surface = surface,
                          .way = start - surface + height + settings.depth * diameter,
                          .speed = settings.speed * std::sqrt(bed->recipe.gravity * d),
                          .samples = settings.samples};
  SteppedWork work(how);
  work.expect(pressing.way / (pressing.speed * bed->setup.numerics.dt));
  ConeRun run{press(*bed, simulation_on(*bed, how, settings.friction), pressing, work)};
  std::vector<PlateSample>& curve = run.pressed.curve;
  std::erase_if(curve, [](const PlateSample& sample) { return sample.sinkage < 0; });
  const double samples = static_cast<double>(curve.size());
  double depth = 0, moment = 0, square = 0;
  for (const PlateSample& sample : curve) run.index += sample.pressure / samples, depth += sample.sinkage / samples;
  for (const PlateSample& sample : curve) {
    const double below = sample.sinkage - depth;
    moment += below * sample.pressure, square += below * below;
  }
  run.gradient = moment / square;
  return run;
}

}  // namespace soilbin::dem
