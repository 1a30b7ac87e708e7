// Drawings as CAD programs leave them are mended to the surface that was meant, and what was changed is told.
#include "dem/surface/drawn_wheel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

#include "dem/engine/simulation.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/surface/mesh_files.hpp"
#include "dem/surface/shapes.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/plates_of_triangles.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Corners = TriangleMesh::Corners;

/// A drawing as a file: text STL with all digits, so that 5e-8 m is there.
class Drawings : public testing::Test {
 protected:
  Drawings() : folder_(fs::path(testing::TempDir()) / ("drawn_wheel." + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Drawings() override { fs::remove_all(folder_); }

  fs::path stl(const MeshSoup& soup) const {
    const fs::path path = folder_ / "wheel.stl";
    std::ofstream text(path);
    text.precision(17);
    text << "solid wheel\n";
    for (const Corners& c : soup.triangles) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const int v : c) {
        const Vec3& p = soup.vertices[v];
        text << "vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
      }
      text << "endloop\nendfacet\n";
    }
    text << "endsolid wheel\n";
    return path;
  }
  fs::path folder_;
};

/// A closed cylinder about y, its ends fans: vertices 2 k on the left, 2 k + 1 on the right; the two middles come last.
MeshSoup cylinder(int sides, double radius, double width) {
  MeshSoup soup;
  for (int k = 0; k < sides; ++k)
    for (const double y : {-width / 2, width / 2})
      soup.vertices.push_back({radius * std::sin(2 * pi * k / sides), y, radius * std::cos(2 * pi * k / sides)});
  const int left = 2 * sides, right = left + 1;
  soup.vertices.push_back({0, -width / 2, 0});
  soup.vertices.push_back({0, width / 2, 0});
  for (int k = 0; k < sides; ++k) {
    const int a = 2 * k, b = (2 * k + 2) % (2 * sides);
    soup.triangles.push_back({a, b + 1, a + 1});
    soup.triangles.push_back({a, b, b + 1});
    soup.triangles.push_back({left, b, a});
    soup.triangles.push_back({right, a + 1, b + 1});
  }
  return soup;
}

MeshSoup joined(MeshSoup a, const MeshSoup& b, const Vec3& shift = {}) {
  const int first = static_cast<int>(a.vertices.size());
  for (const Vec3& v : b.vertices) a.vertices.push_back(v + shift);
  for (const Corners& c : b.triangles) a.triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
  return a;
}

MeshSoup cube(const Vec3& low) {
  tests::Soup two = tests::cube();
  MeshSoup soup;
  for (const Vec3& v : two.vertices) soup.vertices.push_back(0.5 * (v + Vec3{1, 1, 1}) + low);
  soup.triangles = two.triangles;
  return soup;
}

void face_inward(MeshSoup& soup) {
  for (Corners& c : soup.triangles) std::swap(c[1], c[2]);
}

Tire tire_of(double radius, double width) {
  Tire tire;
  tire.name = "drawn", tire.radius = radius, tire.width = width;
  return tire;
}

/// The cylinder of 48 sides whose first quad has a vertex more, 5e-8 m inside its edge.
MeshSoup cylinder_with_a_sliver() {
  MeshSoup soup = cylinder(48, 0.062, 0.04);
  const Vec3 from = soup.vertices[1], to = soup.vertices[3];  // the quad's edge on the right
  const Vec3 inside = unit((soup.vertices[0] + soup.vertices[2]) - (from + to));
  const int extra = static_cast<int>(soup.vertices.size());
  soup.vertices.push_back(0.5 * (from + to) + 5e-8 * inside);
  soup.triangles.erase(soup.triangles.begin(), soup.triangles.begin() + 2);
  for (const Corners& c : {Corners{0, extra, 1}, Corners{extra, 3, 1}, Corners{extra, 2, 3}, Corners{0, 2, extra}})
    soup.triangles.push_back(c);
  return soup;
}

TEST_F(Drawings, ACleanOneStaysAsItIs) {
  const MeshSoup soup = cylinder(48, 0.062, 0.04);
  const DrawnWheel wheel = read_wheel(stl(soup), tire_of(0.062, 0.04));
  EXPECT_THAT(wheel.changes, IsEmpty());
  EXPECT_EQ(wheel.mends.bodies, 1);
  const TriangleMesh as_before = read_mesh(stl(soup), 1, {.closed = true});
  EXPECT_EQ(wheel.mesh.vertices(), as_before.vertices());
  EXPECT_EQ(wheel.mesh.triangles(), as_before.triangles());
}

