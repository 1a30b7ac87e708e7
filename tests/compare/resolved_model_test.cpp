// The case that a loop saves: one condition for each that was run, however often.
#include <gmock/gmock.h>

#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

Campaign re_run_campaign() {
  Campaign campaign;
  campaign.name = "re-run";
  campaign.wheel.radius = 0.11, campaign.wheel.width = 0.1;
  for (int i = 0; i < 6; ++i) {
    Run run;
    run.at.load = 80, run.at.slip = i < 3 ? 0.2 : 0.4;
    run.at.run = i + 1, run.at.position = 0.1 * i;
    campaign.runs.push_back(run);
  }
  return campaign;
}

TEST(ResolvedModel, AsksEachConditionOnce) {
  const Case model = resolved_model(re_run_campaign(), {});
  ASSERT_EQ(model.study.conditions.size(), 2U);
  EXPECT_EQ(model.study.conditions[1].slip, 0.4);
  EXPECT_FALSE(model.study.conditions[0].run || model.study.conditions[0].position) << "nothing hears of these";
}

TEST(ResolvedModel, KeepsRunsApartWhereAnEffectHearsOfThem) {
  Campaign campaign = re_run_campaign();
  campaign.effects = {{"drift", "", {}}};
  const Case model = resolved_model(campaign, {});
  ASSERT_EQ(model.study.conditions.size(), 6U);
  EXPECT_EQ(model.study.conditions[5].run, 6);
}

}  // namespace
}  // namespace soilbin::compare
