#include <gmock/gmock.h>

#include <cmath>

#include "compare/sweep/explanation.hpp"
#include "compare/sweep/prediction.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using test::condition;
using test::wheel_on_sand;
using testing::ElementsAre;
using testing::HasSubstr;

/// Pulls 10 N for each percent of slip, sinks 1 mm, and refuses slips above one half.
struct Linear final : Model {
  std::string name() const override { return "linear"; }
  TractionResult evaluate(const Scenario&, const OperatingCondition& at) const override {
    if (at.slip > 0.5) throw NoSolution("too much slip");
    TractionResult result;
    result.at = at;
    result.drawbar_pull.value = 1000 * at.slip;
    result.sinkage.value = 0.001;
    return result;
  }
};

Run measured(double slip, std::optional<double> pull, std::optional<double> sinkage) {
  Run run;
  run.at = condition(100, slip);
  run.drawbar_pull = pull, run.sinkage = sinkage;
  return run;
}

TEST(Sweep, AConditionWithoutSolutionDoesNotStopTheOthers) {
  std::size_t calls = 0;
  const std::vector<Answer> answers = sweep(Linear(), {}, {condition(1, 0.1), condition(1, 0.9), condition(1, 0.2)},
                                            [&](std::size_t done, std::size_t total) {
                                              EXPECT_EQ(total, 3U);
                                              calls = done;
                                            });
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(calls, 3U);
  EXPECT_TRUE(answers[0].result && answers[2].result);
  EXPECT_EQ(answers[1].error, "too much slip");
}

TEST(Sweep, ProgressMayStopTheWork) {
  EXPECT_THROW(
      sweep(Linear(), {}, {condition(1, 0.1)}, [](std::size_t, std::size_t) { throw std::runtime_error("stop"); }),
      std::runtime_error);
}

TEST(Sweep, DemIsRefused) { EXPECT_THROW(make_model(ModelKind::dem), InputError); }

TEST(Predict, ErrorsAreOverRowsThatHaveBoth) {
  Campaign campaign;
  campaign.runs = {measured(0.1, 103.0, {}), measured(0.2, 196.0, 0.002), measured(0.9, 500.0, 0.002),
                   measured(0.3, {}, 0.004)};
  const Prediction p = predict(Linear(), {}, campaign);
  EXPECT_EQ(p.unsolved, 1U);
  ASSERT_EQ(p.errors.size(), 2U);
  // drawbar pull: residuals -3 and 4
  EXPECT_EQ(p.errors[0].runs, 2U);
  EXPECT_DOUBLE_EQ(p.errors[0].rmse, std::sqrt((9.0 + 16.0) / 2));
  EXPECT_DOUBLE_EQ(p.errors[0].bias, 0.5);
  EXPECT_DOUBLE_EQ(p.errors[0].share_of_range, p.errors[0].rmse / 93.0);
  // sinkage: residuals -1 mm and -3 mm
  EXPECT_DOUBLE_EQ(p.errors[1].bias, -0.002);
  EXPECT_EQ(p.runs[2].run, 3);
  EXPECT_FALSE(residual(p.runs[2], channel_views[0]).has_value());
}

TEST(Varying, CurvesAreToldApartByWhatVariesBesideSlip) {
  const Curves one = curves_against_slip({condition(80, 0), condition(80, 0.2)}, Spread::exact);
  EXPECT_THAT(one.labels, ElementsAre(""));
  EXPECT_EQ(one.varying, "");
  const Curves two = curves_against_slip({condition(4000, 0), condition(90, 0), condition(4000, 0.1)}, Spread::exact);
  EXPECT_THAT(two.labels, ElementsAre("90 N", "4 kN"));
  EXPECT_THAT(two.curve_of, ElementsAre(1U, 0U, 1U));
}

TEST(Varying, ASpeedThatFollowsSlipTellsNothingApart) {
  OperatingCondition a = condition(80, 0), b = condition(80, 0.2);
  a.speed = 0.1, b.speed = 0.08;
  EXPECT_EQ(curves_against_slip({a, b}, Spread::exact).labels.size(), 1U);
  b.slip = 0;
  EXPECT_EQ(curves_against_slip({a, b}, Spread::exact).labels.size(), 2U);
}

TEST(Varying, MeasuredSetpointsScatter) {
  std::vector<OperatingCondition> runs;
  for (const double load : {20.0, 21.0, 23.5, 60.0, 64.0})
    for (const double slip : {0.1, 0.4}) runs.push_back(condition(load, slip));
  EXPECT_EQ(curves_against_slip(runs, Spread::measured).labels.size(), 2U);
  EXPECT_EQ(curves_against_slip(runs, Spread::exact).labels.size(), 5U);
}

TEST(Explanation, StepsRepeatTheResult) {
  const Explanation e = explain(wheel_on_sand(), condition(80, 0.2));
  const auto value = [&](const std::string& name) {
    for (const Step& step : e.steps)
      if (step.name == name) return step.value;
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(value("sinkage"), 1000 * e.result.sinkage.value, 1e-9);
  EXPECT_NEAR(value("sinkage"), 110 * (1 - std::cos(e.result.entry_angle)), 1e-9);
  EXPECT_NEAR(value("drawbar pull"), e.result.drawbar_pull.value, 1e-12);
  EXPECT_NEAR(value("angle of largest stress"), (0.18 + 0.32 * 0.2) * value("entry angle"), 1e-9);
  EXPECT_THAT(e.cross_checks.back().remark, HasSubstr("faulty"));
  // the stress at theta_m is the largest of the patch
  double largest = 0.0;
  for (const StressSample& sample : e.result.patch) largest = std::max(largest, sample.normal);
  EXPECT_NEAR(value("normal stress there"), largest / 1000, 0.01 * largest / 1000);
}

}  // namespace
}  // namespace soilbin::compare
