// What a mesh takes, what it refuses and says, and what it knows about itself.
#include "dem/surface/triangle_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/plates_of_triangles.hpp"
#include "dem/surface/mass_properties.hpp"
#include "scenario/estimate.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using tests::Soup;

/// What the mesh says to these triangles; empty if it takes them.
std::string mesh_refusal(const Soup& soup, bool closed = false) {
  return soilbin::test::error_of(
      [&] { TriangleMesh(soup.vertices, soup.triangles, {.closed = closed, .name = "part.stl"}); });
}

testing::Matcher<std::string> says(const std::string& what) {
  return testing::AllOf(testing::StartsWith("part.stl: "), testing::HasSubstr(what), testing::HasSubstr("hint: "));
}

TEST(TriangleMesh, TakesACubeAndKnowsItsPlanes) {
  const Soup soup = tests::cube();
  const TriangleMesh mesh(soup.vertices, soup.triangles, {.closed = true});
  EXPECT_EQ(mesh.size(), 12);
  EXPECT_EQ(mesh.vertices().size(), 8u);
  EXPECT_EQ(mesh.bounds(), (Box{{-1, -1, -1}, {1, 1, 1}}));
  EXPECT_DOUBLE_EQ(mesh.area(), 24);
  for (int t = 0; t < mesh.size(); ++t) {
    const TriangleFrame& f = mesh.frame(t);
    EXPECT_DOUBLE_EQ(f.offset, 1);  // all faces are 1 from the centre, normals outward
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(length(f.sides[i]), 1, 1e-15);
      EXPECT_NEAR(dot(f.sides[i], f.normal), 0, 1e-15);
      EXPECT_LT(dot(f.sides[i], mesh.corner(t, (i + 2) % 3)), f.side_offsets[i]);  // the triangle is inside
      const EdgeLink other = mesh.across(t, i);
      ASSERT_GE(other.triangle, 0);
      EXPECT_EQ(mesh.across(other.triangle, other.edge), (EdgeLink{t, i}));
      EXPECT_EQ(mesh.triangles()[other.triangle][other.edge], mesh.triangles()[t][(i + 1) % 3]);
    }
  }
}

TEST(TriangleMesh, VertexNormalsAreThoseOfTheSolidNotOfTheCuts) {
  const Soup soup = tests::cube();
  const TriangleMesh mesh(soup.vertices, soup.triangles, {.closed = true});
  for (int v = 0; v < 8; ++v) {  // three right angles: pi/2 (+-1, +-1, +-1), however the faces are cut
    EXPECT_NEAR(length(mesh.vertex_normal(v) - std::numbers::pi / 2 * mesh.vertices()[v]), 0, 1e-14);
  }
}

TEST(TriangleMesh, NoDirectionIntoASurfaceIsFartherThan45DegreesFromAStoredOne) {
  std::mt19937_64 random(7);
  const Soup soup = tests::random_plate(random, 60, 1e-3);
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  for (int t = 0; t < mesh.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = mesh.corner(t, i), q = mesh.corner(t, (i + 1) % 3), r = mesh.corner(t, (i + 2) % 3);
      for (double s = 0; s <= 1; s += 0.125) {
        const Vec3 into = unit((1 - s) * q + s * r - p);
        double nearest = -1;
        for (const Vec3& u : mesh.directions(mesh.triangles()[t][i])) nearest = std::max(nearest, dot(u, into));
        EXPECT_GE(nearest, std::sqrt(0.5) - 1e-9);
      }
    }
  }
}

