// Beds: measured as geometry says, at rest, level, the same each time, and found again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "dem/archive/restart.hpp"
#include "dem/bed/bed_store.hpp"
#include "dem/bed/relative_density.hpp"
#include "dem/bed/settled_bed.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using test::small_recipe;
using test::with_threads;

Grains one_grain(const Vec3& at, double radius) {
  Grains grains;
  grains.add({.radius = radius, .position = at});
  return grains;
}

const SettledBed& small_bed() {
  static const SettledBed bed = settle_bed(small_recipe(), with_threads(1));
  return bed;
}

double weight_of(const SettledBed& bed) {
  double mass = 0;
  for (std::size_t k = 0; k < bed.state.grains.count(); ++k) mass += 1 / bed.state.grains.motion[k].inverse_mass;
  return mass * bed.recipe.gravity;
}

/// Nine grains of ten spin slower [rad/s]. One that spins about the normal of its only contact goes on: nothing twists.
double spin_after(const SettledBed& bed, double time) {
  Simulation simulation(bed.setup, bed.state);
  simulation.run(std::llround(time / bed.setup.numerics.dt));
  std::vector<double> spins;
  for (const GrainNow& grain : simulation.grains()) spins.push_back(length(grain.spin));
  std::sort(spins.begin(), spins.end());
  return spins[spins.size() * 9 / 10];
}

TEST(SlowSettledBed, StopsRockingByTheDashpotOfRolling) {
  ASSERT_EQ(small_bed().setup.laws.rolling, RollingLaw::elastic_plastic);
  const double early = spin_after(small_bed(), 0.25), late = spin_after(small_bed(), 1);
  EXPECT_LT(late, 0.05 * early);
  BedRecipe rocking = small_recipe();
  rocking.soil.grain_grain.rolling_damping = 0;
  EXPECT_GT(spin_after(settle_bed(rocking, with_threads(1)), 1), 20 * late);
}

TEST(SurfaceHeight, OfOneGrainIsItsUpperHalf) {
  const double r = 0.02, z = 0.05;
  const SurfaceHeight seen = surface_height(one_grain({0.1, 0.1, z}, r), {0.1 - r, 0.1 + r, 0.1 - r, 0.1 + r}, r / 100);
  EXPECT_NEAR(seen.highest(), z + r, 1e-5);
  // The circle's share of the square bears the middle height z and half a ball on it.
  EXPECT_NEAR(seen.mean(), (pi * r * r * z + 2.0 / 3 * pi * r * r * r) / (4 * r * r), 3e-5);
}

TEST(SurfaceHeight, HidesWhatLiesUnderneath) {
  Grains grains = one_grain({0, 0, 0.05}, 0.02);
  grains.add({.id = 1, .radius = 0.01, .position = {0, 0, 0.01}});
  EXPECT_EQ(surface_height(grains, {-0.02, 0.02, -0.02, 0.02}, 1e-3).mean(),
            surface_height(one_grain({0, 0, 0.05}, 0.02), {-0.02, 0.02, -0.02, 0.02}, 1e-3).mean());
}

TEST(SolidFraction, OfAGrainInsideAndHalfInside) {
  const Region cube{{0, 0, 0}, {0.1, 0.1, 0.1}};
  const double ball = 4.0 / 3 * pi * 0.03 * 0.03 * 0.03 / 1e-3;
  EXPECT_NEAR(solid_fraction(one_grain({0.05, 0.05, 0.05}, 0.03), cube, 1e-3), ball, 1e-3 * ball);
  EXPECT_NEAR(solid_fraction(one_grain({0.1, 0.05, 0.05}, 0.03), cube, 1e-3), ball / 2, 1e-3 * ball);
  EXPECT_EQ(solid_fraction(one_grain({0.2, 0.05, 0.05}, 0.03), cube, 1e-3), 0);
}

TEST(SlowSettledBed, IsAtRestAndLevel) {
  const BedReport& report = small_bed().report;
  EXPECT_LT(report.unrest.kinetic, 1e-6);
  EXPECT_LT(report.unrest.unbalanced, 0.03);
  // Levelling takes whole grains away: the mean moves by less than a grain's share of it.
  EXPECT_NEAR(report.height, 0.1, 0.002);
  EXPECT_GT(report.coordination, 3.5);
  EXPECT_LT(report.coordination, 6);
  EXPECT_GT(report.void_ratio, 0.5);
  EXPECT_LT(report.void_ratio, 1.0);
}

