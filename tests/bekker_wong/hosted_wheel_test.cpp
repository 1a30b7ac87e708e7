// A wheel whose motion a host gives: steady, it is the static wheel; along a drive's motion it has the drive's forces;
// backward it is the mirrored wheel; and to and fro it never gives the soil's work back.
#include "bekker_wong/transient/hosted_wheel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/drive_fixture.hpp"
#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {
namespace {

using namespace rover;

constexpr double hosted_radius = 0.09;

Drive only_loaded() {
  Drive d;
  d.load = load;
  return d;
}

/// The static wheel at a slip, and the motion that it has at 5 cm/s of rim speed.
RolledWheel static_wheel(double slip) {
  const RollingWheel wheel(scenario().tire, values_of(*scenario().soil.semi_empirical));
  OperatingCondition at;
  at.load = load, at.slip = slip;
  return wheel.roll(at);
}
HostedMotion motion_of(const RolledWheel& wheel, double slip) {
  return {.speed = 0.05 * (1 - slip), .spin = 0.05 / hosted_radius, .depth = wheel.sinkage};
}

TEST(SlowHostedWheel, InSteadyMotionIsTheStaticWheel) {
  for (const double slip : {0.1, 0.4}) {
    const RolledWheel wheel = static_wheel(slip);
    HostedWheel hosted(scenario(), only_loaded(), fine);
    Instant soil;
    for (int i = 0; i < 80; ++i) soil = hosted.advance(0.1, motion_of(wheel, slip));
    EXPECT_NEAR(soil.forward, wheel.reading.drawbar_pull, 2e-5 * load) << slip;
    EXPECT_NEAR(soil.upward, load, 2e-5 * load) << slip;
    EXPECT_NEAR(soil.soil_torque, wheel.reading.torque, 2e-5 * load * hosted_radius) << slip;
    EXPECT_NEAR(soil.contact_slip, slip, 1e-4);
  }
}

TEST(HostedWheel, DoesNotDependOnHowItsStepsAreCut) {
  const HostedMotion motion = motion_of(static_wheel(0.3), 0.3);
  HostedWheel fewer(scenario(), only_loaded(), fine), more(scenario(), only_loaded(), fine);
  const double from = fewer.depth();
  const Instant at_once = fewer.advance(0.4, motion);
  Instant in_parts;
  for (int i = 1; i <= 40; ++i)
    in_parts = more.advance(0.01, {motion.speed, motion.spin, from + (motion.depth - from) * i / 40});
  EXPECT_NEAR(in_parts.forward, at_once.forward, 1e-6 * load);
  EXPECT_NEAR(in_parts.soil_torque, at_once.soil_torque, 1e-6 * load * hosted_radius);
  EXPECT_NEAR(more.given_to_soil(), fewer.given_to_soil(), 1e-6);
}

TEST(SlowHostedWheel, AlongADrivesMotionHasTheDrivesForces) {
  Drive d = drive(0.0, 0.0, 4.0);  // on level ground, where both begin without shear
  const DriveRecord record = drive_wheel(scenario(), d, 2000, fine);
  HostedWheel hosted(scenario(), d, fine);
  double worst = 0.0;
  for (std::size_t i = 1; i < record.samples.size(); ++i) {
    const DriveSample &a = record.samples[i - 1], &b = record.samples[i];
    const Instant soil =
        hosted.advance(b.time - a.time, {(b.travelled - a.travelled) / (b.time - a.time),
                                         0.5 * (a.rim_speed + b.rim_speed) / hosted_radius, b.sinkage});
    worst = std::max(worst, std::abs(soil.forward - b.forward));
  }
  EXPECT_LT(worst, 0.005 * load) << "what it lacks is within a step's change";
  const EnergyLedger& e = record.samples.back().energy;
  EXPECT_NEAR(hosted.given_to_soil(), e.compaction + e.shear + e.added + e.damping, 0.01 * e.motor);
}

TEST(SlowHostedWheel, BackwardIsTheMirroredWheel) {
  const RolledWheel wheel = static_wheel(0.3);
  const HostedMotion ahead = motion_of(wheel, 0.3);
  HostedWheel forward(scenario(), only_loaded(), fine), backward(scenario(), only_loaded(), fine);
  Instant f, b;
  for (int i = 0; i < 80; ++i) {
    f = forward.advance(0.1, ahead);
    b = backward.advance(0.1, {-ahead.speed, -ahead.spin, ahead.depth});
  }
  EXPECT_FALSE(forward.turned_about());
  EXPECT_TRUE(backward.turned_about());
  EXPECT_NEAR(b.forward, -f.forward, 1e-5 * load);
  EXPECT_NEAR(b.upward, f.upward, 1e-5 * load);
  EXPECT_NEAR(b.soil_torque, -f.soil_torque, 1e-5 * load * hosted_radius);
  // And forward again: what was backward is forgotten.
  for (int i = 0; i < 80; ++i) b = backward.advance(0.1, ahead);
  EXPECT_FALSE(backward.turned_about());
  EXPECT_NEAR(b.forward, f.forward, 1e-5 * load);
}

// Each time the slip reverses, the shear that is held goes back once: less than K times the shear force. Over a cycle
// the soil takes work all the same.
TEST(HostedWheel, ToAndFroTheSoilTakesWorkInEveryCycle) {
  const RolledWheel wheel = static_wheel(0.3);
  HostedWheel hosted(scenario(), only_loaded());
  double before = 0.0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (const double direction : {1.0, -1.0})
      for (int i = 0; i < 40; ++i) {
        const HostedMotion there = motion_of(wheel, 0.3);
        hosted.advance(0.05, {direction * there.speed, direction * there.spin, there.depth});
      }
    EXPECT_GT(hosted.given_to_soil(), before + 0.5) << cycle;
    before = hosted.given_to_soil();
  }
}

TEST(HostedWheel, RefusesAMotionThatIsNone) {
  HostedWheel hosted(scenario(), only_loaded());
  EXPECT_THROW(hosted.advance(0.0, {}), InputError);
  EXPECT_THROW(hosted.advance(0.1, {.speed = NAN}), InputError);
  EXPECT_THROW(hosted.advance(0.1, {.depth = 0.95 * hosted_radius}), InputError);
}

}  // namespace
}  // namespace soilbin::bekker_wong
