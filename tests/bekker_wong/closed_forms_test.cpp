// Limits in which the wheel's integrals have closed forms, the envelope formulas, and the source paper's equations.
#include "bekker_wong/closed_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double r = 0.25, b = 0.2, entry = 30 * degree;
const double sinkage = r * (1 - std::cos(entry));

Tire wide_tire() {
  Tire t;
  t.radius = r, t.width = b;
  return t;
}

RolledWheel at_entry(const SoilValues& soil, double slip, double yaw = 0.0, SlipBy by = SlipBy::wheel_plane_speed) {
  OperatingCondition at;
  at.load = 1000, at.slip = slip, at.yaw = yaw, at.slip_by = by;
  return RollingWheel(wide_tire(), soil).at_entry_angle(at, entry);
}

/// Neither friction nor cohesion, greatest stress under the axle: pressure alone.
SoilValues pressure_only(double n) { return {.exponent = n, .k_c = 30e3, .k_phi = 1.35e6, .shear_modulus = 0.01}; }

/// Cohesion alone shears.
SoilValues cohesive(double shear_modulus) {
  return {.exponent = 0.9, .k_phi = 1e6, .cohesion = 5000, .shear_modulus = shear_modulus, .c1 = 0.3, .c2 = 0.2};
}

// The wheel's horizontal pressure is the work of pressing the rut: resistance = b k z^(n+1)/(n+1) for any n.
TEST(ClosedForms, ResistanceIsTheWorkOfCompaction) {
  for (const double n : {0.1, 0.5, 0.8, 1.0, 1.6, 2.0}) {
    const SoilValues soil = pressure_only(n);
    const double expected = b * soil.pressure_modulus(b) * std::pow(sinkage, n + 1) / (n + 1);
    EXPECT_NEAR(-at_entry(soil, 0.2).forces.compaction, expected, 1e-9 * expected) << "n = " << n;
    EXPECT_NEAR(compaction_resistance(soil, b, sinkage), expected, 1e-14 * expected);
  }
}

TEST(ClosedForms, LoadOfAPowerOfOne) {
  const SoilValues soil = pressure_only(1.0);  // k = 30e3/0.2 + 1.35e6 = 1.5e6
  const WheelForces forces = at_entry(soil, 0.2).forces;
  EXPECT_NEAR(forces.vertical, b * 1.5e6 * r * r * (entry / 2 - std::sin(2 * entry) / 4), 1e-10);
  EXPECT_NEAR(forces.vertical, 849.244441, 5e-7);
  EXPECT_NEAR(forces.compaction, -168.273679, 5e-7);
}

TEST(ClosedForms, TorqueOfSaturatedCohesion) {
  const double expected = r * r * b * 5000 * entry;
  EXPECT_NEAR(at_entry(cohesive(1e-12), 0.3).forces.torque, expected, 1e-8 * expected);
  EXPECT_NEAR(at_entry(cohesive(0.02), -1.0).forces.torque, -expected, 1e-12 * expected);  // locked: saturated at any K
}

TEST(ClosedForms, TorqueOfASpinningWheel) {
  for (const double K : {0.001, 0.01, 0.1}) {
    const double expected = r * r * b * 5000 * (entry - K / r * (1 - std::exp(-r * entry / K)));
    EXPECT_NEAR(at_entry(cohesive(K), 1.0).forces.torque, expected, 1e-9 * expected) << "K = " << K;
  }
}

// Dragged sideways with the wheel locked, the shear stress of a cohesive soil is c everywhere, across the wheel.
TEST(ClosedForms, SideForceOfALockedWheelDraggedSideways) {
  const WheelForces forces = at_entry(cohesive(0.02), -1.0, 90 * degree, SlipBy::travel_speed).forces;
  const double expected = r * b * 5000 * entry;
  EXPECT_NEAR(forces.side, expected, 1e-12 * expected);
  EXPECT_NEAR(forces.torque, 0.0, 1e-12 * expected * r);
}

// z = [3 W/((3 - n) b k sqrt(D))]^(2/(2n+1)) at n = 1: [3 W/(2 b k sqrt(D))]^(2/3).
TEST(ClosedForms, BekkersStaticSinkage) {
  const SoilValues soil = pressure_only(1.0);
  const double load = 800, expected = std::cbrt(std::pow(3 * load / (2 * b * 1.5e6 * std::sqrt(2 * r)), 2));
  EXPECT_NEAR(bekker_static_sinkage(soil, r, b, load), expected, 1e-15);
  EXPECT_NEAR(rolling_resistance(soil, r, b, load), b * 1.5e6 * expected * expected / 2, 1e-10);
  SoilValues steep = soil;
  steep.exponent = 3.0;
  EXPECT_THROW(bekker_static_sinkage(steep, r, b, load), InputError);
}

// Bekker's approximation holds for shallow sinkage: it meets the towed frictionless wheel as the load goes to zero.
TEST(ClosedForms, BekkersSinkageIsTheShallowLimit) {
  const SoilValues soil = pressure_only(0.8);
  OperatingCondition at;
  const auto ratio = [&](double load) {
    at.load = load;
    return RollingWheel(wide_tire(), soil).roll(at).sinkage / bekker_static_sinkage(soil, r, b, load);
  };
  const double heavy = ratio(2000), light = ratio(2), lighter = ratio(0.002);
  EXPECT_LT(std::abs(light - lighter), std::abs(heavy - lighter));
  EXPECT_NEAR(lighter, 1.0, 0.03);  // his series in theta_1 is cut after its second term: 2 % low at n = 0.8
}

// Eq. 5's fault, kept as it stands in the paper: its 'slip sinkage' falls with slip.
TEST(PaperEquations, SinkageFallsWithSlip) {
  const SoilValues soil = pressure_only(1.0);
  const double z0 = bekker_static_sinkage(soil, r, b, 800);
  EXPECT_NEAR(paper::sinkage(soil, r, b, 800, 0.2, 0.1), z0 + 0.25 * 0.8 * 0.1, 1e-15);
  EXPECT_LT(paper::sinkage(soil, r, b, 800, 0.6, 0.1), paper::sinkage(soil, r, b, 800, 0.2, 0.1));
}

// A long slope: by its angle of friction without cohesion; with it, where weight and strength on the plane balance.
TEST(InfiniteSlope, SlidesWhereStrengthEqualsWeight) {
  EXPECT_NEAR(infinite_slope_angle(0.0, 0.5, 16e3, 0.3).value(), 0.5, 1e-14);
  const double c = 1e3, phi = 0.5, w = 16e3 * 0.3, slope = infinite_slope_angle(c, phi, 16e3, 0.3).value();
  EXPECT_NEAR(c + w * std::pow(std::cos(slope), 2) * std::tan(phi), w * std::sin(slope) * std::cos(slope), 1e-9 * w);
  EXPECT_GT(slope, 0.5);
  EXPECT_FALSE(infinite_slope_angle(20e3, 0.1, 16e3, 0.3)) << "clay holds";
}

}  // namespace
}  // namespace soilbin::bekker_wong
