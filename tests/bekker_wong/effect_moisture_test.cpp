// moisture: dry runs against wet ones.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

OperatingCondition wet(double w) {
  OperatingCondition at = driven();
  at.moisture = w;
  return at;
}

TEST(Moisture, IsSilentAtTheReferenceAndAtAnUnknownMoisture) {
  expect_silent("moisture", wet(0.08));  // the default w_ref
  expect_silent("moisture", driven());
}

// 3 points wetter at 200 Pa a point: c = 1040 + 600 Pa. More cohesion, more thrust and torque.
TEST(Moisture, CohesionByArithmetic) {
  SoilValues soil = sand();
  soil.cohesion = 1640;
  const Reading found = with({"moisture", "cohesion", {{"a", 200}, {"w_ref", 0.05}}}, wet(0.08));
  const Reading expected = roll(soil, {}, wet(0.08));
  EXPECT_NEAR(found.drawbar_pull, expected.drawbar_pull, 1e-9);
  EXPECT_NEAR(found.torque, expected.torque, 1e-9);
  EXPECT_GT(found.drawbar_pull, base(wet(0.08)).drawbar_pull);
  EXPECT_GT(found.torque, base(wet(0.08)).torque);
}

// Cohesion ends at zero: the driest soil has none, and no less.
TEST(Moisture, CohesionNeverTurnsNegative) {
  SoilValues soil = sand();
  soil.cohesion = 0;
  expect_same_bits(with({"moisture", "cohesion", {{"a", 2000}}}, wet(0.0)), roll(soil, {}, wet(0.0)));
}

// exp(-0.1 * 5) of the cohesion is left 5 points above the reference.
TEST(Moisture, ExponentialByArithmetic) {
  SoilValues soil = sand();
  soil.cohesion *= std::exp(-0.5);
  const Reading found = with({"moisture", "cohesion_exponential", {}}, wet(0.13));
  EXPECT_NEAR(found.torque, roll(soil, {}, wet(0.13)).torque, 1e-9);
}

// Peak at 10 %: 6 % and 14 % are alike, both weaker than 10 %; q(.10) - q(.06) = 0.16 of 500 Pa.
TEST(Moisture, CapillaryHasAPeak) {
  const EffectChoice effect{"moisture", "capillary", {{"w_ref", 0.06}, {"w_p", 0.10}}};
  const auto torque = [&](double w) { return with(effect, wet(w)).torque; };
  EXPECT_NEAR(torque(0.06), torque(0.14), 1e-9);
  EXPECT_GT(torque(0.10), torque(0.06));
  SoilValues soil = sand();
  soil.cohesion += 0.16 * 500;
  EXPECT_NEAR(torque(0.10), roll(soil, {}, wet(0.10)).torque, 1e-9);
}

// An optimum at 10 %: 8 % and 12 % are alike, stiffness and cohesion exp(-a 2^2) of what they are there.
TEST(Moisture, OptimumIsAlikeToBothSides) {
  const EffectChoice effect{"moisture", "optimum", {{"a", 0.05}, {"w_o", 0.10}}};
  SoilValues soil = sand();
  const double left = std::exp(-0.2);
  soil.k_c *= left, soil.k_phi *= left, soil.cohesion *= left;
  const Reading expected = roll(soil, {}, wet(0.08)), dry = with(effect, wet(0.08)), damp = with(effect, wet(0.12));
  EXPECT_NEAR(dry.sinkage, expected.sinkage, 1e-12);
  EXPECT_NEAR(dry.torque, expected.torque, 1e-9);
  EXPECT_NEAR(damp.torque, expected.torque, 1e-9);
}

// Water that lubricates (a < 0 by default): less thrust, less torque on the wet side, more on the dry.
TEST(Moisture, WetterIsWeaker) {
  for (const char* form : {"friction", "softening"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"moisture", form, {}};
    EXPECT_LT(with(effect, wet(0.13)).drawbar_pull, base(wet(0.13)).drawbar_pull);
    EXPECT_GT(with(effect, wet(0.03)).drawbar_pull, base(wet(0.03)).drawbar_pull);
  }
}

// k exp(-0.05 * 5): deeper, so more soil to compact and less pull.
TEST(Moisture, WetterIsSofter) {
  const Reading found = with({"moisture", "stiffness", {}}, wet(0.13)), b = base(wet(0.13));
  EXPECT_GT(found.sinkage, b.sinkage);
  EXPECT_LT(found.drawbar_pull, b.drawbar_pull);
  SoilValues soil = sand();
  soil.k_c *= std::exp(-0.25), soil.k_phi *= std::exp(-0.25);
  EXPECT_NEAR(found.sinkage, roll(soil, {}, wet(0.13)).sinkage, 1e-12);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