TEST_F(Drawings, ASliverIsTakenOutAndTold) {
  const DrawnWheel wheel = read_wheel(stl(cylinder_with_a_sliver()), tire_of(0.062, 0.04));
  EXPECT_EQ(wheel.mends.slivers, 1);
  EXPECT_THAT(wheel.changes, ElementsAre("1 sliver lower than 1.8e-07 m taken out"));
  EXPECT_NEAR(wheel.mends.tolerance, 1e-6 * std::hypot(0.124, 0.124, 0.04), 1e-9);
  EXPECT_EQ(wheel.mesh.size(), 4 * 48 + 2);
  const double clean = 0.04 * 24 * 0.062 * 0.062 * std::sin(2 * pi / 48);
  EXPECT_NEAR(wheel.volume, clean, 1e-11);
  EXPECT_THROW(TriangleMesh(wheel.mesh.vertices(), cylinder_with_a_sliver().triangles, {.closed = true}), InputError);
}

/// The force of grains all around on a wheel after some steps, with its surface cut this way or that.
Vec3 force_of_grains(const TriangleMesh& mesh) {
  Setup setup;
  setup.materials.add({"sand", 2500, 5e6, 0.2}, {.restitution = 0.5, .sliding_friction = 0.5});
  setup.domain = {{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}, {false, false, false}};
  setup.numerics.dt = 1e-6;
  setup.numerics.threads = 1;
  Simulation simulation(setup);
  Body body;
  body.surfaces = {{MeshSurface{std::make_shared<TriangleMesh>(mesh), nullptr}, 0}};
  body.spin = {0, 3, 0};
  const int index = simulation.add_body(body);
  constexpr double radius = 0.004;
  for (int k = 0; k < 24; ++k) {  // pressed by 1e-5 m, moving inward, more of them below
    const double turn = 0.3 + 2.0 * k / 24, out = 0.062 + radius - 2e-4;
    simulation.add_grain({out * std::sin(pi + turn), k % 2 ? 0.011 : -0.013, out * std::cos(pi + turn)}, radius, 0,
                         {0, 0, 0.4});
  }
  simulation.run(50);
  return simulation.body(index).force;
}

TEST_F(Drawings, ForcesOnAMendedOneAreThoseOnTheCleanOne) {
  const MeshSoup clean = cylinder(48, 0.062, 0.04);
  const Vec3 right = force_of_grains(read_wheel(stl(clean), tire_of(0.062, 0.04)).mesh);
  ASSERT_GT(length(right), 1);
  const auto expect_same = [&](const MeshSoup& soup, double within) {
    const Vec3 found = force_of_grains(read_wheel(stl(soup), tire_of(0.062, 0.04)).mesh);
    EXPECT_NEAR(length(found - right) / length(right), 0, within);
  };
  expect_same(cylinder_with_a_sliver(), 1e-3);  // 5e-8 m of an overlap of 2e-4 m
  expect_same(joined(clean, cylinder(30, 0.02, 0.04)), 0);
  MeshSoup inward = clean;
  face_inward(inward);
  expect_same(inward, 1e-9);
}

TEST_F(Drawings, TwoCylindersOfOneWidthAreTheOuterOne) {
  for (const bool hub_first : {false, true}) {
    const MeshSoup tire = cylinder(48, 0.062, 0.04), hub = cylinder(30, 0.02, 0.04);
    const DrawnWheel wheel = read_wheel(stl(hub_first ? joined(hub, tire) : joined(tire, hub)), tire_of(0.062, 0.04));
    EXPECT_EQ(wheel.mends.bodies, 1);
    EXPECT_EQ(wheel.mends.bodies_inside, 1);
    EXPECT_THAT(wheel.changes, ElementsAre("1 part inside another body left out"));
    EXPECT_EQ(wheel.mesh.size(), 4 * 48);
    EXPECT_NEAR(wheel.volume, 0.04 * 24 * 0.062 * 0.062 * std::sin(2 * pi / 48), 1e-12);
  }
}

