// A study's conditions: values, lists, ranges, their product, and unions of products.
#include "scenario/condition_axes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<OperatingCondition> conditions(const std::string& text) {
  const SourceText source = make_source_text(text, "case.yaml");
  Tire tire;
  tire.radius = 0.5;
  return read_conditions(parse_yaml(source), tire, Reading{&source, std::nullopt, nullptr, ""}).conditions;
}

std::string refused_conditions(const std::string& text) {
  return refusal([&] { conditions(text); });
}

auto column(const std::vector<OperatingCondition>& all, auto member) {
  std::vector<std::decay_t<decltype(all.front().*member)>> values;
  for (const OperatingCondition& at : all) values.push_back(at.*member);
  return values;
}

TEST(ConditionAxes, AProductInTheWrittenOrder) {
  const auto load_first = conditions("{load: [1 kN, 2 kN], slip: [0 %, 10 %]}");
  EXPECT_THAT(column(load_first, &OperatingCondition::load), ElementsAre(1000, 1000, 2000, 2000));
  EXPECT_THAT(column(load_first, &OperatingCondition::slip), ElementsAre(0.0, 0.1, 0.0, 0.1));
  const auto slip_first = conditions("{slip: [0 %, 10 %], load: [1 kN, 2 kN]}");
  EXPECT_THAT(column(slip_first, &OperatingCondition::load), ElementsAre(1000, 2000, 1000, 2000));
}

TEST(ConditionAxes, RangesGiveRoundNumbers) {
  const auto by_step = conditions("{load: 1 kN, slip: {from: 0 %, to: 60 %, step: 10 %}}");
  EXPECT_THAT(column(by_step, &OperatingCondition::slip), ElementsAre(0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6));
  const auto falling = conditions("{load: 1 kN, slip: {from: 0.3, to: -0.3, step: -0.3}}");
  EXPECT_THAT(column(falling, &OperatingCondition::slip), ElementsAre(0.3, 0.0, -0.3));
  const auto by_count = conditions("{load: 1 kN, slip: 0, yaw: {from: 0 deg, to: 20 deg, count: 5}}");
  EXPECT_THAT(column(by_count, &OperatingCondition::yaw),
              ElementsAre(0.0, 5 * degree, 10 * degree, 15 * degree, 20 * degree));
  const auto short_of = conditions("{load: 1 kN, slip: {from: 0, to: 0.5, step: 0.2}}");
  EXPECT_THAT(column(short_of, &OperatingCondition::slip), ElementsAre(0.0, 0.2, 0.4)) << "'to' need not be reached";
}

TEST(ConditionAxes, AListIsAUnion) {
  const auto both =
      conditions("- {load: 4 kN, slip: 0.2}\n- {load: 4 kN, slip: 0.2, longitudinal_incline: [5 deg, 10 deg]}\n");
  EXPECT_THAT(column(both, &OperatingCondition::longitudinal_incline), ElementsAre(0.0, 5 * degree, 10 * degree));
}

TEST(ConditionAxes, RotationStaysBesideTheSpeedThatItGives) {
  const SourceText source =
      make_source_text("- {load: 1 kN, slip: 0.25, rotation: 10 rpm}\n- {load: 1 kN, slip: 0.25, speed: 1 m/s}\n", "c");
  Tire tire;
  tire.radius = 0.5;
  const ConditionGrid grid = read_conditions(parse_yaml(source), tire, Reading{&source, std::nullopt, nullptr, ""});
  ASSERT_EQ(grid.rotations.size(), grid.conditions.size());
  ASSERT_TRUE(grid.rotations[0].has_value());
  EXPECT_DOUBLE_EQ(*grid.rotations[0], 10 * 2 * std::numbers::pi / 60);
  EXPECT_EQ(speed_at_rotation(grid.conditions[0], *grid.rotations[0], tire), grid.conditions[0].speed);
  EXPECT_FALSE(grid.rotations[1].has_value());
}

TEST(ConditionAxes, RotationGivesTheSpeedOfTravel) {
  const double rim = 0.5 * 10 * std::numbers::pi / 30;  // r w at 10 rpm
  const auto driven = conditions("{load: 1 kN, slip: [0, 0.25, 1], rotation: 10 rpm}");
  EXPECT_DOUBLE_EQ(driven[0].speed, rim);
  EXPECT_DOUBLE_EQ(driven[1].speed, rim * 0.75) << "s = 1 - v/(r w)";
  EXPECT_EQ(driven[2].speed, 0.0);
  EXPECT_DOUBLE_EQ(conditions("{load: 1 kN, slip: -0.2, rotation: 10 rpm}")[0].speed, rim / 0.8) << "s = r w/v - 1";
  const auto yawed =
      conditions("{load: 1 kN, slip: 0.25, yaw: 60 deg, rotation: 10 rpm, slip_by: [wheel_plane_speed, travel_speed]}");
  EXPECT_NEAR(yawed[0].speed, rim * 0.75 / 0.5, 1e-12) << "v cos(yaw) is what slips";
  EXPECT_NEAR(yawed[1].speed, rim * 0.75, 1e-12);
}

TEST(ConditionAxes, WordsAndIntegersAreAxesToo) {
  const auto passes = conditions("{load: 1 kN, slip: 0, pass: [1, 2], force_frame: [travel, wheel]}");
  EXPECT_THAT(column(passes, &OperatingCondition::pass), ElementsAre(1, 1, 2, 2));
  EXPECT_EQ(passes[1].force_frame, ForceFrame::wheel);
}

TEST(ConditionAxes, Refusals) {
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: 0, speed: 1 m/s, rotation: 10 rpm}"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: -1, rotation: 10 rpm}"), HasSubstr("is locked"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: 0, yaw: 90 deg, rotation: 10 rpm}"), HasSubstr("yaw of 90 deg"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: []}"), HasSubstr("the list of 'slip' is empty"));
  EXPECT_THAT(refused_conditions("[]"), HasSubstr("the list of conditions is empty"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slpi: 0}"), HasSubstr("unknown key 'slpi', did you mean 'slip'?"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: {from: 0, to: 1}}"), HasSubstr("either 'step' or 'count'"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: {from: 0, to: 1, step: 0.1, count: 3}}"),
              HasSubstr("either 'step' or 'count'"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: {from: 0, to: 1, step: -0.1}}"),
              HasSubstr("doesn't lead from one end of the range to the other"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: {from: 0, to: 0, step: 0}}"), HasSubstr("doesn't lead"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: {from: 0, to: 1, step: 1e-9}}"),
              HasSubstr("more than 10000 values"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: {from: 0, to: 1, count: 1}}"), HasSubstr("must be at least 2"));
  EXPECT_THAT(refused_conditions("{load: 1 kN, slip: [0, x]}"), StartsWith("case.yaml:1:24: expected a plain number"));
  const std::string wide = "{from: 0, to: 1, count: 1000}";
  EXPECT_THAT(refused_conditions("{load: {from: 1 N, to: 2 N, count: 1000}, slip: " + wide + "}"),
              HasSubstr("more than 100000 conditions"));
}

}  // namespace
}  // namespace soilbin
