// A failure map of a wheel on an incline, with a stand-in for the grains that differs from the analytic model by a
// formula.
#include "compare/failure_map/incline_map.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>

#include "compare/comparison_fixture.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using Eigen::VectorXd;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

InclineMap slope_map() {
  InclineMap map;
  map.scenario = sand_study({}).scenario;
  map.scenario.tire.lugs = {.height = 0, .count = 16, .thickness = 0.006};
  map.factors = {{"load", 300, 900, "N"},
                 {"lug height", 0, 0.02, "mm"},
                 {"angle", 0, 10 * degree, "deg"},
                 {"slip", 0.05, 0.4, "%"}};
  return map;
}

/// Share of the load by which the analytic model is too low: lugs of 20 mm pull 16 % of the load.
double missing(const VectorXd& values) { return 8 * values[map_lug_height]; }

/// Grains that pull as the analytic model of a smooth wheel does, and what lugs add; `runs` counts them.
VirtualTest stand_in(const InclineMap& map, int& runs) {
  VirtualTest grains;
  grains.identity = "stand-in", grains.factors = map.factors, grains.targets = grain_channels();
  grains.run = [map, &runs](const VectorXd& values, std::uint64_t) {
    ++runs;
    if (values[map_load] > 880) throw NoSolution("too heavy");
    const Answer answer = ask(*make_model(ModelKind::bekker_wong), scenario_at(map, values), condition_at(map, values));
    const double load = values[map_load];
    return std::vector<Estimate>{
        {answer.result->drawbar_pull.value + missing(values) * load, 0.003 * load}, {0, 1}, {0, 1}, {0, 1}};
  };
  return grains;
}

TEST(InclineMap, SetsTheFactorsAndTheKindOfIncline) {
  InclineMap map = slope_map();
  map.base.speed = 0.3;
  const VectorXd values = (VectorXd(4) << 500, 0.01, 5 * degree, 0.2).finished();
  EXPECT_EQ(scenario_at(map, values).tire.lugs.height, 0.01);
  EXPECT_EQ(scenario_at(map, values).tire.lugs.count, 16);
  for (const Incline kind : {Incline::longitudinal, Incline::transverse, Incline::yaw}) {
    map.incline = kind;
    const OperatingCondition at = condition_at(map, values);
    EXPECT_EQ(at.load, 500);
    EXPECT_EQ(at.slip, 0.2);
    EXPECT_EQ(at.speed, 0.3);
    EXPECT_EQ(at.longitudinal_incline, kind == Incline::longitudinal ? 5 * degree : 0);
    EXPECT_EQ(at.transverse_incline, kind == Incline::transverse ? 5 * degree : 0);
    EXPECT_EQ(at.yaw, kind == Incline::yaw ? 5 * degree : 0);
  }
}

TEST(InclineMap, TheDifferenceIsAnalyticLessGrainsOverTheLoad) {
  const InclineMap map = slope_map();
  int runs = 0;
  const VirtualTest grains = stand_in(map, runs);
  ExperimentStore store;
  const FailureQuestion question = failure_question(map, {&grains, nullptr, &store}, 0.1);
  const VectorXd values = (VectorXd(4) << 500, 0.01, 5 * degree, 0.2).finished();
  const std::optional<Estimate> difference = question.difference(values);
  ASSERT_TRUE(difference);
  EXPECT_NEAR(difference->value, -0.08, 1e-12);
  EXPECT_NEAR(difference->std_error, 0.003, 1e-12);
  question.difference(values);
  EXPECT_EQ(runs, 1) << "the second time it comes from the store";
  VirtualTest kept = grains;
  kept.run = nullptr;
  const FailureQuestion stored = failure_question(map, {&kept, nullptr, &store}, 0.1);
  EXPECT_TRUE(stored.difference(values));
  EXPECT_FALSE(stored.difference((VectorXd(4) << 501, 0.01, 5 * degree, 0.2).finished())) << "not in the store";
  EXPECT_FALSE(question.difference((VectorXd(4) << 890, 0, 0, 0.2).finished())) << "grains without an answer";
}

// Grains whose pull is straight in their size: 3 % of the load more for grains 1.4 times as large is 7.5 % for their
// own size, by which the analytic pull seems too low.
TEST(InclineMap, ACoarserTwinTellsTheErrorOfResolution) {
  const InclineMap map = slope_map();
  int runs = 0;
  const VirtualTest grains = stand_in(map, runs);
  VirtualTest coarser = grains;
  coarser.identity = "stand-in, coarser";
  coarser.run = [&](const VectorXd& values, std::uint64_t seed) {
    std::vector<Estimate> answer = grains.run(values, seed);
    answer.front().value += 0.03 * values[map_load];
    return answer;
  };
  ExperimentStore store;
  const FailureQuestion question = failure_question(map, {&grains, &coarser, &store}, 0.1);
  const VectorXd values = (VectorXd(4) << 500, 0.01, 5 * degree, 0.2).finished();
  const std::optional<Estimate> error = question.resolution_error(values);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->value, -0.03 / 0.4, 1e-12);
  EXPECT_NEAR(error->std_error, std::sqrt(2.0) * 0.003 / 0.4, 1e-12);
  EXPECT_FALSE(question.resolution_error((VectorXd(4) << 890, 0, 0, 0.2).finished())) << "grains without an answer";
}

