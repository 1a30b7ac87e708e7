// Ridges, tips, corners and insides of bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/plates_of_triangles.hpp"
#include "dem/surface/touching_points.hpp"

namespace soilbin::dem {
namespace {

using tests::Soup;
using tests::touch;
using tests::uniform;

using std::numbers::pi;

TriangleMesh mesh_of(const Soup& soup, bool closed) { return {soup.vertices, soup.triangles, {.closed = closed}}; }

/// Two half planes that meet in the y axis, rising at `slope` on both sides (negative: a ridge), cut into n cells along
/// y.
Soup dihedral(double slope, int n) {
  Soup soup;
  for (int j = 0; j <= n; ++j) {
    for (const double x : {-1.0, 0.0, 1.0})
      soup.vertices.push_back({x, -1 + 2.0 * j / n, std::abs(x) * std::tan(slope)});
  }
  for (int j = 0; j < n; ++j) {
    for (const int i : {0, 1}) {
      const int a = 3 * j + i;
      soup.triangles.push_back({a, a + 1, a + 4}), soup.triangles.push_back({a, a + 4, a + 3});
    }
  }
  return soup;
}

/// Three faces of the cube [0, 2]^3 that meet in the origin, seen from inside: a concave corner.
Soup corner() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}},
          {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}, {0, 3, 6}, {0, 6, 4}}};
}

/// The closest point of the cube [-1, 1]^3 to a point outside.
Vec3 foot_on_cube(const Vec3& c) {
  return {std::clamp(c.x, -1.0, 1.0), std::clamp(c.y, -1.0, 1.0), std::clamp(c.z, -1.0, 1.0)};
}

// A convex body has one closest point; outside faces, edges and vertices alike, in any position.
TEST(TouchingBodies, TheOutsideOfABoxHasOnePointEverywhere) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20; ++round) {
    const Rotation turn = round ? tests::any_rotation(random) : Rotation{};
    const TriangleMesh mesh = mesh_of(tests::moved(tests::cube(), turn, {}), true);
    for (int i = 0; i < 500; ++i) {
      const auto part = [&] { return random() % 4 ? uniform(random, -1.5, 1.5) : random() % 2 ? 1.0 : -1.0; };
      const Vec3 c{part(), part(), part()};
      const Vec3 foot = foot_on_cube(c);
      const double distance = length(c - foot);
      if (distance < 1e-3) continue;
      const TouchingPoints points = touch(mesh, turn(c), 0.9);
      ASSERT_EQ(points.count, 1);
      EXPECT_NEAR(points[0].distance, distance, 1e-12);
      EXPECT_NEAR(length(points[0].point - turn(foot)), 0, 1e-12);
      EXPECT_NEAR(length(points[0].normal - turn((c - foot) / distance)), 0, 1e-11);
    }
  }
}

// A walk at a constant depth round an edge and over a tip: the normal turns by no more than the path allows,
// 1/distance.
TEST(TouchingBodies, TheNormalTurnsContinuouslyOverARidgeAndATip) {
  std::mt19937_64 random(2);
  const TriangleMesh mesh = mesh_of(tests::cube(), true);
  int steps = 0;
  for (int round = 0; round < 50; ++round) {
    const Vec3 about = round % 2 ? Vec3{1, 1, 1} : Vec3{1, uniform(random, -0.8, 0.8), 1};
    const Vec3 u = tests::any_direction(random), v = unit(cross(u, tests::any_direction(random)));
    TouchingPoint last;
    for (int i = 0; i <= 5000; ++i) {
      const double angle = 2 * pi * i / 5000;
      const Vec3 c = about + 0.3 * std::cos(angle) * u + 0.3 * std::sin(angle) * v;
      const TouchingPoints points = touch(mesh, c, 0.5);
      if (points.count == 0 || points[0].distance < 0.03) {
        last.triangle = -1;
        continue;
      }
      ASSERT_EQ(points.count, 1);
      const double path = 0.3 * 2 * pi / 5000;
      if (last.triangle >= 0) {
        ++steps;
        EXPECT_LE(length(points[0].normal - last.normal), 1.01 * path / points[0].distance);
        EXPECT_LE(std::abs(points[0].distance - last.distance), 1.01 * path);
      }
      last = points[0];
    }
  }
  EXPECT_GT(steps, 50 * 1000);
}

