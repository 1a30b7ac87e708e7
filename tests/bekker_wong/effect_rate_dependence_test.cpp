// rate_dependence: slow runs against fast ones.
#include "bekker_wong/bed_fixture.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition at_speed(double v, double slip = 0.2) {
  OperatingCondition at = driven(800, slip);
  at.speed = v;
  return at;
}

// Pressure grows with the speed of penetration: the same load is carried at less depth and less soil is compacted. At
// 60 % slip the shear is mobilised in the shorter contact too, so more pull is left.
TEST(RateDependence, FastWheelsSinkLessWherePressureGrowsWithSpeed) {
  for (const char* form : {"grahn", "quasi_static"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"rate_dependence", form, {}};
    const Reading slow = with(effect, at_speed(0.05, 0.6)), fast = with(effect, at_speed(1.0, 0.6));
    EXPECT_LT(fast.sinkage, slow.sinkage);
    EXPECT_GT(fast.drawbar_pull, slow.drawbar_pull);
  }
}

// Only v/v0 counts. At rest (1 + v_z/v0)^m = 1: the plate test's soil, the base model to the bit. Grahn's power is a
// softer soil when v_z < v0 everywhere (v sin(theta) < v0 for v < v0), so the wheel sinks deeper than the base's.
TEST(RateDependence, ReferenceSpeed) {
  const Reading a = with({"rate_dependence", "grahn", {{"v0", 0.1}}}, at_speed(0.3));
  const Reading b = with({"rate_dependence", "grahn", {{"v0", 0.2}}}, at_speed(0.6));
  EXPECT_NEAR(a.sinkage, b.sinkage, 1e-13);
  EXPECT_NEAR(a.drawbar_pull, b.drawbar_pull, 1e-9);
  expect_same_bits(with({"rate_dependence", "quasi_static", {}}, at_speed(0.0)), base(at_speed(0.0)));
  EXPECT_GT(with({"rate_dependence", "grahn", {}}, at_speed(0.1)).sinkage, base(at_speed(0.1)).sinkage);
}

// A stronger soil takes more torque and gives more thrust at the same slip; both grow with speed, and for the cohesion
// with slip too, since the rim slides at r w - v cos(theta) = v (1/(1 - s) - cos(theta)).
TEST(RateDependence, StrengthGrowsWithTheLogarithmOfSpeed) {
  for (const char* form : {"cohesion_log", "shear_log"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"rate_dependence", form, {}};
    const Reading slow = with(effect, at_speed(0.05)), fast = with(effect, at_speed(1.0));
    EXPECT_GT(fast.torque, slow.torque);
    EXPECT_GT(fast.drawbar_pull, slow.drawbar_pull);
  }
  const auto gain = [](double slip) {
    return with({"rate_dependence", "cohesion_log", {}}, at_speed(1.0, slip)).torque - base(at_speed(1.0, slip)).torque;
  };
  EXPECT_GT(gain(0.6), gain(0.2));
}

// The law of cohesion has nothing to act on in soil without cohesion; that of the whole strength has. A decade above
// v0 the latter is 1 + a: tan(phi) and c times 1.1.
TEST(RateDependence, CohesionLogNeedsCohesionAndShearLogIsAFactor) {
  SoilValues dry = sand();
  dry.cohesion = 0;
  const OperatingCondition at = at_speed(1.0);
  expect_same_bits(roll(dry, make_effects({{"rate_dependence", "cohesion_log", {}}}), at), roll(dry, {}, at));
  SoilValues strong = sand();
  strong.cohesion *= 1.1;
  strong.friction_angle = std::atan(1.1 * std::tan(strong.friction_angle));
  const Reading expected = roll(strong, {}, at), found = with({"rate_dependence", "shear_log", {{"a", 0.1}}}, at);
  EXPECT_NEAR(found.torque, expected.torque, 1e-4 * expected.torque);  // v held by hypot(10, 0.01)
  EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-4 * expected.torque / radius);
}

// Resistance 2 * 1600 * b z v^2, four times as large at twice the speed; torque and sinkage don't know of it. At yaw it
// acts against travel: all of it in the drawbar pull along travel, none in the side force.
TEST(RateDependence, InertialResistanceGrowsWithTheSquareOfSpeed) {
  const EffectChoice effect{"rate_dependence", "inertial", {{"a", 2.0}}};
  OperatingCondition at = at_speed(1.5);
  at.yaw = 20 * degree;
  const Reading b = base(at), e = with(effect, at);
  EXPECT_NEAR(b.drawbar_pull - e.drawbar_pull, 2 * 1600 * width * b.sinkage * 1.5 * 1.5, 1e-10);
  EXPECT_NEAR(e.lateral_force, b.lateral_force, 1e-10);
  EXPECT_EQ(e.torque, b.torque);
  EXPECT_EQ(e.sinkage, b.sinkage);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
