// What the loop makes of effects near the edge of what the data can tell, and what it would measure next.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "compare/fit/evidence.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

LoopAnswer answer_to(double slip_sinkage, std::uint64_t seed, std::optional<double> inflation_pressure = {}) {
  Campaign campaign = sand_campaign();
  campaign.wheel.inflation_pressure = inflation_pressure;
  measure(campaign, sweep(), {{"slip_sinkage", "lyasko", {{"a", slip_sinkage}}}}, fine_noise, seed);
  LoopOptions options;
  options.attribution.simulations = 1000;
  options.validate = false;
  return run_loop(campaign, options);
}

// Slip sinkage of a thirtieth of its usual size is at the edge of what these data show. In some campaigns its trace
// stands out (p below 5 %), but conditions left out are predicted no better with it, by the gain's own error. Then
// nothing is named. Among campaigns drawn so the first such one is looked at; about one in thirty is.
TEST(LoopChoices, AnEffectThatPredictsNothingIsNotNamed) {
  const auto seen_but_useless = [](const LoopAnswer& a) {
    return a.judgement() && a.judgement()->choice && a.found().signatures.p_value < 0.05 &&
           a.choice().gain.mean < a.choice().gain.std_error;
  };
  LoopAnswer answer;
  for (std::uint64_t seed = 23; seed < 150 && !seen_but_useless(answer); ++seed) answer = answer_to(0.03, seed);
  ASSERT_TRUE(seen_but_useless(answer));
  EXPECT_EQ(answer.verdict(), Verdict::nothing_missing);
  EXPECT_TRUE(std::holds_alternative<NoGain>(answer.judgement()->reason));
  EXPECT_TRUE(answer.effects().empty());
  EXPECT_FALSE(answer.next());
}

// One candidate comes near the noise, so each is weighed against noise of a known size.
TEST(SlowLoopChoices, CandidatesAreWeighedByTheNoiseWhereOneComesNearIt) {
  const LoopAnswer answer = answer_to(0.5, 22);
  const Candidates& candidates = answer.found().candidates;
  ASSERT_FALSE(candidates.none_near_noise);
  ASSERT_GE(candidates.models.size(), 5U);
  for (const CandidateModel& c : candidates.models) {
    EXPECT_DOUBLE_EQ(c.log_evidence, log_evidence(c.model, false));
    EXPECT_NE(c.log_evidence, log_evidence(c.model, true));
  }
}

// Slip sinkage so strong that nothing else comes near: no run is proposed against what is excluded already.
TEST(SlowLoopChoices, NoRunIsProposedAgainstAnExcludedCandidate) {
  const LoopAnswer answer = answer_to(0.5, 22);
  ASSERT_EQ(answer.verdict(), Verdict::effect_found);
  const Candidates& all = answer.found().candidates;
  const double excluded = std::log(thresholds::excluded_odds);
  if (answer.next()) {
    EXPECT_LE(
        all.weighed(answer.next()->separates[0]).log_evidence - all.weighed(answer.next()->separates[1]).log_evidence,
        excluded);
  } else {
    EXPECT_FALSE(what_next(answer).empty());
  }
  EXPECT_EQ(is_settled(all), lead(all) > excluded);
}

/// The first of some answers about a weak slip sinkage that names it and proposes a run.
std::optional<LoopAnswer> proposing_answer(std::optional<double> inflation_pressure = {}) {
  for (const double size : {0.06, 0.09, 0.12, 0.2})
    for (const std::uint64_t seed : {22, 23, 24}) {
      LoopAnswer answer = answer_to(size, seed, inflation_pressure);
      if (answer.verdict() == Verdict::effect_found && answer.next()) return answer;
    }
  return std::nullopt;
}

// Weak slip sinkage. The next run sets it against another set, within what the campaign allows.
TEST(LoopChoices, TheNextRunLiesWithinTheLimitsAndSetsTheBestAgainstAnother) {
  const std::optional<LoopAnswer> proposing = proposing_answer();
  ASSERT_TRUE(proposing);
  const LoopAnswer& answer = *proposing;
  ASSERT_TRUE(answer.next());
  const NextRun& next = *answer.next();
  const Limits limits = limits_of(answer.found().base.data().observations);
  ASSERT_EQ(next.quantities.size(), limits.size());
  for (const std::string& name : next.quantities) {
    const double value = condition_view(name).get(next.at);
    EXPECT_GE(value, limits.at(name).first) << name;
    EXPECT_LE(value, limits.at(name).second) << name;
  }
  ASSERT_EQ(next.separates.size(), 2U);
  EXPECT_EQ(next.separates[0], answer.found().best().ids);
  EXPECT_NE(next.separates[1], next.separates[0]);
  EXPECT_GE(next.runs, 1);
  EXPECT_LE(next.runs, 50);
  EXPECT_GT(next.distance, 0.0);
}

// A pneumatic tire is let out and pumped up about its declared pressure, though no run varied it; a rigid one is not.
TEST(LoopChoices, PressureIsALeverOfTheNextRun) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 1);
  const Observations runs = observe(campaign);
  EXPECT_FALSE(limits_of(runs, campaign.wheel).contains("inflation_pressure"));
  campaign.wheel.inflation_pressure = 40e3;
  EXPECT_EQ(limits_of(runs, campaign.wheel).at("inflation_pressure"), std::pair(20e3, 50e3));
  for (compare::Run& run : campaign.runs) run.at.inflation_pressure = 30e3 + 1e3 * *run.at.run;
  const std::pair ran = {31e3, 30e3 + 1e3 * static_cast<double>(campaign.runs.size())};
  EXPECT_EQ(limits_of(observe(campaign), campaign.wheel).at("inflation_pressure"), ran);
}

// The pressure that no run tells is the tire's: a next run that leaves it, or any other condition, says so. A tire so
// hard that its pressure tells nothing keeps it.
TEST(LoopChoices, TheNextRunTellsWhatLiesBeyondTheRuns) {
  const std::optional<LoopAnswer> proposing = proposing_answer(400e3);
  ASSERT_TRUE(proposing);
  const NextRun& next = *proposing->next();
  ASSERT_THAT(next.quantities, testing::Contains("inflation_pressure"));
  ASSERT_TRUE(next.at.inflation_pressure);
  const Limits run = ranges_of(proposing->found().base.data().observations);
  for (const std::string& name : next.quantities) {
    const double value = condition_view(name).get(next.at);
    const auto [least, most] = name == "inflation_pressure" ? std::pair(400e3, 400e3) : run.at(name);
    EXPECT_EQ(std::ranges::find(next.beyond, name) != next.beyond.end(), value < least || value > most)
        << name << " = " << value;
  }
  EXPECT_EQ(*next.at.inflation_pressure, 400e3);
}

}  // namespace
}  // namespace soilbin::compare
