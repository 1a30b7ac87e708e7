// One plane, one touching point: however it is cut into triangles. And every answer against a plainer one.
#include "dem/surface/touching_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/plates_of_triangles.hpp"

namespace soilbin::dem {
namespace {

using tests::Soup;
using tests::touch;
using tests::uniform;

/// The plate [-1, 1]^2 is convex: its one closest point to c is c with each coordinate clamped.
Vec3 foot_on_plate(const Vec3& c) { return {std::clamp(c.x, -1.0, 1.0), std::clamp(c.y, -1.0, 1.0), 0}; }

/// Over faces, over edges and their middles, over vertices, off the border; each at several heights on both sides.
std::vector<Vec3> places_over(const Soup& plate, std::mt19937_64& random) {
  std::vector<Vec3> feet;
  for (const auto& t : plate.triangles) {
    const Vec3 &a = plate.vertices[t[0]], &b = plate.vertices[t[1]], &c = plate.vertices[t[2]];
    const double s = uniform(random, 0, 1);
    for (const Vec3& p : {a, 0.5 * (a + b), s * b + (1 - s) * c, (a + b + c) / 3}) feet.push_back(p);
  }
  for (int i = 0; i < 200; ++i) feet.push_back({uniform(random, -1.2, 1.2), uniform(random, -1.2, 1.2), 0});
  std::vector<Vec3> places;
  for (const Vec3& p : feet) {
    const double height = std::pow(10, uniform(random, -4, -0.5));
    places.push_back(p + Vec3{0, 0, random() % 2 ? height : -height});
  }
  return places;
}

/// `soup` is the plate, turned and shifted.
void expect_one_plane(const Soup& flat, const Rotation& turn, const Vec3& shift, std::mt19937_64& random,
                      double tolerance) {
  const Soup soup = tests::moved(flat, turn, shift);
  const TriangleMesh mesh(soup.vertices, soup.triangles, {.weld = 1e-9});
  for (const Vec3& c : places_over(flat, random)) {
    const Vec3 foot = foot_on_plate(c);
    const double distance = length(c - foot), radius = 0.4;
    const TouchingPoints points = touch(mesh, turn(c) + shift, radius);
    if (distance >= radius) {
      EXPECT_EQ(points.count, 0);
      continue;
    }
    ASSERT_EQ(points.count, 1) << "over " << c.x << " " << c.y << " " << c.z;
    EXPECT_EQ(points.dropped, 0);
    EXPECT_NEAR(points[0].distance, distance, tolerance);
    EXPECT_NEAR(length(points[0].point - (turn(foot) + shift)), 0, tolerance);
    // The normal's error is that of the foot over the distance.
    EXPECT_NEAR(length(points[0].normal - turn((c - foot) / distance)), 0, tolerance * std::max(1.0, 0.01 / distance));
  }
}

TEST(TouchingPoints, APlateIsOnePlaneHoweverItIsCut) {
  std::mt19937_64 random(1);
  for (const Soup& plate : {tests::two_triangles(), tests::fan(0, 0), tests::fan(0.3, -0.999), tests::fan(0.5, 0.5),
                            tests::cells(7, 5), tests::cells(40, 1), tests::cells(16, 16)}) {
    expect_one_plane(plate, {}, {}, random, 1e-12);
    for (int i = 0; i < 5; ++i)
      expect_one_plane(plate, tests::any_rotation(random), tests::any_direction(random), random, 1e-12);
  }
}

TEST(TouchingPoints, APlateOfRandomTrianglesIsOnePlane) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 30; ++i) {
    const Soup plate = tests::random_plate(random, 10 + 5 * i, 1e-2);
    expect_one_plane(plate, {}, {}, random, 1e-12);
    expect_one_plane(plate, tests::any_rotation(random), tests::any_direction(random), random, 1e-12);
  }
}

