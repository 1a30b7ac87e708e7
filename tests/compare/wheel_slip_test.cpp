// A wheel as Gazebo's WheelSlip has it: the plugin's formula, and lines fitted to curves that are lines, and to a
// wheel's.
#include "compare/export/wheel_slip.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compare/rover_fixture.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

Case rover_question() {
  Case question = rover_on_dry_sand();
  question.study.conditions = {{.load = 65.0, .slip = 0.2}};
  return question;
}

/// What the physics engine does with what the plugin writes (WheelSlip.cc): slip2 = r |w| compliance/normal force
/// [m/s/N] is a force-dependent slip, so that the rim slides by v = slip2 F, until F reaches friction x normal force.
double force_in_gazebo(double rim_speed, double sliding, double compliance, double friction, double normal_force) {
  const double slip2 = rim_speed / normal_force * compliance;
  return std::min(sliding / slip2, friction * normal_force);
}

TEST(WheelSlip, IsThePluginsForceAtEverySpeedAndLoad) {
  constexpr double compliance = 0.8, friction = 0.5, radius = 0.11;
  for (const double load : {10.0, 65.0, 4000.0})
    for (const double spin : {0.5, 10.0})
      for (const double slip : {0.01, 0.2, 0.39, 0.41, 0.9})
        EXPECT_NEAR(force_in_gazebo(radius * spin, slip * radius * spin, compliance, friction, load),
                    load * wheel_slip_force(slip, compliance, friction), 1e-12 * load);
  EXPECT_EQ(wheel_slip_force(-0.2, compliance, friction), -0.25);
  EXPECT_EQ(wheel_slip_force(-2.0, compliance, friction), -0.5);
  EXPECT_EQ(wheel_slip_force(0.1, 0.0, friction), 0.5);
}

TEST(WheelSlip, FindsALineThatIsOne) {
  std::vector<SlipPoint> points;
  for (double slip = 0.0; slip < 0.61; slip += 0.05) points.push_back({slip, wheel_slip_force(slip, 0.7, 0.4)});
  const SlipLine line = fitted_line(points);
  EXPECT_NEAR(line.compliance, 0.7, 1e-6);
  EXPECT_NEAR(line.friction, 0.4, 1e-12);
  EXPECT_LT(line.largest_error, 1e-6);
}

// No other compliance of that friction is nearer.
TEST(WheelSlip, IsTheLeastSquaresOfAWheel) {
  const WheelSlipFit fit = wheel_slip_of(rover_question());
  for (const SlipLine* line : {&fit.longitudinal, &fit.lateral}) {
    const auto squares = [&](double compliance) {
      double sum = 0.0;
      for (const SlipPoint& point : line->points)
        sum += std::pow(wheel_slip_force(point.slip, compliance, line->friction) - point.force_share, 2);
      return sum;
    };
    EXPECT_GT(line->compliance, 0.0);
    EXPECT_NEAR(std::sqrt(squares(line->compliance) / static_cast<double>(line->points.size())), line->rms_error,
                1e-12);
    for (double factor = 0.05; factor < 20; factor *= 1.05)
      EXPECT_GE(squares(line->compliance * factor), squares(line->compliance) - 1e-9) << factor;
  }
  EXPECT_NEAR(fit.lateral.points.back().slip, std::tan(20 * degree) * 0.8, 1e-12);
}

// The line begins where the rover's wheel pulls nothing, and the plugin's slip is what lies beyond.
TEST(WheelSlip, CountsSlipFromWhereTheWheelPullsNothing) {
  const WheelSlipFit fit = wheel_slip_of(rover_question());
  const std::vector<Answer>& curve = fit.answers[0].answers;
  const auto above = std::ranges::find_if(curve, [](const Answer& a) { return a.result->drawbar_pull.value > 0.0; });
  const Answer &after = *above, &before = *std::prev(above);
  EXPECT_GT(fit.idle_slip, before.at.slip);
  EXPECT_LT(fit.idle_slip, after.at.slip);
  EXPECT_GT(fit.idle_torque, before.result->torque.value);
  EXPECT_LT(fit.idle_torque, after.result->torque.value);
  EXPECT_EQ(fit.longitudinal.points.front().force_share, 0.0);
  EXPECT_EQ(fit.longitudinal.points[1].force_share, after.result->drawbar_pull.value / 65.0);
  EXPECT_NEAR(fit.longitudinal.points.back().slip, 0.6 - fit.idle_slip, 1e-12);
  EXPECT_LT(fit.longitudinal.largest_error, 0.3 * fit.longitudinal.friction);
}

TEST(WheelSlip, SaysThatAWheelWithoutPullHasNoLine) {
  Case question = rover_question();
  question.scenario.soil.semi_empirical->friction_angle.value = 5 * degree;
  question.scenario.soil.semi_empirical->cohesion.value = 0.0;
  EXPECT_THROW(wheel_slip_of(question), NoSolution);
}

TEST(WheelSlip, AsksOneConditionOnTheLevel) {
  Case question = rover_question();
  question.study.conditions.front().yaw = 0.1;
  EXPECT_THROW(wheel_slip_of(question), InputError);
  question = rover_question();
  question.study.conditions.push_back(question.study.conditions.front());
  EXPECT_THROW(wheel_slip_of(question), InputError);
}

TEST(WheelSlip, IsToldAsThePluginsSdf) {
  const WheelSlipFit fit = wheel_slip_of(rover_question());
  EXPECT_THAT(text_of(report_on(fit)),
              testing::AllOf(testing::HasSubstr("<slip_compliance_longitudinal>"), testing::HasSubstr("fdir1"),
                             testing::HasSubstr("<wheel_normal_force>65</wheel_normal_force>")));
}

}  // namespace
}  // namespace soilbin::compare
