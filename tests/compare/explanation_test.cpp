// The equations with their values are those of the wheel that is answered.
#include "compare/sweep/explanation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

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

}  // namespace
}  // namespace soilbin::compare
