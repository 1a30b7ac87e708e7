// The section 'granular' of a soil: what its values must agree on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scenario/case.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A soil of grains with these lines more, and these in the contact of two grains.
Soil grains_with(const std::string& lines, const std::string& contact) {
  return parse_soil(make_source_text(
      "format: soilbin-soil/1\nname: sand\ngranular:\n  radius_min: 1 mm\n  radius_max: 2 mm\n  grain_density: 2650 "
      "kg/m^3\n  youngs_modulus: 50 MPa\n  poisson_ratio: 0.25\n" +
          lines + "  grain_grain: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1" + contact +
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

}  // namespace
}  // namespace soilbin