// A ring of 48 sides and a hub that fills its hole, flush on both faces: neither lies inside the other.
TEST_F(Drawings, AHubThatFillsARingStays) {
  MeshSoup ring;
  for (int k = 0; k < 48; ++k)
    for (const double radius : {0.062, 0.02})
      for (const double y : {-0.02, 0.02})
        ring.vertices.push_back({radius * std::sin(2 * pi * k / 48), y, radius * std::cos(2 * pi * k / 48)});
  const auto quad = [&](int a, int b, int c, int d) {
    ring.triangles.push_back({a, c, b});
    ring.triangles.push_back({a, d, c});
  };
  for (int k = 0; k < 48; ++k) {
    const int a = 4 * k, b = 4 * ((k + 1) % 48);  // +0 outer left, +1 outer right, +2 inner left, +3 inner right
    quad(a, a + 1, b + 1, b), quad(a + 2, b + 2, b + 3, a + 3);
    quad(a, b, b + 2, a + 2), quad(a + 1, a + 3, b + 3, b + 1);
  }
  const DrawnWheel wheel = read_wheel(stl(joined(ring, cylinder(30, 0.02, 0.04))), tire_of(0.062, 0.04));
  EXPECT_EQ(wheel.mends.bodies, 2);
  EXPECT_EQ(wheel.mends.bodies_inside, 0);
  EXPECT_THAT(wheel.changes, ElementsAre("6 edges where more than two triangles met taken apart"))
      << "48 and 30 corners have 6 places in common";
  // With the ring's own corners their common wall is met by nothing: one body, its wall left out.
  const DrawnWheel one = read_wheel(stl(joined(ring, cylinder(48, 0.02, 0.04))), tire_of(0.062, 0.04));
  EXPECT_EQ(one.mends.bodies, 1);
  EXPECT_EQ(one.mends.doubled, 2 * 48);
  EXPECT_EQ(one.mends.unreachable, 2 * 48);
  EXPECT_NEAR(one.volume, 0.04 * 24 * 0.062 * 0.062 * std::sin(2 * pi / 48), 1e-12);
}

TEST_F(Drawings, FacesThatFaceInwardAreTurned) {
  const MeshSoup clean = cylinder(48, 0.062, 0.04);
  MeshSoup all = clean, one = clean;
  face_inward(all);
  std::swap(one.triangles[17][1], one.triangles[17][2]);
  const DrawnWheel from_all = read_wheel(stl(all), tire_of(0.062, 0.04));
  EXPECT_THAT(from_all.changes, ElementsAre("192 triangles that faced inward turned"));
  const DrawnWheel from_one = read_wheel(stl(one), tire_of(0.062, 0.04));
  EXPECT_THAT(from_one.changes, ElementsAre("1 triangle that faced inward turned"));
  for (const DrawnWheel* wheel : {&from_all, &from_one})
    EXPECT_NEAR(mass_properties(wheel->mesh).volume, 0.04 * 24 * 0.062 * 0.062 * std::sin(2 * pi / 48), 1e-15);
  // A hollow wheel: its cavity faces inward and stays out of the grains' way.
  MeshSoup cavity = cylinder(24, 0.05, 0.03);
  face_inward(cavity);
  const DrawnWheel hollow = read_wheel(stl(joined(clean, cavity)), tire_of(0.062, 0.04));
  EXPECT_THAT(hollow.changes, ElementsAre("1 part inside another body left out"));
}

TEST_F(Drawings, TheAxleIsTurnedToYAndTheMiddleMovedToTheOrigin) {
  const MeshSoup clean = cylinder(48, 62, 40);
  const Tire tire = tire_of(0.062, 0.04);
  const auto drawn = [&](const auto& change) {
    MeshSoup soup = clean;
    for (Vec3& v : soup.vertices) v = change(v);
    return read_wheel(stl(soup), tire);
  };
  const DrawnWheel along_x = drawn([](const Vec3& v) { return Vec3{v.y, -v.x, v.z}; });
  EXPECT_EQ(along_x.axle, 'x');
  EXPECT_STREQ(along_x.unit.name, "mm");
  EXPECT_THAT(along_x.changes, ElementsAre("turned from axle x to axle y: forward is the drawing's -y, up its z"));
  const DrawnWheel along_z = drawn([](const Vec3& v) { return Vec3{v.x, -v.z, v.y}; });
  EXPECT_EQ(along_z.axle, 'z');
  EXPECT_THAT(along_z.changes, ElementsAre("turned from axle z to axle y: forward is the drawing's x, up its -y"));
  const TriangleMesh upright = read_wheel(stl(clean), tire).mesh;
  EXPECT_EQ(along_x.mesh.vertices(), upright.vertices()) << "a quarter turn rounds nothing";
  EXPECT_EQ(along_z.mesh.vertices(), upright.vertices());
  const DrawnWheel aside = drawn([](const Vec3& v) { return v + Vec3{100, 20, -30}; });
  EXPECT_THAT(aside.changes, ElementsAre("moved by (-100, -20, 30) mm, so that the middle of its axle is the origin"));
  const DrawnWheel by_a_third = drawn([](const Vec3& v) { return v + Vec3{100.0 / 3, 0, 0}; });
  EXPECT_THAT(by_a_third.changes, ElementsAre(HasSubstr(", 0, 0) mm"))) << "rounding is no way";
  EXPECT_NEAR(aside.radius, 0.062, 1e-12);
  EXPECT_NEAR(aside.left, -0.02, 1e-12);
}

