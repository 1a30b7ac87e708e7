// What the loop makes of effects near the edge of what the data can tell, and what it would measure next.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/fit/evidence.hpp"
#include "compare/loop/loop.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {
namespace {

LoopAnswer answer_to(double slip_sinkage, std::uint64_t seed) {
  Campaign campaign = sand_campaign();
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
    return a.judgement && a.judgement->choice && a.found().signatures.p_value < 0.05 &&
           a.choice().gain.mean < a.choice().gain.std_error;
  };
  LoopAnswer answer;
  for (std::uint64_t seed = 23; seed < 150 && !seen_but_useless(answer); ++seed) answer = answer_to(0.03, seed);
  ASSERT_TRUE(seen_but_useless(answer));
  EXPECT_EQ(answer.verdict, Verdict::nothing_missing) << answer.reason;
  EXPECT_THAT(answer.reason, testing::HasSubstr("does not improve cross-validated predictions"));
  EXPECT_TRUE(answer.effects.empty());
  EXPECT_FALSE(answer.next);
}

// One candidate comes near the noise, so each is weighed against noise of a known size.
TEST(LoopChoices, CandidatesAreWeighedByTheNoiseWhereOneComesNearIt) {
  const LoopAnswer answer = answer_to(0.5, 22);
  const Candidates& candidates = answer.found().candidates;
  ASSERT_FALSE(candidates.none_near_noise);
  ASSERT_GE(candidates.models.size(), 5U);
  for (const CandidateModel& c : candidates.models) {
    EXPECT_DOUBLE_EQ(c.log_evidence, log_evidence(c.model, false));
    EXPECT_NE(c.log_evidence, log_evidence(c.model, true));
  }
}

// Slip sinkage is found, alone. The next run sets it against the set behind, within what the campaign allows.
TEST(LoopChoices, TheNextRunLiesWithinTheLimitsAndSetsTheBestAgainstAnother) {
  const LoopAnswer answer = answer_to(0.5, 22);
  ASSERT_EQ(answer.verdict, Verdict::effect_found) << answer.reason;
  ASSERT_TRUE(answer.next);
  const NextTest& next = *answer.next;
  const Limits limits = limits_of(answer.found().base.data().observations);
  ASSERT_EQ(next.quantities.size(), limits.size());
  for (const std::string& name : next.quantities) {
    const double value = condition_view(name).get(next.at);
    EXPECT_GE(value, limits.at(name).first) << name;
    EXPECT_LE(value, limits.at(name).second) << name;
  }
  ASSERT_EQ(next.separates.size(), 2U);
  EXPECT_EQ(next.separates[0], std::set<std::string>{"slip_sinkage"});
  EXPECT_NE(next.separates[1], next.separates[0]);
  EXPECT_GE(next.runs, 1);
  EXPECT_LE(next.runs, 50);
  EXPECT_GT(next.distance, 0.0);
}

}  // namespace
}  // namespace soilbin::compare
