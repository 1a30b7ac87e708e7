#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/report/number_text.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/explanation.hpp"
#include "compare/sweep/prediction.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/answer_report.hpp"
#include "compare/telling/studies_report.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
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

// The study gives the loads between the slips; a reader follows one curve after the other.
TEST(Sweep, ATableHasOneBlockForEachCurve) {
  ModelAnswers model{{ModelKind::bekker_wong, {}, "linear"}, {}};
  for (const double slip : {0.1, 0.2})
    for (const double load : {100.0, 50.0}) model.answers.push_back({condition(load, slip), TractionResult{}, ""});
  const std::string text = text_of({.title = "", .subtitle = "", .parts = study_parts({model})});
  std::vector<std::size_t> places;
  for (const char* row : {" 50 N        10", " 50 N        20", "100 N        10", "100 N        20"})
    places.push_back(text.find(row));
  EXPECT_TRUE(std::ranges::is_sorted(places)) << text;
  EXPECT_NE(places.back(), std::string::npos) << text;
}

// Smooth curves keep the study's own slips and each curve's other conditions; a speed that came from a rotation follows
// the slip: r w (1 - s).
TEST(Sweep, SmoothCurvesGoThroughTheStudysConditions) {
  Case question;
  question.scenario = wheel_on_sand();
  const double radius = question.scenario.tire.radius, rotation = 2.0;
  for (const double load : {50.0, 80.0})
    for (const double slip : {0.0, 0.2, 0.5}) {
      question.study.conditions.push_back(condition(load, slip));
      question.study.conditions.back().speed = radius * rotation * (1 - slip);
      question.study.rotations.emplace_back(rotation);
    }
  const Case smooth = with_smooth_curves(question, 11);
  std::set<double> slips;
  for (const OperatingCondition& at : smooth.study.conditions) {
    EXPECT_TRUE(at.load == 50.0 || at.load == 80.0);
    EXPECT_NEAR(at.speed, radius * rotation * (1 - at.slip), 1e-12);
    slips.insert(at.slip);
  }
  EXPECT_EQ(smooth.study.conditions.size(), 2 * slips.size());
  EXPECT_GE(slips.size(), 11U);
  for (const double slip : {0.0, 0.2, 0.5}) EXPECT_EQ(slips.count(slip), 1U);
  EXPECT_EQ(curves_against_slip(smooth.study.conditions, Spread::exact).labels.size(), 2U);
}

// Three loads 10 % apart, each held to 1 %: a curve of its own for each, not one zigzag. Loads that go on from one to
// the next are one.
TEST(Sweep, MeasuredCurvesAreSplitByLoad) {
  std::vector<OperatingCondition> runs, scattered;
  for (int i = 0; i < 30; ++i) {
    const double scatter = 1.0 + 0.01 * std::sin(12.9898 * (i + 1));
    runs.push_back(condition((i % 3 == 0 ? 34e3 : i % 3 == 1 ? 37.5e3 : 41e3) * scatter, 0.02 * (i / 3)));
    scattered.push_back(condition(13.0 + 0.5 * i + 0.1 * scatter, 0.02 * (i / 3)));
  }
  const Curves curves = curves_against_slip(runs, Spread::measured);
  EXPECT_EQ(curves.labels.size(), 3U);
  for (std::size_t i = 3; i < runs.size(); ++i) EXPECT_EQ(curves.curve_of[i], curves.curve_of[i - 3]);
  EXPECT_EQ(curves_against_slip(scattered, Spread::measured).labels.size(), 1U);
}

// 15 deg in radians and back are 14.999999999999998: a table for people says 15.
TEST(Sweep, TablesOfNumbersAreRoundedToWhatTheyMean) {
  EXPECT_EQ(csv_number(15 * degree / degree), "15");
  EXPECT_EQ(csv_number(0.1 + 0.2), "0.3");
  EXPECT_EQ(csv_number(8890.0), "8890");
  EXPECT_EQ(csv_number(1.0 / 3.0), "0.333333333");
  OperatingCondition at = condition(80, 0.2);
  at.longitudinal_incline = 15 * degree, at.transverse_incline = -7 * degree, at.yaw = 35 * degree;
  Case question;
  question.scenario = wheel_on_sand();
  question.study.models = {{ModelKind::bekker_wong, {}, "m"}}, question.study.conditions = {at};
  EXPECT_THAT(study_csv(run_study(question), [](const ModelChoice&, const Answer&) { return std::string(); }),
              HasSubstr("\nm,80,0.2,0.1,15,-7,35,1,"));
}

