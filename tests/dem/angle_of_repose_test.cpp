// Heaps: one number of several packings, and cylinders that grow until their heap is high enough.
#include "dem/element_tests/angle_of_repose.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scenario/errors.hpp"
#include "scenario/mean_value.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

TEST(OverPackings, TheirScatterIsTheErrorWhereItIsLarger) {
  const Estimate told = mean_of_repeats(std::vector<Estimate>{{1, 0.1}, {3, 0.1}});
  EXPECT_DOUBLE_EQ(told.value, 2);
  EXPECT_DOUBLE_EQ(told.std_error, 1) << "standard deviation sqrt 2, over sqrt 2";
}

TEST(OverPackings, PackingsThatAgreeByChanceKeepTheirOwnErrors) {
  EXPECT_DOUBLE_EQ(mean_of_repeats(std::vector<Estimate>{{2, 0.3}, {2, 0.4}}).std_error, 0.5 / 2);
  EXPECT_DOUBLE_EQ(mean_of_repeats(std::vector<Estimate>{{2, 0.3}}).std_error, 0.3);
}

TEST(HeapsOfRepose, CannotBeFewerThanOne) {
  EXPECT_THROW(heaps_of_repose(test::soft_soil(), {}, 0), InputError);
  EXPECT_THROW(heaps_of_repose(test::soft_soil(), {.lowest = -1}, 1), InputError);
}

// The first heap of a small cylinder is lower than asked; the one that stands is not, and the second packing lies in
// the same cylinder.
TEST(SlowHeapsOfRepose, GrowUntilTheyAreHighEnough) {
  AngleOfReposeSettings small;
  small.radius = 3, small.height = 5;
  WorkOptions how;
  how.threads = 1;
  const AngleOfReposeResult alone = angle_of_repose(test::soft_soil(), small, how);
  small.lowest = 1.2 * alone.height / alone.mean_diameter;
  const std::vector<AngleOfReposeResult> heaps = heaps_of_repose(test::soft_soil(), small, 2, how);
  ASSERT_EQ(heaps.size(), 2U);
  EXPECT_GE(heaps[0].height, small.lowest * heaps[0].mean_diameter);
  EXPECT_GT(heaps[0].grains, alone.grains);
  EXPECT_NEAR(heaps[1].grains, heaps[0].grains, 0.1 * heaps[0].grains);
  EXPECT_EQ(heaps[1].packing, heaps[0].packing + 1);
}

}  // namespace
}  // namespace soilbin::dem
