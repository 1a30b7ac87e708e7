// Decisions between candidates, on answers that are written down.
#include "compare/calibrate/decision.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "compare/telling/calibration_report.hpp"

namespace soilbin::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double load = 100, radius = 0.1;

Run measured(const char* setpoint, double slip, double pull) {
  Run run;
  run.at.load = load, run.at.slip = slip;
  run.setpoint = setpoint, run.drawbar_pull = pull;
  return run;
}

Campaign campaign_of(std::vector<Run> runs) {
  Campaign campaign;
  campaign.name = "made", campaign.wheel.radius = radius;
  campaign.runs = std::move(runs);
  return campaign;
}

/// A setpoint whose pull [N] is known that well.
Setpoint pull_of(const Estimate& pull) {
  Setpoint setpoint;
  setpoint.at.load = load, setpoint.runs = 1, setpoint.measured[0] = pull;
  return setpoint;
}

Answer pulls(const Estimate& pull) {
  TractionResult result;
  result.drawbar_pull = pull;
  return {result.at, result, ""};
}

Answer none(const char* why) { return {{}, std::nullopt, why}; }

TEST(Setpoints, AreMeansWithTheScatterOfAllReRuns) {
  const auto setpoints =
      setpoints_of(campaign_of({measured("A", 0.19, 10), measured("B", 0.40, 20), measured("A", 0.21, 14),
                                measured("B", 0.40, 20), measured("B", 0.40, 26)}));
  ASSERT_EQ(setpoints.size(), 2U);
  EXPECT_DOUBLE_EQ(setpoints[0].at.slip, 0.20);
  EXPECT_DOUBLE_EQ(setpoints[0].at.load, load);
  EXPECT_EQ(setpoints[0].runs, 2);
  EXPECT_EQ(setpoints[1].runs, 3);
  // Squares about the means 12 and 22: 4 + 4 and 4 + 4 + 16, with 1 + 2 degrees of freedom.
  const double sd = std::sqrt((8.0 + 24.0) / 3);
  EXPECT_DOUBLE_EQ(setpoints[0].measured[0]->value, 12);
  EXPECT_DOUBLE_EQ(setpoints[0].measured[0]->std_error, sd / std::sqrt(2));
  EXPECT_DOUBLE_EQ(setpoints[1].measured[0]->std_error, sd / std::sqrt(3));
  EXPECT_FALSE(setpoints[0].measured[1]);  // nobody measured a torque
}

TEST(Setpoints, WithoutAMeasurementAreLeftOut) {
  std::vector<compare::Run> runs{measured("A", 0.1, 10), measured("B", 0.2, 20)};
  runs[0].drawbar_pull.reset();
  runs[1].at.run = 7, runs[1].at.position = 3.0;
  const auto setpoints = setpoints_of(campaign_of(runs));
  ASSERT_EQ(setpoints.size(), 1U);
  EXPECT_EQ(setpoints[0].at.slip, 0.2);
  EXPECT_FALSE(setpoints[0].at.run || setpoints[0].at.position);  // which grains don't know
  EXPECT_EQ(setpoints[0].measured[0]->std_error, 0);              // no re-runs: not known
}

TEST(Setpoints, BetweenBoundsIncludeThem) {
  const auto all = setpoints_of(campaign_of({measured("A", 0.1, 1), measured("B", 0.2, 2), measured("C", 0.3, 3)}));
  const auto kept = between(all, &OperatingCondition::slip, 0.2, 0.3);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept.front().at.slip, 0.2);
}

TEST(Decisions, ErrorsAreSharesOfTheLoad) {
  Setpoint setpoint = pull_of({20, 0});
  setpoint.measured[1] = {5, 0};      // N m
  setpoint.measured[2] = {0.012, 0};  // m
  Answer answer = pulls({26, 0.5});
  answer.result->torque = {5.8, 0}, answer.result->sinkage = {0.011, 0};
  const Decision decision = decide("made", {setpoint}, {{answer}}, radius);
  const Trial& trial = decision.trials[0];
  EXPECT_DOUBLE_EQ(trial.errors[0]->value, 6.0 / load);
  EXPECT_DOUBLE_EQ(trial.errors[0]->std_error, 0.5 / load);
  EXPECT_DOUBLE_EQ(trial.errors[1]->value, 0.8 / (load * radius));
  EXPECT_NEAR(trial.errors[2]->value, 0.001 / radius, 1e-15);
  EXPECT_FALSE(trial.errors[3]);
  EXPECT_NEAR(trial.error->value, std::sqrt((0.06 * 0.06 + 0.08 * 0.08 + 0.01 * 0.01) / 3), 1e-15);
  EXPECT_THAT(decision_columns(decision),
              ElementsAre("drawbar pull off [% W]", "torque off [% W r]", "sinkage off [% r]", "off [%]", "soil bin"));
  EXPECT_THAT(decision_cells(decision, 0), ElementsAre("6.00 ± 0.50", "8.000", "1.000", "5.80 ± 0.17", "chosen"));
}

