// What virtual tests of contacts are asked, and what they follow from: no grain moves here.
#include "compare/experiments/element_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/grain_sizes.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::compare {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Soil of_grains(const GranularSoil& grains) {
  Soil soil;
  soil.name = "toy", soil.granular = grains;
  return soil;
}

GranularSoil of_jkr() {
  GranularSoil grains = dem::test::soft_soil();
  grains.cohesion_law = GrainCohesion::jkr, grains.grain_grain.work_of_adhesion = 20;
  return grains;
}

std::string identity_of_test(const GranularSoil& grains, const std::vector<Factor>& factors) {
  ContactQuestion question;
  question.factors = factors;
  question.targets = {{"friction_angle", {0.5, 0.01}, "deg"}};
  return contact_test(of_grains(grains), question).identity;
}

TEST(ContactTests, VaryTheValueOfTheSoilsLawOfCohesion) {
  const auto names = [](const GranularSoil& grains) {
    std::vector<std::string> all;
    for (const Factor& factor : usual_factors(ContactKind::grain_grain, grains)) all.push_back(factor.name);
    return all;
  };
  EXPECT_THAT(names(dem::test::soft_soil()),
              ::testing::ElementsAre("sliding_friction", "rolling_friction", "cohesion"));
  EXPECT_THAT(names(of_jkr()), ::testing::ElementsAre("sliding_friction", "rolling_friction", "work_of_adhesion"));
}

// Kept experiments are found by their identity, so it changes where the new values are asked for, and nowhere else.
TEST(ContactTests, HaveAdhesionAndSizesInTheirIdentityWhereASoilHasThem) {
  const std::vector<Factor> friction{{"sliding_friction", 0.1, 0.9, "-"}};
  const GranularSoil plain = dem::test::soft_soil();
  EXPECT_THAT(identity_of_test(plain, friction), Not(HasSubstr("adhesion")));
  EXPECT_THAT(identity_of_test(plain, friction), Not(HasSubstr("\nsize ")));
  EXPECT_THAT(identity_of_test(of_jkr(), friction), HasSubstr("\nwork_of_adhesion 20"));
  GranularSoil two = plain;
  set_sizes(two, {{0.008, 0.4}, {0.012, 0.6}});
  EXPECT_THAT(identity_of_test(two, friction), HasSubstr("\nsize 0.008\nshare 0.4\nsize 0.012\nshare 0.6"));
}

}  // namespace
}  // namespace soilbin::compare
