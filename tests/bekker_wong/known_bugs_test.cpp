// Bugs found in public codes of this model, each as a test that fails where the bug is present. (The last one of the
// list, too small an active box of grains, belongs to the discrete element model and is tested there.)
#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

using bed::smooth_tire;

/// Wong's dry sand with an exponent of choice.
SoilValues sand(double n = 1.1) {
  SoilValues soil = bed::sand();
  soil.exponent = n;
  return soil;
}

OperatingCondition at_slip(double slip, double load = 800) { return test::condition(load, slip); }

RolledWheel roll(double slip, const SoilValues& soil = sand()) {
  return RollingWheel(smooth_tire(), soil).roll(at_slip(slip));
}

/// Normal stress by the conventions at an angle, from theta_1 and theta_m alone.
double normal_stress(double theta, const ContactAngles& angles, const SoilValues& soil) {
  if (theta < angles.max_stress) theta = angles.entry - theta / angles.max_stress * (angles.entry - angles.max_stress);
  const double k = soil.k_c / 0.1 + soil.k_phi;
  return k * std::pow(0.25 * (std::cos(theta) - std::cos(angles.entry)), soil.exponent);
}

// cos(t) - cos(t1)**n: the power binds tighter than the difference. Invisible at n = 1, so n is 0.5 and 1.6 here.
TEST(KnownBugs, ThePowerTakesTheWholeDifferenceOfCosines) {
  for (const double n : {0.5, 1.6}) {
    const SoilValues soil = sand(n);
    const ContactPatch patch = roll(0.2, soil).patch;
    for (int i = 0; i < patch.count; ++i) {
      const double expected = normal_stress(patch.theta[i], patch.angles, soil);
      EXPECT_NEAR(patch.sigma[i], expected, 1e-7 * expected) << "n " << n << " theta " << patch.theta[i];
    }
  }
}

// A rear stress that drops a term of the mirror angle jumps at theta_m; here it meets the front's there, falls
// monotonically to zero at the exit, and is the front's at the mirror angle.
TEST(KnownBugs, TheRearStressMeetsTheFrontAtTheCrest) {
  const SoilValues soil = sand();
  const ContactPatch patch = roll(0.2, soil).patch;
  double before_crest = 0, behind_crest = 0, nearest_before = 1e9, nearest_behind = 1e9, last = 1e9;
  for (int i = 0; i < patch.count; ++i) {
    const double from_crest = patch.theta[i] - patch.angles.max_stress;
    if (from_crest > 0 && from_crest < nearest_before) nearest_before = from_crest, before_crest = patch.sigma[i];
    if (from_crest < 0 && -from_crest < nearest_behind) nearest_behind = -from_crest, behind_crest = patch.sigma[i];
    if (from_crest < 0) {
      EXPECT_LT(patch.sigma[i], last);
      last = patch.sigma[i];
    }
  }
  const double crest = normal_stress(patch.angles.max_stress, patch.angles, soil);
  EXPECT_NEAR(before_crest / crest, 1, 0.02);
  EXPECT_NEAR(behind_crest / crest, 1, 0.02);
  EXPECT_LT(last, 1e-3 * crest);
}

// sigma = 0 at theta_m exactly (front for theta > theta_m, rear for theta < theta_m, nothing between): with theta_m at
// the exit, a whole side is that one point. No node may be left without stress.
TEST(KnownBugs, NoAngleIsWithoutStress) {
  for (const double c1 : {0.0, 0.3, 1.0}) {
    SoilValues soil = sand();
    soil.c1 = c1, soil.c2 = 0.0;
    const ContactPatch patch = RollingWheel(smooth_tire(), soil).roll(at_slip(0.2, 100)).patch;
    ASSERT_GT(patch.count, 0);
    for (int i = 0; i < patch.count; ++i) EXPECT_GT(patch.sigma[i], 0.0) << "c1 " << c1;
  }
}

