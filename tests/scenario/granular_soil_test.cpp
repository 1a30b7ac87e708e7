// The section 'granular' of a soil: what its values must agree on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scenario/case.hpp"
#include "scenario/grain_sizes.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A soil of grains with these lines more, and these in the contact of two grains.
Soil grains_with(const std::string& lines, const std::string& contact,
                 const std::string& radii = "  radius_min: 1 mm\n  radius_max: 2 mm\n") {
  return parse_soil(
      make_source_text("format: soilbin-soil/1\nname: sand\ngranular:\n" + radii +
                           "  grain_density: 2650 kg/m^3\n  youngs_modulus: 50 MPa\n  poisson_ratio: 0.25\n" + lines +
                           "  grain_grain: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1" + contact +
                           "}\n  grain_tire: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1}\n",
                       "sand.yaml"));
}

std::string refused(const std::string& lines, const std::string& contact) {
  return test::refusal([&] { grains_with(lines, contact); });
}

TEST(CohesionOfGrains, IsLinearUnlessAFileNamesJkr) {
  EXPECT_EQ(grains_with("", "").granular->cohesion_law, GrainCohesion::linear);
  EXPECT_EQ(grains_with("", ", cohesion: 20 kJ/m^3").granular->grain_grain.cohesion, 20e3);
  const Soil sticky = grains_with("  cohesion_law: jkr\n", ", work_of_adhesion: 50 J/m^2");
  EXPECT_EQ(sticky.granular->cohesion_law, GrainCohesion::jkr);
  EXPECT_EQ(sticky.granular->grain_grain.work_of_adhesion, 50);
  const Soil again = parse_soil(make_source_text(write_soil(sticky), "again.yaml"));
  EXPECT_EQ(write_soil(again), write_soil(sticky));
  EXPECT_EQ(again.granular->cohesion_law, GrainCohesion::jkr);
}

TEST(CohesionOfGrains, EachLawHasAValueOfItsOwnUnit) {
  const std::string jkr = "  cohesion_law: jkr\n";
  EXPECT_THAT(refused(jkr, ", cohesion: 20 kJ/m^3"),
              AllOf(StartsWith("sand.yaml:4:3: the cohesion of grain_grain is an energy density"),
                    HasSubstr("hint: work_of_adhesion in J/m^2")));
  EXPECT_THAT(refused("", ", work_of_adhesion: 1 J/m^2"),
              AllOf(StartsWith("sand.yaml:4:3: the work_of_adhesion of grain_grain is read by cohesion_law jkr"),
                    HasSubstr("hint: cohesion_law: jkr")));
  EXPECT_THAT(refused(jkr, ""), HasSubstr("cohesion_law jkr needs the work_of_adhesion of a contact"));
  EXPECT_THAT(refused(jkr, ", work_of_adhesion: 1 kJ/m^3"), HasSubstr("expected an energy per area"));
  EXPECT_THAT(refused("  cohesion_law: jrk\n", ""), HasSubstr("unknown word 'jrk', did you mean 'jkr'?"));
}

/// A soil of these radii.
Soil of_sizes(const std::string& radii) { return grains_with("", "", radii); }
std::string refused_sizes(const std::string& radii) {
  return test::refusal([&] { of_sizes(radii); });
}

// 30 % of 1 mm, 50 % of 2 mm, 20 % of 4 mm by mass: numbers as 0.3, 0.5/8, 0.2/64, so 0.82, 0.17 and 0.0085 of all.
TEST(SizesOfGrains, StandInPlaceOfTheRadiiThatFollowFromThem) {
  const std::string sizes =
      "  sizes: [{radius: 1 mm, share: 30 %}, {radius: 2 mm, share: 50 %}, {radius: 4 mm, share: 20 %}]\n";
  const Soil soil = of_sizes(sizes);
  const GranularSoil& grains = *soil.granular;
  EXPECT_EQ(grains.radius_min, 1e-3);
  EXPECT_EQ(grains.radius_max, 4e-3);
  EXPECT_NEAR(mean_diameter(grains), 2 * (0.3 * 1 + 0.5 * 2 + 0.2 * 4) * 1e-3, 1e-15) << "by mass";
  EXPECT_NEAR(mean_cube(grains), 1e-9 / (0.3 + 0.5 / 8 + 0.2 / 64), 1e-20) << "by number";
  const Soil again = parse_soil(make_source_text(write_soil(soil), "again.yaml"));
  EXPECT_EQ(write_soil(again), write_soil(soil));
  ASSERT_EQ(again.granular->sizes.size(), 3U);
  EXPECT_EQ(again.granular->sizes[1].share, 0.5);
  EXPECT_NO_THROW(of_sizes(sizes + "  radius_min: 1 mm\n"));
}

TEST(SizesOfGrains, OfOneFractionAreThoseOfEqualRadii) {
  GranularSoil one;
  set_sizes(one, {{0.0073, 1}});
  GranularSoil uniform;
  uniform.radius_min = uniform.radius_max = 0.0073;
  EXPECT_EQ(mean_diameter(one), mean_diameter(uniform));
  EXPECT_EQ(mean_cube(one), mean_cube(uniform));
}

TEST(SizesOfGrains, GrowAlikeWhereGrainsAreScaled) {
  GranularSoil soil;
  set_sizes(soil, {{0.001, 0.5}, {0.002, 0.5}});
  const double before = mean_diameter(soil), cube = mean_cube(soil);
  scale_sizes(soil, 3);
  EXPECT_NEAR(mean_diameter(soil), 3 * before, 1e-15);
  EXPECT_NEAR(mean_cube(soil), 27 * cube, 1e-20);
  EXPECT_EQ(wrong_in_sizes(soil), "");
}

TEST(SizesOfGrains, MustRiseAndMakeUpTheWhole) {
  EXPECT_THAT(refused_sizes("  sizes: [{radius: 2 mm, share: 50 %}, {radius: 1 mm, share: 50 %}]\n"),
              StartsWith("sand.yaml:4:3: the radii of 'sizes' must rise, and 1 mm follows 2 mm"));
  EXPECT_THAT(refused_sizes("  sizes: [{radius: 1 mm, share: 50 %}, {radius: 2 mm, share: 40 %}]\n"),
              AllOf(HasSubstr("add up to 90 %, not to 100 %"), HasSubstr("hint: each is the mass that its sieve")));
  EXPECT_NO_THROW(of_sizes("  sizes: [{radius: 1 mm, share: 33.3 %}, {radius: 2 mm, share: 66.5 %}]\n"));
  EXPECT_THAT(refused_sizes("  sizes: [{radius: 1 mm, share: 100 %}]\n  radius_max: 2 mm\n"),
              AllOf(HasSubstr("not the smallest and the largest of 'sizes'"), HasSubstr("hint: leave them out")));
  EXPECT_THAT(refused_sizes("  radius_max: 2 mm\n"),
              AllOf(HasSubstr("key 'radius_min' is missing"), HasSubstr("or in their place sizes:")));
}

}  // namespace
}  // namespace soilbin
