// The grid finds what looking at every triangle finds.
#include "dem/surface/triangle_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/plates_of_triangles.hpp"
#include "dem/surface/closest_point.hpp"

namespace soilbin::dem {
namespace {

using tests::Soup;
using tests::uniform;

std::vector<int> plainly_near(const TriangleMesh& mesh, const Vec3& p, double reach) {
  std::vector<int> near;
  ClosestPoint unused;
  for (int t = 0; t < mesh.size(); ++t) {
    if (closest_within(mesh, t, p, reach, unused)) near.push_back(t);
  }
  return near;
}

TEST(TriangleGrid, FindsWhatEveryTriangleTells) {
  std::mt19937_64 random(1);
  for (const double reach : {0.03, 0.2, 5.0}) {
    Soup soup = tests::random_plate(random, 200, 1e-3);
    for (Vec3& v : soup.vertices) v.z = uniform(random, -0.5, 0.5);
    soup = tests::moved(soup, tests::any_rotation(random), 3 * tests::any_direction(random));
    const TriangleMesh mesh(soup.vertices, soup.triangles);
    const TriangleGrid grid(mesh, reach);
    const Vec3 middle = 0.5 * (mesh.bounds().low + mesh.bounds().high);
    std::vector<int> found;
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = middle + uniform(random, 0, 2 + reach) * tests::any_direction(random);
      const double ask = i % 2 ? reach : uniform(random, 0, reach);
      const std::vector<int> expected = plainly_near(mesh, p, ask);
      grid.near(p, ask, found);
      ASSERT_EQ(found, expected);
      hits += !found.empty();
      const auto around = grid.around(p);
      EXPECT_TRUE(std::is_sorted(around.begin(), around.end()));
      const std::vector<int> all = plainly_near(mesh, p, reach);
      EXPECT_TRUE(std::includes(around.begin(), around.end(), all.begin(), all.end()));
    }
    EXPECT_GT(hits, 20);
  }
}

TEST(TriangleGrid, ReachesBeyondTheBoxByItsReachAndNoFarther) {
  const Soup soup = tests::cube();
  const TriangleMesh mesh(soup.vertices, soup.triangles, {.closed = true});
  const TriangleGrid grid(mesh, 0.25);
  EXPECT_FALSE(grid.around({0.2, 0.3, 1.2499999}).empty());
  EXPECT_FALSE(grid.around({-1.2499999, 0.3, 0}).empty());
  EXPECT_TRUE(grid.around({0, 0, 1.26}).empty());
  EXPECT_TRUE(grid.around({0, -1.26, 0}).empty());
  EXPECT_TRUE(grid.around({0, 0, 0}).empty());  // deep inside nothing is near
  EXPECT_TRUE(grid.around({std::nan(""), 0, 0}).empty());
  EXPECT_TRUE(grid.around({1e300, 0, 0}).empty());
}

TEST(TriangleGrid, RefusesAReachThatItCannotHave) {
  const Soup soup = tests::cube();
  const TriangleMesh mesh(soup.vertices, soup.triangles);
  EXPECT_THROW(TriangleGrid(mesh, 0), std::invalid_argument);
  EXPECT_THROW(TriangleGrid(mesh, std::nan("")), std::invalid_argument);
  EXPECT_THROW(TriangleGrid(mesh, std::numeric_limits<double>::infinity()), std::invalid_argument);
  std::vector<int> out;
  EXPECT_THROW(TriangleGrid(mesh, 0.1).near({}, 0.2, out), std::invalid_argument);
}

// A long plate under tiny grains: cells grow instead of filling the memory, and miss nothing.
TEST(TriangleGrid, OfATinyReachStaysSmall) {
  Soup soup = tests::cube();
  const TriangleMesh mesh(soup.vertices, soup.triangles, {.closed = true});
  const TriangleGrid grid(mesh, 1e-3);
  std::mt19937_64 random(2);
  std::vector<int> found;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 0.998, 1.002)};
    grid.near(p, 1e-3, found);
    ASSERT_EQ(found, plainly_near(mesh, p, 1e-3));
  }
}

}  // namespace
}  // namespace soilbin::dem
