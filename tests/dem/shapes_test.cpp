// Shapes: closed, facing outward, of the volume that formulas tell, fit for grains everywhere.
#include "dem/surface/shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "dem/surface/mass_properties.hpp"
#include "dem/surface/touching_points.hpp"
#include "dem/surface/triangle_grid.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

Tire paper_tire(LugPattern pattern) {
  Tire tire;
  tire.name = "paper", tire.radius = 0.496, tire.width = 0.305;
  tire.lugs = {.height = 0.011, .count = 40, .thickness = 0.025, .pattern = pattern};
  if (pattern == LugPattern::staggered) tire.lugs.thickness = 0.02;
  return tire;
}

constexpr std::array all_patterns = {LugPattern::straight, LugPattern::chevron, LugPattern::slanted,
                                     LugPattern::staggered};

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (int t = 0; t < mesh.size(); ++t) {
    for (int i = 0; i < 3; ++i) longest = std::max(longest, length(mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i)));
  }
  return longest;
}

double volume(const TriangleMesh& mesh) { return mass_properties(mesh).volume; }

/// Half the strip of half-width s through a circle of radius r.
double strip(double r, double s) { return s * std::sqrt(r * r - s * s) + r * r * std::asin(s / r); }

std::string shape_refusal(const std::function<void()>& make) {
  return soilbin::test::error_of([&] { make(); });
}

TEST(Shapes, ABoxIsABoxHoweverFine) {
  for (const double edge : {any_edge, 0.7, 0.1}) {
    const TriangleMesh mesh = box({0.5, 1, 2}, edge);
    EXPECT_TRUE(mesh.closed());
    EXPECT_EQ(mesh.bounds(), (Box{{-0.25, -0.5, -1}, {0.25, 0.5, 1}}));
    EXPECT_NEAR(volume(mesh), 1, 1e-14);
    EXPECT_NEAR(mesh.area(), 2 * (0.5 + 1 + 2), 1e-12);
    EXPECT_NEAR(mass_properties(mesh).xx, (1 + 4) / 12.0, 1e-14);
    EXPECT_LE(longest_edge(mesh), std::min(edge, 3.0) * std::sqrt(2) * (1 + 1e-12));  // a cell's diagonal
  }
  EXPECT_EQ(box({1, 1, 1}).size(), 12);
  EXPECT_EQ(box({1, 2, 3}, 1).size(), 4 * (2 + 6 + 3));
}

TEST(Shapes, APlateLiesInItsPlane) {
  const TriangleMesh mesh = plate(6, 1, 12, 3);
  EXPECT_FALSE(mesh.closed());
  EXPECT_EQ(mesh.size(), 72);
  EXPECT_NEAR(mesh.area(), 6, 1e-13);
  EXPECT_EQ(mesh.bounds(), (Box{{-3, -0.5, 0}, {3, 0.5, 0}}));
  for (int t = 0; t < mesh.size(); ++t) EXPECT_NEAR(mesh.frame(t).normal.z, 1, 1e-15);
}

// A prism over a regular n-gon: V = b (n/2) r^2 sin(2 pi/n); about the axle I = V r^2 (2 + cos(2 pi/n))/6... per area
// of the triangle (0, p, q): Int |x|^2 = A (p^2 + q^2 + p.q)/6.
TEST(Shapes, ASmoothWheelIsAPrism) {
  for (const int n : {3, 4, 5, 7, 24, 200}) {
    for (const double edge : {any_edge, 0.3, 0.05}) {
      const double r = 0.5, b = 0.3;
      const TriangleMesh mesh = smooth_wheel(r, b, n, edge);
      const double expected = b * n / 2 * r * r * std::sin(2 * pi / n);
      const MassProperties m = mass_properties(mesh);
      EXPECT_NEAR(m.volume, expected, 1e-14);
      EXPECT_NEAR(m.yy, expected * r * r * (2 + std::cos(2 * pi / n)) / 6, 1e-14);
      EXPECT_NEAR(length(m.centroid), 0, 1e-14);
      // No triangle of a side is turned over: the areas, not only their sum with signs, make up the whole.
      const double rim = n * 2 * r * std::sin(pi / n) * b;
      EXPECT_NEAR(mesh.area(), rim + 2 * expected / b, 1e-12) << n << " " << edge;
    }
  }
}

