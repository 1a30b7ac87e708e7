// Runs of grains told as a campaign: every row is a run, what is hidden is gone, and the loop finds what was left out.
#include "compare/recorded/campaign_of_records.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>

#include "compare/comparison_fixture.hpp"
#include "compare/loop/loop.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

RecordedRun run_at(const OperatingCondition& at, double pull, std::uint64_t packing = 1) {
  RecordedRun run;
  TractionResult result;
  result.at = at;
  result.drawbar_pull = {pull, 1}, result.torque = {2 * pull, 1}, result.sinkage = {1e-5 * pull, 1e-4};
  result.lateral_force = {-pull, 1};
  run.answer = {at, result, ""};
  run.packing = packing, run.steady = true;
  return run;
}

/// Two conditions, one of them twice, on a slope of 5 deg.
std::vector<RecordedRun> on_a_slope() {
  OperatingCondition a, b;
  a.load = b.load = 1000, a.slip = 0.1, b.slip = 0.3;
  a.longitudinal_incline = b.longitudinal_incline = 5 * degree;
  return {run_at(a, 10), run_at(b, 20), run_at(a, 12, 2)};
}

const Scenario& sand_scenario() {
  static const Scenario scenario = sand_study({}).scenario;
  return scenario;
}

TEST(CampaignOfRecords, HasARowForEachRunAndKnowsRerunsByTheirConditions) {
  const CampaignOfRecords told = campaign_from_runs(sand_scenario(), on_a_slope(), {.name = "made"});
  ASSERT_EQ(told.campaign.runs.size(), 3U);
  ASSERT_EQ(told.runs.size(), 3U);
  std::multiset<double> pulls;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& row = told.campaign.runs[k];
    EXPECT_EQ(row.at.run, static_cast<int>(k) + 1);
    EXPECT_EQ(*row.drawbar_pull, told.runs[k].answer.result->drawbar_pull.value);
    EXPECT_EQ(*row.torque, 2 * *row.drawbar_pull);
    EXPECT_EQ(row.at.longitudinal_incline, 5 * degree);
    EXPECT_FALSE(row.lateral_force) << "zero by symmetry: not told";
    for (const auto& other : told.campaign.runs)
      EXPECT_EQ(row.setpoint == other.setpoint, row.at.slip == other.at.slip);
    pulls.insert(*row.drawbar_pull);
  }
  EXPECT_THAT(pulls, testing::ElementsAre(10, 12, 20));
  EXPECT_EQ(told.campaign.soil.exponent.std_error, 0.05) << "the declared doubt";
}

TEST(CampaignOfRecords, LeavesOutWhatIsHidden) {
  Scenario lugged = sand_scenario();
  lugged.tire.lugs = {.height = 0.01, .count = 12, .thickness = 0.005};
  lugged.bin = Bin{0.2, 0.5};
  const CampaignOfRecords told =
      campaign_from_runs(lugged, on_a_slope(), {.name = "made", .hide = {"longitudinal_incline", "lugs", "bin"}});
  for (const auto& row : told.campaign.runs) EXPECT_EQ(row.at.longitudinal_incline, 0);
  EXPECT_EQ(told.runs.front().answer.at.longitudinal_incline, 5 * degree) << "the truth stays with the runs";
  EXPECT_FALSE(is_lugged(told.campaign.wheel));
  EXPECT_FALSE(told.campaign.bin);
  EXPECT_TRUE(is_lugged(campaign_from_runs(lugged, on_a_slope(), {}).campaign.wheel));
}

TEST(CampaignOfRecords, TheOrderIsDrawnFromTheSeed) {
  const auto order = [](std::uint64_t seed) {
    std::vector<RecordedRun> runs;
    OperatingCondition at;
    at.load = 1;
    for (int k = 0; k < 20; ++k) at.slip = 0.01 * k, runs.push_back(run_at(at, k));
    std::vector<double> pulls;
    for (const auto& row : campaign_from_runs(sand_scenario(), runs, {.seed = seed}).campaign.runs)
      pulls.push_back(*row.drawbar_pull);
    return pulls;
  };
  EXPECT_EQ(order(1), order(1));
  EXPECT_NE(order(1), order(2));
  EXPECT_FALSE(std::is_sorted(order(1).begin(), order(1).end()));
}