// A turned sliver's vertices are rounded by 1e-16, so its own plane is off by that over its height.
TEST(TouchingPoints, APlateOfSliversIsOnePlane) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 30; ++i) {
    const Soup plate = tests::random_plate(random, 100, 1e-6);
    expect_one_plane(plate, {}, {}, random, 1e-12);
    expect_one_plane(plate, tests::any_rotation(random), tests::any_direction(random), random, 1e-8);
  }
}

// Just beside an edge or vertex, by less and by more than the slack of the search: never none, never two.
TEST(TouchingPoints, BesideAnEdgeOrAVertexByAHairThereIsOne) {
  std::mt19937_64 random(4);
  const Soup plate = tests::random_plate(random, 40, 1e-3);
  const TriangleMesh mesh(plate.vertices, plate.triangles);
  for (int i = 0; i < 20000; ++i) {
    const auto& t = plate.triangles[random() % plate.triangles.size()];
    const double s = random() % 3 ? uniform(random, 0, 1) : 0;
    Vec3 c = (1 - s) * plate.vertices[t[0]] + s * plate.vertices[t[1]] + Vec3{0, 0, uniform(random, 1e-3, 0.19)};
    const double angle = uniform(random, 0, 7), off = std::pow(10, uniform(random, -17, -5));
    c += off * Vec3{std::cos(angle), std::sin(angle), 0};
    const TouchingPoints points = touch(mesh, c, 0.2, 0);
    ASSERT_EQ(points.count, 1) << "off by " << off;
    ASSERT_NEAR(points[0].distance, length(c - foot_on_plate(c)), 1e-12);
    ASSERT_NEAR(length(points[0].point - foot_on_plate(c)), 0, 1e-9);
  }
}

TEST(TouchingPoints, APointOnSeveralTrianglesBelongsToTheLowest) {
  const Soup soup = tests::fan(0, 0);
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  EXPECT_EQ(touch(mesh, {0, 0, 0.1}, 0.2)[0].triangle, 0);
  EXPECT_EQ(touch(mesh, {0.5, 0.5, 0.1}, 0.2)[0].triangle, 1);    // triangles 1 and 2
  EXPECT_EQ(touch(mesh, {-0.5, -0.5, 0.1}, 0.2)[0].triangle, 0);  // triangles 0 and 3
  EXPECT_EQ(touch(mesh, {-0.5, 0.5, 0.1}, 0.2)[0].triangle, 2);
}

TEST(TouchingPoints, TouchOnlyWhatIsCloserThanTheRadius) {
  const Soup soup = tests::two_triangles();
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  EXPECT_EQ(touch(mesh, {0.2, 0.1, 0.25}, 0.25).count, 0);
  EXPECT_EQ(touch(mesh, {0.2, 0.1, 0.25}, std::nextafter(0.25, 1)).count, 1);
  EXPECT_EQ(touch(mesh, {1.25, 0, 0}, 0.25).count, 0);
  EXPECT_EQ(touch(mesh, {std::nan(""), 0, 0}, 0.25).count, 0);
  EXPECT_DOUBLE_EQ(touch(mesh, {0.2, 0.1, 0.2}, 0.25)[0].overlap(0.25), 0.05);
}

// Two-sided: above the sheet the normal is up, below it is down, the overlap the same.
TEST(TouchingPoints, ASheetHasTwoSides) {
  const Soup soup = tests::fan(0.1, 0.2);
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  for (const Vec3& foot : {Vec3{0.3, 0.1, 0}, Vec3{0.1, 0.2, 0}, Vec3{0.55, 0.6, 0}}) {
    const auto up = touch(mesh, foot + Vec3{0, 0, 0.1}, 0.2), down = touch(mesh, foot - Vec3{0, 0, 0.1}, 0.2);
    EXPECT_NEAR(up[0].normal.z, 1, 1e-12);
    EXPECT_NEAR(down[0].normal.z, -1, 1e-12);
    EXPECT_NEAR(up[0].distance, down[0].distance, 1e-15);
    EXPECT_NEAR(touch(mesh, foot, 0.2)[0].distance, 0, 1e-15);  // in the sheet: the outer side
    EXPECT_NEAR(touch(mesh, foot, 0.2)[0].normal.z, 1, 1e-12);
  }
}

