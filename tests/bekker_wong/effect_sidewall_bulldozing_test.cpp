// sidewall_bulldozing: soil against the wheel's wall.
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/effects/edge.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

const std::string bulldozed = "sidewall_bulldozing";
const char* const bulldozing_forms[] = {"ishigami", "passive_wedge", "side_area"};

OperatingCondition yawed(double yaw_deg, double load = 800, double slip = 0.2) {
  OperatingCondition at = driven(load, slip);
  at.yaw = yaw_deg * degree;
  return at;
}

OperatingCondition across(double beta_deg, double load = 800) {
  OperatingCondition at = driven(load);
  at.transverse_incline = beta_deg * degree;
  return at;
}

double side_gain(const char* form, OperatingCondition at) {
  at.force_frame = ForceFrame::wheel;
  return with({bulldozed, form, {}}, at).lateral_force - base(at).lateral_force;
}

TEST(SidewallBulldozing, IsSilentStraightOnAndOnLevelGround) { expect_silent(bulldozed, driven()); }

// At positive yaw the wheel slides to its right, so the soil pushes it to the left: F_y rises, and the side force's
// component along the travel takes pull. Torque and sinkage stay to the bit. The other yaw mirrors it.
TEST(SidewallBulldozing, PushesAgainstTheSidewaysMotion) {
  for (const char* form : bulldozing_forms) {
    SCOPED_TRACE(form);
    const Reading r = with({bulldozed, form, {}}, yawed(20)), b = base(yawed(20)),
                  l = with({bulldozed, form, {}}, yawed(-20));
    EXPECT_GT(r.lateral_force, b.lateral_force);
    EXPECT_LT(r.drawbar_pull, b.drawbar_pull);
    EXPECT_EQ(r.torque, b.torque);
    EXPECT_EQ(r.sinkage, b.sinkage);
    EXPECT_NEAR(l.lateral_force, -r.lateral_force, 1e-9);
    EXPECT_NEAR(l.drawbar_pull, r.drawbar_pull, 1e-9);
  }
}

// More yaw calls up more, a deeper rut offers more wall, and at full slip the wheel doesn't move sideways at all.
TEST(SidewallBulldozing, GrowsWithYawAndLoadAndFadesAtFullSlip) {
  for (const char* form : bulldozing_forms) {
    SCOPED_TRACE(form);
    EXPECT_GT(side_gain(form, yawed(5)), 0.0);
    EXPECT_GT(side_gain(form, yawed(15)), side_gain(form, yawed(5)));
    EXPECT_GT(side_gain(form, yawed(40)), side_gain(form, yawed(15)));
    EXPECT_GT(side_gain(form, yawed(15, 1600)), 2 * side_gain(form, yawed(15, 400)));
    EXPECT_NEAR(side_gain(form, yawed(15, 500, 1.0)), 0.0, 1e-9);
  }
  // The exponential saturates where the sine of the side area goes on.
  const auto rise = [](const char* form) { return side_gain(form, yawed(50)) / side_gain(form, yawed(25)); };
  EXPECT_LT(rise("passive_wedge"), rise("side_area"));
}

// Left side up: the wheel leans to its right, soil pushes to the left. F_y, by convention the soil's force less the
// load's share along the slope, comes closer to zero and never past it.
TEST(SidewallBulldozing, HoldsOnACrossSlope) {
  for (const char* form : bulldozing_forms) {
    SCOPED_TRACE(form);
    for (const double beta : {3.0, 12.0, 20.0}) {
      const double before = base(across(beta)).lateral_force;
      const double after = with({bulldozed, form, {{"a", 1.0}}}, across(beta)).lateral_force;
      EXPECT_LT(before, 0.0);
      EXPECT_GT(after, before);
      EXPECT_LT(after, 0.0);
      EXPECT_NEAR(with({bulldozed, form, {{"a", 1.0}}}, across(-beta)).lateral_force, -after, 1e-9);
    }
    // A slight slope asks for little, and gets nearly all of it.
    EXPECT_NEAR(with({bulldozed, form, {{"a", 1.0}}}, across(0.1)).lateral_force / base(across(0.1)).lateral_force, 0.0,
                0.05);
  }
}

const char* const rough_forms[] = {"rough_wedge", "rough_area"};

/// A rough wall's row of the budget, in the wheel's axes.
AddedForce rough_wall(const char* form, double mu, const OperatingCondition& at) {
  const EffectList effects = make_effects({{bulldozed, form, {{"a", 1.0}, {"mu", mu}}}});
  return wheel_on(sand(), effects).roll(at).forces.added.rows()[0];
}

