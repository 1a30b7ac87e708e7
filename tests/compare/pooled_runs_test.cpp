// Runs that lie near each other taken as one: what is kept of them, and what is not lost.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "compare/attribution/candidates.hpp"
#include "compare/fit/fitted_model.hpp"
#include "compare/loop_fixture.hpp"

namespace soilbin::compare {
namespace {

using Eigen::VectorXd;

/// Three loads by seven slips, each run ten times on the level; nothing else varies.
Campaign repeated() {
  std::vector<OperatingCondition> rows;
  for (int again = 0; again < 5; ++again) {
    std::vector<OperatingCondition> once = sweep();
    for (OperatingCondition& at : once) at.pass = 1, at.position.reset();
    rows.insert(rows.end(), once.begin(), once.end());
  }
  Campaign campaign = sand_campaign();
  measure(campaign, rows, {}, fine_noise, 5);
  for (Run& run : campaign.runs) run.at.run.reset(), run.setpoint.reset();
  return campaign;
}

// 210 rows of 21 conditions in at most 21 groups: each group is a condition. In fewer, every row is in one group all
// the same, and none holds two passes.
TEST(PooledRuns, GroupsAreNeighbours) {
  const Observations one_pass = observe(repeated());
  const auto groups = near_rows(one_pass, 21);
  ASSERT_EQ(groups.size(), 21u);
  for (const std::vector<int>& group : groups) {
    EXPECT_EQ(group.size(), 10u);
    for (const int row : group) EXPECT_EQ(one_pass.condition[row], one_pass.condition[group.front()]);
  }
  Campaign mixed = sand_campaign();
  measure(mixed, sweep(), {}, fine_noise, 6);
  const Observations two_passes = observe(mixed);
  std::set<int> seen;
  const auto few = near_rows(two_passes, 8);
  EXPECT_EQ(few.size(), 8u);
  for (const std::vector<int>& group : few)
    for (const int row : group) {
      EXPECT_TRUE(seen.insert(row).second);
      EXPECT_EQ(two_passes.rows[row].pass, two_passes.rows[group.front()].pass);
    }
  EXPECT_EQ(seen.size(), two_passes.rows.size());
}

// Where the runs of a group are re-runs, chi2 of their means differs from that of all runs by the same at every soil:
// by the squares within the groups, N - n cells' worth of noise.
TEST(SlowPooledRuns, RerunsLoseNothing) {
  const Campaign campaign = repeated();
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  const auto few = pooled(base, 21);
  ASSERT_TRUE(few);
  const auto chi2 = [](const FittedModel& model, const VectorXd& theta) {
    VectorXd predicted;
    EXPECT_TRUE(model.predictor().predict(theta, predicted));
    return model.data().whitening(VectorXd(model.data().observations.values() - predicted)).squaredNorm();
  };
  const WithinPools& within = few->data().within_pools;
  EXPECT_EQ(within.cells, 3 * (210 - 21));
  EXPECT_NEAR(within.chi2 / within.cells, 1.0, 4 * std::sqrt(2 / within.cells));
  for (const double moved : {-0.5, 0.0, 0.3, 1.0}) {
    VectorXd theta = base.fit().theta;
    for (int i = 0; i < base.predictor().soil_parameters(); ++i)
      theta[i] += (i % 2 == 0 ? moved : -moved) * base.predictor().parameters()[i].scale;
    const double all = chi2(base, theta);
    EXPECT_NEAR(all - chi2(*few, theta), within.chi2, 1e-7 * all) << moved;
  }
  for (int i = 0; i < base.predictor().soil_parameters(); ++i)
    EXPECT_NEAR(few->fit().theta[i], base.fit().theta[i], 0.02 * base.predictor().parameters()[i].scale);
}

// 210 runs, more than are searched, with a wheel that digs itself in: the search beside pooled runs names it.
TEST(SlowPooledRuns, AnEffectOfManyRunsIsFound) {
  std::vector<OperatingCondition> rows;
  for (int again = 0; again < 5; ++again)
    for (OperatingCondition at : sweep()) {
      at.load *= 1 + 0.02 * again, at.slip += 0.008 * again;
      rows.push_back(at);
    }
  Campaign campaign = sand_campaign();
  measure(campaign, rows, {{"slip_sinkage", "lyasko", {}}}, fine_noise, 7);
  const Attribution found = attribute(fit_base(campaign, observe(campaign), {}), {});
  ASSERT_TRUE(found.candidates.best);
  EXPECT_TRUE(found.best().ids.contains("slip_sinkage"));
  EXPECT_EQ(found.best().model.data().observations.rows.size(), 210u);  // fitted to all
}

}  // namespace
}  // namespace soilbin::compare
