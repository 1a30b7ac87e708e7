// Surfaces of one body that meet in one plane are refused: a grain there would be pressed twice.
#include "dem/surface/seams.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dem/surface/shapes.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/worlds.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using ::testing::HasSubstr;

Surface placed(const TriangleMesh& mesh, const Vec3& at, const Rotation& turn = {}) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(turn(vertex) + at);
  return {
      MeshSurface{std::make_shared<TriangleMesh>(vertices, mesh.triangles(), MeshOptions{.closed = mesh.closed()}), {}},
      0};
}

Body with(std::vector<Surface> surfaces) {
  Body body;
  body.name = "floor";
  body.surfaces = std::move(surfaces);
  return body;
}

std::string refused(const Body& body) {
  return soilbin::test::error_of([&] { check_seams(body); });
}

TEST(Seams, OfTwoSheetsInOnePlaneAreRefused) {
  const TriangleMesh sheet = plate(2, 2, 2, 2);
  const std::string why = refused(with({placed(sheet, {-1, 0, 0}), placed(sheet, {1, 0, 0})}));
  EXPECT_THAT(why, HasSubstr("body floor: its surfaces 1 and 2 meet in one plane at (0, "));
  EXPECT_THAT(why, HasSubstr("hint: make them one mesh"));
  const Rotation over = rotation_by({0, std::acos(-1.0), 0});  // a sheet has two sides
  EXPECT_NE(refused(with({placed(sheet, {-1, 0, 0}), placed(sheet, {1, 0, 0}, over)})), "");
  // Cut in another way: the vertices of one lie within the edges of the other.
  EXPECT_NE(refused(with({placed(plate(2, 2, 3, 3), {-1, 0, 0}), placed(sheet, {1, 0, 0})})), "");
  EXPECT_EQ(refused(with({placed(sheet, {-1, 0, 0}), placed(sheet, {1.01, 0, 0})})), "") << "apart";
  EXPECT_EQ(refused(with({placed(sheet, {-1, 0, 0})})), "");
}

TEST(Seams, AreRefusedUpToTheAngleThatOneMeshMerges) {
  const TriangleMesh sheet = plate(2, 2, 1, 1);
  for (const double angle : {0.1, 0.19, 0.21, 1.5}) {
    const Rotation rise = rotation_by({0, -angle, 0});
    const Body dale = with({placed(sheet, {-1, 0, 0}), placed(sheet, rise({1, 0, 0}), rise)});
    EXPECT_EQ(refused(dale) != "", angle < 0.2) << angle;
  }
}

TEST(Seams, OfBodiesThatStandOnEachOtherAreNone) {
  const TriangleMesh large = box({4, 4, 1}), small = box({1, 1, 1});
  EXPECT_EQ(refused(with({placed(large, {0, 0, 0}), placed(small, {0, 0, 1})})), "");
  EXPECT_NE(refused(with({placed(small, {0, 0, 0}), placed(small, {0, 0, 1})})), "") << "their sides are one wall";
  EXPECT_NE(refused(with({placed(large, {0, 0, 0}), placed(small, {4.5 / 2, 0, 0})})), "") << "their tops are level";
}

TEST(Seams, OfPlanes) {
  const Surface floor{Plane{{0, 0, 0}, {0, 0, 1}}, 0}, again{Plane{{3, 1, 0}, {0, 0, 1}}, 0},
      lid{Plane{{0, 0, 0}, {0, 0, -1}}, 0}, wall{Plane{{0, 0, 0}, {1, 0, 0}}, 0};
  EXPECT_NE(refused(with({floor, again})), "");
  EXPECT_EQ(refused(with({floor, lid, wall})), "");
  const TriangleMesh sheet = plate(2, 2, 1, 1);
  EXPECT_NE(refused(with({floor, placed(sheet, {})})), "");
  EXPECT_EQ(refused(with({floor, placed(sheet, {0, 0, 0.1})})), "");
  EXPECT_EQ(refused(with({floor, placed(box({1, 1, 1}), {0, 0, 0.5})})), "") << "its underside faces down";
}

// What a seam would do, and that the engine refuses it: two sheets carry a grain on one point where they are one mesh.
TEST(Seams, AreRefusedByTheEngine) {
  Simulation simulation(test::soft_stone());
  EXPECT_THROW(simulation.add_body(with({placed(plate(2, 2, 1, 1), {-1, 0, 0}), placed(plate(2, 2, 1, 1), {1, 0, 0})})),
               InputError);
  simulation.add_body(with({placed(plate(4, 2, 2, 1), {})}));
  simulation.add_grain({0, 0, 0.0099}, 0.01, 0);
  simulation.run(1);
  EXPECT_EQ(simulation.contacts().size(), 1u);
}

}  // namespace
}  // namespace soilbin::dem
