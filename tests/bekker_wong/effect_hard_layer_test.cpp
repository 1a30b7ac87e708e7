// hard_layer: light wheels against heavy ones over something hard.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

// The layer stiffens what lies deep: a heavy wheel loses a larger share of its sinkage than a light one, and gains more
// pull for its load.
TEST(HardLayer, HeavyWheelsNoticeMore) {
  for (const char* form : {"hyperbolic", "transition"}) {
    SCOPED_TRACE(form);
    const EffectChoice effect{"hard_layer", form, {}};
    const auto lost = [&](double load) { return 1 - with(effect, driven(load)).sinkage / base(driven(load)).sinkage; };
    EXPECT_GT(lost(3000), lost(300));
    EXPECT_GE(lost(300), 0);
    EXPECT_GT(with(effect, driven(3000)).drawbar_pull, base(driven(3000)).drawbar_pull);
  }
}

// Where the wheel stays above the layer nothing changes, to the bit.
TEST(HardLayer, TransitionIsSilentAboveTheLayer) {
  const OperatingCondition at = driven(300);
  const double z = base(at).sinkage;
  expect_same_bits(with({"hard_layer", "transition", {{"d", 1.01 * z}}}, at), base(at));
  EXPECT_LT(with({"hard_layer", "transition", {{"d", 0.5 * z}}}, at).sinkage, z);
}

// A bin 0.1 m deep is a floor at 0.1 m, whatever the parameter says; a deeper bin matters less.
TEST(HardLayer, TheBinsFloorComesFirst) {
  for (const char* form : {"hyperbolic", "logarithmic"}) {
    SCOPED_TRACE(form);
    const OperatingCondition at = driven(2000);
    const Reading in_bin = with({"hard_layer", form, {{"depth", 2.0}}}, at, Bin{.depth = 0.1, .width = 1.0});
    expect_same_bits(in_bin, with({"hard_layer", form, {{"depth", 0.1}}}, at));
    const Reading in_deeper = with({"hard_layer", form, {{"depth", 0.1}}}, at, Bin{.depth = 0.5, .width = 1.0});
    EXPECT_LT(in_bin.sinkage, in_deeper.sinkage);
  }
}

// n = 1, z << z_w: -p_w ln(1 - z/z_w) = p_w z/z_w (1 + z/(2 z_w) + ...): the base model with k + p_w/z_w.
TEST(HardLayer, LogarithmIsAStiffnessFarAboveTheFloor) {
  SoilValues soil = sand(), stiff;
  soil.exponent = 1;
  stiff = soil;
  stiff.k_phi += 1e6 / 5.0;
  const OperatingCondition at = driven(300);
  const EffectList effect = make_effects({{"hard_layer", "logarithmic", {{"p_w", 1e6}, {"depth", 5.0}}}});
  const Reading found = roll(soil, effect, at), expected = roll(stiff, {}, at);
  EXPECT_NEAR(found.sinkage, expected.sinkage, 1e-3 * expected.sinkage);
}

// Past the laws' singularities the tail goes on as a line: soil this soft over a floor at 2 cm holds the wheel up near
// the floor, finitely, and more load still means more depth.
TEST(HardLayer, NoSingularityWithinReach) {
  SoilValues mud = sand();
  mud.k_phi = 2e4;
  double before = 0;
  for (const double load : {200.0, 2000.0, 8000.0}) {
    const Reading r =
        roll(mud, make_effects({{"hard_layer", "logarithmic", {{"p_w", 2e5}, {"depth", 0.02}}}}), driven(load));
    EXPECT_GT(r.sinkage, before);
    EXPECT_TRUE(std::isfinite(r.drawbar_pull));
    before = r.sinkage;
  }
  EXPECT_GT(before, 0.02);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