TEST(SlowSettledBed, FloorAndWallsBearItsWeight) {
  const SettledBed& bed = small_bed();
  double borne = 0;
  for (const Contact& contact : Simulation(bed.setup, bed.state).contacts())
    if (contact.second == -1 - bin_body) borne += contact.force.z;
  EXPECT_NEAR(borne, weight_of(bed), 0.005 * weight_of(bed));
}

TEST(SlowSettledBed, IsTheSameForAnyNumberOfThreads) {
  const BedRecipe recipe = small_recipe({0.1, 0.1, 0.06});
  const SettledBed one = settle_bed(recipe, with_threads(1)), two = settle_bed(recipe, with_threads(2));
  ASSERT_EQ(two.state.grains.count(), one.state.grains.count());
  for (std::size_t k = 0; k < two.state.grains.count(); ++k)
    ASSERT_EQ(two.state.grains.motion[k].position, one.state.grains.motion[k].position);
}

TEST(SlowSettledBed, IsDenserWhereGrainsSlideAsTheyFall) {
  BedRecipe slippery = small_recipe();
  slippery.settling_friction = 0;
  EXPECT_LT(settle_bed(slippery, with_threads(1)).report.void_ratio, small_bed().report.void_ratio - 0.05);
}

TEST(SettledBed, RefusesWhatMakesNoSense) {
  BedRecipe flat = small_recipe({0.2, 0.15, 0.01});
  EXPECT_THROW(settle_bed(flat), InputError);
  BedRecipe none = small_recipe();
  none.soil.radius_min = 0;
  EXPECT_THROW(settle_bed(none), InputError);
}

TEST(SettledBed, StopsWhenAsked) {
  std::stop_source source;
  WorkOptions how = with_threads(1);
  how.stop = source.get_token();
  how.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "settling");
    source.request_stop();
  };
  EXPECT_THROW(settle_bed(small_recipe(), how), Stopped);
}

TEST(ContentKey, FollowsFromTheGrainsAndNotFromTheTire) {
  const BedRecipe recipe = small_recipe();
  BedRecipe other = recipe;
  other.soil.grain_tire.sliding_friction = 0.9;
  EXPECT_EQ(content_key(recipe), content_key(other));
  other.soil.grain_grain.sliding_friction = std::nextafter(recipe.soil.grain_grain.sliding_friction, 1);
  EXPECT_NE(content_key(recipe), content_key(other));
  other = recipe;
  other.packing = 2;
  EXPECT_NE(content_key(recipe), content_key(other));
}

TEST(BedKey, CohesionOfGrainsIsPartOfItAndSwitchesItsLawOn) {
  BedRecipe dry = small_recipe(), moist = dry;
  moist.soil.grain_grain.cohesion = 2e5;
  EXPECT_NE(content_key(dry), content_key(moist));
  EXPECT_EQ(with_cohesion_of(dry.soil.grain_grain, dry.laws).cohesion, CohesionLaw::none);
  EXPECT_EQ(with_cohesion_of(moist.soil.grain_grain, moist.laws).cohesion, CohesionLaw::linear);
  moist.laws.cohesion = CohesionLaw::jkr;
  EXPECT_EQ(with_cohesion_of(moist.soil.grain_grain, moist.laws).cohesion, CohesionLaw::jkr);
  EXPECT_EQ(interaction_of(moist.soil.grain_grain).cohesion, 2e5);
}

class SlowBedStore : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("soilbin-bed-store-" + std::to_string(::getpid()));
};

TEST_F(SlowBedStore, FindsABedAgainToTheBit) {
  const auto made = BedStore(folder_).bed(small_recipe(), with_threads(1));
  BedStore store(folder_);
  ASSERT_TRUE(std::filesystem::exists(store.file(small_recipe())));
  const auto found = store.bed(small_recipe(), with_threads(1));
  Simulation one(made->setup, made->state), other(found->setup, found->state);
  one.run(50), other.run(50);
  for (std::size_t k = 0; k < one.state().grains.count(); ++k)
    ASSERT_EQ(one.state().grains.motion[k].position, other.state().grains.motion[k].position);
  EXPECT_EQ(found->report.settling_time, made->report.settling_time);
  EXPECT_EQ(found->report.void_ratio, made->report.void_ratio);
  EXPECT_EQ(store.bed(small_recipe()), found);
}

TEST_F(SlowBedStore, ABedThatCannotBeKeptIsUsedAndThatIsTold) {
  std::ofstream(folder_) << "in the way";
  WorkOptions how = with_threads(1);
  std::string told;
  how.tell = [&](const std::string& words) { told += words; };
  EXPECT_EQ(BedStore(folder_).bed(small_recipe(), how)->state.grains.count(), small_bed().state.grains.count());
  EXPECT_THAT(told, ::testing::HasSubstr("the bed isn't kept"));
}

