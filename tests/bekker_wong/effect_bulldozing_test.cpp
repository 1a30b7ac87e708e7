// bulldozing: the bow wave's resistance.
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/earth_pressure.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

double resistance(const char* form, const OperatingCondition& at, const SoilValues& soil = sand()) {
  const EffectList effect = make_effects({{"bulldozing", form, {{"a", 1.0}}}});
  return roll(soil, {}, at).drawbar_pull - roll(soil, effect, at).drawbar_pull;
}

// phi = 30 deg: N_phi = 3; X = 30 deg, D1 = cot 30 + tan 60 = 2 sqrt 3, D2 = cot 30 + cot^2 30 tan 30 = 2 sqrt 3.
// phi = 0: N_phi = 1, D1 = 2, D2 = 1, K_c = N_c = 1 + 3 pi/2, K_gamma = 8 + 1.
TEST(Bulldozing, EarthPressuresInClosedForm) {
  SoilValues soil{.cohesion = 1000, .friction_angle = 30 * degree, .density = 2000};
  const double d = 0.1, gamma = 2000 * 9.80665;
  EXPECT_NEAR(passive_force(soil, d, 500), 3 * gamma * d * d / 2 + 3 * 500 * d + 2 * 1000 * d * std::sqrt(3), 1e-10);
  EXPECT_NEAR(hegedus_force(soil, d), 2 * std::sqrt(3) * (1000 * d + std::sqrt(3) * gamma * d * d), 1e-10);
  soil.friction_angle = 0;
  EXPECT_NEAR(passive_force(soil, d), gamma * d * d / 2 + 2 * 1000 * d, 1e-10);
  EXPECT_NEAR(hegedus_force(soil, d), 2 * (1000 * d + gamma * d * d / 2), 1e-10);
  EXPECT_NEAR(bearing_factors(0).k_c, 1 + 1.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(bearing_factors(0).k_gamma, 9, 1e-12);
  EXPECT_NEAR(bearing_factors(1e-9).k_c, bearing_factors(0).k_c, 1e-7);
}

// Terzaghi's factors for general shear, by his table: phi = 30 deg N_c = 37.2, N_q = 22.5, so
// K_c = (37.2 - 0.577) 0.75 = 27.5.
TEST(Bulldozing, TerzaghisTable) { EXPECT_NEAR(bearing_factors(30 * degree).k_c, 27.5, 0.1); }

// The resistance is the force of the rut's depth on the wheel's width. Clay, phi = 0, by Bekker:
// b z (2 c K_c + gamma z K_gamma)/2 + gamma z^3 pi/6 + 2 c z^2.
TEST(Bulldozing, ResistanceOfTheRutsDepth) {
  const OperatingCondition at = driven();
  const double z = base(at).sinkage;
  EXPECT_NEAR(resistance("rankine", at), width * passive_force(sand(), z), 1e-9);
  EXPECT_NEAR(resistance("hegedus", at), width * hegedus_force(sand(), z), 1e-9);
  SoilValues clay = sand();
  clay.friction_angle = 0;
  const double d = roll(clay, {}, at).sinkage, gamma = 1600 * 9.80665, c = clay.cohesion;
  EXPECT_NEAR(resistance("bekker", at, clay),
              width * d * (2 * c * (1 + 1.5 * std::numbers::pi) + 9 * gamma * d) / 2 +
                  gamma * d * d * d * std::numbers::pi / 6 + 2 * c * d * d,
              1e-9);
}

// The wave presses through the axle and not downward: torque and sinkage stay to the bit. Deeper ruts push more soil,
// so resistance grows with load; with slip it changes only as the sinkage does.
TEST(Bulldozing, TakesPullAloneAndGrowsWithLoad) {
  for (const char* form : {"hegedus", "bekker", "rankine", "advancing", "power"}) {
    SCOPED_TRACE(form);
    const Reading r = with({"bulldozing", form, {}}, driven()), b = base(driven());
    EXPECT_EQ(r.torque, b.torque);
    EXPECT_EQ(r.sinkage, b.sinkage);
    EXPECT_LT(r.drawbar_pull, b.drawbar_pull);
    EXPECT_GT(resistance(form, driven(1600)), 1.5 * resistance(form, driven(400)));
  }
  EXPECT_NEAR(resistance("hegedus", driven(800, 0.3)) / resistance("hegedus", driven(800, 0.0)), 1.0, 0.1);
  // Hegedus' wedge is heavier than Rankine's.
  EXPECT_GT(resistance("hegedus", driven()), resistance("rankine", driven()));
}

// The wave that only an advancing wheel pushes: all of it while braked or free, 1 - s of it driven, none stuck.
TEST(Bulldozing, AdvancingWave) {
  EXPECT_NEAR(resistance("advancing", driven(400, -0.2)), resistance("rankine", driven(400, -0.2)), 1e-9);
  EXPECT_NEAR(resistance("advancing", driven(800, 0.4)), 0.6 * resistance("rankine", driven(800, 0.4)), 1e-9);
  EXPECT_NEAR(resistance("advancing", driven(500, 1.0)), 0.0, 1e-9);
}

// A power of the sinkage through Rankine's force at a depth of r/5: on clean sand (c = 0) e = 2 is Rankine's law.
TEST(Bulldozing, PowerOfSinkage) {
  SoilValues clean = sand();
  clean.cohesion = 0;
  const auto force = [&](double e, const OperatingCondition& at) {
    const EffectList effect = make_effects({{"bulldozing", "power", {{"a", 1.0}, {"e", e}}}});
    return roll(clean, {}, at).drawbar_pull - roll(clean, effect, at).drawbar_pull;
  };
  const OperatingCondition light = driven(300), heavy = driven(1200);
  EXPECT_NEAR(force(2, heavy), resistance("rankine", heavy, clean), 1e-9);
  const double deeper = roll(clean, {}, heavy).sinkage / roll(clean, {}, light).sinkage;
  for (const double e : {1.0, 2.5}) EXPECT_NEAR(force(e, heavy) / force(e, light), std::pow(deeper, e), 1e-6);
}

// At yaw the wave is met with cos(psi) and turned into the frame of travel by cos(psi) and sin(psi): it takes
// R cos^2(psi) from the pull and R cos(psi) sin(psi) from the force to the left. Sideways there is none.
TEST(Bulldozing, AtYaw) {
  OperatingCondition at = driven(800, 0.3);
  at.yaw = 25 * degree;
  const Reading b = base(at), r = with({"bulldozing", "rankine", {{"a", 1.0}}}, at);
  const double whole = width * passive_force(sand(), b.sinkage), c = std::cos(at.yaw), s = std::sin(at.yaw);
  EXPECT_NEAR(b.drawbar_pull - r.drawbar_pull, whole * c * c, 1e-9);
  EXPECT_NEAR(b.lateral_force - r.lateral_force, whole * c * s, 1e-9);
  at.yaw = 90 * degree;
  at.slip_by = SlipBy::travel_speed;
  EXPECT_NEAR(with({"bulldozing", "rankine", {}}, at).drawbar_pull, base(at).drawbar_pull, 1e-9);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
