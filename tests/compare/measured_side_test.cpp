#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bekker_wong/gsl.hpp"
#include "compare/comparison_fixture.hpp"
#include "compare/discrepancy/side.hpp"
#include "scenario/errors.hpp"
#include "scenario/yawed_frames.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// The base model's answers at the study's motions as a rig with these definitions would have measured them.
Campaign told_by(const Case& question, ForceFrame frame, SlipBy by) {
  Case rig = question;
  for (OperatingCondition& at : rig.study.conditions) {
    at.slip = slip_by(at.slip, at.yaw, at.slip_by, by);
    at.slip_by = by, at.force_frame = frame;
  }
  Campaign campaign = as_campaign(side_of(base_answers(rig)), rig);
  campaign.name = "rig";
  return campaign;
}

Case yawed_study() {
  Case question = sand_study({0.1, 0.3, 0.5});
  const std::vector<OperatingCondition> straight = question.study.conditions;
  for (const double yaw : {20.0, 40.0})
    for (OperatingCondition at : straight) at.yaw = yaw * degree, question.study.conditions.push_back(at);
  return question;
}

double value_at(const Side& side, std::size_t condition, std::size_t channel) {
  return ((*side.points[condition].result).*channel_views[channel].predicted).value;
}

// The same nature told in the wheel's axes, and by the slip of the whole speed, is the same nature.
TEST(MeasuredSide, FramesAndSlipsOfTheCampaignAreTurnedToTheStudys) {
  const Case question = yawed_study();
  const Side model = side_of(base_answers(question));
  for (const ForceFrame frame : {ForceFrame::travel, ForceFrame::wheel})
    for (const SlipBy by : {SlipBy::wheel_plane_speed, SlipBy::travel_speed}) {
      const Side rig = side_of(told_by(question, frame, by), question);
      for (std::size_t i = 0; i < question.study.conditions.size(); ++i)
        for (std::size_t c = 0; c < channel_views.size(); ++c)
          EXPECT_NEAR(value_at(rig, i, c), value_at(model, i, c), 1e-9 * 1000) << i << " " << channel_views[c].name;
    }
}

// By the speed of travel, 0.5 at 40 deg of yaw is 1 - 0.5 cos 40 deg = 0.617 in the wheel's plane, and near no
// condition; 0.1 is 1 - 0.9 cos 40 deg = 0.311, and near 0.3. At 20 deg all three move by 0.03 to 0.05, to no
// condition.
TEST(MeasuredSide, TheSameNumberOfSlipByAnotherSpeedIsAnotherCondition) {
  const Case question = yawed_study();
  Campaign campaign = told_by(question, ForceFrame::travel, SlipBy::wheel_plane_speed);
  for (auto& run : campaign.runs) run.at.slip_by = SlipBy::travel_speed;
  const Side side = side_of(campaign, question);
  for (std::size_t i = 0; i < question.study.conditions.size(); ++i) {
    const OperatingCondition& at = question.study.conditions[i];
    const bool moved_here = at.yaw == 40 * degree && at.slip == 0.3;
    EXPECT_EQ(side.points[i].result.has_value(), at.yaw == 0.0 || moved_here) << at.slip;
  }
}

// Two forces turn into two. One alone says nothing of the other frame, but where both are the same, at no yaw.
TEST(MeasuredSide, APullAloneIsLeftOutAtYawAndTheRestStays) {
  const Case question = yawed_study();
  Campaign campaign = told_by(question, ForceFrame::wheel, SlipBy::wheel_plane_speed);
  for (auto& run : campaign.runs) run.lateral_force.reset();
  const Side side = side_of(campaign, question);
  for (std::size_t i = 0; i < question.study.conditions.size(); ++i) {
    const bool straight = question.study.conditions[i].yaw == 0.0;
    EXPECT_EQ(side.points[i].has[0], straight);
    EXPECT_TRUE(side.points[i].has[1] && side.points[i].has[2]);
    EXPECT_EQ(tell_of(side.points[i].doubts, DoubtKind::forces_not_turned_to_travel), !straight);
  }
  for (auto& run : campaign.runs) run.at.force_frame = ForceFrame::travel;
  EXPECT_TRUE(side_of(campaign, question).points.back().has[0]) << "in the study's own frame it needs no turning";
}

