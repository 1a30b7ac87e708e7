// The response of 3D-RFT to one element: against the theory's own angles, and its symmetries.
#include "resistive_force/response.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace soilbin::resistive_force {
namespace {

constexpr Vec3 up{0, 0, 1};

Vec3 direction(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

/// Agarwal's formulas as they are printed: a local frame and three angles.
Vec3 generic_by_angles(const Vec3& n, const Vec3& v) {
  const Vec3 horizontal_v{v.x, v.y, 0}, horizontal_n{n.x, n.y, 0};
  Vec3 r{1, 0, 0};
  if (length(horizontal_v) > 1e-12)
    r = dem::unit(horizontal_v);
  else if (length(horizontal_n) > 1e-12)
    r = dem::unit(horizontal_n);
  const Vec3 theta = cross(up, r);
  const double pi = std::numbers::pi;
  const double gamma = (v.z > 0 ? -1 : 1) * std::acos(std::clamp(dot(v, r), -1.0, 1.0));
  const double tilt = std::acos(std::clamp(n.z, -1.0, 1.0));
  const double beta = dot(n, r) >= 0 ? (n.z >= 0 ? -tilt : pi - tilt) : (n.z >= 0 ? tilt : tilt - pi);
  const double psi = length(horizontal_n) > 1e-12 ? std::atan(dot(horizontal_n, theta) / dot(horizontal_n, r)) : 0.0;
  const double x3 = std::cos(psi) * std::cos(gamma) * std::sin(beta) + std::sin(gamma) * std::cos(beta);
  const ResponseFits f = response_fits(std::sin(gamma), std::cos(beta), x3);
  return (f.f1 * std::sin(beta) * std::cos(psi) + f.f2 * std::cos(gamma)) * r +
         f.f1 * std::sin(beta) * std::sin(psi) * theta + (-f.f1 * std::cos(beta) - f.f2 * std::sin(gamma) - f.f3) * up;
}

RC_GTEST_PROP(Response, IsThatOfTheAngles, ()) {
  const auto angle = [](double upper) { return *rc::gen::inRange(1, 9999) * 1e-4 * upper; };
  const double pi = std::numbers::pi;
  const Vec3 n = direction(angle(pi), angle(2 * pi)), v = direction(angle(pi), angle(2 * pi));
  RC_PRE(dot(n, v) > 0.0);
  const Vec3 generic = generic_by_angles(n, v);
  const Response r = response(n, v, up);
  RC_ASSERT(std::abs(length(r.normal) - std::abs(dot(generic, n))) < 1e-12);
  RC_ASSERT(std::abs(length(r.tangential) - length(generic - dot(generic, n) * n)) < 1e-12);
}

TEST(Response, ToAPlatePushedDownIsItsPressureAlone) {
  const Response r = response({0, 0, -1}, {0, 0, -1}, up);
  EXPECT_NEAR(r.normal.z, 0.87504, 1e-12);  // -(f1 + f2 + f3) at x1 = x2 = x3 = 1: sums of the table's rows
  EXPECT_NEAR(length(r.tangential), 0.0, 1e-12);
  EXPECT_EQ(plate_response(), r.normal.z);
}

TEST(Response, IsNoneToWhatMovesAway) {
  EXPECT_EQ(response({0, 0, -1}, {0, 0, 1}, up).normal, Vec3{});
  EXPECT_EQ(response({1, 0, 0}, {-1, 0, 0}, up).tangential, Vec3{});
}

RC_GTEST_PROP(Response, PushesAgainstTheElementAndItsMotion, ()) {
  const auto angle = [](double upper) { return *rc::gen::inRange(1, 9999) * 1e-4 * upper; };
  const double pi = std::numbers::pi;
  const Vec3 n = direction(angle(pi), angle(2 * pi)), v = direction(angle(pi), angle(2 * pi));
  RC_PRE(dot(n, v) > 0.0);
  const Response r = response(n, v, up);
  RC_ASSERT(dot(r.normal, n) <= 0.0);
  RC_ASSERT(dot(r.tangential, v) <= 0.0);
  RC_ASSERT(std::abs(dot(r.tangential, n)) < 1e-12);
}

RC_GTEST_PROP(Response, TurnsAndMirrorsWithTheElement, ()) {
  const auto angle = [](double upper) { return *rc::gen::inRange(1, 9999) * 1e-4 * upper; };
  const double pi = std::numbers::pi;
  const double a = angle(pi), b = angle(2 * pi), c = angle(pi), d = angle(2 * pi), turn = angle(2 * pi);
  const Response one = response(direction(a, b), direction(c, d), up);
  const Response turned = response(direction(a, b + turn), direction(c, d + turn), up);
  const Response mirrored = response(direction(a, -b), direction(c, -d), up);
  const Vec3 sum = one.normal + one.tangential, other = turned.normal + turned.tangential,
             image = mirrored.normal + mirrored.tangential;
  const Vec3 expected{std::cos(turn) * sum.x - std::sin(turn) * sum.y, std::sin(turn) * sum.x + std::cos(turn) * sum.y,
                      sum.z};
  RC_ASSERT(length(other - expected) < 1e-9);
  RC_ASSERT(length(image - Vec3{sum.x, -sum.y, sum.z}) < 1e-9);
}

TEST(Traction, IsBoundedByTheSurfacesFriction) {
  const Response r = response(dem::unit({1, 0, -1}), {1, 0, 0}, up);
  EXPECT_EQ(traction(r, 0.0), r.normal);
  const Vec3 rough = traction(r, 10.0);
  EXPECT_NEAR(length(rough - (r.normal + r.tangential)), 0.0, 1e-15);
  EXPECT_NEAR(length(traction(r, 0.1) - r.normal), 0.1 * length(r.normal), 1e-15);
}

TEST(EstimatedXiN, IsThePublishedPolynomial) {
  EXPECT_NEAR(estimated_xi_n(1500, 0.5, 9.81), 1500 * 9.81 * (894 * 0.125 - 386 * 0.25 + 89 * 0.5), 1e-6);
  EXPECT_NEAR(estimated_xi_n(1310, 0.21, 9.81), 127'826, 1);  // the sand of Agarwal's verification
  EXPECT_EQ(estimated_xi_n(1500, 0.0, 9.81), 0.0);
}

}  // namespace
}  // namespace soilbin::resistive_force
