// Beds with the soil's grains along the middle and coarser ones below and beside them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dem/bed/bed_store.hpp"
#include "dem/bed/insertion.hpp"
#include "dem/rig/dem_model.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

BedRecipe graded_recipe() {
  BedRecipe recipe = test::small_recipe({0.3, 0.4, 0.2});
  recipe.settling_friction = 0;
  recipe.grading = {.factor = 2, .half_width = 0.08, .depth = 0.08, .transition = 0.04};
  return recipe;
}

TEST(GradedBed, SizesGrowFromTheFineZoneOnAndNoFarther) {
  const BedRecipe recipe = graded_recipe();
  const auto scale = [&](double y, double z) { return recipe.grading.scale(recipe.size, y, z); };
  EXPECT_EQ(scale(0.2, 0.19), 1);            // in the middle, at the top
  EXPECT_EQ(scale(0.13, 0.13), 1);           // a corner of the zone
  EXPECT_NEAR(scale(0.2, 0.10), 1.5, 1e-9);  // half of the transition below it: 0.2 - 0.08 - 0.04/2
  EXPECT_NEAR(scale(0.3, 0.19), 1.5, 1e-9);  // half of it aside: 0.2 + 0.08 + 0.04/2
  EXPECT_EQ(scale(0.2, 0.01), 2);
  EXPECT_EQ(scale(0.01, 0.19), 2);
}

TEST(GradedBed, TheZoneFollowsFromTheTire) {
  Tire tire;
  tire.radius = 0.5, tire.width = 0.3;
  const GranularSoil soil = test::soft_soil();  // d = 20 mm
  const Grading grading = grading_for(tire, soil, 2);
  EXPECT_NEAR(grading.half_width, 0.15 + 0.05, 1e-12);  // l = 0.2 m, a quarter of it beside the tire
  EXPECT_NEAR(grading.depth, 0.2, 1e-12);               // and as deep as it is long
  EXPECT_NEAR(grading.transition, 0.04, 1e-12);         // a coarse diameter
  tire.lugs.height = 0.03;
  EXPECT_NEAR(grading_for(tire, soil, 2).depth, 0.23, 1e-12);  // lugs reach deeper by their height
  EXPECT_EQ(grading_for(tire, soil, 1).half_width, 0);
}

// A map varies the lugs' height: one bed, fine as deep as the highest ask for, serves all.
TEST(GradedBed, ServesLowerLugsToo) {
  Scenario scenario;
  scenario.tire.radius = 0.5, scenario.tire.width = 0.3;
  scenario.soil.granular = test::soft_soil();
  DemSettings settings;
  settings.graded = 2, settings.highest_lugs = 0.03;
  const std::string smooth = recipe_text(DemModel(settings).recipe(scenario));
  scenario.tire.lugs = {.height = 0.03, .count = 20, .thickness = 0.01};
  EXPECT_EQ(recipe_text(DemModel(settings).recipe(scenario)), smooth);
  settings.highest_lugs = 0;
  EXPECT_EQ(recipe_text(DemModel(settings).recipe(scenario)), smooth) << "lugs of that height themselves";
  scenario.tire.lugs.height = 0.01;
  EXPECT_NE(recipe_text(DemModel(settings).recipe(scenario)), smooth);
}

TEST(GradedBed, IsAnotherBedThanAUniformOneWhoseKeyStays) {
  BedRecipe recipe = graded_recipe();
  EXPECT_NE(recipe_text(recipe).find("graded 2\n"), std::string::npos);
  recipe.grading = {};
  EXPECT_EQ(recipe_text(recipe).find("graded"), std::string::npos);
  recipe.grading.factor = 5;
  EXPECT_THROW(settle_bed(recipe), InputError);
  recipe.grading.factor = 0.5;
  EXPECT_THROW(settle_bed(recipe), InputError);
}

TEST(GradedBed, IsFilledWithTheSoilsRadiiWhateverTheirScale) {
  const RadiusRange radii{0.8, 1.2};
  const auto scale = [](const Vec3& at) { return at.z < 15 ? 2.0 : 1.0; };
  std::array<int, 4> quarter{};
  const auto put = [&](const Vec3& at, double radius) {
    const double share = (radius / scale(at) - radii.smallest) / (radii.largest - radii.smallest);
    ++quarter.at(static_cast<std::size_t>(4 * share));
  };
  insert_graded(put, {{0, 0, 0}, {40, 40, 40}}, {radii, scale, 2, 0.25 * 64000}, 7);
  const double grains = quarter[0] + quarter[1] + quarter[2] + quarter[3];
  ASSERT_GT(grains, 1500);
  for (const int count : quarter) EXPECT_NEAR(count / grains, 0.25, 4 * std::sqrt(0.25 * 0.75 / grains));
}

TEST(SlowGradedBed, HoldsFineGrainsUnderTheTrackAndCoarseOnesElsewhere) {
  const BedRecipe recipe = graded_recipe();
  const SettledBed bed = settle_bed(recipe, test::with_threads(1));
  EXPECT_NEAR(bed.report.height, recipe.size.depth, 0.002);
  const auto mean_diameter_where = [&](const auto& inside) {
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < bed.state.grains.count(); ++k)
      if (const Motion& grain = bed.state.grains.motion[k]; inside(std::abs(grain.position.y - 0.2), grain.position.z))
        sum += 2 * grain.radius, count += 1;
    return sum / count;
  };
  // Half a coarse diameter within the zones: grains come down a little aside of where they belong.
  EXPECT_NEAR(mean_diameter_where([](double y, double z) { return y < 0.06 && z > 0.14; }), 0.020, 0.001);
  EXPECT_GT(mean_diameter_where([](double y, double z) { return y > 0.14 || z < 0.06; }), 0.035);
  const double grains = static_cast<double>(bed.state.grains.count());
  EXPECT_NEAR(expected_grains(recipe) / grains, 1, 0.25);
}

TEST(SlowGradedBed, IsTheSameForAnyNumberOfThreads) {
  BedRecipe recipe = graded_recipe();
  recipe.size = {0.2, 0.3, 0.16};
  const SettledBed one = settle_bed(recipe, test::with_threads(1)), three = settle_bed(recipe, test::with_threads(3));
  EXPECT_EQ(test::bits(one.state), test::bits(three.state));
}

}  // namespace
}  // namespace soilbin::dem
