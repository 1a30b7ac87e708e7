// bed_tilt: the load's share along a bed that is not level, by hand.
#include "bekker_wong/bed_fixture.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

// 2 deg uphill under 800 N: 800 sin(2 deg) = 27.92 N less pull, the same at every slip, twice as much at twice the
// load; the other channels as they were.
TEST(BedTilt, LeakAlongIsProportionalToLoadAndBlindToSlip) {
  const EffectChoice effect{"bed_tilt", "along", {{"a", 2 * degree}}};
  for (const double load : {800.0, 1600.0})
    for (const double slip : {-0.3, 0.0, 0.5}) {
      const Reading b = base(driven(load, slip)), e = with(effect, driven(load, slip));
      EXPECT_NEAR(e.drawbar_pull - b.drawbar_pull, -load * 0.0348994967025, 1e-6);
      EXPECT_EQ(e.torque, b.torque);
      EXPECT_EQ(e.sinkage, b.sinkage);
      EXPECT_EQ(e.lateral_force, b.lateral_force);
    }
}

// Left side up: 800 sin(2 deg) to the right.
TEST(BedTilt, LeakAcrossGoesIntoTheLateralForce) {
  const Reading b = base(driven()), e = with({"bed_tilt", "across", {{"a", 2 * degree}}}, driven());
  EXPECT_NEAR(e.lateral_force - b.lateral_force, -800 * 0.0348994967025, 1e-9);
  EXPECT_EQ(e.drawbar_pull, b.drawbar_pull);
}

// A bed that leans both ways leaks into both forces: e = -0.5 is half the tilt, right side up.
TEST(BedTilt, LeansInAnyDirection) {
  const Reading b = base(driven()),
                e = with({"bed_tilt", "along_and_across", {{"a", 2 * degree}, {"e", -0.5}}}, driven());
  EXPECT_NEAR(e.drawbar_pull - b.drawbar_pull, -800 * 0.0348994967025, 1e-9);
  EXPECT_NEAR(e.lateral_force - b.lateral_force, 800 * 0.0174524064373, 1e-9);
  EXPECT_EQ(e.torque, b.torque);
}

// A bed of curvature 0.02/m that is level at 1 m rises by 4 % at 3 m and falls by as much at -1 m; where a run has no
// position nothing is known.
TEST(BedTilt, SaggingBedIsLevelAtOnePlace) {
  const EffectChoice effect{"bed_tilt", "sagging", {{"a", 0.02}, {"x_ref", 1.0}}};
  for (const auto& [position, rise] : {std::pair{3.0, 0.04}, {1.0, 0.0}, {-1.0, -0.04}}) {
    OperatingCondition at = driven();
    at.position = position;
    const Reading b = base(at), e = with(effect, at);
    EXPECT_NEAR(e.drawbar_pull - b.drawbar_pull, -800 * rise / std::hypot(1.0, rise), 1e-9);
    EXPECT_EQ(e.sinkage, b.sinkage);
  }
  expect_same_bits(with(effect, driven()), base(driven()));
}

// Yawed by 30 deg to the left and measured in the wheel's plane, the backward force -W sin(a) has cos(30 deg) of itself
// along that plane, and, with the wheel's left pointing partly backward, +sin(30 deg) of it to the wheel's left.
TEST(BedTilt, InTheWheelsAxesItSplits) {
  OperatingCondition at = driven();
  at.yaw = 30 * degree;
  at.force_frame = ForceFrame::wheel;
  const double leak = 800 * std::sin(2 * degree);
  for (const char* form : {"along", "along_with_load"}) {
    SCOPED_TRACE(form);
    const Reading b = base(at), e = with({"bed_tilt", form, {{"a", 2 * degree}}}, at);
    EXPECT_NEAR(e.drawbar_pull - b.drawbar_pull, -leak * std::cos(30 * degree), 0.5);
    EXPECT_NEAR(e.lateral_force - b.lateral_force, leak * 0.5, 0.5);
  }
}

// A bed that truly tilts by a is an incline of a, which the base model knows: every channel agrees, on a slope too.
TEST(BedTilt, TrueTiltIsAnIncline) {
  OperatingCondition at = driven(), tilted = at;
  at.longitudinal_incline = 8 * degree, at.transverse_incline = 4 * degree, at.yaw = 10 * degree;
  tilted = at;
  tilted.longitudinal_incline = 11 * degree;
  const Reading expected = base(tilted), found = with({"bed_tilt", "along_with_load", {{"a", 3 * degree}}}, at);
  EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-3);
  EXPECT_NEAR(found.torque, expected.torque, 1e-9);
  EXPECT_NEAR(found.sinkage, expected.sinkage, 1e-12);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
