// The functions over nodes against extended precision, at every length that leaves a remainder, and at their edges.
#include "bekker_wong/node_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "scenario/estimate.hpp"

namespace soilbin::bekker_wong {
namespace {

std::vector<double> spread(int count, double low, double high) {
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(low * std::pow(high / low, (i + 0.5) / count));
  return x;
}

TEST(NodeFunctions, HalfAngle) {
  const std::vector<double> angle = spread(1000, 1e-9, 3.2);
  std::vector<double> sine(angle.size()), cosine(angle.size());
  half_angle(angle, sine, cosine);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const long double half = angle[i] / 2.0L;
    EXPECT_NEAR(sine[i], static_cast<double>(std::sin(half)), 3e-16);
    EXPECT_NEAR(sine[i] / static_cast<double>(std::sin(half)), 1.0, 5e-16);
    EXPECT_NEAR(cosine[i], static_cast<double>(std::cos(half)), 3e-16);
  }
}

TEST(NodeFunctions, ScaledPower) {
  for (const double exponent : {0.1, 0.5, 1.0, 1.37, 2.0}) {
    const std::vector<double> base = spread(1000, 1e-30, 10.0);
    std::vector<double> out(base.size());
    scaled_power(base, exponent, 3.0, out);
    for (std::size_t i = 0; i < base.size(); ++i) {
      const long double expected =
          3.0L * std::pow(static_cast<long double>(base[i]), static_cast<long double>(exponent));
      const double allowed = 1e-15 * (2 + std::abs(exponent * std::log(base[i])));
      EXPECT_NEAR(static_cast<double>(out[i] / expected), 1.0, allowed) << base[i] << '^' << exponent;
    }
  }
}

TEST(NodeFunctions, ScaledPowerAtItsEdges) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> base = {0.0, -1.0, not_a_number, infinity, 1.0};
  std::vector<double> out(base.size());
  scaled_power(base, 0.7, 2.0, out);
  EXPECT_EQ(out[0], 0.0);
  EXPECT_EQ(out[1], 0.0);
  EXPECT_TRUE(std::isnan(out[2]));
  EXPECT_TRUE(std::isnan(out[3]));
  EXPECT_EQ(out[4], 2.0);
}

TEST(NodeFunctions, MobilisedShare) {
  const std::vector<double> j = spread(1000, 1e-12, 1e3), modulus(j.size(), 0.3);
  std::vector<double> out(j.size());
  mobilised_share(j, modulus, out);
  for (std::size_t i = 0; i < j.size(); ++i)
    EXPECT_NEAR(static_cast<double>(out[i] / -std::expm1(-static_cast<long double>(j[i]) / 0.3)), 1.0, 5e-16) << j[i];
}

TEST(NodeFunctions, MobilisedShareAtItsEdges) {
  const std::vector<double> j = {0.0, 1.0, not_a_number}, modulus = {1.0, 1e-300, 1.0};
  std::vector<double> out(j.size());
  mobilised_share(j, modulus, out);
  EXPECT_EQ(out[0], 0.0);
  EXPECT_EQ(out[1], 1.0);
  EXPECT_TRUE(std::isnan(out[2]));
}

TEST(NodeFunctions, Length) {
  const std::vector<double> x = {3, 0, -5}, y = {4, 0, 12};
  std::vector<double> out(x.size());
  length(x, y, out);
  EXPECT_EQ(out, (std::vector<double>{5, 0, 13}));
}

// A node's value must not depend on which neighbours are computed with it.
TEST(NodeFunctions, AValueDoesNotDependOnItsPlace) {
  const std::vector<double> x = spread(37, 1e-3, 2.0);
  std::vector<double> whole(x.size());
  scaled_power(x, 0.83, 1.0, whole);
  for (std::size_t i = 0; i < x.size(); ++i) {
    double alone = 0.0;
    scaled_power({&x[i], 1}, 0.83, 1.0, {&alone, 1});
    EXPECT_EQ(alone, whole[i]);
  }
}

}  // namespace
}  // namespace soilbin::bekker_wong
