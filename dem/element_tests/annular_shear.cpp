#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/element_tests/tool_bed.hpp"
#include "dem/surface/shapes.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

void check(const AnnulusSettings& s) {
  const Requirements require("annular shear");
  require(s.inner > 0 && s.outer - s.inner >= narrowest_tool,
          fmt::format("the ring must be at least {:.3g} grains wide", narrowest_tool));
  require(s.grousers >= 3 && s.grouser_height > 0 && s.grouser_width > 0, "3 grousers or more, of sizes above 0");
  require(!s.stresses.empty() && *std::min_element(s.stresses.begin(), s.stresses.end()) > 0,
          "normal stresses must be above 0");
  require(s.travel > 0 && s.speed >= 1e-6 && s.speed <= 1 && s.samples >= 20,
          "travel, speed and samples are too small");
}

/// A closed ring about z, its underside in z = 0.
TriangleMesh ring(double inner, double outer, double thick, int segments) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * pi * k / segments, x = std::cos(angle), y = std::sin(angle);
    vertices.push_back({outer * x, outer * y, 0});
    vertices.push_back({outer * x, outer * y, thick});
    vertices.push_back({inner * x, inner * y, thick});
    vertices.push_back({inner * x, inner * y, 0});
  }
  // Round the section, outside first: side, top, hole, underside.
  for (int k = 0; k < segments; ++k)
    for (int i = 0; i < 4; ++i) {
      const int here = 4 * k, next = 4 * ((k + 1) % segments), j = (i + 1) % 4;
      triangles.push_back({here + i, next + i, next + j});
      triangles.push_back({here + i, next + j, here + j});
    }
  MeshOptions options;
  options.closed = true;
  options.name = "ring";
  return {std::move(vertices), std::move(triangles), options};
}

/// A radial bar under the ring's underside.
MeshSurface grouser(const AnnulusSettings& s, double d, double angle) {
  // Shorter than the ring is wide: the corners of a straight bar stay under it.
  const double length = (s.outer - s.inner) * d * 0.98, middle = (s.outer + s.inner) / 2 * d;
  const TriangleMesh bar = box({length, s.grouser_width * d, s.grouser_height * d});
  const Rotation turn = rotation_by({0, 0, angle});
  return surface_of(bar, [&](const Vec3& vertex) { return turn(vertex + Vec3{middle, 0, -s.grouser_height * d / 2}); });
}

AnnulusRun turn_ring(const SettledBed& bed, double stress, const AnnulusSettings& s, const WorkOptions& how,
                     SteppedWork& work) {
  const double d = mean_diameter(bed.recipe.soil), inner = s.inner * d, outer = s.outer * d;
  const double middle = bed.recipe.size.length / 2, mean_radius = (inner + outer) / 2;
  Simulation simulation = simulation_on(bed, how);
  const double dt = simulation.setup().numerics.dt, area = pi * (outer * outer - inner * inner);
  Body body;
  body.name = "ring";
  body.surfaces.push_back({surface_at(ring(inner, outer, 6 * d, 64), {}), 1});
  for (int k = 0; k < s.grousers; ++k) body.surfaces.push_back({grouser(s, d, 2 * pi * k / s.grousers), 1});
  body.position = {middle, middle, highest_within(bed, outer) + s.grouser_height * d};
  body.servo = press({0, 0, 1}, stress, area, bed.recipe.soil, dt);
  const int index = simulation.add_body(body);
  work.begin("pressing");
  work.settle_wall(simulation, index, bed.recipe.size.depth);

  AnnulusRun run;
  run.stress = stress, run.speed = s.speed * std::sqrt(bed.recipe.gravity * d);
  run.packing = bed.recipe.packing;
  simulation.body(index).spin = {0, 0, run.speed / mean_radius};
  const double rest = simulation.body(index).position.z;
  const auto steps = steps_of_sample(s.travel * d, run.speed * dt, s.samples);
  work.begin("turning");
  for (int k = 0; k < s.samples; ++k) {
    AnnulusSample sample;
    const double before = simulation.body(index).position.z;
    double moment = 0, force = 0;
    for (std::int64_t i = 0; i < steps; ++i) {
      work.step(simulation);
      moment -= simulation.body(index).torque.z / static_cast<double>(steps);
      force += simulation.body(index).force.z / static_cast<double>(steps);
    }
    sample.displacement = (k + 0.5) * static_cast<double>(steps) * dt * run.speed;
    sample.shear_stress = 3 * moment / (2 * pi * (outer * outer * outer - inner * inner * inner));
    sample.normal_stress = force / area;
    sample.sinkage = rest - (before + simulation.body(index).position.z) / 2;
    run.curve.push_back(sample);
  }
  return run;
}

}  // namespace

std::vector<AnnulusRun> annular_shear(const GranularSoil& soil, const AnnulusSettings& settings, const WorkOptions& how,
                                      BedStore* beds) {
  check(settings);
  const double d = mean_diameter(soil);
  const auto bed = bed_for_tool(soil, settings.bed, 2 * settings.outer * d, how, beds);
  const double speed = settings.speed * std::sqrt(bed->recipe.gravity * d);
  SteppedWork work(how);
  const double dt = bed->setup.numerics.dt;
  work.expect(static_cast<double>(settings.stresses.size()) * (settings.travel * d / (speed * dt) + 0.5 / dt));
  std::vector<AnnulusRun> runs;
  for (const double stress : settings.stresses) runs.push_back(turn_ring(*bed, stress, settings, how, work));
  return runs;
}

}  // namespace soilbin::dem
