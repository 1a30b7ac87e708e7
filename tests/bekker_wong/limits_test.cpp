// The steady questions that ask for a slip or a slope.
#include "bekker_wong/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/bed_fixture.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

using bed::wheel_on;

// A little less than the largest load has a balance, a little more has none.
TEST(Limits, TheLargestLoadIsTheLastThatTheSoilCarries) {
  const RollingWheel wheel = wheel_on(bed::sand());
  OperatingCondition at = bed::driven(100);
  at.slip = 0.2;
  const std::optional<double> most = largest_load(wheel, at, 1e6);
  ASSERT_TRUE(most);
  at.load = *most;
  EXPECT_NO_THROW(wheel.roll(at));
  at.load = 1.001 * *most;
  EXPECT_THROW(wheel.roll(at), NoSolution);
  EXPECT_EQ(largest_load(wheel, at, 0.5 * *most), 0.5 * *most);
}

TEST(Limits, TheSlipFoundGivesThePullAskedFor) {
  const RollingWheel wheel = wheel_on(bed::sand());
  OperatingCondition at = bed::driven(400);
  for (const double slope : {-5 * degree, 0.0, 4 * degree}) {
    at.longitudinal_incline = slope;
    const auto slip = slip_for_pull(wheel, at, 20.0);
    ASSERT_TRUE(slip);
    at.slip = *slip;
    EXPECT_NEAR(wheel.roll(at).reading.drawbar_pull, 20.0, 1e-6);
  }
}

// On firm and on loose soil, on the level and on a slope: braked by no torque, the wheel resists.
TEST(Limits, AFreeWheelHasNoTorqueAndResists) {
  for (const double load : {100.0, 400.0})
    for (const double slope : {0.0, 5 * degree}) {
      const RollingWheel wheel = wheel_on(bed::sand());
      OperatingCondition at = bed::driven(load);
      at.longitudinal_incline = slope;
      const std::optional<double> slip = free_slip(wheel, at);
      ASSERT_TRUE(slip);
      EXPECT_LT(*slip, 0.0);
      at.slip = *slip;
      const Reading free = wheel.roll(at).reading;
      EXPECT_NEAR(free.torque, 0.0, 1e-9 * load * wheel.tire().radius);
      EXPECT_LT(free.drawbar_pull, 0.0);
    }
}

// Steep downhill even half braked wheels are pulled along: the slip lies below -0.5, or there is none.
TEST(Limits, ASteepDescentIsBrakedFurtherOrNotHeld) {
  const RollingWheel wheel = wheel_on(bed::sand());
  OperatingCondition at = bed::driven(400);
  const auto pull = [&](double slip) {
    at.slip = slip;
    return wheel.roll(at).reading.drawbar_pull;
  };
  bool further = false, not_held = false;
  for (double slope = -5; slope > -60; slope -= 1) {
    at.longitudinal_incline = slope * degree;
    const auto slip = slip_for_pull(wheel, at);
    if (slip) {
      EXPECT_NEAR(pull(*slip), 0.0, 1e-6) << slope;
      further |= *slip < -0.5;
    } else {
      EXPECT_GT(pull(-1.0), 0.0) << slope;
      not_held = true;
    }
  }
  EXPECT_TRUE(further);
  EXPECT_TRUE(not_held);
}

// Soft and steep: braked hard the wheel is buried. Where the least braked slip that the soil carries pulls more than is
// asked, no slip pulls that; else the one found does.
TEST(SlowLimits, ASlipBesideABurialPullsWhatIsAskedOrThereIsNone) {
  SoilValues soft = bed::sand();
  soft.k_phi *= 0.1;
  const RollingWheel wheel = wheel_on(soft);
  int found = 0, none = 0;
  for (double load = 100; load < 3000; load *= 1.03)
    for (const double slope : {0.0, -4 * degree, -10 * degree}) {
      OperatingCondition at = bed::driven(load);
      at.longitudinal_incline = slope;
      std::optional<double> slip;
      try {
        slip = slip_for_pull(wheel, at);
      } catch (const NoSolution&) {
        continue;
      }
      if (!slip) {
        ++none;
        continue;
      }
      ++found, at.slip = *slip;
      EXPECT_NEAR(wheel.roll(at).reading.drawbar_pull, 0.0, 1e-6 * load) << load << " " << slope;
    }
  EXPECT_GT(found, 10);
  EXPECT_GT(none, 10);
}

TEST(Limits, OnTheSteepestSlopeTheLargestPullIsNone) {
  const RollingWheel wheel = wheel_on(bed::sand());
  OperatingCondition at = bed::driven(400);
  const auto slope = steepest_slope(wheel, at);
  ASSERT_TRUE(slope);
  at.longitudinal_incline = *slope;
  EXPECT_NEAR(largest_pull(wheel, at).drawbar_pull, 0.0, 1e-6);
  at.longitudinal_incline = *slope + 0.01 * degree;
  EXPECT_FALSE(slip_for_pull(wheel, at));
  at.longitudinal_incline = *slope - 0.01 * degree;
  EXPECT_TRUE(slip_for_pull(wheel, at));
}

// On a hard floor of pure friction, nothing is compacted and full slip calls up sigma tan(phi) everywhere: the pull is
// W tan(phi) and the steepest slope is phi.
TEST(Limits, OnHardGroundTheSteepestSlopeIsTheFrictionAngle) {
  SoilValues hard = bed::sand();
  hard.cohesion = 0.0, hard.k_phi = 1e12, hard.k_c = 0.0, hard.exponent = 1.0, hard.shear_modulus = 1e-7;
  const RollingWheel wheel = wheel_on(hard);
  const auto slope = steepest_slope(wheel, bed::driven(100));
  ASSERT_TRUE(slope);
  EXPECT_NEAR(*slope / degree, 28.0, 0.1);
  EXPECT_NEAR(largest_pull(wheel, bed::driven(100)).drawbar_pull, 100 * std::tan(28 * degree), 0.3);
}

TEST(Limits, APeakInsideTheRangeIsFound) {  // the wheel digs itself in: pull rises, then falls
  const RollingWheel wheel = wheel_on(bed::sand(), make_effects({{"slip_sinkage", "lyasko", {}}}));
  const OperatingCondition at = bed::driven(400);
  const PullPeak peak = largest_pull(wheel, at);
  EXPECT_GT(peak.slip, 0.05);
  EXPECT_LT(peak.slip, 0.95);
  for (const double slip : {peak.slip - 1e-3, peak.slip + 1e-3}) {
    OperatingCondition beside = at;
    beside.slip = slip;
    EXPECT_LT(wheel.roll(beside).reading.drawbar_pull, peak.drawbar_pull);
  }
}

}  // namespace
}  // namespace soilbin::bekker_wong