TEST_F(Drawings, TheUnitIsNamed) {
  for (const LengthUnit unit : drawing_units) {
    const MeshSoup soup = cylinder(48, 0.062 / unit.metres, 0.04 / unit.metres);
    const DrawnWheel wheel = read_wheel(stl(soup), tire_of(0.062, 0.04));
    EXPECT_STREQ(wheel.unit.name, unit.name);
    const DrawnWheel said = read_wheel(stl(soup), unit);
    EXPECT_NEAR(said.radius, 0.062, 1e-12);
    EXPECT_NEAR(said.width(), 0.04, 1e-12);
  }
  const DrawnWheel guessed = read_wheel(stl(cylinder(48, 62, 40)), std::nullopt);
  EXPECT_STREQ(guessed.unit.name, "mm");
  EXPECT_THAT(guessed.other_units, ElementsAre("cm (radius 620 mm)", "inch (radius 1575 mm)"));
  EXPECT_STREQ(read_wheel(stl(cylinder(48, 0.062, 0.04)), std::nullopt).unit.name, "m");
  EXPECT_THROW(read_wheel(stl(cylinder(48, 1e-6, 1e-6)), std::nullopt), InputError);
}

TEST_F(Drawings, BodiesThatShareAnEdgeOrACornerComeApart) {
  MeshMends mends;
  const MeshSoup at_edge = mended(joined(cube({0, 0, 0}), cube({1, 1, 0})), "two", mends);
  EXPECT_EQ(mends.edges_parted, 1);
  EXPECT_EQ(mends.bodies, 2);
  const TriangleMesh two(at_edge.vertices, at_edge.triangles, {.closed = true, .as_given = true});
  EXPECT_EQ(two.vertices().size(), 16u);
  EXPECT_NEAR(mass_properties(two).volume, 2, 1e-14);
  const MeshSoup at_corner = mended(joined(cube({0, 0, 0}), cube({1, 1, 1})), "two", mends);
  EXPECT_EQ(mends.bodies, 2);
  EXPECT_NEAR(
      mass_properties(TriangleMesh(at_corner.vertices, at_corner.triangles, {.closed = true, .as_given = true})).volume,
      2, 1e-14);
  // Side by side, the wall between them in both: one box, whichever way its faces run.
  std::mt19937 random(1);
  for (int round = 0; round < 10; ++round) {
    MeshSoup row = joined(cube({0, 0, 0}), cube({1, 0, 0}));
    for (Corners& c : row.triangles)
      if (random() % 2) std::swap(c[1], c[2]);
    const MeshSoup box = mended(row, "box", mends);
    EXPECT_EQ(mends.bodies, 1);
    EXPECT_NEAR(mass_properties(TriangleMesh(box.vertices, box.triangles, {.closed = true, .as_given = true})).volume,
                2, 1e-14);
  }
}

TEST_F(Drawings, AVertexOnAnOpenEdgeClosesTheCrack) {
  MeshSoup soup = cylinder(48, 0.062, 0.04);
  // The first quad gets a vertex in the middle of its right edge, the end beside it does not.
  const int extra = static_cast<int>(soup.vertices.size());
  soup.vertices.push_back(0.5 * (soup.vertices[1] + soup.vertices[3]));
  soup.triangles.erase(soup.triangles.begin());
  soup.triangles.push_back({0, extra, 1});
  soup.triangles.push_back({0, 3, extra});
  const DrawnWheel wheel = read_wheel(stl(soup), tire_of(0.062, 0.04));
  EXPECT_THAT(wheel.changes, ElementsAre("1 triangle split where a vertex lay on an open edge"));
  EXPECT_NEAR(wheel.volume, 0.04 * 24 * 0.062 * 0.062 * std::sin(2 * pi / 48), 1e-15);
}

TEST_F(Drawings, AHoleIsRefusedAndToldInTheDrawingsUnit) {
  MeshSoup soup = cylinder(48, 62, 40);
  soup.triangles.erase(soup.triangles.begin() + 2);
  EXPECT_THAT(soilbin::test::refusal([&] { read_wheel(stl(soup), tire_of(0.062, 0.04)); }),
              HasSubstr("not closed: 3 of its edges have one triangle only, such as that from (0, -20, 62) to"));
}

// A fan of 60,000 triangles about one vertex took 18 s, in the square of their number.
TEST(SlowFan, TakesATimeThatGrowsWithItsTriangles) {
  const std::clock_t begin = std::clock();  // of this process alone
  MeshMends mends;
  const MeshSoup soup = mended(cylinder(60000, 0.062, 0.04), "fan", mends);
  EXPECT_EQ(TriangleMesh(soup.vertices, soup.triangles, {.closed = true}).size(), 240000);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 12) << "a few on a machine with other work";
}

}  // namespace
}  // namespace soilbin::dem
