// What element tests make of their curves: lines of strength, peaks, residuals, rates.
#include "dem/element_tests/strength_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dem/element_tests/mobilised.hpp"
#include "dem/element_tests/specimen.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

TEST(StrengthLine, GivesBackCohesionAndFrictionAngle) {
  const double c = 3630, phi = 30.72 * degree;
  std::vector<StrengthPoint> points;
  for (const double sigma : {10e3, 20e3, 50e3}) points.push_back({sigma, {c + sigma * std::tan(phi), 100}});
  const StrengthLine line = fit_strength(points);
  EXPECT_NEAR(line.cohesion.value, c, 1e-6);
  EXPECT_NEAR(line.friction_angle.value, phi, 1e-12);
  EXPECT_NEAR(line.chi2, 0, 1e-12);
}

TEST(StrengthLine, CirclesOfMohrGiveBackTheSame) {
  // s = (s1 + s3)/2, t = (s1 - s3)/2 of a soil that fails at s1 = s3 k + 2 c sqrt(k), k = tan^2(45 deg + phi/2).
  const double c = 3630, phi = 30.72 * degree, k = std::pow(std::tan(45 * degree + phi / 2), 2);
  std::vector<StrengthPoint> points;
  for (const double s3 : {10e3, 20e3, 50e3}) {
    const double s1 = s3 * k + 2 * c * std::sqrt(k);
    points.push_back({(s1 + s3) / 2, {(s1 - s3) / 2, 100}});
  }
  const StrengthLine line = fit_circles(points);
  EXPECT_NEAR(line.cohesion.value, c, 1e-6);
  EXPECT_NEAR(line.friction_angle.value, phi, 1e-12);
}

TEST(StrengthLine, TwoPointsCarryTheirErrorsThrough) {
  // With two points the line is exact: b = (y2 - y1)/(x2 - x1), a = y1 - b x1.
  const double x1 = 10e3, x2 = 30e3, e1 = 100, e2 = 200;
  const std::vector<StrengthPoint> points{{x1, {6e3, e1}}, {x2, {16e3, e2}}};
  const StrengthLine line = fit_strength(points);
  const double b = 10e3 / (x2 - x1), db = std::hypot(e1, e2) / (x2 - x1), turn = 1 / (1 + b * b);
  EXPECT_NEAR(line.friction_angle.value, std::atan(b), 1e-12);
  EXPECT_NEAR(line.friction_angle.std_error, turn * db, 1e-12);
  // a = (x2 y1 - x1 y2)/(x2 - x1)
  EXPECT_NEAR(line.cohesion.value, 1000, 1e-6);
  EXPECT_NEAR(line.cohesion.std_error, std::hypot(x2 * e1, x1 * e2) / (x2 - x1), 1e-6);
  const double covariance = -(x2 * e1 * e1 + x1 * e2 * e2) / std::pow(x2 - x1, 2);  // of a and b
  EXPECT_NEAR(line.covariance, turn * covariance, 1e-9);
}

TEST(StrengthLine, ScatterBeyondTheErrorsWidensThem) {
  // Twice each stress, 300 Pa above and below the line: chi2 = 4 (300/100)^2 = 36 at 4 - 2 degrees of freedom.
  const std::vector<StrengthPoint> wide{
      {1e4, {5300, 100}}, {1e4, {4700, 100}}, {3e4, {15300, 100}}, {3e4, {14700, 100}}};
  std::vector<StrengthPoint> close = wide;
  for (StrengthPoint& point : close) point.shear.value = point.normal / 2;
  const StrengthLine scattered = fit_strength(wide), exact = fit_strength(close);
  EXPECT_NEAR(scattered.chi2, 36, 1e-9);
  EXPECT_NEAR(scattered.friction_angle.std_error / exact.friction_angle.std_error, std::sqrt(36 / 2.0), 1e-9);
  EXPECT_NEAR(scattered.covariance / exact.covariance, 36 / 2.0, 1e-9);
}

TEST(StrengthLine, RefusesWhatHasNoLine) {
  EXPECT_THROW(fit_strength(std::vector<StrengthPoint>{{1e4, {5e3, 10}}, {1e4, {6e3, 10}}}), InputError);
  EXPECT_THROW(fit_strength(std::vector<StrengthPoint>{{1e4, {5e3, 10}}, {2e4, {6e3, 0}}}), InputError);
  EXPECT_THROW(fit_strength({}), InputError);
}