// Runs of +-8 N about the pull in the wheel's plane, one lateral force: at 60 deg they are +-8 cos 60 along travel and
// +-8 sin 60 across, so the spread of 8 sqrt(2) is turned with them.
TEST(MeasuredSide, ErrorsAreThoseOfTheTurnedForces) {
  Case question = sand_study({0.2});
  question.study.conditions[0].yaw = 60 * degree;
  Campaign campaign = told_by(question, ForceFrame::wheel, SlipBy::wheel_plane_speed);
  campaign.runs.push_back(campaign.runs[0]);
  *campaign.runs[0].drawbar_pull -= 8, *campaign.runs[1].drawbar_pull += 8;
  const TractionResult result = *side_of(campaign, question).points[0].result;
  EXPECT_NEAR(result.drawbar_pull.std_error, 8 * std::cos(60 * degree), 1e-9);
  EXPECT_NEAR(result.lateral_force.std_error, 8 * std::sin(60 * degree), 1e-9);
}

class Rig : public testing::Test {
 protected:
  Case question = sand_study({0.0, 0.1, 0.2, 0.4});
  Campaign campaign = told_by(question, ForceFrame::travel, SlipBy::wheel_plane_speed);

  /// Makes a condition's run into two, of these pulls more and less.
  void run_twice(std::size_t condition, double pull) {
    campaign.runs.push_back(campaign.runs[condition]);
    *campaign.runs[condition].drawbar_pull -= pull, *campaign.runs.back().drawbar_pull += pull;
  }
};

TEST_F(Rig, RunsCountAtTheNearestConditionIfTheyAreNearAny) {
  const double pull = *campaign.runs[2].drawbar_pull;
  run_twice(2, 8);
  campaign.runs.back().at.slip += 0.01;
  campaign.runs.push_back(campaign.runs[2]);
  campaign.runs.back().at.load *= 1.5;  // near none
  const Side side = side_of(campaign, question);
  EXPECT_EQ(side.points[2].runs, 2U);
  EXPECT_NEAR(side.points[2].result->drawbar_pull.value, pull, 1e-9);
  EXPECT_NEAR(side.points[2].result->drawbar_pull.std_error, 8.0, 1e-9);  // spread 8 sqrt(2) over sqrt(2)
}

// Pairs of +-6 and +-8 N: variances 72 and 128 with one degree of freedom each, 100 with two. So one run has 10 N, also
// where it was made once, and a pair's mean 10/sqrt(2) N, also where the pair happens to agree.
TEST_F(Rig, NoiseIsPooledOverAllSetpointsRunTwice) {
  run_twice(0, 6), run_twice(1, 8);
  Side side = side_of(campaign, question);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(side.points[i].scatter[0], 10.0, 1e-9);
    EXPECT_NEAR(side.points[i].result->drawbar_pull.std_error, i < 2 ? 10 / std::sqrt(2.0) : 10.0, 1e-9);
    EXPECT_EQ(side.points[i].freedom[0], 2.0);
    EXPECT_THAT(side.points[i].doubts, IsEmpty());
  }
  run_twice(2, 0);
  side = side_of(campaign, question);
  EXPECT_NEAR(side.points[2].result->drawbar_pull.std_error, std::sqrt(200.0 / 3 / 2), 1e-9)
      << "200 N^2 over 3, of 2 runs";
}

TEST_F(Rig, ReRunsNearNoConditionOfTheStudyTellTheNoiseToo) {
  run_twice(0, 6), run_twice(1, 8);
  question.study.conditions = {question.study.conditions[3]};
  EXPECT_NEAR(side_of(campaign, question).points[0].scatter[0], 10.0, 1e-9);
}

TEST_F(Rig, WithoutReRunsTheScatterIsNotKnown) {
  for (const SidePoint& point : side_of(campaign, question).points) {
    EXPECT_EQ(point.result->drawbar_pull.std_error, 0.0);
    EXPECT_TRUE(tell_of(point.doubts, DoubtKind::no_reruns));
  }
}

Lugs lugs(double height, std::optional<int> count) {
  Lugs all;
  all.height = height, all.count = count;
  return all;
}

