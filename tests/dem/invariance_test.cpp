// Turn or mirror a whole world, or watch it from a train: the trajectories turn along.
#include <gtest/gtest.h>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

/// A rotation, after the change of the sign of x where `mirrored`.
struct Change {
  Rotation turn;
  bool mirrored = false;

  Vec3 of(Vec3 arrow) const {
    if (mirrored) arrow.x = -arrow.x;
    return turn(arrow);
  }
  /// Spins and torques turn the other way round in a mirror.
  Vec3 of_spin(const Vec3& spin) const { return mirrored ? -of(spin) : of(spin); }
};

TriangleMesh changed(const TriangleMesh& mesh, const Change& change) {
  std::vector<Vec3> vertices = mesh.vertices();
  std::vector<TriangleMesh::Corners> triangles = mesh.triangles();
  for (Vec3& v : vertices) v = change.of(v);
  if (change.mirrored)
    for (auto& corners : triangles) std::swap(corners[1], corners[2]);
  return {vertices, triangles, {.closed = mesh.closed()}};
}

/// Grains thrown about in a box of planes round a stirring cuboid of triangles, all of it changed, and moving at
/// `wind`.
Simulation world(const ContactLaws& laws, const Change& change, const Vec3& wind = {}) {
  Setup setup = test::soft_stone(laws);
  setup.numerics.dt = 2e-5;
  Simulation simulation(setup);
  simulation.set_gravity(change.of({1, 2, -9}));
  Body walls = test::box_of_planes({-0.015, -0.015, -0.015}, {0.08, 0.08, 0.08});
  for (Surface& surface : walls.surfaces) {
    Plane& plane = std::get<Plane>(surface.shape);
    plane = {change.of(plane.point), change.of(plane.normal)};
  }
  walls.velocity = wind;
  simulation.add_body(walls);
  TriangleMesh cuboid = changed(box({0.04, 0.038, 0.034}, 0.01), change);
  Body stirrer = test::mesh_body(std::move(cuboid));
  stirrer.position = change.of({0.033, 0.033, 0.033});
  stirrer.velocity = change.of({0.1, 0.2, -0.2}) + wind;
  stirrer.spin = change.of_spin({3, 2, 1});
  simulation.add_body(stirrer);
  for (const test::Grain& grain : test::cloud(64, 4, 1))
    if (length(grain.position - Vec3{0.033, 0.033, 0.033}) > 0.034)
      simulation.add_grain(change.of(grain.position), grain.radius, 0, change.of(grain.velocity) + wind,
                           change.of_spin(grain.spin));
  return simulation;
}

/// Largest difference of velocities [m/s] and spins [rad/s, over 100], after a while.
double difference(const ContactLaws& laws, const Change& change, const Vec3& wind) {
  Simulation plain = world(laws, {}), other = world(laws, change, wind);
  plain.run(500);
  other.run(500);
  EXPECT_GT(plain.contacts().size(), 5u);
  EXPECT_EQ(plain.contacts().size(), other.contacts().size());
  EXPECT_NE(plain.body(1).work, 0) << "the stirrer touches nothing";
  double worst = length(change.of(plain.body(1).force) - other.body(1).force);
  for (GrainId id = 0; id < plain.state().grains.count(); ++id) {
    const GrainNow a = plain.grain(id), b = other.grain(id);
    worst = std::max(worst, length(change.of(a.velocity) + wind - b.velocity));
    worst = std::max(worst, length(change.of_spin(a.spin) - b.spin) / 100);
    worst = std::max(worst, length(change.of(a.position) + other.time() * wind - b.position));
  }
  return worst;
}

TEST(SlowInvariance, OfARotationUnderEachLaw) {
  const Change change{rotation_by({0.4, 1.1, -0.7})};
  for (const ContactLaws& laws : test::all_laws()) EXPECT_LT(difference(laws, change, {}), 1e-9) << test::name_of(laws);
}

TEST(SlowInvariance, OfAReflectionUnderEachLaw) {
  const Change change{rotation_by({-0.2, 0.5, 2}), true};
  for (const ContactLaws& laws : test::all_laws()) EXPECT_LT(difference(laws, change, {}), 1e-9) << test::name_of(laws);
}

TEST(Invariance, OfAQuarterTurnAndAPlainMirror) {
  const Vec3 quarter{0, 0, 1.5707963267948966};
  EXPECT_LT(difference({}, {rotation_by(quarter)}, {}), 1e-9);
  EXPECT_LT(difference({}, {{}, true}, {}), 1e-9);
}

TEST(SlowInvariance, OfAMovingFrameUnderEachLaw) {
  for (const ContactLaws& laws : test::all_laws())
    EXPECT_LT(difference(laws, {}, {3, -2, 1}), 1e-9) << test::name_of(laws);
}

}  // namespace
}  // namespace soilbin::dem