TEST(InclineMap, TwoQuickModelsNeedNoGrains) {
  InclineMap map = slope_map();
  map.of = ModelKind::rft, map.against = ModelKind::bekker_wong;
  const FailureQuestion question = failure_question(map, {}, 0.1);
  const VectorXd values = (VectorXd(4) << 500, 0.01, 5 * degree, 0.2).finished();
  const auto pull = [&](ModelKind kind) {
    return ask(*make_model(kind), scenario_at(map, values), condition_at(map, values)).result->drawbar_pull.value;
  };
  ASSERT_TRUE(question.difference(values));
  EXPECT_NEAR(question.difference(values)->value, (pull(ModelKind::rft) - pull(ModelKind::bekker_wong)) / 500, 1e-12);
  EXPECT_FALSE(question.waits());
  map.against = ModelKind::rft;
  EXPECT_THROW(failure_question(map, {}, 0.1), InputError) << "a model against itself";
  map.of = ModelKind::cone_index;
  EXPECT_THROW(failure_question(map, {}, 0.1), InputError) << "it knows neither lugs nor cross slopes";
}

// Effect lug_thrust assumes lugs where a tire declares none; at the map's height of 0 the wheel is smooth.
TEST(InclineMap, AtNoHeightTheAnalyticWheelIsSmooth) {
  InclineMap map = slope_map();
  map.against = ModelKind::rft;
  const VectorXd values = (VectorXd(4) << 500, 0, 0, 0.2).finished();
  const double smooth = failure_question(map, {}, 0.1).difference(values)->value;
  map.scenario.effects = {{"lug_thrust", "side_factors", {{"a", 1.0}}}};
  EXPECT_EQ(failure_question(map, {}, 0.1).difference(values)->value, smooth);
  const VectorXd lugged = (VectorXd(4) << 500, 0.02, 0, 0.2).finished();
  const double with = failure_question(map, {}, 0.1).difference(lugged)->value;
  map.scenario.effects.clear();
  EXPECT_GT(with, failure_question(map, {}, 0.1).difference(lugged)->value);
}

TEST(InclineMap, RefusesAWheelWithoutLugsToVaryAndGrainsWithoutAnalyticValues) {
  InclineMap map = slope_map();
  int runs = 0;
  const VirtualTest grains = stand_in(map, runs);
  ExperimentStore store;
  map.scenario.tire.lugs.count.reset();
  EXPECT_THROW(failure_question(map, {&grains, nullptr, &store}, 0.1), InputError);
  map = slope_map(), map.scenario.soil.semi_empirical.reset();
  EXPECT_THROW(failure_question(map, {&grains, nullptr, &store}, 0.1), InputError);
}

TEST(InclineMap, ACheckCountsBothErrors) {
  EXPECT_NEAR((FreshCheck{{}, {0.10, 0.03}, Estimate{0.15, 0.04}}.sigma()), 1.0, 1e-12);
  const std::vector<FreshCheck> checks = {
      {{}, {0.1, 0}, Estimate{0.13, 0}}, {{}, {0.2, 0}, Estimate{0.16, 0}}, {{}, {}, {}}};
  EXPECT_NEAR(rms_of(checks), std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2), 1e-12);
}

/// A map of the stand-in, its result, and the file that keeps its runs; several tests look at it.
class SlowInclineMap : public testing::Test {
 protected:
  struct Learnt {
    std::filesystem::path file;
    int runs = 0, again = 0;
    FailureMapResult result;
  };
  static FailureMapResult learn(const InclineMap& map, const VirtualTest& grains, ExperimentStore& store) {
    FailureMapResult result;
    result.asked = map;
    result.question = failure_question(map, {&grains, nullptr, &store}, 0.1);
    result.map = map_failures(result.question, {.first = 16, .at_boundary = 6});
    result.checks = check_fresh(result.question, result.map, 4, 1);
    result.shares = shares_of(result.question, result.map);
    return result;
  }
  static const Learnt& learnt() {
    static const Learnt once = [] {
      Learnt l;
      std::string pattern = (std::filesystem::temp_directory_path() / "soilbin-map-XXXXXX").string();
      l.file = std::filesystem::path(::mkdtemp(pattern.data())) / "runs.json";
      const InclineMap map = slope_map();
      {
        const VirtualTest grains = stand_in(map, l.runs);
        ExperimentStore store(l.file);
        l.result = learn(map, grains, store);
      }
      const VirtualTest grains = stand_in(map, l.again);
      ExperimentStore kept(l.file);
      learn(map, grains, kept);
      std::filesystem::remove_all(l.file.parent_path());
      return l;
    }();
    return once;
  }
};