TEST_F(Rig, AnotherWheelIsRefused) {
  const auto refused = [&](const auto& change) {
    Campaign other = campaign;
    change(other.wheel);
    return soilbin::test::error_of([&] { side_of(other, question); });
  };
  EXPECT_EQ(refused([](Tire& t) { t.radius *= 1.04, t.width *= 0.96; }), "");
  EXPECT_THAT(refused([](Tire& t) { t.radius *= 1.06; }), HasSubstr("measured wheel (r 265 mm"));
  EXPECT_THAT(refused([](Tire& t) { t.width *= 1.06; }), HasSubstr("b 106 mm"));
  EXPECT_THAT(refused([](Tire& t) { t.lugs = lugs(0.015, 20); }), HasSubstr("20 lugs of 15 mm"));
  EXPECT_THAT(refused([](Tire& t) { t.inflation_pressure = 150e3; }), HasSubstr("150 kPa"));
  question.scenario.tire.lugs = lugs(0.015, 20);
  EXPECT_THAT(refused([](Tire&) {}), HasSubstr("smooth"));
  EXPECT_THAT(refused([](Tire& t) { t.lugs = lugs(0.015, 24); }), HasSubstr("24 lugs"));
  EXPECT_THAT(refused([](Tire& t) { t.lugs = lugs(0.012, 20); }), HasSubstr("lugs of 12 mm"));
  EXPECT_EQ(refused([](Tire& t) { t.lugs = lugs(0.015, std::nullopt); }), "") << "their number isn't always known";
}

// What the loop is given is what `soilbin loop` reads: each run in its order, place, frame and setpoint.
TEST(MeasuredSide, TheLoopLooksAtTheRunsAsTheyWereMeasured) {
  const Case question = yawed_study();
  Campaign campaign = told_by(question, ForceFrame::wheel, SlipBy::travel_speed);
  campaign.runs.insert(campaign.runs.end(), campaign.runs.begin(), campaign.runs.begin() + 3);
  for (std::size_t i = 0; i < campaign.runs.size(); ++i)
    campaign.runs[i].at.run = static_cast<int>(i + 1), campaign.runs[i].at.position = 0.5 * static_cast<double>(i % 4);
  campaign.soil.cohesion.value = 1;  // the case's soil is the declared one
  const Campaign looped = as_campaign(side_of(campaign, question), question);
  ASSERT_EQ(looped.runs.size(), campaign.runs.size());
  EXPECT_EQ(looped.force_frame, ForceFrame::wheel);
  EXPECT_EQ(looped.slip_by, SlipBy::travel_speed);
  EXPECT_EQ(looped.soil.cohesion.value, question.scenario.soil.semi_empirical->cohesion.value);
  EXPECT_EQ(observe(looped).rerun_freedom(), 3);
  for (std::size_t i = 0; i < looped.runs.size(); ++i) {
    EXPECT_EQ(looped.runs[i].at.run, campaign.runs[i].at.run);
    EXPECT_EQ(looped.runs[i].at.position, campaign.runs[i].at.position);
    EXPECT_EQ(looped.runs[i].at.slip, campaign.runs[i].at.slip);
    EXPECT_EQ(looped.runs[i].drawbar_pull, campaign.runs[i].drawbar_pull);
    EXPECT_EQ(looped.runs[i].setpoint, campaign.runs[i].setpoint);
  }
}

/// 200 setpoints of two runs, the pull from 0 to 1000 N with noise of sd `floor` and of `growth` times the pull.
NoiseFloor noise_of_pairs(double floor, double growth, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Run> runs(400);
  std::vector<std::vector<const Run*>> setpoints(200);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double pull = 5.0 * static_cast<double>(i / 2);
    runs[i].drawbar_pull = pull + std::hypot(floor, growth * pull) * normal(random);
    setpoints[i / 2].push_back(&runs[i]);
  }
  return rerun_noise(setpoints);
}

// 200 degrees of freedom know a standard deviation to 1/sqrt(400) = 5 %; three times that, and the size at the ends.
TEST(RerunNoise, GrowsWithTheSignalWhereTheReRunsShowIt) {
  const ChannelNoise grows = noise_of_pairs(1.0, 0.05, 1).channels[0];
  EXPECT_NEAR(grows.sd(800) / (0.05 * 800), 1.0, 0.15);
  EXPECT_LT(grows.sd(0), 0.25 * grows.sd(800));
  const ChannelNoise steady = noise_of_pairs(10.0, 0.0, 2).channels[0];
  EXPECT_EQ(steady.growth, 0.0);
  EXPECT_NEAR(steady.floor / 10, 1.0, 0.15);
  EXPECT_EQ(steady.freedom, 200.0);
}

// One channel is Fisher's F to the digit; with many degrees of freedom the covariance is known, and the sum chi square.
TEST(TraceTail, IsFForOneChannelAndChiSquareWhereTheErrorsAreKnown) {
  EXPECT_DOUBLE_EQ(trace_tail(30, 20, 1, 9), gsl::f_tail(1.5, 20, 9));
  EXPECT_NEAR(trace_tail(75, 60, 3, 1e6), gsl::chi_square_tail(75, 60), 1e-4);
  EXPECT_GT(trace_tail(75, 60, 3, 20), 2 * gsl::chi_square_tail(75, 60)) << "few re-runs: less sure";
}