// 1 - exp(-|j|/K) without the sign of j makes a braked wheel pull: thrust and torque must be negative there.
TEST(KnownBugs, ABrakedWheelIsHeldBack) {
  for (const double slip : {-0.3, -0.6, -1.0}) {
    const RolledWheel wheel = roll(slip);
    EXPECT_LT(wheel.forces.thrust, 0.0) << slip;
    EXPECT_LT(wheel.reading.torque, 0.0) << slip;
    EXPECT_LT(wheel.reading.drawbar_pull, roll(0.0).reading.drawbar_pull) << slip;
  }
}

// Some codes subtract or force the drawbar pull at zero slip. A wheel without slip still compacts the soil.
TEST(KnownBugs, DrawbarPullAtZeroSlipIsNotZero) {
  const double at_rest = roll(0.0).reading.drawbar_pull;
  EXPECT_LT(at_rest, -0.02 * 800);
  EXPECT_NEAR(roll(1e-9).reading.drawbar_pull, at_rest, 1e-5);
  EXPECT_NEAR(roll(-1e-9).reading.drawbar_pull, at_rest, 1e-5);
}

// Torque read from the wrong joint carries the load's or the drawbar pull's moment. The axle's is that of tau alone: no
// shear strength, no torque; and the slope's share of the load, a force through the axle, leaves it alone.
TEST(KnownBugs, TorqueIsTheMomentOfShearAboutTheAxle) {
  const SoilValues slippery{.exponent = 1, .k_phi = 1e6, .shear_modulus = 0.01, .c1 = 0.3};
  EXPECT_EQ(roll(0.3, slippery).reading.torque, 0.0);
  EXPECT_LT(roll(0.3, slippery).reading.drawbar_pull, 0.0);

  const RolledWheel level = roll(0.3);
  OperatingCondition uphill = at_slip(0.3);
  uphill.longitudinal_incline = 10 * degree;
  uphill.load = 800 / std::cos(10 * degree);
  const Reading climbing = RollingWheel(smooth_tire(), sand()).roll(uphill).reading;
  EXPECT_NEAR(climbing.torque, level.reading.torque, 1e-9);
  EXPECT_NEAR(climbing.drawbar_pull, level.reading.drawbar_pull - 800 * std::tan(10 * degree), 1e-9);

  double moment = 0.0;
  for (int i = 0; i < level.patch.count; ++i) moment += level.patch.arc[i] * level.patch.tau_x[i] * 0.25 * 0.1;
  EXPECT_NEAR(level.reading.torque, moment, 1e-12 * moment);
}

// Pitfall: c1 + c2 |s| above 1 puts theta_m before the entry angle, and the front's length turns negative.
TEST(KnownBugs, TheCrestStaysBehindTheEntry) {
  SoilValues soil = sand();
  soil.c1 = 0.9, soil.c2 = 0.5;
  const ContactAngles angles = RollingWheel(smooth_tire(), soil).roll(at_slip(0.8, 100)).patch.angles;
  EXPECT_NEAR(angles.max_stress, 0.98 * angles.entry, 1e-15);
}

// Pitfall: k_c is divided by the wheel's width here, by the plate's radius in a plate fit. A wheel twice as wide on a
// soil without k_phi has half the modulus, and the same load sinks it as deep.
TEST(KnownBugs, KcGoesWithTheWheelsWidth) {
  SoilValues soil = sand();
  soil.k_c = 150e3, soil.k_phi = 0, soil.cohesion = 0;
  const Reading narrow = RollingWheel(smooth_tire(0.25, 0.1), soil).roll(at_slip(0.2)).reading;
  const Reading wide = RollingWheel(smooth_tire(0.25, 0.2), soil).roll(at_slip(0.2)).reading;
  EXPECT_NEAR(wide.sinkage, narrow.sinkage, 1e-12);
  EXPECT_NEAR(wide.drawbar_pull, narrow.drawbar_pull, 1e-9);
}

}  // namespace
}  // namespace soilbin::bekker_wong
