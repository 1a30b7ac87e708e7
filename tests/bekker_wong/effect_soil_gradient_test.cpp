// soil_gradient: one end of the bin against the other.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition at_position(double x) {
  OperatingCondition at = driven();
  at.position = x;
  return at;
}

TEST(SoilGradient, IsSilentAtTheReferenceAndAtAnUnknownPosition) {
  expect_silent("soil_gradient", at_position(0.0));  // the default x_ref
  expect_silent("soil_gradient", driven());
}

// Stiffer toward the far end: less sinkage and more pull there, the reverse at the near end.
TEST(SoilGradient, StifferAlongTheBin) {
  for (const char* form : {"stiffness", "stiffness_exponential"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"soil_gradient", form, {{"x_ref", 1.0}}};
    const Reading near = with(effect, at_position(0.0)), far = with(effect, at_position(2.0)), b = base(driven());
    EXPECT_LT(far.sinkage, b.sinkage);
    EXPECT_GT(near.sinkage, b.sinkage);
    EXPECT_GT(far.drawbar_pull, near.drawbar_pull);
  }
}

// A bay: stiffer to both sides of its place, k exp(a d^2).
TEST(SoilGradient, ABayIsAlikeToBothSides) {
  const EffectChoice bay{"soil_gradient", "stiffness_bay", {{"a", 0.05}, {"x_ref", 1.0}}};
  SoilValues stiffer = sand();
  stiffer.k_c *= std::exp(0.2), stiffer.k_phi *= std::exp(0.2);
  const Reading near = with(bay, at_position(-1.0)), far = with(bay, at_position(3.0)), k = roll(stiffer, {}, driven());
  EXPECT_NEAR(near.sinkage, k.sinkage, 1e-12);
  EXPECT_NEAR(far.sinkage, k.sinkage, 1e-12);
  EXPECT_NEAR(far.drawbar_pull, k.drawbar_pull, 1e-9);
}

// Stronger toward the far end: more torque and more pull there.
TEST(SoilGradient, StrongerAlongTheBin) {
  for (const char* form : {"strength", "stiffness_and_strength"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"soil_gradient", form, {{"x_ref", 1.0}}};
    EXPECT_GT(with(effect, at_position(2.0)).drawbar_pull, with(effect, at_position(0.0)).drawbar_pull);
  }
  EXPECT_GT(with({"soil_gradient", "strength", {}}, at_position(2.0)).torque, base(driven()).torque);
}

// 3 m past the reference at 0.1 a metre: k times 1.3.
TEST(SoilGradient, ByArithmetic) {
  SoilValues soil = sand();
  soil.k_c *= 1.3, soil.k_phi *= 1.3;
  const Reading found = with({"soil_gradient", "stiffness", {{"a", 0.1}, {"x_ref", -1.0}}}, at_position(2.0));
  EXPECT_NEAR(found.sinkage, roll(soil, {}, driven()).sinkage, 1e-13);
}

// 1 - 2 * 3 < 0: a twentieth of the strength stays.
TEST(SoilGradient, StrengthNeverTurnsNegative) {
  SoilValues soil = sand();
  soil.cohesion *= 0.05;
  soil.friction_angle = std::atan(0.05 * std::tan(soil.friction_angle));
  const Reading found = with({"soil_gradient", "strength", {{"a", -2.0}}}, at_position(3.0));
  EXPECT_NEAR(found.torque, roll(soil, {}, driven()).torque, 1e-9);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
