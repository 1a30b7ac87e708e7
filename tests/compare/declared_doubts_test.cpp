// What is doubtful in a soil and a wheel by themselves, and that ordinary ones raise no doubt.
#include "compare/doubts/declared_doubts.hpp"

#include <gmock/gmock.h>

#include "compare/doubts/doubts.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using test::dry_sand;
using test::wheel_on_sand;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Soil soil_of(const SemiEmpiricalSoil& values) {
  Soil soil;
  soil.semi_empirical = values;
  return soil;
}

TEST(DeclaredDoubts, NothingToSayOfAnOrdinarySoil) { EXPECT_TRUE(doubts(soil_of(dry_sand())).empty()); }

// A standard deviation of many times the value is a slip of a unit; what may well be 0 may have one of its size.
TEST(DeclaredDoubts, AStandardDeviationFarBeyondItsValueIsTold) {
  const auto with_sd = [](Estimate SemiEmpiricalSoil::*value, double of, double std_error) {
    SemiEmpiricalSoil soil = dry_sand();
    soil.*value = {of, std_error};
    return doubts(soil_of(soil));
  };
  using S = SemiEmpiricalSoil;
  EXPECT_THAT(with_sd(&S::k_phi, 1.5e6, 1e7), ElementsAre(HasSubstr("standard deviation of k_phi is 6.7 times")));
  EXPECT_THAT(with_sd(&S::k_c, 1e3, 1e6), ElementsAre(HasSubstr("standard deviation of k_c is 1000 times")));
  EXPECT_THAT(with_sd(&S::cohesion, 1e3, 1e5), ElementsAre(HasSubstr("standard deviation of c is 100 times")));
  EXPECT_THAT(with_sd(&S::cohesion, 0, 5e3), ElementsAre(HasSubstr("of c is large beside a value of 0")));
  EXPECT_THAT(with_sd(&S::k_c, 0, 1e6), ElementsAre(HasSubstr("of k_c is large beside a value of 0")));
  EXPECT_THAT(with_sd(&S::stress_angle_c2, 0.3, 3), ElementsAre(HasSubstr("standard deviation of c2 is 10 times")));
  EXPECT_THAT(with_sd(&S::stress_angle_c1, 0.3, 0.15), IsEmpty()) << "as where a file leaves it out";
  EXPECT_THAT(with_sd(&S::k_phi, 1.5e6, 7e5), IsEmpty());
  EXPECT_THAT(with_sd(&S::k_c, 1e3, 2e4), IsEmpty()) << "small beside k_phi";
  EXPECT_THAT(with_sd(&S::cohesion, 100, 500), IsEmpty()) << "little of what sand holds";
}

TEST(DeclaredDoubts, AWheelByItselfIsJudgedToo) {
  Tire tire = wheel_on_sand().tire;
  EXPECT_THAT(doubts(tire), IsEmpty());
  tire.radius = 25;
  EXPECT_THAT(doubts(tire), ElementsAre(StartsWith("the wheel's radius = 2.5e+04 mm is outside 20 .. 2000: ")));
}

TEST(DeclaredDoubts, ASoilThatCarriesNothingIsTold) {
  SemiEmpiricalSoil soil = dry_sand();
  soil.k_c.value = 0.0, soil.k_phi.value = -5.0;
  EXPECT_THAT(doubts(soil_of(soil)), ElementsAre(HasSubstr("carries nothing")));
}

// Grains alone, under a gravity in the wrong unit.
TEST(DeclaredDoubts, AGravityThatNoPlaceHasIsToldOfGrainsToo) {
  Soil soil;
  soil.granular.emplace().gravity = 1.62e-3;
  EXPECT_THAT(doubts(soil), ElementsAre(HasSubstr("gravity = 0.00162 m/s^2 is outside 0.1 .. 25")));
  Case question;
  question.scenario.tire = wheel_on_sand().tire, question.scenario.soil = soil;
  question.study.models = {{ModelKind::dem, {}, ""}};
  EXPECT_THAT(doubts(question, {}), testing::Contains(HasSubstr("gravity = 0.00162 m/s^2")));
}

}  // namespace
}  // namespace soilbin::compare
