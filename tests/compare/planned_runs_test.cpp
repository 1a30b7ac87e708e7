// A designed test: the shapes' distances by hand, what every plan must vary, what no plan may fall below.
#include "compare/test_design/planned_runs.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "compare/loop_fixture.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using Eigen::MatrixXd;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

double phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Two effects of one form each, one soil value; a run tells (d_1, d_2, J) on one channel.
EffectShapes by_hand(std::vector<std::array<double, 3>> runs) {
  EffectShapes shapes;
  shapes.ids = {"first", "second"};
  shapes.shapes = {{0, true, 1.0}, {1, true, 1.0}};
  shapes.soil = 1;
  for (const auto& run : runs) shapes.sensitivities.push_back(Eigen::RowVector3d(run[0], run[1], run[2]));
  return shapes;
}

MatrixXd information(const EffectShapes& shapes) {
  MatrixXd sum = MatrixXd::Zero(shapes.columns(), shapes.columns());
  for (const MatrixXd& run : shapes.sensitivities) sum += run.transpose() * run;
  return sum;
}

const CandidatePair& between(const std::vector<CandidatePair>& all, std::size_t truth,
                             std::optional<std::size_t> other) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const CandidatePair& r) { return r.truth == truth && r.other == other; });
}

// d_1 = (3, 0), d_2 = (4, 4): S_11 = 9, S_12 = 12, S_22 = 32, so D = 9 - 144/32 = 4.5 and 32 - 144/9 = 16.
TEST(EffectShapes, DistanceIsWhatTheNearestCandidateLeaves) {
  const EffectShapes shapes = by_hand({{3, 4, 0}, {0, 4, 0}});
  const auto all = candidate_pairs(shapes, information(shapes));
  ASSERT_THAT(all, SizeIs(4));
  EXPECT_NEAR(between(all, 0, 1).separation, std::sqrt(4.5), 1e-12);
  EXPECT_NEAR(between(all, 1, 0).separation, 4.0, 1e-12);
  EXPECT_NEAR(between(all, 0, {}).separation, 3.0, 1e-12);
  EXPECT_NEAR(between(all, 0, 1).right, phi(std::sqrt(4.5) / 2), 1e-12);
  EXPECT_NEAR(share_named_right(shapes, information(shapes)),
              0.5 * (phi(std::sqrt(4.5) / 2) * phi(1.5) + phi(2.0) * phi(std::sqrt(32.0) / 2)), 1e-12);
}

// A shape against its own sign is not taken for it where physics fixes both signs: d_2 = -d_1 leaves all of it.
TEST(EffectShapes, AnOppositeShapeOfFixedSignExplainsNothing) {
  EffectShapes shapes = by_hand({{2, -2, 0}});
  EXPECT_NEAR(between(candidate_pairs(shapes, information(shapes)), 0, 1).separation, 2.0, 1e-12);
  shapes.shapes[1].one_sided = false;
  EXPECT_NEAR(between(candidate_pairs(shapes, information(shapes)), 0, 1).separation, 0.0, 1e-12);
}

// A soil value whose column is j times the shape's, prior sd 1: S = d^2 (1 - j^2/(1 + j^2)).
TEST(EffectShapes, TheSoilTakesWhatItsPriorAllows) {
  const EffectShapes shapes = by_hand({{1, 0, 3}});
  EXPECT_NEAR(shapes.off_soil(information(shapes))(0, 0), 1.0 / 10.0, 1e-12);
}

/// A wheel of which nothing is measured yet, on a rig that goes so far.
Campaign unmeasured() { return sand_campaign(); }
DesignOptions options(int runs) {
  return {.runs = runs, .limits = {{"load", {600, 1500}}, {"slip", {-0.2, 0.6}}}, .threads = 2};
}

// The size of an effect: mean D beside nothing of 1 a run, over the conditions that may be chosen.
TEST(EffectShapes, EachShapeIsAsLargeAsTheNoise) {
  std::vector<OperatingCondition> conditions;
  for (const double load : {600.0, 1000.0, 1500.0})
    for (const double slip : {-0.1, 0.1, 0.3, 0.5}) {
      conditions.emplace_back();
      conditions.back().load = load, conditions.back().slip = slip;
    }
  const Campaign campaign = unmeasured();
  const EffectShapes shapes = effect_shapes(campaign, conditions, conditions.size(), usual_noise(campaign, conditions));
  ASSERT_GE(shapes.ids.size(), 8U);
  EXPECT_THAT(shapes.not_shown, testing::IsSupersetOf({"multipass", "moisture", "soil_gradient", "drift"}));
  const MatrixXd s = shapes.off_soil(information(shapes));
  for (Eigen::Index f = 0; f < s.cols(); ++f) EXPECT_NEAR(s(f, f) / 12, 1.0, 1e-9) << f;
}

TEST(TestDesign, KeepsWithinTheLimitsAndRepeatsAConditionOnce) {
  const TestDesign design = design_test(unmeasured(), options(24));
  ASSERT_THAT(design.runs, SizeIs(24));
  EXPECT_THAT(design.varied, ElementsAre("slip", "load"));
  std::map<std::pair<double, double>, int> times;
  std::set<int> numbers;
  for (const compare::Run& run : design.runs) {
    EXPECT_TRUE(run.at.load >= 600.0 && run.at.load <= 1500.0);
    EXPECT_TRUE(run.at.slip >= -0.2 && run.at.slip <= 0.6);
    ++times[{run.at.load, run.at.slip}], numbers.insert(*run.at.run);
  }
  for (const auto& [at, count] : times) EXPECT_LE(count, 2);
  EXPECT_EQ(*numbers.begin(), 1);
  EXPECT_EQ(*numbers.rbegin(), 24);
  EXPECT_FALSE(design.noise[lateral_force]) << "no side force without yaw or cross slope";
}

