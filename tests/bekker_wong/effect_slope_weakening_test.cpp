// slope_weakening: the same wheel on level ground, up, down and across a slope.
#include "bekker_wong/bed_fixture.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition on(double alpha, double beta = 0.0, double slip = 0.4) {
  OperatingCondition at = driven(800, slip);
  at.longitudinal_incline = alpha;
  at.transverse_incline = beta;
  return at;
}

TEST(SlopeWeakening, IsSilentOnLevelGround) { expect_silent("slope_weakening", on(0)); }

// Weaker soil gives less thrust for the same slip and needs less torque; the loss grows with the angle.
TEST(SlopeWeakening, PullAndTorqueFallFurtherThanTheLoadsShare) {
  for (const char* form : {"friction", "strength", "directional"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"slope_weakening", form, {}};
    const auto lost_pull = [&](double a) { return base(on(a)).drawbar_pull - with(effect, on(a)).drawbar_pull; };
    const auto lost_torque = [&](double a) { return base(on(a)).torque - with(effect, on(a)).torque; };
    EXPECT_GT(lost_pull(5 * degree), 0);
    EXPECT_GT(lost_pull(15 * degree), lost_pull(5 * degree));
    EXPECT_GT(lost_torque(15 * degree), lost_torque(5 * degree));
    EXPECT_GT(lost_torque(5 * degree), 0);
  }
}

// On 10 deg with a = 0.5 the friction left is tan(28 deg) - 0.5 tan(10 deg), downhill and on a cross slope as well.
TEST(SlopeWeakening, FrictionByArithmetic) {
  SoilValues soil = sand();
  soil.friction_angle = std::atan(std::tan(28 * degree) - 0.5 * std::tan(10 * degree));
  for (const OperatingCondition& at : {on(10 * degree), on(-10 * degree), on(0, 10 * degree), on(0, -10 * degree)}) {
    const Reading found = with({"slope_weakening", "friction", {}}, at), expected = roll(soil, {}, at);
    EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-9);
    EXPECT_NEAR(found.torque, expected.torque, 1e-9);
  }
}

// A driving wheel pushes soil backward: downhill when it climbs (weaker), uphill when it descends (stronger). Across a
// slope, straight ahead, it pushes nothing sideways: nothing changes.
TEST(SlopeWeakening, DirectionalHelpsAWheelThatDrivesDownhill) {
  const EffectChoice effect{"slope_weakening", "directional", {}};
  EXPECT_LT(with(effect, on(10 * degree)).drawbar_pull, base(on(10 * degree)).drawbar_pull);
  EXPECT_GT(with(effect, on(-10 * degree)).drawbar_pull, base(on(-10 * degree)).drawbar_pull);
  expect_same_bits(with(effect, on(0, 10 * degree)), base(on(0, 10 * degree)));
}

// The slope's shear over its pressure is tan(i), wherever the steepest way leads: a wheel that pushes soil straight
// downhill loses what `friction` takes from all directions.
TEST(SlopeWeakening, DirectionalTakesTheTangentOfTheSteepestAngle) {
  const OperatingCondition at = on(30 * degree, 30 * degree);
  const double along = std::tan(at.longitudinal_incline) / std::cos(at.transverse_incline),
               across = std::tan(at.transverse_incline), steepest = std::hypot(along, across);
  const EffectList effects = make_effects({{"slope_weakening", "directional", {{"a", 1.0}}}});
  ContactPatch patch;
  patch.count = 1;
  patch.sigma[0] = 100, patch.strength[0] = 1000, patch.j_x[0] = along, patch.j_y[0] = across;
  const Tire tire{};
  const std::optional<Bin> no_bin;
  effects.front()->strength(patch, {}, {}, {tire, {}, at, {}, no_bin});
  const double cosine = std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
  EXPECT_NEAR(steepest, std::tan(std::acos(cosine)), 1e-12);
  EXPECT_NEAR(1000 - patch.strength[0], 100 * std::tan(std::acos(cosine)), 1e-9);
}

// Along a cross slope with the left side up, a wheel that points left slides to its own right: the soil holds it to the
// left and is itself pushed right, which is downhill, and is weaker. With the slope the other way it is stronger.
TEST(SlopeWeakening, DirectionalTellsTheSidesApart) {
  const EffectChoice effect{"slope_weakening", "directional", {}};
  OperatingCondition left_up = on(0, 10 * degree), right_up = on(0, -10 * degree);
  left_up.yaw = right_up.yaw = 15 * degree;
  EXPECT_LT(with(effect, left_up).lateral_force, base(left_up).lateral_force);
  EXPECT_GT(with(effect, right_up).lateral_force, base(right_up).lateral_force);
}

// A slope carries less: deeper rut, more soil to compact, less pull.
TEST(SlopeWeakening, BearingSinksDeeper) {
  const Reading found = with({"slope_weakening", "bearing", {}}, on(10 * degree));
  EXPECT_GT(found.sinkage, base(on(10 * degree)).sinkage);
  EXPECT_LT(found.drawbar_pull, base(on(10 * degree)).drawbar_pull);
}

// tan(28 deg) - 2 tan(35 deg) < 0: a twentieth of the friction stays.
TEST(SlopeWeakening, StrengthNeverTurnsNegative) {
  SoilValues soil = sand();
  soil.friction_angle = std::atan(0.05 * std::tan(28 * degree));
  const Reading found = with({"slope_weakening", "friction", {{"a", 2.0}}}, on(35 * degree));
  EXPECT_NEAR(found.torque, roll(soil, {}, on(35 * degree)).torque, 1e-9);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