TEST(TriangleMesh, WeldsVerticesThatAreAlmostOneAndForgetsThoseOfNoTriangle) {
  Soup soup{{{-1, -1, 0}, {9, 9, 9}, {1, -1, 0}, {1, 1, 0}, {-1, -1, 1e-7}, {1 - 2e-7, 1, 0}, {-1, 1, 0}},
            {{0, 2, 3}, {4, 5, 6}}};
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  EXPECT_EQ(mesh.vertices().size(), 4u);
  EXPECT_EQ(mesh.vertices()[0], (Vec3{-1, -1, 0}));  // the first of each cluster stays, to the bit
  EXPECT_EQ(mesh.vertices()[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(mesh.across(0, 2), (EdgeLink{1, 0}));
  EXPECT_EQ(mesh.bounds().high, (Vec3{1, 1, 0}));
  const TriangleMesh apart(soup.vertices, soup.triangles, {.weld = 1e-9});
  EXPECT_EQ(apart.vertices().size(), 6u);
}

TEST(TriangleMesh, RefusesWhatIsNoSurfaceAndSaysWhere) {
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}}, {}}), says("no triangles"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {0, not_a_number, 0}}, {{0, 1, 2}}}),
              says("vertex 2 at (0, nan, 0) m is not finite"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}),
              says("triangle 0 has vertex 3, but there are 3"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, -1}}}), says("triangle 0 has vertex -1"));
}

TEST(TriangleMesh, RefusesTrianglesWithoutAreaAndTwins) {
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}),
              says("triangle 0 at (0, 0, 0) m has no area"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {2, 1e-7, 0}}, {{0, 1, 2}}}), says("has no area"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}, {{0, 1, 1}}}), says("has no area"));
  EXPECT_THAT(mesh_refusal({{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}, {{0, 1, 2}}}), says("has no area"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 2, 0}}}),
              says("triangles 0 and 1 are the same"));
  EXPECT_THAT(mesh_refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 2}}}),
              says("triangles 0 and 1 are the same"));
}

TEST(TriangleMesh, RefusesBranchesAndTwistedNeighbours) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  EXPECT_THAT(mesh_refusal({points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}),
              says("the edge from (0, 0, 0) m to (1, 0, 0) m is shared by more than two triangles: 0, 1, 2"));
  EXPECT_THAT(mesh_refusal({points, {{0, 1, 2}, {0, 1, 3}}}), says("triangles 0 and 1 face opposite sides"));
  EXPECT_EQ(mesh_refusal({points, {{0, 1, 2}, {1, 0, 3}}}), "");
}

TEST(TriangleMesh, RefusesTJoints) {
  // Two halves of a plate, one of them cut at the middle of the common edge.
  const Soup cut{{{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 3, 4}, {4, 3, 1}}};
  EXPECT_THAT(mesh_refusal(cut),
              says("a T-joint: the vertex at (0, 0, 0) m lies inside the edge from (0, -1, 0) m to (0, 1, 0) m"));
  // In the edge of two triangles that are joined well, by a third that only touches.
  EXPECT_THAT(mesh_refusal({{{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, {0, 1, 1}},
                            {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}}}),
              says("a T-joint"));
  // The search finds the one bad vertex of a fine plate, wherever it is.
  std::mt19937_64 random(3);
  for (int round = 0; round < 20; ++round) {
    Soup soup = tests::random_plate(random, 200, 1e-3);
    EXPECT_EQ(mesh_refusal(soup), "");
    const auto corners = soup.triangles[random() % soup.triangles.size()];
    const Vec3 &a = soup.vertices[corners[0]], &b = soup.vertices[corners[1]];
    const int n = static_cast<int>(soup.vertices.size());
    for (const Vec3& p : {0.3 * a + 0.7 * b, Vec3{0, 0, 3}, Vec3{0, 1, 3}}) soup.vertices.push_back(p);
    soup.triangles.push_back({n, n + 1, n + 2});
    EXPECT_THAT(mesh_refusal(soup), says("a T-joint"));
  }
}