TEST(Shapes, ThePapersTireComesOut) {
  for (const LugPattern pattern : all_patterns) {
    const Tire tire = paper_tire(pattern);
    const TriangleMesh mesh = tire_surface(tire, {.edge = 0.02});
    EXPECT_TRUE(mesh.closed());
    double least = 1, most = 0;
    for (const Vec3& p : mesh.vertices()) {
      const double from_axle = std::hypot(p.x, p.z);
      most = std::max(most, from_axle);
      if (std::abs(std::abs(p.y) - 0.1525) > 1e-9) least = std::min(least, from_axle);
    }
    EXPECT_NEAR(least, 0.496, 1e-12);
    EXPECT_NEAR(most, 0.507, 1e-12);
    EXPECT_NEAR(mesh.bounds().low.y, -0.1525, 1e-15);
    EXPECT_NEAR(mesh.bounds().high.y, 0.1525, 1e-15);
    EXPECT_NEAR(length(mass_properties(mesh).centroid), 0, 1e-3);
  }
}

// The closed form of the header, reached with the square of the edge; the mesh lies inside its circles, so from below.
TEST(Shapes, TheVolumeOfALuggedTireGoesToTheClosedForm) {
  for (const LugPattern pattern : all_patterns) {
    const Tire tire = paper_tire(pattern);
    const double r = tire.radius, h = tire.lugs.height, s = *tire.lugs.thickness / 2;
    const double bar = strip(r + h, s) - strip(r, s);
    EXPECT_NEAR(bar, 2 * s * h, 1e-3 * bar);  // nearly a rectangle
    const double expected = tire.width * (pi * r * r + 40 * bar);
    const double coarse = expected - volume(tire_surface(tire, {.edge = 0.027}));
    const double fine = expected - volume(tire_surface(tire, {.edge = 0.0134}));
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(fine / coarse, 0.25, 0.01);  // both bars and gaps are cut twice as often
    // A chord of angle a lacks a^2/6: 1.2e-4 at 13.3 mm on 496 mm. Of slanted bars each cell of the tread is cut along
    // the diagonal that lacks more, of a chevron's half of them.
    EXPECT_LT(fine, (pattern == LugPattern::slanted ? 2.2e-4 : 1.5e-4) * expected);
  }
}

