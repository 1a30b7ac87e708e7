// The cone-index relations behind the common interface: forces, budget, errors, slopes, what is taken of a tire, and
// what is refused.
#include "cone_index/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cone_index {
namespace {

Scenario on_loam() {
  Scenario scenario;
  scenario.tire.radius = 0.352, scenario.tire.width = 0.226, scenario.tire.section_height = 0.15;
  scenario.tire.inflation_pressure = 150e3;
  scenario.tire.deflection = DeflectionTable{"made", {{3892, 150e3, 0.02}}};
  scenario.soil.name = "loam";
  scenario.soil.cone_index = Estimate{310e3, 31e3};
  return scenario;
}

Scenario on_sand() {
  Scenario scenario = on_loam();
  scenario.soil.cone_index.reset();
  scenario.soil.cone_index_gradient = Estimate{6e6, 1e6};
  return scenario;
}

const OperatingCondition level{.load = 3892, .slip = 0.1};

TractionResult answer(const Scenario& scenario, const OperatingCondition& at = level) {
  return ConeIndex().evaluate(scenario, at);
}

TEST(ConeIndex, PullsWhatTheRelationSays) {
  EXPECT_NEAR(answer(on_loam()).drawbar_pull.value / 3892, 0.1978, 1e-4);
  const double number = 6e6 * std::pow(0.226 * 0.704, 1.5) / 3892 * 0.02 / 0.15;
  EXPECT_NEAR(answer(on_sand()).drawbar_pull.value, 3892 * turnage(number, 0.1).net(), 1e-9);
}

TEST(ConeIndex, HasTheTorqueOfItsGrossTractionAndTheEfficiencyOfBoth) {
  const TractionResult r = answer(on_loam());
  const Ratios ratios = brixius(brixius_number(310e3, {0.704, 0.226, 0.15, 0.02}, 3892), 0.1);
  EXPECT_NEAR(r.torque.value, 3892 * 0.352 * ratios.gross, 1e-9);
  EXPECT_NEAR(r.tractive_efficiency, ratios.net() / ratios.gross * 0.9, 1e-12);
}

TEST(ConeIndex, HasNoSinkageRatherThanOneOf0) {
  const TractionResult r = answer(on_loam());
  EXPECT_TRUE(std::isnan(r.sinkage.value) && std::isnan(r.sinkage.std_error));
  EXPECT_TRUE(std::isnan(r.entry_angle));
  EXPECT_TRUE(r.patch.empty());
  EXPECT_EQ(r.lateral_force.value, 0.0);
}

TEST(ConeIndex, LoadsTheGroundWithGravitysPartSquareToTheSlope) {
  OperatingCondition uphill = level, square = level;
  uphill.longitudinal_incline = 10 * degree;
  square.load = level.load * std::cos(10 * degree);
  const TractionResult up = answer(on_loam(), uphill), flat = answer(on_loam(), square);
  EXPECT_NEAR(up.drawbar_pull.value, flat.drawbar_pull.value - level.load * std::sin(10 * degree), 1e-9);
  EXPECT_NEAR(up.torque.value, flat.torque.value, 1e-9);
}

TEST(ConeIndex, HasABudgetThatAddsUp) {
  OperatingCondition uphill = level;
  uphill.longitudinal_incline = 5 * degree;
  const TractionResult r = answer(on_loam(), uphill);
  double sum = 0.0;
  for (const Contribution& part : r.budget) sum += part.force;
  EXPECT_EQ(r.budget.size(), 3U);
  EXPECT_NEAR(sum, r.drawbar_pull.value, 1e-9);
}

TEST(ConeIndex, ErrsAsItsConeIndexDoes) {
  for (const Scenario& scenario : {on_loam(), on_sand()}) {
    Scenario stronger = scenario;
    std::optional<Estimate>& value =
        stronger.soil.cone_index ? stronger.soil.cone_index : stronger.soil.cone_index_gradient;
    const double step = 1e-6 * value->value, sd = value->std_error;
    value->value += step;
    const TractionResult one = answer(scenario), other = answer(stronger);
    for (const auto channel : {&TractionResult::drawbar_pull, &TractionResult::torque}) {
      const double slope = ((other.*channel).value - (one.*channel).value) / step;
      EXPECT_NEAR((one.*channel).std_error, std::abs(slope) * sd, 1e-4 * std::abs(slope) * sd);
    }
  }
}

TEST(ConeIndex, TakesTheDeflectionFromTheTablePressureOrAsUsual) {
  Tire tire = on_loam().tire;
  EXPECT_EQ(tire_taken(tire, 3892).deflection, DeflectionFrom::table);
  EXPECT_NEAR(tire_taken(tire, 3892).measures.deflection, 0.02, 1e-12);
  tire.deflection.reset();  // 3892 N over 150 kPa: an ellipse of 0.0259 m^2, which is 20.7 mm deep; the table has 20
  EXPECT_EQ(tire_taken(tire, 3892).deflection, DeflectionFrom::pressure);
  EXPECT_NEAR(tire_taken(tire, 3892).measures.deflection, 3892 / (std::numbers::pi * 150e3 * std::sqrt(0.704 * 0.226)),
              1e-12);
  EXPECT_NEAR(tire_taken(tire, 3892).measures.deflection, 0.02, 0.001);
  tire.inflation_pressure.reset();
  EXPECT_EQ(tire_taken(tire, 3892).deflection, DeflectionFrom::assumed);
  EXPECT_NEAR(tire_taken(tire, 3892).measures.deflection, 0.2 * 0.15, 1e-12);
}

TEST(ConeIndex, AssumesASectionHeightWhereNoneIsDeclared) {
  Tire tire = on_loam().tire;
  tire.section_height.reset();
  EXPECT_TRUE(tire_taken(tire, 3892).section_height_assumed);
  EXPECT_NEAR(tire_taken(tire, 3892).measures.section_height, 0.176, 1e-12) << "half of the outer radius";
  tire.width = 0.1;
  EXPECT_NEAR(tire_taken(tire, 1000).measures.section_height, 0.085, 1e-12);
}

TEST(ConeIndex, HasTheInflationPressureOfTheCondition) {
  Scenario scenario = on_loam();
  scenario.tire.deflection.reset();
  OperatingCondition soft = level;
  soft.inflation_pressure = 100e3;
  EXPECT_GT(answer(scenario, soft).drawbar_pull.value, answer(scenario).drawbar_pull.value);
}

TEST(ConeIndex, RefusesATireThatDeflectsByItsSectionHeight) {
  Scenario scenario = on_loam();
  scenario.tire.deflection.reset();
  scenario.tire.inflation_pressure = 20e3;
  EXPECT_THROW(answer(scenario), InputError);
}

TEST(ConeIndex, RefusesWhatNoConeTells) {
  for (const OperatingCondition& at : {OperatingCondition{.load = 3892, .slip = 0.1, .yaw = 5 * degree},
                                       OperatingCondition{.load = 3892, .slip = 0.1, .transverse_incline = 5 * degree},
                                       OperatingCondition{.load = 3892, .slip = -0.1}})
    EXPECT_THROW(answer(on_loam(), at), InputError);
}

TEST(ConeIndex, NeedsAValueOfACone) {
  Scenario scenario = on_loam();
  scenario.soil.cone_index.reset();
  EXPECT_THROW(answer(scenario), InputError);
}

TEST(ConeIndex, HasNoAnswerOnASoilThatHoldsTheWheelFast) {
  Scenario scenario = on_loam();
  scenario.soil.cone_index->value = 20e3;
  EXPECT_THROW(answer(scenario), NoSolution);
}

}  // namespace
}  // namespace soilbin::cone_index
