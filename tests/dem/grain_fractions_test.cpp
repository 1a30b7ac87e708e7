// Grains of several sizes: put in, settled, and how densely they lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <vector>

#include "dem/bed/bed_store.hpp"
#include "dem/rig/bed_job.hpp"
#include "dem/surface/mass_properties.hpp"
#include "scenario/errors.hpp"
#include "scenario/grain_sizes.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using test::small_recipe;
using test::with_threads;

const std::vector<GrainFraction> three{{0.005, 0.2}, {0.008, 0.5}, {0.011, 0.3}};

BedRecipe recipe_of(std::vector<GrainFraction> sizes, const BedSize& size = {0.2, 0.15, 0.1}) {
  BedRecipe recipe = small_recipe(size);
  set_sizes(recipe.soil, std::move(sizes));
  return recipe;
}

/// Which of the fractions has this radius.
std::size_t fraction_of(double radius, const std::vector<GrainFraction>& fractions) {
  for (std::size_t k = 0; k < fractions.size(); ++k)
    if (std::abs(radius / fractions[k].radius - 1) < 1e-9) return k;
  ADD_FAILURE() << radius << " is no radius of the fractions";
  return 0;
}

// Numbers go as share/r^3: 0.2/125, 0.5/512, 0.3/1331.
TEST(GrainFractions, AreDrawnByTheirNumbers) {
  const RadiusRange radii{three.front().radius, three.back().radius, three};
  const std::array<double, 3> number{0.2 / 125, 0.5 / 512, 0.3 / 1331};
  std::array<int, 3> count{};
  Random random(5);
  constexpr int grains = 20000;
  for (int k = 0; k < grains; ++k) ++count[fraction_of(radii.drawn(random), three)];
  for (std::size_t k = 0; k < 3; ++k) {
    const double p = number[k] / (number[0] + number[1] + number[2]);
    EXPECT_NEAR(count[k] / double{grains}, p, 4 * std::sqrt(p * (1 - p) / grains));
  }
}

// A region of 8 by 8 by 8 whose lower half asks for grains twice as large.
TEST(GrainFractions, FillARegionWithTheirSharesToAGrainWhateverTheirScale) {
  const std::vector<GrainFraction> fractions{{0.1, 0.25}, {0.2, 0.35}, {0.3, 0.4}};
  const auto scale = [](const Vec3& at) { return at.z < 4 ? 2.0 : 1.0; };
  std::array<double, 3> volume{};
  const auto put = [&](const Vec3& at, double radius) {
    volume[fraction_of(radius / scale(at), fractions)] += sphere_volume(radius);
  };
  insert_graded(put, {{0, 0, 0}, {8, 8, 8}}, {{0.1, 0.3, fractions}, scale, 2, 100}, 3);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(volume[k], 100 * fractions[k].share, 2 * sphere_volume(0.6));
}

TEST(GrainFractions, AreInTheKeyOfABedAndOthersStayAsTheyWere) {
  EXPECT_THAT(recipe_text(recipe_of(three)), ::testing::HasSubstr("\nsizes 0.005 0.2 0.008 0.5 0.011 0.3\n"));
  EXPECT_THAT(recipe_text(small_recipe()), ::testing::Not(::testing::HasSubstr("sizes")));
}

TEST(GrainFractions, AreGivenToTheProgramThatSettlesABed) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "soilbin-fractions-job";
  std::filesystem::create_directories(folder);
  const BedRecipe recipe = recipe_of(three);
  write_bed_job(folder, recipe);
  EXPECT_EQ(recipe_text(read_bed_job(folder)), recipe_text(recipe));
  std::filesystem::remove_all(folder);
}

TEST(GrainFractions, WhoseRadiiWereChangedAloneAreRefused) {
  BedRecipe recipe = recipe_of(three);
  recipe.soil.radius_max *= 2;
  EXPECT_THROW(settle_bed(recipe), InputError);
}

TEST(SlowGrainFractions, OfOneSizeSettleToTheBitsOfEqualRadii) {
  BedRecipe uniform = small_recipe();
  uniform.soil.radius_min = uniform.soil.radius_max = 0.01;
  const SettledBed one = settle_bed(recipe_of({{0.01, 1}}), with_threads(1)),
                   equal = settle_bed(uniform, with_threads(1));
  ASSERT_EQ(one.state.grains.count(), equal.state.grains.count());
  for (std::size_t k = 0; k < one.state.grains.count(); ++k)
    EXPECT_EQ(one.state.grains.motion[k].position, equal.state.grains.motion[k].position);
}

// Levelling takes some grains away, of whatever size lies there: a fraction of N grains keeps its share to 1/sqrt(N).
TEST(SlowGrainFractions, MakeUpTheirSharesOfASettledBed) {
  const BedRecipe recipe = recipe_of(three);
  const SettledBed bed = settle_bed(recipe, with_threads(1));
  std::array<double, 3> mass{}, count{};
  double all = 0;
  for (std::size_t k = 0; k < bed.state.grains.count(); ++k) {
    const double radius = bed.state.grains.motion[k].radius, of_grain = sphere_volume(radius);
    const std::size_t fraction = fraction_of(radius, three);
    mass[fraction] += of_grain, all += of_grain, count[fraction] += 1;
  }
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(mass[k] / all, three[k].share, 3 * three[k].share / std::sqrt(count[k])) << count[k];
  EXPECT_NEAR(expected_grains(recipe) / static_cast<double>(bed.state.grains.count()), 1, 0.25);
}

// Small grains fill what large ones leave between them: the wider the sizes, the denser. Settled without friction;
// packings 1 and 2 gave void ratios of 0.407 and 0.409 with three sizes, 0.520 and 0.531 with one.
TEST(SlowGrainFractions, OfWideSizesLieDenserThanOneSize) {
  const auto void_ratio = [&](std::vector<GrainFraction> sizes) {
    BedRecipe recipe = recipe_of(std::move(sizes), {0.2, 0.16, 0.12});
    recipe.soil.youngs_modulus = 2e7;  // a coarse grain lands on a fine one
    recipe.settling_friction = 0;
    return settle_bed(recipe, with_threads(1)).report.void_ratio;
  };
  EXPECT_LT(void_ratio({{0.004, 0.25}, {0.008, 0.25}, {0.012, 0.5}}), void_ratio({{0.008, 1}}) - 0.06);
}

}  // namespace
}  // namespace soilbin::dem