// The section of straight bars as a polygon, by the shoelace formula over its corners in order.
TEST(Shapes, TheVolumeOfStraightBarsIsThatOfTheirPolygon) {
  const Tire tire = paper_tire(LugPattern::straight);
  const TriangleMesh mesh = tire_surface(tire, {.edge = 1});  // one cell a bar, one a gap
  const double r = 0.496, top = 0.507, half = std::asin(0.0125 / r), half_top = std::asin(0.0125 / top);
  double twice = 0;
  std::vector<std::array<double, 2>> corners;
  for (int k = 0; k < 40; ++k) {
    const double c = 2 * pi * k / 40;
    for (const auto& [radius, angle] :
         {std::pair{r, c - half}, {top, c - half_top}, {top, c + half_top}, {r, c + half}}) {
      corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  EXPECT_NEAR(volume(mesh), 0.305 * twice / 2, 1e-14);
}

TEST(Shapes, EdgesKeepToTheirTarget) {
  for (const LugPattern pattern : {LugPattern::straight, LugPattern::chevron}) {
    const TriangleMesh mesh = tire_surface(paper_tire(pattern), {.edge = 0.02});
    // Cells of 0.02 (0.0204 on the tops) sheared by tan(0.5): their longer diagonal; on the sides rings are joined
    // askew.
    EXPECT_LT(longest_edge(mesh), 0.02 * std::hypot(1.03 + std::tan(0.5), 1.0) * 1.02);
  }
}

// The centre line leads: rolling to +x the top goes to +x, so there the bar's middle is ahead of its ends.
TEST(Shapes, AChevronLeadsOnTheCentreLine) {
  const TriangleMesh mesh = tire_surface(paper_tire(LugPattern::chevron), {.edge = 0.01});
  const auto top_of_bar = [&](double y) {  // mean x of the vertices of the top bar's upper side at this y
    double sum = 0, n = 0;
    for (const Vec3& p : mesh.vertices()) {
      const double back = 0.496 * std::atan2(p.x, p.z) + std::abs(y) * std::tan(0.5);
      if (std::abs(p.y - y) < 1e-9 && std::hypot(p.x, p.z) > 0.5069 && std::abs(back) < 0.02) sum += p.x, n += 1;
    }
    return sum / n;
  };
  EXPECT_NEAR(top_of_bar(0), 0, 1e-12);
  for (const double end : {-0.1525, 0.1525})
    EXPECT_NEAR(top_of_bar(end), -0.507 * std::sin(0.1525 * std::tan(0.5) / 0.496), 1e-4);
}

/// Angles about the axle of the bars' tops at this y, by their outermost vertices, turned so that one is 0.
std::set<int> bars_at(const TriangleMesh& mesh, double y, double top) {
  std::set<int> degrees;
  for (const Vec3& p : mesh.vertices())
    if (std::abs(p.y - y) < 1e-9 && std::hypot(p.x, p.z) > top - 1e-4)
      degrees.insert(static_cast<int>(std::lround(std::atan2(p.x, p.z) * 180 / pi)));
  return degrees;
}

// An agricultural drive tire: 12 bars of 45 deg on each side, half a pitch apart on the centre line, their outer ends
// behind. Slanted bars lead on the right.
TEST(Shapes, StaggeredBarsStandHalfAPitchApart) {
  Tire tire = paper_tire(LugPattern::staggered);
  tire.lugs = {.height = 0.04, .count = 12, .thickness = 0.04, .pattern = LugPattern::staggered, .angle = pi / 4};
  const TriangleMesh mesh = tire_surface(tire, {.edge = 0.02});
  EXPECT_TRUE(mesh.closed());
  const double r = tire.radius, s = 0.02, half_bar = 180 / pi * std::asin(s / (r + 0.04));
  const double expected = tire.width * (pi * r * r + 12 * (strip(r + 0.04, s) - strip(r, s)));
  EXPECT_NEAR(volume(mesh), expected, 1e-3 * expected);
  EXPECT_NEAR(mass_properties(mesh).centroid.y, 0, 1e-4);
  const std::set<int> middle = bars_at(mesh, 0, r + 0.04);
  const double end = 180 / pi * (tire.width / 2) / r;  // tan(45 deg) = 1
  for (const double bar : {0.0, 15.0, 30.0, 45.0}) {   // both sides' on the centre line
    EXPECT_TRUE(middle.contains(static_cast<int>(std::lround(bar + half_bar)))) << bar;
    EXPECT_TRUE(middle.contains(static_cast<int>(std::lround(bar - half_bar)))) << bar;
  }
  const std::set<int> left = bars_at(mesh, tire.width / 2, r + 0.04), right = bars_at(mesh, -tire.width / 2, r + 0.04);
  EXPECT_TRUE(left.contains(static_cast<int>(std::lround(-end + half_bar))));
  EXPECT_TRUE(right.contains(static_cast<int>(std::lround(15 - end + half_bar))));
  EXPECT_FALSE(left.contains(static_cast<int>(std::lround(15 - end)))) << "a gap";

  tire.lugs.pattern = LugPattern::slanted;
  const TriangleMesh slanted = tire_surface(tire, {.edge = 0.02});
  EXPECT_TRUE(bars_at(slanted, tire.width / 2, r + 0.04).contains(static_cast<int>(std::lround(-end + half_bar))));
  EXPECT_TRUE(bars_at(slanted, -tire.width / 2, r + 0.04).contains(static_cast<int>(std::lround(end - half_bar))));
}

// Grains round a tire: straight bars against a plain answer in the section's plane, within the faceting.
TEST(Shapes, AGrainTouchesALuggedTireWhereItsSectionSays) {
  const TriangleMesh mesh = tire_surface(paper_tire(LugPattern::straight), {.edge = 0.01});
  const TriangleGrid grid(mesh, 0.02);
  TouchingPoints points;
  const auto touch = [&](double x, double y, double z) {
    find_touching_points(mesh, grid.around({x, y, z}), {x, y, z}, 0.015, MergeAngle(), points);
    return points.count;
  };
  ASSERT_EQ(touch(0, 0.03, 0.507 + 0.01), 1);  // on a bar's top
  EXPECT_NEAR(points[0].distance, 0.01, 1e-4);
  EXPECT_NEAR(points[0].normal.z, 1, 1e-2);
  const double middle = pi / 40;  // between two bars
  ASSERT_EQ(touch(0.508 * std::sin(middle), 0, 0.508 * std::cos(middle)), 1);
  EXPECT_NEAR(points[0].distance, 0.012, 1e-4);
  // Beside a bar, 10 mm from its side and above the base: the side and the base.
  ASSERT_EQ(touch(0.0125 + 0.008, 0, 0.496 + 0.009), 2);
  EXPECT_NEAR(points[0].distance, 0.008, 1e-9);
  EXPECT_NEAR(points[0].normal.x, 1, 1e-9);
  EXPECT_NEAR(points[1].distance, std::hypot(0.0205, 0.505) - 0.496, 1e-4);
  // At the flank, half-way up the side: one; beyond the rim of the bar: the rim.
  ASSERT_EQ(touch(0.1, 0.1525 + 0.01, 0.2), 1);
  EXPECT_NEAR(points[0].normal.y, 1, 1e-12);
  EXPECT_NEAR(points[0].distance, 0.01, 1e-12);
  ASSERT_EQ(touch(0, 0.1525 + 0.006, 0.507 + 0.008), 1);
  EXPECT_NEAR(points[0].distance, 0.01, 1e-4);
}

TEST(Shapes, SmoothTiresAndOddOnes) {
  Tire tire = paper_tire(LugPattern::straight);
  tire.lugs = {};
  EXPECT_NEAR(volume(tire_surface(tire)), pi * 0.496 * 0.496 * 0.305, 1e-3 * 0.235);
  tire = paper_tire(LugPattern::chevron);
  for (const int count : {1, 2, 3, 17, 100}) {
    for (const double edge : {0.05, 0.2}) {
      tire.lugs.count = count;
      const double bars = count * (strip(0.507, 0.0125) - strip(0.496, 0.0125));
      const double expected = 0.305 * (pi * 0.496 * 0.496 + bars);
      EXPECT_NEAR(volume(tire_surface(tire, {.edge = edge})), expected, 0.02 * expected);
    }
  }
  // Rover wheel of the code-to-code comparison: 18 lugs 10 mm high and 5 mm thick on a radius of 0.1 m.
  Tire rover;
  rover.radius = 0.1, rover.width = 0.1, rover.lugs = {.height = 0.01, .count = 18, .thickness = 0.005};
  EXPECT_NEAR(volume(tire_surface(rover, {.edge = 0.004})),
              0.1 * (pi * 0.01 + 18 * (strip(0.11, 0.0025) - strip(0.1, 0.0025))), 4e-6);
}

TEST(Shapes, RefuseWhatCanNotBe) {
  EXPECT_THAT(shape_refusal([] { box({1, -1, 1}); }), testing::HasSubstr("box: its width is -1 m"));
  EXPECT_THAT(shape_refusal([] { box({1, 1, 1}, 1e-9); }), testing::HasSubstr("more than 100000 parts"));
  EXPECT_THAT(shape_refusal([] { box({1, 1, 1}, 0); }), testing::HasSubstr("target edge"));
  EXPECT_THAT(shape_refusal([] { plate(1, 1, 0, 3); }), testing::HasSubstr("0 x 3 cells"));
  EXPECT_THAT(shape_refusal([] { smooth_wheel(1, 1, 2); }), testing::HasSubstr("2 segments"));
  EXPECT_THAT(shape_refusal([] { smooth_wheel(std::nan(""), 1, 20); }), testing::HasSubstr("its radius is nan m"));
  Tire tire = paper_tire(LugPattern::straight);
  tire.lugs.count.reset();
  EXPECT_THAT(shape_refusal([&] { tire_surface(tire); }), testing::HasSubstr("paper: the number of lugs is not known"));
  tire = paper_tire(LugPattern::straight), tire.lugs.thickness.reset();
  EXPECT_THAT(shape_refusal([&] { tire_surface(tire); }), testing::HasSubstr("the thickness of the lugs is not known"));
  tire = paper_tire(LugPattern::straight), tire.lugs.thickness = 0.078;
  EXPECT_THAT(shape_refusal([&] { tire_surface(tire); }), testing::HasSubstr("leave no gap"));
  tire = paper_tire(LugPattern::chevron), tire.lugs.angle = 1.5;
  EXPECT_THAT(shape_refusal([&] { tire_surface(tire); }), testing::HasSubstr("chevron angle of 1.5"));
  tire = paper_tire(LugPattern::straight), tire.lugs.angle = 0.3;
  EXPECT_THAT(shape_refusal([&] { tire_surface(tire); }), testing::HasSubstr("straight lugs at an angle of 0.3 rad"));
  tire = paper_tire(LugPattern::staggered), tire.lugs.thickness = 0.04;  // half the pitch is 39 mm
  EXPECT_THAT(shape_refusal([&] { tire_surface(tire); }), testing::HasSubstr("leave no gap"));
}

}  // namespace
}  // namespace soilbin::dem