TEST(Mobilised, FindsAPlateauAfterAPeak) {
  std::vector<double> way, curve;
  for (int k = 0; k < 100; ++k) {
    way.push_back(0.01 * (k + 1));
    curve.push_back(k >= 20 && k < 30 ? 0.8 : 0.5);
  }
  const Mobilised found = peak_and_residual(way, curve, 0.1, 0.4);
  EXPECT_NEAR(found.peak.value, 0.8, 1e-12);
  EXPECT_NEAR(found.peak_at, 0.255, 1e-12);
  EXPECT_NEAR(found.residual.value, 0.5, 1e-12);
  EXPECT_EQ(found.residual_from, 60u);
}

TEST(Mobilised, TellsHowAStressWasHeldWhereTheStrengthIsRead) {
  std::vector<double> way, strength, stress;
  for (int k = 0; k < 100; ++k) {
    way.push_back(0.01 * (k + 1));
    const bool peak = k >= 20 && k < 30;
    strength.push_back(peak ? 0.8 : 0.5);
    stress.push_back(peak ? 10.3e3 : k >= 60 ? 9.9e3 : 20e3);
  }
  const HeldStress held = held_stress(stress, peak_and_residual(way, strength, 0.1, 0.4), 10e3);
  EXPECT_NEAR(held.at_peak, 10.3e3, 1e-6);
  EXPECT_NEAR(held.at_residual, 9.9e3, 1e-6);
  EXPECT_NEAR(held.error, 0.03, 1e-12);
}

// Grains that give way at a steady speed push a servo's wall off by that speed over its gain; the lead takes that away.
TEST(HeldForce, HasNoErrorAtASteadySpeed) {
  const double asked = 100, stiffness = 1e5, yielding = 0.01, dt = 1e-4;  // [N], [N/m], [m/s], [s]
  Servo servo{.direction = {1, 0, 0}, .target = asked, .gain = 1e-2};
  HeldForce held;
  double force = asked, gap = 0;
  for (int step = 0; step < 20000; ++step) {
    held.aim(servo, asked);
    const double speed = servo.gain * (force - servo.target);
    gap += (yielding - speed) * dt, force = asked + stiffness * gap;
    held.learn(force);
  }
  EXPECT_NEAR(force, asked, 1e-6);
  EXPECT_NEAR(servo.target, asked - yielding / servo.gain, 1e-6);  // off by 1 % without the lead
}

TEST(Rates, InertialNumberAndRateAreInverse) {
  const GranularSoil soil = test::soft_soil();
  EXPECT_NEAR(inertial_number(shear_rate(1e-3, 20e3, soil), 20e3, soil), 1e-3, 1e-15);
  // I = rate d sqrt(rho/p): 1 1/s, 20 mm, 2500 kg/m^3 at 10 kPa.
  EXPECT_NEAR(inertial_number(1, 10e3, soil), 0.02 * 0.5, 1e-12);
}

// Two packings, each on a line of its own through the origin: tan phi = 0.5 and 0.6. All six points scatter about one
// line, but they are two measurements: half of the difference of the two angles.
TEST(StrengthLine, PackingsErrAsAWhole) {
  std::vector<StrengthPoint> points;
  std::vector<std::uint64_t> packings;
  for (const double normal : {1e4, 2e4, 4e4})
    for (const std::uint64_t packing : {1, 2}) {
      points.push_back({normal, {normal * (packing == 1 ? 0.5 : 0.6), 0.001 * normal}});
      packings.push_back(packing);
    }
  const StrengthLine all = fit_strength(points), told = fit_over_packings(points, packings, fit_strength);
  const double apart = std::atan(0.6) - std::atan(0.5);
  EXPECT_EQ(told.friction_angle.value, all.friction_angle.value);
  EXPECT_GT(apart / 2, all.friction_angle_without_cohesion.std_error);
  EXPECT_NEAR(told.friction_angle_without_cohesion.std_error, apart / 2, 1e-12);
  EXPECT_GE(told.friction_angle.std_error, all.friction_angle.std_error);
}

}  // namespace
}  // namespace soilbin::dem