// The wall rubs on the soil that it presses: without friction the wedge is the smooth one to the bit, with it a force
// of mu times the pressing, against the wall's motion. Dragged locked at yaw the whole wall moves forward: exactly mu N
// backward. A spinning wheel's buried wall moves backward: forward thrust, paid by the motor.
TEST(SidewallBulldozing, ARoughWallRubs) {
  expect_same_bits(with({bulldozed, "rough_wedge", {{"a", 1.0}, {"mu", 0.0}}}, yawed(20)),
                   with({bulldozed, "passive_wedge", {{"a", 1.0}}}, yawed(20)));
  for (const char* form : rough_forms) {
    SCOPED_TRACE(form);
    const AddedForce dragged = rough_wall(form, 0.3, yawed(30, 200, -1.0));
    EXPECT_NEAR(dragged.forward, -0.3 * dragged.lateral, 1e-12 * dragged.lateral);
    EXPECT_EQ(dragged.vertical, 0.0);
    EXPECT_LT(dragged.torque, 0.0);  // the soil turns it on
    const AddedForce spun = rough_wall(form, 0.3, yawed(30, 400, 0.7));
    EXPECT_GT(spun.forward, 0.0);
    EXPECT_GT(spun.torque, 0.0);
    EXPECT_LE(std::hypot(spun.forward, spun.vertical), 0.3 * spun.lateral * (1 + 1e-12));
    const AddedForce left = rough_wall(form, 0.3, yawed(-30, 400, 0.7));
    EXPECT_NEAR(left.lateral, -spun.lateral, 1e-9);
    EXPECT_NEAR(left.forward, spun.forward, 1e-9);
  }
}

// What the wall rubs away is no more than what the motor gives to it: M w >= F v in its plane.
TEST(SidewallBulldozing, FrictionTakesPower) {
  for (const char* form : rough_forms)
    for (const double slip : {-0.8, -0.3, 0.0, 0.3, 0.8}) {
      const OperatingCondition at = yawed(25, 300, slip);
      const AddedForce f = rough_wall(form, 0.5, at);
      const Kinematics motion = kinematics(at);
      EXPECT_GT(f.torque / radius - f.forward * motion.forward, 0.0) << form << " at slip " << slip;
    }
}

// A wheel that slip has dug in over its axle: the wall is as deep as the circle, up to where it leaves the soil.
TEST(SidewallBulldozing, DepthOfTheWallOverTheAxleIsTheCircles) {
  const OperatingCondition at = driven(800, 0.6);
  const EffectList digs = make_effects({{"slip_sinkage", "reece", {{"h", 0.15}}}});
  Tire tire;
  tire.radius = radius, tire.width = width;
  const RolledWheel w = RollingWheel(tire, sand(), digs).roll(at);
  ASSERT_GT(w.patch.angles.entry, 95 * degree);
  const SoilValues soil = sand();
  const Outline outline{.radius = radius, .width = width, .shear_radius = radius};
  const std::optional<Bin> bin;
  const Surroundings around{tire, soil, w.at, w.motion, bin};
  const Rolling rolling{around, soil, outline, w.patch, w.sinkage};
  const Rim rim(rolling);
  for (int i = 0; i < w.patch.count; ++i)
    EXPECT_NEAR(rim.at(i).depth, radius * (std::cos(w.patch.theta[i]) - std::cos(w.patch.angles.entry)), 1e-8 * radius);
}

// Dragged sideways and locked, all of the wall's buried half segment r^2 (theta_1 - sin theta_1 cos theta_1)/2 takes
// the mean ground pressure W/(b r sin theta_1).
TEST(SidewallBulldozing, ARoughAreaInClosedForm) {
  OperatingCondition at = yawed(90, 300, -1.0);
  at.slip_by = SlipBy::travel_speed;
  const EffectList effects = make_effects({{bulldozed, "rough_area", {{"a", 1.0}, {"mu", 0.0}}}});
  const RolledWheel w = wheel_on(sand(), effects).roll(at);
  const double t = w.balance_angle, wall = radius * radius * (t - std::sin(t) * std::cos(t)) / 2;
  ASSERT_EQ(w.forces.added.rows().size(), 1u);
  EXPECT_NEAR(w.forces.added.rows()[0].lateral, 300 / (width * radius * std::sin(t)) * wall, 1e-7);
}

// tan(psi_s) = v_y/(r w): the rim that stops slides sideways alone.
TEST(SidewallBulldozing, SideAreaHasNoStepAtTheLockedWheel) {
  const auto side = [&](double slip) {
    const RolledWheel w = wheel_on(sand(), make_effects({{bulldozed, "side_area", {}}})).roll(yawed(17, 300, slip));
    return w.forces.added.rows()[0].lateral;
  };
  EXPECT_NEAR(side(-0.999999) / side(-1.0), 1.0, 1e-4);
}

// Closed form: sideways and locked all of the wall's resistance is called up. In weightless clay (phi = 0, gamma = 0)
// Rankine's pressure is 2 c, on the wall's buried half segment r^2 (theta_1 - sin theta_1 cos theta_1)/2.
TEST(SidewallBulldozing, LockedSidewaysInClosedForm) {
  SoilValues clay = sand();
  clay.friction_angle = 0, clay.density = 0, clay.cohesion = 3000;
  OperatingCondition at = yawed(90, 300, -1.0);
  at.slip_by = SlipBy::travel_speed;
  const RolledWheel w = wheel_on(clay, make_effects({{bulldozed, "passive_wedge", {{"a", 1.0}}}})).roll(at);
  const double t = w.balance_angle, wall = radius * radius * (t - std::sin(t) * std::cos(t)) / 2;
  ASSERT_EQ(w.forces.added.rows().size(), 1u);
  EXPECT_NEAR(w.forces.added.rows()[0].lateral, 2 * 3000 * wall, 1e-7);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