// --- a plainer answer: Ericson's closest point by barycentric regions, and the definition of a minimum word by word

Vec3 ericson(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + (vb / (va + vb + vc)) * ab + (vc / (va + vb + vc)) * ac;
}

/// Closest points of single triangles from which no triangle that has them leads closer.
std::vector<Vec3> plain_minima(const TriangleMesh& mesh, const Vec3& centre, double radius) {
  const auto closest = [&](int t, const Vec3& p) {
    return ericson(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
  };
  std::vector<Vec3> minima;
  for (int t = 0; t < mesh.size(); ++t) {
    const Vec3 p = closest(t, centre);
    if (length(p - centre) >= radius) continue;
    bool minimum = true;
    for (int u = 0; u < mesh.size() && minimum; ++u) {
      minimum = length(closest(u, p) - p) > 1e-10 || length(closest(u, centre) - p) < 1e-9;
    }
    const auto same = [&](const Vec3& q) { return length(p - q) < 1e-8; };
    if (minimum && std::none_of(minima.begin(), minima.end(), same)) minima.push_back(p);
  }
  return minima;
}

/// A rough landscape: a random plate lifted at its vertices.
TEST(TouchingPoints, AreTheMinimaOfThePlainAnswerOverARoughLandscape) {
  std::mt19937_64 random(5);
  int several = 0;
  for (int round = 0; round < 40; ++round) {
    Soup soup = tests::random_plate(random, 30, 3e-2);
    for (Vec3& v : soup.vertices) v.z = uniform(random, -0.2, 0.2);
    const TriangleMesh mesh(soup.vertices, soup.triangles);
    for (int i = 0; i < 100; ++i) {
      const Vec3 c{uniform(random, -1.1, 1.1), uniform(random, -1.1, 1.1), uniform(random, -0.4, 0.4)};
      const std::vector<Vec3> expected = plain_minima(mesh, c, 0.2);
      const TouchingPoints found = touch(mesh, c, 0.2, 0);
      ASSERT_EQ(found.count + found.dropped, static_cast<int>(expected.size()));
      several += found.count > 1;
      for (const TouchingPoint& point : found) {
        const auto same = [&](const Vec3& q) { return length(point.point - q) < 1e-9; };
        EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), same));
        EXPECT_NEAR(length(point.point + point.distance * point.normal - c), 0, 1e-12);
      }
    }
  }
  EXPECT_GT(several, 400);  // the landscape has dales
}

TEST(TouchingPoints, DependOnNoFartherCandidateAndOnNothingInOut) {
  std::mt19937_64 random(6);
  Soup soup = tests::random_plate(random, 60, 3e-2);
  for (Vec3& v : soup.vertices) v.z = uniform(random, -0.1, 0.1);
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  TouchingPoints dirty = touch(mesh, {0, 0, 0.1}, 0.5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 c{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -0.3, 0.3)};
    std::vector<int> few;
    for (int t = 0; t < mesh.size(); ++t) {
      const Vec3 p = ericson(c, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
      if (length(p - c) < 0.2 + 1e-12) few.push_back(t);
    }
    find_touching_points(mesh, few, c, 0.2, MergeAngle(), dirty);
    const TouchingPoints all = touch(mesh, c, 0.2);
    ASSERT_EQ(dirty.count, all.count);
    for (int k = 0; k < all.count; ++k) {
      EXPECT_EQ(dirty[k].point, all[k].point);
      EXPECT_EQ(dirty[k].normal, all[k].normal);
      EXPECT_EQ(dirty[k].distance, all[k].distance);
      EXPECT_EQ(dirty[k].triangle, all[k].triangle);
    }
  }
}

}  // namespace
}  // namespace soilbin::dem