TEST(Bed, ATimeStepThatGetsNowhereIsRefused) {
  BedRecipe recipe = small_recipe();
  recipe.dt = 1e-300;
  EXPECT_THROW(settle_bed(recipe, with_threads(1)), InputError);
  recipe.dt = 0;
  EXPECT_THROW(settle_bed(recipe, with_threads(100000)), InputError);
}

TEST_F(SlowBedStore, SettlesAnewWhereTheFileIsDamaged) {
  BedStore store(folder_);
  std::filesystem::create_directories(folder_);
  std::ofstream(store.file(small_recipe())) << "not a bed";
  EXPECT_EQ(store.bed(small_recipe(), with_threads(1))->state.grains.count(), small_bed().state.grains.count());
  EXPECT_GT(std::filesystem::file_size(store.file(small_recipe())), 1000);
}

// A bed whose seal fits, made by somebody else: it is settled anew, and that is told.
TEST_F(SlowBedStore, SettlesAnewWhatItsRecipeDoesNotGive) {
  const auto right = BedStore(folder_).bed(small_recipe(), with_threads(1));
  const auto file = BedStore(folder_).file(small_recipe());
  const std::string good = test::read_bytes(file);
  const Restart kept = read_restart(file);
  const auto expect_settled_anew = [&](const std::function<void(Restart&)>& change) {
    Restart forged = kept;
    change(forged);
    write_restart(file, forged.setup, forged.state, forged.notes, Keep::nothing);
    std::string told;
    WorkOptions how = with_threads(1);
    how.tell = [&](const std::string& words) { told += words; };
    const auto bed = BedStore(folder_).bed(small_recipe(), how);
    EXPECT_EQ(test::Bits(bed->state), test::Bits(right->state));
    EXPECT_THAT(told, testing::AllOf(testing::HasSubstr(file.string()), testing::HasSubstr("settled anew")));
    EXPECT_EQ(test::read_bytes(file), good);
  };
  expect_settled_anew([](Restart& bed) { bed.state.grains.motion[5].position.z = not_a_number; });
  expect_settled_anew([](Restart& bed) {
    bed.setup.numerics.dt /= 2;
    for (Motion& grain : bed.state.grains.motion) grain.radius *= 1.5;
  });
}

TEST(RelativeDensity, RunsFromTheLoosestToTheDensest) {
  const DensityLimits limits{.loosest = 0.8, .densest = 0.5};
  EXPECT_DOUBLE_EQ(relative_density(0.8, limits), 0);
  EXPECT_DOUBLE_EQ(relative_density(0.5, limits), 1);
  EXPECT_NEAR(relative_density(0.71, limits), 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(relative_density(0.6, {0.6, 0.6})));
}

TEST(RelativeDensity, CountsFromBedsThatSettleUnderTheSoilsOwnGravity) {
  GranularSoil soil = test::soft_soil();
  for (const BedRecipe& recipe : limit_beds(soil)) EXPECT_EQ(recipe.gravity, 9.81);
  soil.gravity = 1.62;
  for (const BedRecipe& recipe : limit_beds(soil)) EXPECT_EQ(recipe.gravity, 1.62);
}

// The limits' own beds lie at 0 and 1, friction that keeps grains from sliding lies between, and what is not made yet
// is not made by asking whether it is known.
TEST(SlowRelativeDensity, OfABedByNameLiesBetweenItsLimits) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("relative-density-" + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const GranularSoil soil = test::soft_soil();
  BedStore store(folder);
  EXPECT_FALSE(known_density_limits(soil, store));
  const DensityLimits limits = density_limits(soil, store, with_threads(1));
  EXPECT_GT(limits.loosest, limits.densest + 0.05);
  BedStore again(folder);
  const auto known = known_density_limits(soil, again);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->loosest, limits.loosest);
  EXPECT_EQ(known->densest, limits.densest);
  std::vector<double> densities;
  for (const NamedDensity& name : named_densities) {
    BedRecipe recipe = limit_beds(soil)[0];
    recipe.settling_friction = name.settling_friction;
    densities.push_back(relative_density(store.bed(recipe, with_threads(1))->report.void_ratio, limits));
  }
  EXPECT_DOUBLE_EQ(densities[0], 0) << "loose";
  EXPECT_GT(densities[1], 0.2) << "medium";
  EXPECT_LT(densities[1], 0.8) << "medium";
  EXPECT_DOUBLE_EQ(densities[2], 1) << "dense";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace soilbin::dem
