// The equations with their values are those of the wheel that is answered.
#include "compare/sweep/explanation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "scenario/unit.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

double step_named(const Explanation& explanation, const std::string& name) {
  const auto step = std::ranges::find(explanation.steps, name, &Step::name);
  if (step == explanation.steps.end()) throw std::runtime_error("no step " + name);
  return step->value;
}

/// The largest normal stress and the shear stress beside it, of the nodes [kPa].
std::pair<double, double> largest_of(const std::vector<StressSample>& patch) {
  const auto most = std::ranges::max_element(patch, {}, &StressSample::normal);
  return {most->normal / 1000, most->shear / 1000};
}

// Also where an effect settles the wheel and less of the soil's stresses carries the load.
TEST(Explanation, TellsTheStressesThatAct) {
  Scenario scenario = test::wheel_on_sand();
  for (const char* settles : {"", "lyasko", "reece"}) {
    scenario.effects.clear();
    if (*settles) scenario.effects = {{"slip_sinkage", settles, {}}};
    const Explanation explanation = explain(scenario, test::condition(80, 0.5));
    const auto [normal, shear] = largest_of(explanation.result.patch);
    EXPECT_NEAR(step_named(explanation, "normal stress there") / normal, 1, 0.01) << settles;
    EXPECT_NEAR(step_named(explanation, "shear stress there") / shear, 1, 0.1) << settles;
  }
}

// Where an effect moves the circle that presses, or the one that shears, the numbers are that circle's: what they give
// is what stands behind them.
TEST(Explanation, ItsNumbersGiveItsSinkageWhateverCircleEffectsLeave) {
  Scenario scenario = test::wheel_on_sand();
  scenario.tire.inflation_pressure = 20e3, scenario.tire.lugs.height = 5e-3;
  for (const EffectChoice& effect :
       {EffectChoice{"lug_thrust", "tips", {{"lambda", 1.0}}}, EffectChoice{"lug_thrust", "shear_radius", {}},
        EffectChoice{"tire_flexibility", "substitute_circle", {}}}) {
    SCOPED_TRACE(effect.form);
    scenario.effects = {effect};
    const Explanation explanation = explain(scenario, test::condition(80, 0.2));
    const auto step = std::ranges::find(explanation.steps, "sinkage", &Step::name);
    double radius = 0, angle = 0;  // "0.09 m (1 - cos 30 deg)"
    ASSERT_EQ(std::sscanf(step->numbers.c_str(), "%lf m (1 - cos %lf deg)", &radius, &angle), 2) << step->numbers;
    EXPECT_NEAR(1000 * radius * (1 - std::cos(angle * degree)) / step->value, 1, 2e-3);
    const auto [normal, shear] = largest_of(explanation.result.patch);
    EXPECT_NEAR(step_named(explanation, "normal stress there") / normal, 1, 0.01);
    EXPECT_NEAR(step_named(explanation, "shear stress there") / shear, 1, 0.1);
  }
  scenario.effects = {{"lug_thrust", "tips", {}}};
  const Explanation explanation = explain(scenario, test::condition(80, 0.2));
  EXPECT_NEAR(step_named(explanation, "sinkage as it is told"), 1000 * explanation.result.sinkage.value, 1e-9);
}

}  // namespace
}  // namespace soilbin::compare
