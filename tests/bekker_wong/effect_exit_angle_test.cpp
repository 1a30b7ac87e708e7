// exit_angle: where the contact ends decides how much of the load is carried behind the axle.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

RolledWheel rolled(const EffectChoice& choice, const OperatingCondition& at) {
  return wheel_on(sand(), make_effects({choice})).roll(at);
}

// Soil behind the axle carries load and pushes forward: the wheel rides higher and pulls more, at every load and slip.
TEST(ExitAngle, ContactBehindTheAxleLiftsAndPulls) {
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id != "exit_angle") continue;
    SCOPED_TRACE(form.form);
    for (const double load : {200.0, 800.0, 2000.0}) {
      for (const double slip : {0.0, 0.2, 0.6}) {
        const Reading r = with({form.id, form.form, {}}, driven(load, slip)), b = base(driven(load, slip));
        EXPECT_LT(r.sinkage, b.sinkage);
        EXPECT_GT(r.drawbar_pull, b.drawbar_pull);
      }
    }
  }
}

// Soil that leaves early carries less: the wheel sinks and pulls less.
TEST(ExitAngle, LeavingEarlySinks) {
  const EffectChoice early{"exit_angle", "proportional", {{"c3", -0.2}}};
  EXPECT_GT(with(early, driven()).sinkage, base(driven()).sinkage);
  EXPECT_LT(with(early, driven()).drawbar_pull, base(driven()).drawbar_pull);
  EXPECT_GT(rolled(early, driven()).patch.angles.exit, 0.0);
}

// The forms' own equations: 1 - cos theta_2 = lambda z/r; theta_2 = -c3 theta_1; theta_2 = -theta_c.
TEST(ExitAngle, IsWhatTheFormsSay) {
  const RolledWheel rebound = rolled({"exit_angle", "rebound", {{"lambda", 0.5}}}, driven());
  EXPECT_NEAR(1 - std::cos(rebound.patch.angles.exit), 0.5 * rebound.sinkage / radius, 1e-14);
  const RolledWheel share = rolled({"exit_angle", "proportional", {{"c3", 0.3}}}, driven());
  EXPECT_DOUBLE_EQ(share.patch.angles.exit, -0.3 * share.patch.angles.entry);
  EXPECT_DOUBLE_EQ(rolled({"exit_angle", "fixed", {{"theta_c", 0.1}}}, driven()).patch.angles.exit, -0.1);
  // A light wheel whose entry angle is smaller than theta_c stands symmetrically.
  const RolledWheel light = rolled({"exit_angle", "fixed", {{"theta_c", 0.5}}}, driven(50));
  EXPECT_LT(light.patch.angles.entry, 0.5);
  EXPECT_DOUBLE_EQ(light.patch.angles.exit, -light.patch.angles.entry);
}

// theta_m = 0 and lambda = 1 make the pressure symmetric about the axle: no compaction resistance is left.
TEST(ExitAngle, FullReboundTakesTheCompactionResistance) {
  SoilValues soil = sand();
  soil.c1 = soil.c2 = 0;
  const RollingWheel wheel = wheel_on(soil, make_effects({{"exit_angle", "rebound", {{"lambda", 1.0}}}}));
  EXPECT_NEAR(wheel.roll(driven()).forces.compaction, 0.0, 1e-9 * 800);
  EXPECT_LT(wheel_on(soil).roll(driven()).forces.compaction, -100.0);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