TEST_F(SlowInclineMap, LearnsTheFormulaAndPredictsFreshConditions) {
  const FailureMapResult& result = learnt().result;
  EXPECT_LT(result.map.held_out.rms(), 0.01);
  ASSERT_EQ(result.checks.size(), 4U);
  EXPECT_LT(rms_of(result.checks), 0.01);
  for (const FreshCheck& check : result.checks)
    if (check.found) {
      EXPECT_NEAR(check.found->value, -missing(check.values), 1e-9);
    }
  // Lugs above 12.5 of 20 mm are beyond 10 %: 3 of 9 nodes (15, 17.5, 20), the map errs by a node at most.
  EXPECT_NEAR(result.shares.beyond, 3.0 / 9, 1.0 / 9);
}

// The stand-in's lugs of 20 mm pull 16 % of the load more than none; the smooth analytic wheel has none of it.
TEST_F(SlowInclineMap, TellsWhatLugsBring) {
  const FailureMapResult& result = learnt().result;
  const std::vector<LugGain> gains = lug_gains(result.asked, result.question, result.map);
  ASSERT_EQ(gains.size(), 18U);
  for (const LugGain& gain : gains) {
    EXPECT_NEAR(gain.of, 0.0, 1e-12);
    EXPECT_NEAR(gain.against.value, 0.16, 0.02);
    EXPECT_LT(std::abs(gain.against.value - 0.16), 3 * gain.against.std_error + 0.003);
  }
}

TEST_F(SlowInclineMap, GoesOnFromTheStoreWithoutARun) {
  EXPECT_GE(learnt().runs, 20);
  EXPECT_EQ(learnt().again, 0);
}

TEST_F(SlowInclineMap, TellsItInWordsAsAPageAndAsJson) {
  const FailureMapResult& result = learnt().result;
  const Report report = report_on(result, {"Map", "format: ..."});
  const Json json = report.data();
  EXPECT_EQ(json["format"], "soilbin-failure-map/1");
  EXPECT_EQ(json["rows"].size(), result.map.rows.size());
  EXPECT_EQ(json["checks"].size(), 4U);
  EXPECT_NEAR(json["cross_validated_error"].get<double>(), result.map.held_out.rms(), 1e-15);
  EXPECT_THAT(json["summary"][1].get<std::string>(),
              AllOf(StartsWith("Do not trust it: The error exceeds "), HasSubstr("Longitudinal incline: "),
                    HasSubstr("conditions run differ by more than"), HasSubstr("too low at all of them")));
  const std::string page = page_of(report, {"soilbin failure-map made", {}});
  const std::size_t answer = page.find("id=\"answer\"");  // the words stand after the map
  ASSERT_NE(answer, std::string::npos);
  for (const char* part : {"The error exceeds", "Cross-validated error of the map", "fresh conditions:"})
    EXPECT_NE(page.find(part, answer), std::string::npos) << part;
  EXPECT_THAT(page, HasSubstr("Where may I trust the quick estimate?"));
  EXPECT_LT(page.find("sliding-map"), page.find("Cross-validated error of the map"));
  EXPECT_EQ(page.find("Cross-validated error of the map"), page.rfind("Cross-validated error of the map"));
  EXPECT_THAT(page, HasSubstr("class=\"plot heat\""));
  EXPECT_THAT(page, HasSubstr("soilbin failure-map made"));
}

// No box of conditions that was run, and yet the models agree in some cells: the answer does not deny them.
TEST_F(SlowInclineMap, WithoutABoxItSaysInHowMuchOfTheRangeTheModelsAgree) {
  FailureMapResult result = learnt().result;
  ASSERT_TRUE(result.clauses.empty());
  ASSERT_GT(result.shares.agree, 0.1);
  EXPECT_THAT(text_of(report_on(result, {"Map", "format: ..."})),
              AllOf(HasSubstr(fmt::format("95 % confidence in {:.0f} % of the range, but in no box",
                                          100 * result.shares.agree)),
                    testing::Not(HasSubstr("Nowhere"))));
  result.shares.agree = 0.0;
  EXPECT_THAT(text_of(report_on(result, {"Map", "format: ..."})), HasSubstr("Nowhere: no part of the range"));
}

}  // namespace
}  // namespace soilbin::compare