TEST(TouchingBodies, AConcaveEdgeHasTwoPointsAndAConcaveCornerThree) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 200; ++round) {
    const Rotation turn = round ? tests::any_rotation(random) : Rotation{};
    const TriangleMesh mesh = mesh_of(tests::moved(corner(), turn, {}), false);
    const Vec3 c{uniform(random, 0.1, 0.29), uniform(random, 0.1, 0.29), uniform(random, 0.1, 0.29)};
    const TouchingPoints three = touch(mesh, turn(c), 0.3);
    ASSERT_EQ(three.count, 3);
    std::vector<double> heights{c.x, c.y, c.z};
    std::sort(heights.begin(), heights.end());
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(three[i].distance, heights[i], 1e-12);  // deepest first
    Vec3 sum;
    for (const TouchingPoint& point : three) sum += point.distance * point.normal;
    EXPECT_NEAR(length(sum - turn(c)), 0, 1e-12);

    const TouchingPoints two = touch(mesh, turn({c.x, c.y, 1}), 0.3);
    ASSERT_EQ(two.count, 2);
    EXPECT_NEAR(two[0].distance, std::min(c.x, c.y), 1e-12);
    EXPECT_NEAR(two[1].distance, std::max(c.x, c.y), 1e-12);
    EXPECT_EQ(touch(mesh, turn({c.x, 1, 1}), 0.3).count, 1);
  }
}

// A valley of two planes rising at s has normals 2 s apart: one point up to the merge angle, two beyond. A ridge has
// one.
TEST(TouchingBodies, AShallowValleyIsOneContactASteepOneTwo) {
  for (const int n : {1, 2, 9}) {
    for (const double slope : {0.001, 0.05, 0.099, 0.101, 0.3, 0.7}) {
      const TriangleMesh valley = mesh_of(dihedral(slope, n), false), ridge = mesh_of(dihedral(-slope, n), false);
      for (const double y : {0.0, 0.123, -0.5}) {
        const Vec3 c{0.1 * slope, y, 0.3};  // so near the middle that both feet are on their planes
        const TouchingPoints points = touch(valley, c, 0.35);
        const double deepest = (c.z - c.x * std::tan(slope)) * std::cos(slope);
        EXPECT_EQ(points.count, slope > 0.1 ? 2 : 1) << slope;
        if (slope > 0.1) {
          EXPECT_NEAR(points[0].distance, deepest, 1e-12);
        }
        EXPECT_NEAR(points[0].distance, deepest, (1 - std::cos(slope)) * deepest + 1e-12);  // the fillet
        EXPECT_EQ(touch(valley, c, 0.35, 0).count, 2);
        EXPECT_EQ(touch(valley, c, 0.35, 1.5).count, 1);
        EXPECT_EQ(touch(ridge, c, 0.35, 0).count, 1);
      }
    }
  }
}

// Across the bottom of a shallow valley the normal goes from one plane's to the other's, and stands upright between.
// It begins to turn where the foot on the other plane is on the edge: x = -+d sin(slope), at the distance d.
TEST(TouchingBodies, OverAShallowValleyTheNormalTurnsAndDoesNotJump) {
  const double slope = 0.05, height = 0.3;
  for (const double radius : {0.35, 0.3005}) {  // there the other plane ends at its edge, and at its depth
    const TriangleMesh valley = mesh_of(dihedral(slope, 2), false);
    EXPECT_NEAR(length(touch(valley, {0, 0.1, height}, radius)[0].normal - Vec3{0, 0, 1}), 0, 1e-12);
    const double d = height / std::cos(slope), reach = 1.1 * d * std::sin(slope);
    const int steps = 4000;
    Vec3 before{std::sin(slope), 0, std::cos(slope)};
    for (int k = 0; k <= steps; ++k) {
      const Vec3 c{reach * (2.0 * k / steps - 1), 0.1, height};
      const TouchingPoints points = touch(valley, c, radius);
      ASSERT_EQ(points.count, 1);
      EXPECT_LT(length(points[0].normal - before), 20 * slope / steps) << c.x;
      EXPECT_NEAR(length(points[0].point + points[0].distance * points[0].normal - c), 0, 1e-12);
      before = points[0].normal;
    }
    EXPECT_NEAR(length(before - Vec3{-std::sin(slope), 0, std::cos(slope)}), 0, 1e-12);
  }
}

