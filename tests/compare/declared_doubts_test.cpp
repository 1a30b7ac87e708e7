// What is doubtful in a soil and a wheel by themselves, and that ordinary ones raise no doubt.

#include <gmock/gmock.h>

#include <cmath>

#include "compare/doubt_matchers.hpp"
#include "compare/doubts/doubts.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using test::dry_sand;
using test::tells;
using test::wheel_on_sand;
using testing::ElementsAre;
using testing::IsEmpty;

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
  EXPECT_THAT(with_sd(&S::k_phi, 1.5e6, 1e7), ElementsAre(tells(DoubtKind::hardly_known, {"k_phi", 1e7 / 1.5e6})));
  EXPECT_THAT(with_sd(&S::k_c, 1e3, 1e6), ElementsAre(tells(DoubtKind::hardly_known, {"k_c", 1000})));
  EXPECT_THAT(with_sd(&S::cohesion, 1e3, 1e5), ElementsAre(tells(DoubtKind::hardly_known, {"c", 100})));
  EXPECT_THAT(with_sd(&S::cohesion, 0, 5e3), ElementsAre(tells(DoubtKind::hardly_known_at_zero, {"c"})));
  EXPECT_THAT(with_sd(&S::k_c, 0, 1e6), ElementsAre(tells(DoubtKind::hardly_known_at_zero, {"k_c"})));
  EXPECT_THAT(with_sd(&S::stress_angle_c2, 0.3, 3), ElementsAre(tells(DoubtKind::hardly_known, {"c2", 10})));
  EXPECT_THAT(with_sd(&S::stress_angle_c1, 0.3, 0.15), IsEmpty()) << "as where a file leaves it out";
  EXPECT_THAT(with_sd(&S::k_phi, 1.5e6, 7e5), IsEmpty());
  EXPECT_THAT(with_sd(&S::k_c, 1e3, 2e4), IsEmpty()) << "small beside k_phi";
  EXPECT_THAT(with_sd(&S::cohesion, 100, 500), IsEmpty()) << "little of what sand holds";
}

// k_phi in N for kN, or in kN for N: what presses a plate 100 mm wide in by 50 mm is beyond every soil of the library.
TEST(DeclaredDoubts, ModuliAThousandTimesOffAreTold) {
  SemiEmpiricalSoil soil = dry_sand();
  for (Estimate* modulus : {&soil.k_c, &soil.k_phi}) modulus->value *= 1000;
  const double pressure = (soil.k_c.value / 0.1 + soil.k_phi.value) * std::pow(0.05, soil.exponent.value) / 1000;
  EXPECT_THAT(doubts(soil_of(soil)), ElementsAre(tells(DoubtKind::unusual_pressure, {pressure, 0.5, 3000})));
  for (Estimate* modulus : {&soil.k_c, &soil.k_phi}) modulus->value /= 1e6;
  EXPECT_THAT(doubts(soil_of(soil)), testing::Contains(tells(DoubtKind::unusual_pressure, {pressure / 1e6})));
}

TEST(DeclaredDoubts, NoSoilOfTheLibraryBearsAnUnusualPressure) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  for (const std::string& name : library.names(Shelf::soils))
    EXPECT_FALSE(tell_of(doubts(find_soil(name, library)), DoubtKind::unusual_pressure)) << name;
}

TEST(DeclaredDoubts, AWheelByItselfIsJudgedToo) {
  Tire tire = wheel_on_sand().tire;
  EXPECT_THAT(doubts(tire), IsEmpty());
  tire.radius = 25;
  EXPECT_THAT(doubts(tire), ElementsAre(tells(DoubtKind::unusual_radius, {25000, 20, 2000})));
}

// 110 bar for 1.1 bar.
TEST(DeclaredDoubts, APressureThatNoTireHasIsTold) {
  Tire tire = wheel_on_sand().tire;
  tire.inflation_pressure = 110e3;
  EXPECT_THAT(doubts(tire), IsEmpty());
  tire.inflation_pressure = 110e5;
  EXPECT_THAT(doubts(tire), ElementsAre(tells(DoubtKind::unusual_inflation, {11000, 1500})));
}

TEST(DeclaredDoubts, ASoilThatCarriesNothingIsTold) {
  SemiEmpiricalSoil soil = dry_sand();
  soil.k_c.value = 0.0, soil.k_phi.value = -5.0;
  EXPECT_THAT(doubts(soil_of(soil)), ElementsAre(tells(DoubtKind::carries_nothing)));
}

// Grains alone, under a gravity in the wrong unit.
TEST(DeclaredDoubts, AGravityThatNoPlaceHasIsToldOfGrainsToo) {
  Soil soil;
  soil.granular.emplace().gravity = 1.62e-3;
  EXPECT_THAT(doubts(soil), ElementsAre(tells(DoubtKind::unusual_gravity, {1.62e-3, 0.1, 25})));
  Case question;
  question.scenario.tire = wheel_on_sand().tire, question.scenario.soil = soil;
  question.study.models = {{ModelKind::dem, {}, ""}};
  EXPECT_THAT(doubts(question, {}), testing::Contains(tells(DoubtKind::unusual_gravity)));
}

}  // namespace
}  // namespace soilbin::compare
