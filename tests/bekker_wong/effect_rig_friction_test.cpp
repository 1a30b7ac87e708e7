// rig_friction: torque that never reaches the soil, by hand.
#include <cmath>

#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

double added(const EffectChoice& choice, const OperatingCondition& at) {
  const Reading b = base(at), e = with(choice, at);
  EXPECT_EQ(e.drawbar_pull, b.drawbar_pull);
  EXPECT_EQ(e.sinkage, b.sinkage);
  EXPECT_EQ(e.lateral_force, b.lateral_force);
  return e.torque - b.torque;
}

double added(const char* form, double a, const OperatingCondition& at) {
  return added({"rig_friction", form, {{"a", a}}}, at);
}

TEST(RigFriction, IsSilentAtALockedWheel) { expect_silent("rig_friction", driven(800, -1.0)); }

// The wheel turns forward whether it drives or brakes: friction adds in both.
TEST(RigFriction, CoulombIsTheSameEverywhere) {
  EXPECT_NEAR(added("coulomb", 1.5, driven(800, 0.3)), 1.5, 1e-12);
  EXPECT_NEAR(added("coulomb", 1.5, driven(400, -0.3)), 1.5, 1e-12);
}

// 0.01 * W * r: 0.01 * 800 * 0.25 = 2 N m; half of it at half the load.
TEST(RigFriction, BearingsTakeInProportionToLoad) {
  EXPECT_NEAR(added("load_proportional", 0.01, driven(800)), 2.0, 1e-12);
  EXPECT_NEAR(added("load_proportional", 0.01, driven(400)), 1.0, 1e-12);
}

// 2 N m at 1 kN; at a quarter of the load the same, a half or a quarter for e = 0, 1/2, 1.
TEST(RigFriction, SealsAndABearingTakeByAPowerOfTheLoad) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const EffectChoice both{"rig_friction", "seals_and_bearing", {{"a", 2.0}, {"e", e}}};
    EXPECT_NEAR(added(both, driven(1000)), 2.0, 1e-12);
    EXPECT_NEAR(added(both, driven(250)), 2.0 * std::pow(0.25, e), 1e-12);
  }
}

// Rim speed v/(1 - s): 0.1/(1 - 0.2) = 0.125 m/s driven, 0.1 (1 - 0.2) = 0.08 m/s braked.
TEST(RigFriction, OilTakesInProportionToRimSpeed) {
  EXPECT_NEAR(added("viscous", 8.0, driven(800, 0.2)), 1.0, 1e-12);
  EXPECT_NEAR(added("viscous", 8.0, driven(800, -0.2)), 0.64, 1e-12);
}

TEST(RigFriction, GearsTakeAShareOfTheTorqueInEitherDirection) {
  for (const double slip : {0.4, -0.4}) {
    const double torque = base(driven(800, slip)).torque;
    EXPECT_NEAR(added("transmission", 0.05, driven(800, slip)), 0.05 * std::abs(torque), 1e-12);
  }
  EXPECT_LT(base(driven(800, -0.4)).torque, 0);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