TEST(CampaignOfRecords, TellsTheLateralForceWhereARunLeansOrIsYawed) {
  std::vector<RecordedRun> runs = on_a_slope();
  runs[1].answer.at.yaw = 0.1;
  const std::vector<compare::Run> told = campaign_from_runs(sand_scenario(), runs, {}).campaign.runs;
  ASSERT_EQ(told.size(), runs.size());
  for (const compare::Run& row : told) EXPECT_EQ(row.lateral_force, -*row.drawbar_pull);
}

TEST(CampaignOfRecords, CountsWhatItLeavesOut) {
  std::vector<RecordedRun> runs = on_a_slope();
  runs[0].answer.result.reset(), runs[1].steady = false;
  EXPECT_EQ(campaign_from_runs(sand_scenario(), runs, {}).without_result, 1U);
  const CampaignOfRecords told = campaign_from_runs(sand_scenario(), runs, {.only_steady = true});
  EXPECT_EQ(told.not_steady, 1U);
  EXPECT_EQ(told.campaign.runs.size(), 1U);
}

TEST(CampaignOfRecords, RefusesWhatItCannotTell) {
  const auto refusal = [](const Scenario& scenario, const CampaignOptions& disclosed) -> std::string {
    return soilbin::test::error_of([&] { campaign_from_runs(scenario, on_a_slope(), disclosed); });
  };
  EXPECT_THAT(refusal(sand_scenario(), {.hide = {"lug"}}), HasSubstr("did you mean 'lugs'?"));
  EXPECT_THAT(refusal(sand_scenario(), {.hide = {"load"}}), HasSubstr("nothing to hide is called 'load'"));
  Scenario grains = sand_scenario();
  grains.soil.semi_empirical.reset();
  EXPECT_THAT(refusal(grains, {}), HasSubstr("soilbin bevameter"));
  EXPECT_THROW(campaign_from_runs(sand_scenario(), {}, {}), InputError);
}

// A nature that is the base model on a bed that tilts by 4 deg, told as level: the loop names the tilt and its size.
TEST(SlowCampaignOfRecords, TheLoopFindsATiltThatWasNotTold) {
  Case question = sand_study({});
  std::vector<RecordedRun> runs;
  std::mt19937_64 random(5);
  std::normal_distribution<double> per_cent(0.0, 0.01);
  for (const double load : {400.0, 800.0, 1200.0})
    for (const double slip : {0.05, 0.2, 0.4})
      for (int packing = 1; packing <= 2; ++packing) {
        OperatingCondition at;
        at.load = load, at.slip = slip, at.longitudinal_incline = 4 * degree;
        Answer answer = ask(*make_model(ModelKind::bekker_wong), question.scenario, at);
        TractionResult& result = *answer.result;
        result.drawbar_pull.value += per_cent(random) * load;
        result.torque.value += per_cent(random) * 0.3 * load * 0.25;
        result.sinkage.value *= 1 + per_cent(random);
        RecordedRun run;
        run.answer = answer, run.packing = static_cast<std::uint64_t>(packing);
        runs.push_back(run);
      }
  const CampaignOfRecords told =
      campaign_from_runs(question.scenario, runs, {.name = "tilted", .hide = {"longitudinal_incline"}});
  LoopOptions options;
  options.validate = false;
  const LoopAnswer answer = run_loop(told.campaign, options);
  ASSERT_EQ(answer.verdict(), Verdict::effect_found);
  ASSERT_EQ(answer.effects().front().choice.id, "bed_tilt");
  EXPECT_NEAR(answer.effects().front().choice.parameters.at("a"), 4 * degree, 0.5 * degree);
}

}  // namespace
}  // namespace soilbin::compare