TEST(TestDesign, IsTheSameAgainWhateverTheThreads) {
  DesignOptions alone = options(12);
  alone.threads = 1;
  const TestDesign one = design_test(unmeasured(), alone), several = design_test(unmeasured(), options(12));
  EXPECT_EQ(report_on(one).data(), report_on(several).data());
}

// With soil values that nobody knows beforehand, a bed whose stiffness or strength goes with the place is at one place
// just another soil. So a plan that asks for it must visit several, and at one place nothing shows it.
TEST(TestDesign, VariesWhatAloneSetsAnEffectOffFromTheSoil) {
  Campaign campaign = unmeasured();
  for (Estimate* e : {&campaign.soil.k_c, &campaign.soil.k_phi, &campaign.soil.cohesion}) e->std_error = 100 * e->value;
  campaign.soil.friction_angle.std_error = 10.0;
  for (const int runs : {6, 10}) {
    DesignOptions asked = options(runs);
    asked.effects = {"soil_gradient"};
    asked.limits["position"] = {0.5, 4.5};
    const TestDesign design = design_test(campaign, asked);
    std::set<double> places;
    for (const compare::Run& run : design.runs) places.insert(*run.at.position);
    EXPECT_GE(places.size(), 2U);
    EXPECT_GT(design.planned.candidate_pairs.front().separation, 2.0);
    asked.limits["position"] = {0.5, 0.5};
    EXPECT_THROW(design_test(campaign, asked), InputError);
  }
}

// The sweep is where one of the searches starts, and no exchange makes it worse.
TEST(TestDesign, IsNeverBelowItsSweep) {
  for (const int runs : {4, 9, 24}) {
    const TestDesign design = design_test(unmeasured(), options(runs));
    EXPECT_GE(design.planned.named_right, design.swept.named_right) << runs;
    EXPECT_THAT(design.swept.runs, SizeIs(runs));
  }
}

// What more runs tell is never less: a sum of squares grows.
TEST(SlowTestDesign, MoreRunsAreNeverWorse) {
  double before = 0.0;
  for (const int runs : {4, 6, 12, 24, 48}) {
    const double now = design_test(unmeasured(), options(runs)).planned.named_right;
    EXPECT_GT(now, before) << runs;
    before = now;
  }
}

TEST(SlowTestDesign, CountsOnTheRunsThatAreMade) {
  Campaign campaign = unmeasured();
  measure(campaign, sweep(), {}, fine_noise, 1);
  for (compare::Run& run : campaign.runs) run.lateral_force.reset();
  const DesignOptions asked = options(12);
  const TestDesign fresh = design_test(unmeasured(), asked), more = design_test(campaign, asked);
  EXPECT_EQ(more.made, 42U);
  EXPECT_GT(more.swept.named_right, fresh.swept.named_right);
  for (const compare::Run& run : more.runs) EXPECT_GT(*run.at.run, 42);
}

// Labels say which runs repeat each other, so a second plan's are none of the first one's.
TEST(TestDesign, ASecondPlanHasLabelsAndNumbersOfItsOwn) {
  Campaign campaign = unmeasured();
  campaign.runs = design_test(campaign, options(8)).runs;
  std::set<std::string> labels;
  for (compare::Run& run : campaign.runs) run.drawbar_pull = 10.0, labels.insert(*run.setpoint);
  for (const compare::Run& run : design_test(campaign, options(8)).runs) {
    EXPECT_FALSE(labels.contains(*run.setpoint)) << *run.setpoint;
    EXPECT_GT(*run.at.run, 8);
  }
}

// The middle of these loads is far beyond what the soil carries.
TEST(TestDesign, LeavesOutWhatTheSoilDoesNotCarry) {
  DesignOptions asked = options(8);
  asked.limits["load"] = {600, 300e3};
  for (const OperatingCondition& at : design_test(unmeasured(), asked).swept.runs) EXPECT_LT(at.load, 100e3);
}

TEST(TestDesign, RefusesWhatItCannotPlan) {
  const auto refusal = [](const Campaign& campaign, const DesignOptions& asked) {
    return soilbin::test::error_of([&] { design_test(campaign, asked); });
  };
  DesignOptions asked = options(12);
  asked.effects = {"slip_sinkag"};
  EXPECT_THAT(refusal(unmeasured(), asked), HasSubstr("did you mean 'slip_sinkage'"));
  asked.effects = {"multipass"};
  EXPECT_THAT(refusal(unmeasured(), asked), HasSubstr("no test within these limits shows multipass"));
  Campaign declared = unmeasured();
  declared.effects = {{"slip_sinkage", "lyasko", {}}};
  asked.effects = {"slip_sinkage"};
  EXPECT_THAT(refusal(declared, asked), HasSubstr("has it already"));
  EXPECT_THAT(refusal(unmeasured(), {.limits = {{"slip", {0, 0.5}}}}), HasSubstr("which loads the rig can carry"));
  EXPECT_THAT(refusal(unmeasured(), {.limits = {{"load", {1e6, 2e6}}}}), HasSubstr("carries the wheel nowhere"));
}

TEST(TestDesign, ItsRowsHoldTheMeasuredChannelsToFillIn) {
  DesignOptions asked = options(5);
  asked.noise[drawbar_pull] = 5.0, asked.noise[sinkage] = 3e-4;
  const std::string rows = rows_to_fill_in(design_test(unmeasured(), asked));
  EXPECT_THAT(rows, testing::StartsWith("run,setpoint,load_N,slip,drawbar_pull_N,sinkage_m\n"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 6);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), ','), 6 * 5);
}

}  // namespace
}  // namespace soilbin::compare