// What drives is piled up above zero and what holds back below it; the piles' ends add up to the sum of the parts.
// What the page says of a curve's peak is what it draws, not the nearest of a few conditions; a pull that still grows
// at the end is told so. The analytic model's lines in a plot are as smooth, those of grains hold their own points.
TEST(Sweep, PeaksAreThoseOfTheSmoothCurves) {
  StudyPart part;
  part.question.scenario = wheel_on_sand();
  part.question.study.models = {{ModelKind::bekker_wong, {}, "bekker_wong"}};
  for (const double slip : {0.0, 0.3, 0.6}) part.question.study.conditions.push_back(condition(80, slip));
  part.study = run_study(part.question);
  part.curves = with_smooth_curves(part.question, 41);
  part.along_curves = run_study(part.curves);
  double most = 0.0, at = 0.0;
  for (const Answer& answer : part.along_curves.front().answers)
    if (answer.result && has_efficiency(*answer.result) && answer.result->tractive_efficiency > most)
      most = answer.result->tractive_efficiency, at = answer.at.slip;
  EXPECT_NE(at, 0.3);
  EXPECT_THAT(in_words(part),
              HasSubstr(fmt::format("peak tractive efficiency {:.0f} %, at {:.3g} % slip", 100 * most, 100 * at)));
  const double end = part.along_curves.front().answers.back().result->drawbar_pull.value;
  const bool grows = std::ranges::all_of(part.along_curves.front().answers,
                                         [&](const Answer& a) { return a.result->drawbar_pull.value <= end; });
  EXPECT_EQ(in_words(part).find("where it still grows") != std::string::npos, grows);

  std::vector<ModelAnswers> both = part.study;
  both.push_back({{ModelKind::dem, {}, "dem"}, part.study.front().answers});
  const Sheet sheet = study_sheet(part.question, smoothed_for_plot(part.question, both));
  const std::vector<Series>& pulls = sheet.plots.front().series;
  ASSERT_EQ(pulls.size(), 2U);
  EXPECT_GE(pulls[0].x.size(), 41U);
  EXPECT_EQ(pulls[0].label, "analytic wheel");
  EXPECT_EQ(pulls[1].x.size(), 3U);
  EXPECT_EQ(pulls[1].label, "grains");
}

TEST(Sweep, PartsOfThePullArePiledUp) {
  std::vector<Answer> answers;
  for (const auto& [slip, push] : {std::pair{0.1, 5.0}, {0.2, -3.0}}) {
    TractionResult result;
    result.budget = {{"thrust", 10.0}, {"resistance", -4.0}, {"push", push}};
    result.drawbar_pull.value = 6.0 + push;
    answers.push_back({condition(1, slip), result, ""});
  }
  answers.push_back({condition(1, 0.3), std::nullopt, "none"});
  const Sheet sheet = budget_sheet("t", {{"", answers}});
  const std::vector<Series>& all = sheet.plots.at(0).series;
  ASSERT_EQ(all.size(), 5U) << "push both drives and holds back";
  double top = 0.0, bottom = 0.0, sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    top = std::max(top, all[k].y[1]), bottom = std::min(bottom, all[k].y[1]);
    sum += all[k].y[0] - all[k].base[0];
    EXPECT_TRUE(std::isnan(all[k].y[2]));
  }
  EXPECT_EQ(top, 10.0);
  EXPECT_EQ(bottom, -7.0);
  EXPECT_EQ(sum, 11.0);
  EXPECT_EQ(all[4].y[0], 11.0);
  EXPECT_TRUE(all[4].base.empty());
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

TEST(Varying, WhatConditionsShareIsTold) {
  OperatingCondition one = condition(80, 0.1), other = condition(80, 0.2);
  EXPECT_EQ(shared_in_words({one, other}, true), "load 80 N");
  one.longitudinal_incline = other.longitudinal_incline = 10 * degree;
  one.yaw = 5 * degree, other.yaw = 8 * degree;
  EXPECT_EQ(shared_in_words({one, other}, false), "load 80 N, uphill 10°") << "the yaw is no longer one";
  other.slip = 0.1, other.yaw = one.yaw;
  EXPECT_EQ(shared_in_words({one, other}, true), "load 80 N, slip 10 %, uphill 10°, yaw 5°");
  other.load = 90;
  EXPECT_EQ(shared_in_words({one, other}, false), "uphill 10°, yaw 5°");
}

// The fault of a paper's equation is told who asks about the paper's tire or sand.
TEST(Explanation, NamesThePapersEquationToItsReaders) {
  Scenario scenario = wheel_on_sand();
  const auto named = [&] {
    const std::vector<Step> steps = explain(scenario, condition(80, 0.2)).cross_checks;
    return std::ranges::any_of(steps, [](const Step& step) { return step.name.starts_with("Eq. 5"); });
  };
  EXPECT_FALSE(named());
  scenario.tire.name = "paper-lugged";
  EXPECT_TRUE(named());
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
  // the stress at theta_m is the largest of the patch
  double largest = 0.0;
  for (const StressSample& sample : e.result.patch) largest = std::max(largest, sample.normal);
  EXPECT_NEAR(value("normal stress there"), largest / 1000, 0.01 * largest / 1000);
}

TEST(Varying, CurvesRunOverInflationPressure) {
  std::vector<OperatingCondition> all;
  for (const double load : {2000.0})
    for (const double pressure : {150e3, 300e3, 450e3}) {
      all.push_back(condition(load, 0.2));
      all.back().inflation_pressure = pressure;
    }
  const ConditionView* over = curves_run_over(all);
  ASSERT_EQ(over, &condition_view("inflation_pressure"));
  EXPECT_EQ(curves_against(*over, all, Spread::exact).labels.size(), 1U);
  EXPECT_EQ(in_words(all[1]), "load 2 kN, slip 20 %, inflation 300 kPa");
}

}  // namespace
}  // namespace soilbin::compare