/// Campaigns of exact truth: 21 conditions, two runs each, noise in pull and torque correlated by 0.6.
class NullCampaigns {
 public:
  NullCampaigns() {
    SemiEmpiricalSoil& soil = *question.scenario.soil.semi_empirical;
    for (Estimate* e : {&soil.exponent, &soil.k_phi, &soil.cohesion, &soil.friction_angle, &soil.shear_modulus,
                        &soil.stress_angle_c1, &soil.stress_angle_c2})
      e->std_error = 0.0;
    truth = as_campaign(model = side_of(base_answers(question)), question);
  }

  Side measured(std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Campaign campaign = truth;
    campaign.runs.insert(campaign.runs.end(), truth.runs.begin(), truth.runs.end());
    for (auto& run : campaign.runs) {
      const double shared = normal(random);
      *run.drawbar_pull += 6.0 * shared;
      *run.torque += 2.0 * (0.6 * shared + 0.8 * normal(random));
      *run.sinkage += 4e-4 * normal(random);
    }
    return side_of(campaign, question);
  }

  Case question = sand_study({0.05, 0.12, 0.2, 0.3, 0.42, 0.55, 0.7}, {600, 1000, 1500});
  Side model;
  Campaign truth;
};

/// Three standard deviations of the share of n trials that chance p passes.
double binomial_limit(double p, double n) { return 3 * std::sqrt(p * (1 - p) / n); }

// A row is passed by chance once in 22 (two standard errors of a normal), also where each point has two runs. One row
// of a campaign and channel: rows of one campaign share its pooled noise.
TEST(SlowNullCampaigns, ChanceMakesAsManyDifferencesAsTheRuleSays) {
  constexpr int campaigns = 3000;
  const NullCampaigns null;
  const double chance = std::erfc(2 / std::sqrt(2.0));  // 4.55 %
  std::array<int, 3> differ{};
  for (int k = 0; k < campaigns; ++k) {
    const std::vector<Side> sides = {null.model, null.measured(1000 + static_cast<std::uint64_t>(k))};
    for (const Difference& d : differences(sides, 0, 1, null.question.study.conditions, null.question.scenario.tire))
      if (d.condition == static_cast<std::size_t>(k) % 21)
        differ[d.channel] += d.finding == DifferenceFinding::difference;
  }
  for (const int count : differ)
    EXPECT_NEAR(static_cast<double>(count) / campaigns, chance, binomial_limit(chance, campaigns));
}

// The joint p-value of campaigns that differ in nothing is uniform: Kolmogorov's distance stays below what chance
// passes once in a hundred, 1.63/sqrt(n), and one in twenty and one in a hundred fall below 0.05 and 0.01.
TEST(SlowNullCampaigns, TheJointPValueIsUniform) {
  constexpr int campaigns = 400;
  const NullCampaigns null;
  std::vector<double> p;
  for (int k = 0; k < campaigns; ++k) {
    const auto test = joint_test(null.measured(5000 + static_cast<std::uint64_t>(k)), null.question, {}).test;
    ASSERT_TRUE(test);
    ASSERT_EQ(test->freedom, 21.0);
    p.push_back(test->p_value);
  }
  std::sort(p.begin(), p.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    distance = std::max({distance, std::abs(p[i] - static_cast<double>(i) / campaigns),
                         std::abs(p[i] - static_cast<double>(i + 1) / campaigns)});
  EXPECT_LT(distance, 1.63 / std::sqrt(campaigns));
  for (const double level : {0.05, 0.01}) {
    const auto below = std::lower_bound(p.begin(), p.end(), level) - p.begin();
    EXPECT_NEAR(static_cast<double>(below) / campaigns, level, binomial_limit(level, campaigns));
  }
}

// Two setpoints run twice know the noise of one channel, but not the covariance of three.
TEST_F(Rig, TooFewReRunsHaveNoJointTestAndTheSummarySaysWhy) {
  run_twice(0, 6), run_twice(1, 8);
  for (const std::size_t i : {4, 5}) *campaign.runs[i].torque += 3, *campaign.runs[i].sinkage += 1e-4;
  const Side side = side_of(campaign, question);
  EXPECT_THAT(joint_test(side, question, {}).why_not,
              HasSubstr("2 runs beyond the first of a condition; 7 are needed"));
  for (auto& run : campaign.runs) run.torque.reset(), run.sinkage.reset();
  EXPECT_TRUE(joint_test(side_of(campaign, question), question, {}).test);
}

}  // namespace
}  // namespace soilbin::compare