/// A trough: the lower half of a cylinder of radius 1 about y, n facets, seen from inside.
Soup trough(int n) {
  Soup soup;
  for (int i = 0; i <= n; ++i) {
    const double angle = -pi / 2 + pi * i / n;
    for (const double y : {-1.0, 1.0}) soup.vertices.push_back({std::sin(angle), y, -std::cos(angle)});
  }
  for (int i = 0; i < n; ++i) {
    soup.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3}), soup.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return soup;
}

TEST(TouchingBodies, AFinelyCutTroughIsOneContact) {
  for (const int n : {33, 64, 150}) {
    const TriangleMesh mesh = mesh_of(trough(n), false);
    for (double angle = -1; angle <= 1; angle += 0.01) {
      for (const double from_axis : {0.3, 0.6, 0.9}) {
        const Vec3 c{from_axis * std::sin(angle), 0.1, -from_axis * std::cos(angle)};
        const TouchingPoints points = touch(mesh, c, 1.05 - from_axis);
        ASSERT_EQ(points.count, 1) << n << " " << angle << " " << from_axis;
        const double rise = 1 - std::cos(pi / n / 2);  // of the facets, and of the fillets between them
        EXPECT_NEAR(points[0].distance, 1 - from_axis, rise + 4 * rise * (1 - from_axis) + 1e-12);
      }
    }
  }
}

TEST(TouchingBodies, TheInsideIsPushedOutTheNearestWay) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 300; ++round) {
    const Rotation turn = tests::any_rotation(random);
    const TriangleMesh mesh = mesh_of(tests::moved(tests::cube(), turn, {}), true);
    const Vec3 c{uniform(random, -0.9, 0.9), uniform(random, -0.9, 0.9), uniform(random, 0.91, 0.999)};
    const TouchingPoints points = touch(mesh, turn(c), 0.5);
    ASSERT_EQ(points.count, 1);
    EXPECT_NEAR(points[0].distance, c.z - 1, 1e-12);
    EXPECT_NEAR(length(points[0].normal - turn({0, 0, 1})), 0, 1e-12);
    EXPECT_NEAR(length(points[0].point - turn({c.x, c.y, 1})), 0, 1e-12);
    EXPECT_NEAR(points[0].overlap(0.5), 0.5 + 1 - c.z, 1e-12);
    EXPECT_EQ(touch(mesh, {0, 0, 0}, 0.5).count, 0);  // deeper than the radius: not noticed
  }
}

// Down through a face, over its middle, over a cut and over a vertex of the cut: overlap and normal go on.
TEST(TouchingBodies, GoingInThroughAFaceIsContinuous) {
  const TriangleMesh mesh = mesh_of(tests::cube(), true);
  for (const Vec3& foot : {Vec3{0.2, 0.1, 1}, Vec3{0.3, 0.3, 1}, Vec3{0, 0, 1}}) {
    for (double height = 0.2; height > -0.2; height -= 0.001) {
      const TouchingPoints points = touch(mesh, foot + Vec3{0, 0, height}, 0.25);
      ASSERT_EQ(points.count, 1);
      EXPECT_NEAR(points[0].distance, height, 1e-12);
      EXPECT_NEAR(length(points[0].normal - Vec3{0, 0, 1}), 0, 1e-9);
    }
    for (const double height : {1e-17, -1e-17, 1e-12, -1e-12, 0.0}) {
      EXPECT_NEAR(touch(mesh, foot + Vec3{0, 0, height}, 0.25)[0].normal.z, 1, 1e-9);
    }
  }
}