TEST(TriangleMesh, RefusesAHoleAnInsideOutBodyAndTwoThatShareAVertex) {
  Soup open = tests::cube();
  open.triangles.pop_back();
  EXPECT_EQ(mesh_refusal(open), "");
  EXPECT_THAT(mesh_refusal(open, true), says("not closed: the edge from"));
  Soup inward = tests::cube();
  for (auto& t : inward.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(mesh_refusal(inward), "");
  EXPECT_THAT(mesh_refusal(inward, true), says("the triangles face inward: the volume is -8 m^3"));
  Soup two = tests::cube();
  for (int v = 0; v < 8; ++v) two.vertices.push_back(two.vertices[v] + Vec3{2, 2, 2});
  for (int t = 0; t < 12; ++t) {
    const auto c = two.triangles[t];
    two.triangles.push_back({c[0] + 8, c[1] + 8, c[2] + 8});
  }
  EXPECT_EQ(mesh_refusal(two), "");
  EXPECT_THAT(mesh_refusal(two, true), says("share only the vertex at (1, 1, 1) m"));
}

// A box a x b x c has the principal moments V (b^2 + c^2)/12, ...; turned and shifted, I = R I0 R^T.
TEST(MassProperties, OfATurnedBoxAreTheClosedForm) {
  std::mt19937_64 random(11);
  const double a = 0.6, b = 1.4, c = 2.2, volume = a * b * c;
  const Vec3 principal{volume * (b * b + c * c) / 12, volume * (c * c + a * a) / 12, volume * (a * a + b * b) / 12};
  for (int round = 0; round < 20; ++round) {
    const Rotation turn = tests::any_rotation(random);
    const Vec3 shift = 3 * tests::any_direction(random);
    Soup soup = tests::cube();
    for (Vec3& v : soup.vertices) v = {0.5 * a * v.x, 0.5 * b * v.y, 0.5 * c * v.z};
    soup = tests::moved(soup, turn, shift);
    const TriangleMesh mesh(soup.vertices, soup.triangles, {.closed = true});
    const MassProperties m = mass_properties(mesh);
    EXPECT_NEAR(m.volume, volume, 1e-13);
    EXPECT_NEAR(length(m.centroid - shift), 0, 1e-13);
    const Vec3 ex = turn({1, 0, 0}), ey = turn({0, 1, 0}), ez = turn({0, 0, 1});
    const auto expected = [&](double Vec3::*i, double Vec3::*j) {
      return principal.x * ex.*i * ex.*j + principal.y * ey.*i * ey.*j + principal.z * ez.*i * ez.*j;
    };
    EXPECT_NEAR(m.xx, expected(&Vec3::x, &Vec3::x), 1e-12);
    EXPECT_NEAR(m.yy, expected(&Vec3::y, &Vec3::y), 1e-12);
    EXPECT_NEAR(m.zz, expected(&Vec3::z, &Vec3::z), 1e-12);
    EXPECT_NEAR(m.xy, expected(&Vec3::x, &Vec3::y), 1e-12);
    EXPECT_NEAR(m.yz, expected(&Vec3::y, &Vec3::z), 1e-12);
    EXPECT_NEAR(m.zx, expected(&Vec3::z, &Vec3::x), 1e-12);
  }
}

// A tetrahedron with three edges 1 along the axes: V = 1/6, centroid 1/4, Int x^2 = 1/60, Int x y = 1/120 from the
// corner.
TEST(MassProperties, OfATetrahedron) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                          {.closed = true});
  const MassProperties m = mass_properties(mesh);
  EXPECT_NEAR(m.volume, 1.0 / 6, 1e-16);
  EXPECT_NEAR(m.centroid.x, 0.25, 1e-15);
  EXPECT_NEAR(m.xx, 2 * (1.0 / 60 - 1.0 / 96), 1e-16);
  EXPECT_NEAR(m.xy, -(1.0 / 120 - 1.0 / 96), 1e-16);
  EXPECT_NEAR(m.zx, m.xy, 1e-17);
  EXPECT_THROW(mass_properties(TriangleMesh(mesh.vertices(), mesh.triangles())), std::logic_error);
}

}  // namespace
}  // namespace soilbin::dem