TEST(Decisions, AnErrorIsARootMeanSquareOverSetpoints) {
  const Decision decision =
      decide("made", {pull_of({0, 0}), pull_of({0, 0})}, {{pulls({3, 0}), pulls({-4, 0})}}, radius);
  EXPECT_DOUBLE_EQ(decision.trials[0].error->value, std::sqrt((9.0 + 16.0) / 2) / load);
}

TEST(Decisions, TheNearestIsChosenWhereItIsToldApart) {
  const Decision decision =
      decide("made", {pull_of({20, 0})}, {{pulls({28, 1})}, {pulls({21, 1})}, {pulls({10, 1})}}, radius);
  EXPECT_EQ(decision.nearest, 1U);
  EXPECT_EQ(decision.chosen, 1U);
  EXPECT_EQ(decision.tied(), 1);
  EXPECT_TRUE(decision.trials[0].apart && decision.trials[2].apart);
  EXPECT_THAT(decision_sentences(decision), Contains(HasSubstr("(b) is nearest to made")));
}

TEST(Decisions, OfThoseThatCannotBeToldApartTheLikeliestIsChosen) {
  // 6 N off and 5 N off, each known to 1 N: 36 - 25 = 11 N^2 with an error of 2 sqrt(6^2 + 5^2) = 16 N^2.
  const Decision decision =
      decide("made", {pull_of({20, 0})}, {{pulls({26, 1})}, {pulls({25, 1})}, {pulls({60, 1})}}, radius);
  EXPECT_EQ(decision.nearest, 1U);
  EXPECT_EQ(decision.chosen, 0U);  // candidates come with the likeliest first
  EXPECT_EQ(decision.tied(), 2);
  EXPECT_THAT(decision_sentences(decision), Contains(HasSubstr("does not differ from (a) by two standard errors")));
  EXPECT_EQ(decision_cells(decision, 1).back(), "nearest, not told apart");
  EXPECT_EQ(decision_cells(decision, 2).back(), "farther off");
}

TEST(Decisions, TheSameDifferenceCountsWhereItIsKnownBetter) {
  // 11 N^2 with an error of 2 * 0.25 sqrt(61) = 3.9 N^2.
  const Decision decision = decide("made", {pull_of({20, 0})}, {{pulls({26, 0.25})}, {pulls({25, 0.25})}}, radius);
  EXPECT_EQ(decision.chosen, 1U);
}

TEST(Decisions, AMeasurementThatScattersTellsLess) {
  const std::vector<std::vector<Answer>> answers{{pulls({30, 0.1})}, {pulls({18, 0.1})}};
  // 100 - 4 = 96 N^2; the measurement's part of the error is 2 * 12 N * its own.
  EXPECT_EQ(decide("made", {pull_of({20, 1})}, answers, radius).chosen, 1U);
  EXPECT_EQ(decide("made", {pull_of({20, 3})}, answers, radius).chosen, 0U);
}

TEST(Decisions, ACandidateWithoutAResultIsOut) {
  const std::vector<Setpoint> two{pull_of({20, 0}), pull_of({20, 0})};
  const Decision decision =
      decide("made", two, {{pulls({20, 0}), none("it dug itself in")}, {pulls({24, 1}), pulls({24, 1})}}, radius);
  EXPECT_EQ(decision.chosen, 1U);
  EXPECT_FALSE(decision.trials[0].error);
  EXPECT_THAT(decision_cells(decision, 0).back(), HasSubstr("it dug itself in"));
}

TEST(Decisions, WithoutAnyResultNothingIsDecided) {
  const Decision decision = decide("made", {pull_of({20, 0})}, {{none("it dug itself in")}}, radius);
  EXPECT_FALSE(decision.decided());
  EXPECT_THAT(decision_sentences(decision), ElementsAre(HasSubstr("the likeliest is kept")));
  EXPECT_FALSE(to_json(decision).at("decided").get<bool>());
}

TEST(Decisions, EqualCandidatesAreSeldomToldApart) {
  // Two candidates with one truth, both 5 % of the load off, at three setpoints; two standard errors: below 5 %.
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 1);
  const std::vector<Setpoint> setpoints(3, pull_of({20, 0}));
  int apart = 0;
  constexpr int tries = 2000;
  for (int k = 0; k < tries; ++k) {
    std::vector<std::vector<Answer>> answers(2);
    for (auto& row : answers)
      for (std::size_t s = 0; s < setpoints.size(); ++s) row.push_back(pulls({25 + noise(random), 1}));
    apart += decide("made", setpoints, answers, radius).tied() == 1;
  }
  EXPECT_LT(apart, 0.05 * tries + 2 * std::sqrt(0.05 * tries));
}

}  // namespace
}  // namespace soilbin::compare
