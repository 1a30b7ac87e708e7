// Resistive force theory behind the common interface: frames, budget, errors, and what it takes for a soil that does
// not declare it.
#include "resistive_force/model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "resistive_force/response.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::resistive_force {
namespace {

Scenario on_sand() {
  Scenario scenario;
  scenario.tire.radius = 0.125, scenario.tire.width = 0.15;
  scenario.tire.lugs = {.height = 0.01, .count = 24, .thickness = 0.003};
  scenario.soil.name = "sand";
  scenario.soil.resistive_force = ResistiveForceSoil{.xi_n = {8e5, 1e5}, .surface_friction = {0.5, 0.05}};
  return scenario;
}

const OperatingCondition uphill{.load = 150, .slip = 0.25, .longitudinal_incline = 10 * degree, .yaw = 10 * degree};

TEST(ResistiveForce, HasABudgetThatAddsUp) {
  const TractionResult r = ResistiveForce().evaluate(on_sand(), uphill);
  EXPECT_LT(std::abs(r.budget_rest.force), r.budget_rest.bound);
  std::vector<std::string> names;
  for (const Contribution& part : r.budget) names.push_back(part.name);
  EXPECT_EQ(names, (std::vector<std::string>{"tread", "lugs", "sides", "slope"}));
  EXPECT_NEAR(r.budget.back().force, -150 * std::sin(10 * degree), 1e-9);
}

// The triangles of a drawing are no mirror images, elements left and right are summed in another order.
TEST(ResistiveForce, OfADrawingHasNoSideForceStraightAhead) {
  const Scenario scenario = on_sand();
  TreadElements drawn = tread_elements(scenario.tire);
  for (Element& element : drawn.all) element.place.y += 1e-16, element.normal.y *= 1 - 1e-15;
  OperatingCondition straight = uphill;
  straight.yaw = 0;
  const TractionResult result = ResistiveForce(drawn).evaluate(scenario, straight);
  EXPECT_EQ(result.lateral_force.value, 0);
  EXPECT_EQ(result.lateral_force.std_error, 0);
  EXPECT_NEAR(result.drawbar_pull.value, ResistiveForce().evaluate(scenario, straight).drawbar_pull.value, 1e-9);
}

TEST(ResistiveForce, TurnsItsForcesToTheWheelsAxes) {
  OperatingCondition in_wheel = uphill;
  in_wheel.force_frame = ForceFrame::wheel;
  const TractionResult travel = ResistiveForce().evaluate(on_sand(), uphill),
                       wheel = ResistiveForce().evaluate(on_sand(), in_wheel);
  EXPECT_NEAR(std::hypot(travel.drawbar_pull.value, travel.lateral_force.value),
              std::hypot(wheel.drawbar_pull.value, wheel.lateral_force.value), 1e-9);
  EXPECT_NEAR(wheel.drawbar_pull.value,
              travel.drawbar_pull.value * std::cos(10 * degree) + travel.lateral_force.value * std::sin(10 * degree),
              1e-9);
}

TEST(ResistiveForce, ErrsAsItsTwoValuesDo) {
  Scenario exact = on_sand(), soft = on_sand(), rough = on_sand(), smooth = on_sand();
  const auto pull = [](const Scenario& s) { return ResistiveForce().evaluate(s, uphill).drawbar_pull; };
  exact.soil.resistive_force->xi_n.std_error = exact.soil.resistive_force->surface_friction.std_error = 0;
  EXPECT_EQ(pull(exact).std_error, 0.0);
  soft.soil.resistive_force->xi_n.value += 1e3;
  rough.soil.resistive_force->surface_friction.value += 0.05;
  smooth.soil.resistive_force->surface_friction.value -= 0.05;
  const double by_xi = (pull(soft).value - pull(exact).value) / 1e3 * 1e5;
  const double by_friction = (pull(rough).value - pull(smooth).value) / 2;
  EXPECT_NEAR(pull(on_sand()).std_error, std::hypot(by_xi, by_friction), 0.02 * std::hypot(by_xi, by_friction));
}

// Where friction caps no traction, more of it changes nothing and less of it does: the error knows that side.
TEST(ResistiveForce, ErrsToTheSideOnWhichFrictionBegins) {
  Scenario scenario = on_sand();
  ResistiveForceSoil& soil = *scenario.soil.resistive_force;
  const auto torque = [&](double friction, double sd) {
    soil.xi_n.std_error = 0, soil.surface_friction = {friction, sd};
    return ResistiveForce().evaluate(scenario, uphill).torque;
  };
  const double enough = 3.0, sd = 2.8;
  EXPECT_EQ(torque(enough, 0).value, torque(enough + sd, 0).value);
  EXPECT_NEAR(torque(enough, sd).std_error, 0.5 * std::abs(torque(enough, 0).value - torque(enough - sd, 0).value),
              1e-9);
}

TEST(ResistiveForce, TakesASoilsDensityAndFrictionWhereNothingIsDeclared) {
  Scenario scenario = on_sand();
  scenario.soil.resistive_force.reset();
  EXPECT_THROW(ResistiveForce().evaluate(scenario, uphill), InputError);
  SemiEmpiricalSoil& values = scenario.soil.semi_empirical.emplace();
  values.exponent.value = 1, values.friction_angle.value = 0.5, values.density = 1600.0;
  const ResistiveForceSoil taken = resistive_force_of(scenario.soil);
  EXPECT_DOUBLE_EQ(taken.xi_n.value, estimated_xi_n(1600, std::tan(0.5), standard_gravity));
  EXPECT_DOUBLE_EQ(taken.surface_friction.value, std::tan(1.0 / 3.0));
  EXPECT_GT(ResistiveForce().evaluate(scenario, uphill).drawbar_pull.std_error, 0.0);
}

TEST(ResistiveForce, RefusesLugsThatItCannotDraw) {
  Scenario scenario = on_sand();
  scenario.tire.lugs.count.reset();
  EXPECT_THROW(ResistiveForce().evaluate(scenario, uphill), InputError);
}

TEST(ResistiveForce, KnowsWhichTireItIsAsked) {
  const ResistiveForce model;
  Scenario other = on_sand();
  other.tire.width = 0.2;
  const double narrow = model.evaluate(on_sand(), uphill).sinkage.value,
               wide = model.evaluate(other, uphill).sinkage.value;
  EXPECT_LT(wide, narrow);
  EXPECT_EQ(model.evaluate(on_sand(), uphill).sinkage.value, narrow);
}

}  // namespace
}  // namespace soilbin::resistive_force
