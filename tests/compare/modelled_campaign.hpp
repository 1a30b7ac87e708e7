// A campaign whose rows are as the base model has them: what tests of doubts share.
#pragma once

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {

/// Eight runs over slip, so far apart, at one load as the base model has them.
inline Campaign modelled_campaign(double step = 0.05) {
  Campaign campaign;
  const Scenario scenario = test::wheel_on_sand();
  campaign.wheel = scenario.tire;
  campaign.soil = *scenario.soil.semi_empirical;
  for (int i = 0; i < 8; ++i) {
    Run run;
    run.at = test::condition(80, step * i);
    run.at.run = i + 1;
    run.csv_line = i + 2;
    const TractionResult told = *ask(*make_model(ModelKind::bekker_wong), scenario, run.at).result;
    run.drawbar_pull = told.drawbar_pull.value, run.torque = told.torque.value, run.sinkage = told.sinkage.value;
    campaign.runs.push_back(run);
  }
  return campaign;
}

}  // namespace soilbin::compare
