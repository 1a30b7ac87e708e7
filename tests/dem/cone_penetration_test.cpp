// A cone pressed into grains: what it refuses, and what the size of its grains changes.
#include <gtest/gtest.h>

#include "dem/element_tests/bevameter_tests.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

ConeSettings small_cone() {
  ConeSettings settings;
  settings.diameter = 5, settings.depth = 0.6, settings.speed = 0.5, settings.samples = 40;
  settings.bed.width = 2.4, settings.bed.depth = 3;
  return settings;
}

TEST(ConePenetration, RefusesWhatMakesNoSense) {
  ConeSettings narrow = small_cone(), deep = small_cone();
  narrow.diameter = 4;
  EXPECT_THROW(cone_penetration(test::soft_soil(), narrow), InputError);
  deep.depth = 1;  // its tip would come to 0.13 of its diameter above the floor
  EXPECT_THROW(cone_penetration(test::soft_soil(), deep), InputError);
}

// Lengths and stiffness four times, times twice: the equations of motion are those of before, so that resistance is
// four times as large at the same depth in diameters, but for what two small beds differ by.
TEST(SlowConePenetration, OfGrainsFourTimesAsLargeHasFourTimesTheResistance) {
  const GranularSoil soil = test::soft_soil();
  GranularSoil large = soil;
  large.radius_min *= 4, large.radius_max *= 4, large.youngs_modulus *= 4;
  const ConeRun one = cone_penetration(soil, small_cone(), test::with_threads(1));
  const ConeRun other = cone_penetration(large, small_cone(), test::with_threads(1));
  EXPECT_GT(one.index, 0);
  EXPECT_NEAR(other.index / one.index, 4, 0.4);
  EXPECT_GT(one.gradient, 0);
  EXPECT_DOUBLE_EQ(other.pressed.diameter, 4 * one.pressed.diameter);
  EXPECT_GE(one.pressed.curve.front().sinkage, 0) << "it counts from where the cone's base is level with the surface";
  EXPECT_NEAR(one.pressed.curve.back().sinkage, 0.6 * one.pressed.diameter, 0.05 * one.pressed.diameter);
}

// Grains that neither rub nor roll hold up a body by their weight alone, once they are pushed aside slowly.
TEST(SlowConePenetration, IsResistedByFriction) {
  GranularSoil rough = test::soft_soil(), smooth = rough;
  smooth.grain_grain.sliding_friction = smooth.grain_grain.rolling_friction = 0;
  EXPECT_GT(cone_penetration(rough, small_cone(), test::with_threads(1)).index,
            2 * cone_penetration(smooth, small_cone(), test::with_threads(1)).index);
}

}  // namespace
}  // namespace soilbin::dem