// A plate 0.1 thick: its far face is nearer than the radius, but seen through the body.
TEST(TouchingBodies, TheFarFaceOfAThinBodyIsNotTouched) {
  Soup thin = tests::cube();
  for (Vec3& v : thin.vertices) v.z *= 0.05;
  const TriangleMesh mesh = mesh_of(thin, true);
  std::mt19937_64 random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 c{uniform(random, -1.2, 1.2), uniform(random, -1.2, 1.2), uniform(random, 0.06, 0.3)};
    const Vec3 foot{std::clamp(c.x, -1.0, 1.0), std::clamp(c.y, -1.0, 1.0), 0.05};
    const TouchingPoints points = touch(mesh, c, 0.5);
    ASSERT_EQ(points.count, 1);
    EXPECT_NEAR(length(points[0].point - foot), 0, 1e-12);
  }
  EXPECT_NEAR(touch(mesh, {0, 0, 0.01}, 0.5)[0].normal.z, 1, 1e-12);  // inside: out by the nearer face
  EXPECT_EQ(touch(mesh, {0, 0, 0.01}, 0.5).count, 1);
  EXPECT_NEAR(touch(mesh, {0, 0, -0.01}, 0.5)[0].normal.z, -1, 1e-12);
}

// More points than fit: a centre amid the spikes of a cup of n flat facets, all equally far.
TEST(TouchingBodies, TheDeepestAreKeptAndTheRestCounted) {
  Soup soup;
  const int n = 14;  // separate small triangles round a circle, facing inward, each a bit farther than the one before
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n, r = 1 + 0.01 * ((i * 5) % n);
    const Vec3 out{std::cos(angle), std::sin(angle), 0}, along{-std::sin(angle), std::cos(angle), 0};
    const int k = 3 * i;
    soup.vertices.push_back(r * out - 0.1 * along - Vec3{0, 0, 0.1});
    soup.vertices.push_back(r * out + 0.1 * along - Vec3{0, 0, 0.1});
    soup.vertices.push_back(r * out + Vec3{0, 0, 0.1});
    soup.triangles.push_back({k, k + 2, k + 1});
  }
  const TouchingPoints points = touch(mesh_of(soup, false), {}, 2);
  EXPECT_EQ(points.count, 8);
  EXPECT_EQ(points.dropped, 6);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(points[i].distance, 1 + 0.01 * i, 1e-12);
}

// The centre itself on the surface: any normal between those of the faces there is right, as long as it is one.
TEST(TouchingBodies, ACentreOnARidgeIsPushedOut) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 300; ++i) {
    const Rotation turn = i ? tests::any_rotation(random) : Rotation{};
    const TriangleMesh mesh = mesh_of(tests::moved(tests::cube(), turn, {}), true);
    for (const Vec3& on : {Vec3{1, uniform(random, -1, 1), 1}, Vec3{1, 1, 1}}) {
      const TouchingPoints points = touch(mesh, turn(on), 0.3);
      ASSERT_EQ(points.count, 1);
      EXPECT_NEAR(points[0].distance, 0, 1e-15);
      const Vec3 normal = turn.inverse()(points[0].normal);
      EXPECT_NEAR(length(normal), 1, 1e-12);
      EXPECT_GE(std::min({normal.x, normal.y, normal.z}), -1e-12);
    }
  }
}

TEST(MergeAngle, IsFromZeroToARightAngle) {
  EXPECT_THROW(MergeAngle(-0.1), std::invalid_argument);
  EXPECT_THROW(MergeAngle(2), std::invalid_argument);
  EXPECT_THROW(MergeAngle(std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(MergeAngle(pi / 2));
}

}  // namespace
}  // namespace soilbin::dem
