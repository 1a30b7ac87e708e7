#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "compare/comparison_fixture.hpp"
#include "compare/discrepancy/comparison.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/telling/comparison_report.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(DifferenceFinding, ADifferenceNeedsBothMoreThanTheScatterAndMoreThanTwoErrors) {
  EXPECT_EQ(finding_of(10, 3, 5), DifferenceFinding::difference);
  EXPECT_EQ(finding_of(-10, 3, 5), DifferenceFinding::difference);
  EXPECT_EQ(finding_of(10, 3, 12), DifferenceFinding::within_scatter);  // another run would move as much
  EXPECT_EQ(finding_of(10, 6, 5), DifferenceFinding::within_errors);
  EXPECT_EQ(finding_of(0, 1, 0), DifferenceFinding::within_scatter);
  EXPECT_EQ(finding_of(10, 0, 0), DifferenceFinding::not_judged);  // exact numbers: nothing to judge by
}

// Student's t at the chance that a normal passes 2, 4.55 %. One degree of freedom is Cauchy's: 2/pi atan(1/k) = 0.0455.
TEST(DifferenceFinding, AnErrorOfFewReRunsCountsMore) {
  const double chance = std::erfc(2 / std::sqrt(2.0));
  EXPECT_NEAR(counting_errors(1), 1 / std::tan(chance * std::numbers::pi / 2), 1e-6);            // 13.97
  EXPECT_NEAR(counting_errors(2), (1 - chance) * std::sqrt(2 / (chance * (2 - chance))), 1e-6);  // 4.53, in closed form
  EXPECT_NEAR(counting_errors(1e5), 2.0, 1e-4);
  EXPECT_EQ(counting_errors(std::numeric_limits<double>::infinity()), 2.0);
  EXPECT_EQ(finding_of(10, 3, 5, 2), DifferenceFinding::within_errors);  // 3.3 errors, of which 4.5 are asked for
  EXPECT_EQ(finding_of(14, 3, 5, 2), DifferenceFinding::difference);
}

// Three runs of 90, 100 and 110 N: mean 100 N, spread 10 N, so the mean's error is 10/sqrt(3). Own errors of 1 N say
// that the packing, not the run's length, makes the scatter.
TEST(GrainRuns, TheSpreadBetweenPackingsGoesIntoTheError) {
  const Case question = sand_study({0.2});
  const ModelAnswers base = base_answers(question);
  const double pull = base.answers[0].result->drawbar_pull.value;
  const SidePoint point = grain_side(base, {-10, 0, 10}, 1.0).points[0];
  EXPECT_NEAR(point.result->drawbar_pull.value, pull, 1e-9);
  EXPECT_NEAR(point.scatter[0], 10.0, 1e-9);
  EXPECT_NEAR(point.result->drawbar_pull.std_error, 10 / std::sqrt(3.0), 1e-9);
  EXPECT_THAT(point.doubts, IsEmpty());
}

// Where runs agree better than their own errors allow, the errors stand: 4 N each, 4/sqrt(2) for the mean.
TEST(GrainRuns, LuckyAgreementDoesNotMakeThemSurer) {
  const ModelAnswers base = base_answers(sand_study({0.2}));
  const SidePoint point = grain_side(base, {0, 0}, 4.0).points[0];
  EXPECT_NEAR(point.result->drawbar_pull.std_error, 4 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(point.scatter[0], 4.0, 1e-12);
}

// One packing here, two there: the scatter that those show is that of the one as well, and Student's t pays for how few
// they are.
TEST(GrainRuns, TheScatterIsThatOfAllConditionsTogether) {
  const ModelAnswers base = base_answers(sand_study({0.2, 0.4}));
  std::vector<RecordedRun> runs = grain_runs(base, {-10, 10}, 2.0);
  runs.pop_back();
  const Side side = side_of("dem", runs, {base.answers[0].at, base.answers[1].at});
  const double spread = std::sqrt(200.0);
  EXPECT_NEAR(side.points[0].scatter[0], spread, 1e-9);
  EXPECT_NEAR(side.points[1].scatter[0], spread, 1e-9) << "errors of 2 N each there too";
  EXPECT_NEAR(side.points[0].result->drawbar_pull.std_error, spread / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(side.points[1].result->drawbar_pull.std_error, spread, 1e-9);
  EXPECT_EQ(side.points[1].freedom[0], 1.0);
  EXPECT_THAT(side.points[1].doubts, IsEmpty());
  EXPECT_TRUE(std::isinf(side.points[1].freedom[1])) << "torques agree better than their own errors";
}

TEST(GrainRuns, OnePackingAndDriftAreToldAsDoubts) {
  auto runs = grain_runs(base_answers(sand_study({0.2})), {0}, 4.0);
  runs[0].steady = false;
  runs[0].drift = 3.7;
  const SidePoint point = side_of("dem", runs, {runs[0].answer.at}).points[0];
  EXPECT_TRUE(tell_of(point.doubts, DoubtKind::one_bed_sample));
  EXPECT_THAT(point.doubts, Contains(test::tells(DoubtKind::unsteady_runs, {1, 1, 3.7})));
}

class Pair : public testing::Test {
 protected:
  Case question = sand_study({0.0, 0.1, 0.2, 0.4});
  ModelAnswers base = base_answers(question);

  Comparison against(const std::vector<double>& offsets, double own) const {
    return compare_sides(question, {grain_side(base, offsets, own), side_of(base)});
  }
};

TEST_F(Pair, ErrorsOfBothSidesAddInSquares) {
  const Comparison comparison = against({300}, 40.0);
  ASSERT_EQ(comparison.sides[0].label, "bekker_wong");  // analytic first
  const Difference& d = comparison.differences.front();
  const double soil = base.answers[0].result->drawbar_pull.std_error;
  EXPECT_NEAR(d.difference, -300, 1e-9);
  EXPECT_NEAR(d.std_error, std::hypot(soil, 40.0), 1e-9);
  EXPECT_NEAR(d.sigma, -300 / std::hypot(soil, 40.0), 1e-9);
  EXPECT_NEAR(d.share, -300 / 1000.0, 1e-12);
  EXPECT_EQ(d.finding, DifferenceFinding::difference);
}

TEST_F(Pair, LessThanTheScatterIsNoDifference) {
  const Comparison comparison = against({20, 120}, 1.0);  // mean 70 N off, spread 70.7 N
  for (const Difference& d : comparison.differences)
    if (d.channel == 0) {
      EXPECT_NEAR(d.scatter, 100 / std::sqrt(2.0), 1e-9);
      EXPECT_EQ(d.finding, DifferenceFinding::within_scatter);
    }
  EXPECT_EQ(comparison.tallies.front().differ, 0U);
}

// An effect of amplitude 0 changes nothing, and two models of one soil can't be two standard errors of that soil apart.
TEST_F(Pair, TwoAnalyticModelsShareTheSoilsDoubt) {
  ModelAnswers other = base;
  other.choice.label = "other";
  for (Answer& answer : other.answers) answer.result->drawbar_pull.value += 50;
  const Comparison comparison = compare_sides(question, {side_of(base), side_of(other)});
  ASSERT_FALSE(comparison.differences.empty());
  for (const Difference& d : comparison.differences) {
    EXPECT_EQ(d.finding, DifferenceFinding::not_judged);
    EXPECT_EQ(d.std_error, 0.0);
    EXPECT_NEAR(d.difference, d.channel == 0 ? 50.0 : 0.0, 1e-9);
  }
  std::size_t said = 0;  // that they are not tested: once, not at each channel
  for (const Clause& clause : summary(comparison))
    said += clause.text.find("no significance test") != std::string::npos ? 1 : 0;
  EXPECT_EQ(said, 1U);
}

// The flexible wheel is farther from the grains than the rigid one: yet the headline is of the pair with like tires,
// and the other pair says that its tires differ.
TEST_F(Pair, AFlexibleTireAgainstRigidGrainsIsSaidAndNeverTheHeadline) {
  ModelAnswers flexible = base;
  flexible.choice.effects = {{"tire_flexibility", "", {}}}, flexible.choice.label = "flexible";
  for (Answer& answer : flexible.answers) answer.result->drawbar_pull.value += 400;
  const Comparison comparison =
      compare_sides(question, {side_of(base), side_of(flexible), grain_side(base, {100}, 40.0)});
  const std::string unlike = "The tires differ";
  const std::optional<Clause> first = headline(comparison);
  ASSERT_TRUE(first);
  EXPECT_THAT(first->text, AllOf(HasSubstr("is 100 N"), Not(HasSubstr(unlike))));
  std::size_t said = 0;
  for (const Clause& clause : summary(comparison))
    said +=
        clause.text.find("flexible - grains: ") != std::string::npos && clause.text.find(unlike) != std::string::npos;
  EXPECT_EQ(said, 3U) << "at each of its channels";
  const Comparison alone = compare_sides(question, {side_of(flexible), grain_side(base, {100}, 40.0)});
  EXPECT_THAT(headline(alone)->text, HasSubstr(unlike));
}

// Values of sand at 1600 kg/m^3 speak of a bed of 1590, not of one of 1450.
TEST_F(Pair, ABedOfAnotherDensityThanTheSoilsValuesIsSaid) {
  Soil soil = question.scenario.soil;
  soil.semi_empirical->density = 1600;
  std::vector<RecordedRun> runs = grain_runs(base, {0}, 1.0);
  const auto at = [&](double density) {
    for (RecordedRun& run : runs) run.bed.bulk = density;
    return bed_density_doubts(soil, runs);
  };
  EXPECT_THAT(at(1590), IsEmpty());
  EXPECT_THAT(at(1450), Contains(test::tells(DoubtKind::bed_density, {"looser", 1450, 1600})));
  EXPECT_THAT(at(1700), Contains(test::tells(DoubtKind::bed_density, {"denser", 1700, 1600})));
  EXPECT_THAT(at(0), IsEmpty()) << "a record that does not tell it";
  soil.semi_empirical->density.reset();
  EXPECT_THAT(at(1450), IsEmpty());
}

// One row a condition: the grains' own value, then what the model adds to it, with a star where that is significant.
TEST_F(Pair, TheMatrixHoldsTheBaselineAndEachChange) {
  const std::vector<Table> one = matrix_tables(against({300}, 40.0));
  ASSERT_EQ(one.size(), 1U);
  const Table& matrix = one.front();
  ASSERT_EQ(matrix.rows.size(), question.study.conditions.size());
  ASSERT_EQ(matrix.header.size(), 7U) << "the condition, then two columns for each of three channels";
  EXPECT_THAT(matrix.header[1], AllOf(HasSubstr("drawbar pull ["), HasSubstr("grains")));
  EXPECT_THAT(matrix.header[2], HasSubstr("change ["));
  const bool kilo = matrix.header[1].find("[kN]") != std::string::npos;
  for (const auto& row : matrix.rows) EXPECT_EQ(row[2].text, kilo ? "-0.3 *" : "-300 *");
  EXPECT_EQ(matrix.rows[0][4].text, "0") << "a torque as it was";
}

// Four sides of three channels are twelve columns: a table a channel, so that none of them is left out.
TEST_F(Pair, AMatrixOfManySidesIsATableForEachChannel) {
  Comparison comparison = against({300}, 40.0);
  const Side analytic = comparison.sides.front();
  comparison.sides.insert(comparison.sides.begin(), {analytic, analytic});
  for (Tally& tally : comparison.tallies) tally.side = 2, tally.reference = 3;
  for (Difference& difference : comparison.differences) difference.side = 2, difference.reference = 3;
  const std::vector<Table> tables = matrix_tables(comparison);
  ASSERT_EQ(tables.size(), 3U);
  for (std::size_t c = 0; c < tables.size(); ++c) {
    ASSERT_EQ(tables[c].header.size(), 5U) << "the condition, the baseline and three changes";
    EXPECT_THAT(tables[c].header[1], HasSubstr(channel_views[c].title));
    EXPECT_EQ(tables[c].rows.size(), question.study.conditions.size());
    EXPECT_NE(tables[c].rows[0][4].text, "-");
  }
}

// Efficiency ends at 100 %: the axis cuts a band that goes further, and is left alone by one that does not.
TEST_F(Pair, NoEfficiencyIsDrawnAboveOne) {
  const auto upper = [&](double error) {
    Comparison comparison = against({300}, 40.0);
    for (SidePoint& point : comparison.sides[0].points)
      point.result->drawbar_pull.std_error = error * point.result->drawbar_pull.value;
    for (const Plot& plot : curve_sheet(comparison, 0).plots)
      if (plot.title.starts_with("Tractive efficiency")) return plot.y.upper;
    throw std::logic_error("no efficiency");
  };
  EXPECT_EQ(upper(10.0), 100.0);
  EXPECT_EQ(upper(0.01), std::nullopt);
}

TEST_F(Pair, TheTallyIsTheRowsInShort) {
  const Comparison comparison = against({300}, 40.0);
  const Tally& pull = comparison.tallies.front();
  EXPECT_EQ(pull.values, 4U);
  EXPECT_NEAR(pull.bias, -300, 1e-9);
  EXPECT_NEAR(pull.rms, 300, 1e-9);
  EXPECT_NEAR(pull.rms_share, 0.3, 1e-12);
  EXPECT_EQ(pull.differ + pull.in_scatter + pull.in_errors + pull.unknown, 4U);
  EXPECT_EQ(comparison.tallies.size(), 3U) << "a flat bed has no lateral force to compare";
}

TEST_F(Pair, EveryClauseOfTheSummaryHasItsRows) {
  const Comparison comparison = against({300}, 40.0);
  const std::vector<Clause> clauses = summary(comparison);
  for (const Clause& clause : clauses) {
    if (clause.about == "not compared") continue;
    EXPECT_FALSE(clause.rows.empty() && clause.evidence.empty()) << clause.text;
    for (const std::size_t row : clause.rows) EXPECT_LT(row, comparison.differences.size());
  }
  EXPECT_EQ(clauses[0].about, "In short");
  EXPECT_THAT(clauses[0].text, HasSubstr("is 300 N (30 % of the load) below that of "));
  const std::size_t first = opening(comparison).size();
  EXPECT_EQ(clauses[first].about, "drawbar pull") << "the largest difference comes first";
  EXPECT_THAT(clauses[first].text, HasSubstr("30 % of the load"));
}

// What a page says first fits two of its lines, and leads to the curve that it speaks of.
TEST_F(Pair, TheHeadlineIsShortAndSpeaksOfTheWidestRow) {
  const Comparison comparison = against({300}, 40.0);
  const std::optional<Clause> clause = headline(comparison);
  ASSERT_TRUE(clause);
  EXPECT_LT(clause->text.size(), 200U);
  EXPECT_EQ(clause->rows, opening(comparison).front().rows);
  const Difference* worst = widest_difference(comparison);
  ASSERT_NE(worst, nullptr);
  EXPECT_THAT(clause->text, HasSubstr(fmt::format("{:.4g} % slip",
                                                  100 * comparison.question.study.conditions[worst->condition].slip)));
  EXPECT_THAT(clause->text, HasSubstr(": significant. "));
  EXPECT_EQ(tally_table(comparison).header.at(3),
            fmt::format("mean of {} - {}", name_of(comparison.sides[0]), name_of(comparison.sides[1])));
}

// The table's first row is the widest pair; what the errors cannot have made is bad news, what they can is good.
TEST_F(Pair, TheTableOfChannelsPutsTheWidestFirstAndMarksIt) {
  const Table apart = tally_table(against({300}, 40.0));
  EXPECT_EQ(apart.rows.at(0).at(0).text, "drawbar pull");
  EXPECT_EQ(apart.rows.at(0).at(1).tone, Tone::bad);
  EXPECT_EQ(apart.rows.at(0).at(4).text, "4 of 4");
  EXPECT_EQ(apart.rows.at(0).at(0).anchor, "rows-0-1-0");
  const Comparison near = against({10}, 40.0);
  const Table table = tally_table(near);
  const auto pull =
      std::find_if(table.rows.begin(), table.rows.end(), [](const auto& row) { return row[0].text == "drawbar pull"; });
  ASSERT_NE(pull, table.rows.end());
  EXPECT_EQ(pull->at(1).tone, Tone::good);
}

// One packing says nothing of the scatter between beds: where all points are so, the legend says it. A negative sinkage
// is marked where it stands.
TEST_F(Pair, LimitsOfGrainsAreMarkedOnTheCurves) {
  Comparison comparison = against({300}, 40.0);
  comparison.sides[1].points[0].result->sinkage.value = -0.001;
  for (SidePoint& point : comparison.sides[1].points) point.runs = 1;
  const Sheet sheet = curve_sheet(comparison, 0, true);
  const auto labelled = [&](const std::string& label) {
    std::size_t points = 0;
    for (const Plot& plot : sheet.plots)
      for (const Series& series : plot.series)
        if (series.label == label) points += series.x.size();
    return points;
  };
  EXPECT_GT(labelled(name_of(comparison.sides[1]) + ", coarse for the wheel, one bed sample each"), 0u);
  EXPECT_EQ(labelled("negative sinkage: the tread is above the mean surface"), 1u);
  comparison.sides[1].points[0].runs = 2;
  const Sheet some = curve_sheet(comparison, 0, false);
  std::size_t marked = 0;
  for (const Series& series : some.plots.front().series)
    if (series.label.starts_with("one bed sample")) marked = series.x.size();
  EXPECT_EQ(marked, comparison.sides[1].points.size() - 1);
}

// With the soil exact, chi2 is the plain sum of squared sigmas. With doubt it can but fall: an offset that the friction
// angle could have made costs hardly anything.
TEST_F(Pair, TheSoilsDoubtExplainsWhatASoilValueCouldHaveDone) {
  Case harder = question;
  harder.scenario.soil.semi_empirical->friction_angle.value += 0.02;  // within its sd of 1.5 deg
  const ModelAnswers other = base_answers(harder);
  const Side dem = of_known_scatter(grain_side(other, {0}, 5.0));
  const auto test = joint_test(dem, question, {}).test;
  ASSERT_TRUE(test);
  double plain = 0;
  for (std::size_t i = 0; i < dem.points.size(); ++i)
    for (const ChannelView& channel : channel_views) {
      if (channel.name == "lateral_force") continue;
      const Estimate& there = (*dem.points[i].result).*channel.predicted;
      plain += std::pow((((*base.answers[i].result).*channel.predicted).value - there.value) / there.std_error, 2);
    }
  EXPECT_NEAR(test->chi2_soil_exact, plain, 1e-6 * plain);
  EXPECT_GT(test->chi2_soil_exact, 30.0);
  EXPECT_LT(test->chi2, 2.0) << "(0.02 rad over 1.5 deg)^2 = 0.58, and what first order leaves";
  EXPECT_GT(test->p_value, 0.9);
}

// Two values of the soil that err as one, against each other: what one of them does to the pull the other undoes, and
// their doubt explains nothing that they would explain apart.
TEST_F(Pair, TheJointTestHeedsHowAFitsValuesErrTogether) {
  SemiEmpiricalSoil& soil = *question.scenario.soil.semi_empirical;
  for (const SoilParameter& p : soil_parameters) (soil.*p.value).std_error = 0;
  const double b = question.scenario.tire.width;
  soil.k_phi.std_error = 0.2 * soil.k_phi.value;
  soil.k_c.std_error = b * soil.k_phi.std_error;  // k_c/b + k_phi is all that the wheel knows
  Case softer = question;
  softer.scenario.soil.semi_empirical->k_phi.value -= soil.k_phi.std_error;
  const Side other = of_known_scatter(grain_side(base_answers(softer), {0}, 5.0));
  const auto test_of = [&](double r) {
    ModelChoice model = base.choice;
    model.errors = {{.parameter = "k_c", .std_error = {}, .correlations = {}},
                    {.parameter = "k_phi", .std_error = {}, .correlations = {r}}};
    return joint_test(other, question, model).test.value();
  };
  EXPECT_LT(test_of(0).chi2, 0.1 * test_of(0).chi2_soil_exact);
  EXPECT_NEAR(test_of(-1).chi2 / test_of(-1).chi2_soil_exact, 1, 1e-6);
  EXPECT_EQ(test_of(0).chi2, joint_test(other, question, base.choice).test->chi2);
}

TEST_F(Pair, WithoutAStatedErrorThereIsNoJointTestAndTheSummarySaysWhy) {
  Side dem = of_known_scatter(grain_side(base, {10}, 5.0));
  dem.points[2].result->torque.std_error = 0.0;
  EXPECT_FALSE(joint_test(dem, question, {}).test);
  const Comparison comparison = compare_sides(question, {side_of(base), dem});
  ASSERT_EQ(comparison.not_compared.size(), 1U);
  EXPECT_EQ(comparison.not_compared.front().what, NotCompared::What::no_joint_test);
  EXPECT_THAT(summary(comparison).back().text,
              HasSubstr("analytic wheel and grains have no test of all values at once: a value has no standard"));
}

// A run's own errors do not tell how far beds scatter: no probability can be had from them.
TEST_F(Pair, OnePackingOfUnknownScatterHasNoJointTest) {
  const Comparison comparison = against({10}, 5.0);
  EXPECT_TRUE(comparison.joint.empty());
  ASSERT_EQ(comparison.not_compared.size(), 1U);
  EXPECT_THAT(comparison.not_compared.front().why, HasSubstr("the scatter between bed samples is unknown"));
}

// Two beds whose errors rest on one degree of freedom: far apart by any known error, and yet nothing is decided.
TEST_F(Pair, TooFewRerunsDecideNothing) {
  JointTest test;
  test.values = 32, test.chi2 = 5000.0, test.freedom = 1.0, test.p_value = 0.06, test.p_errors_known = 0.0;
  EXPECT_EQ(test.verdict(), JointVerdict::undecided);
  test.p_errors_known = 0.5;
  EXPECT_EQ(test.verdict(), JointVerdict::noise);
  test.p_value = 1e-4;
  EXPECT_EQ(test.verdict(), JointVerdict::significant);
}

// Packings that scatter less than single runs' own errors say so too: those errors are then the ones that count.
TEST_F(Pair, PackingsThatHardlyScatterHaveAJointTest) {
  const Side dem = grain_side(base, {-0.1, 0.1}, 5.0);
  EXPECT_TRUE(std::isinf(dem.points.front().freedom.front()));  // of the drawbar pull
  EXPECT_TRUE(joint_test(dem, question, {}).test);
}

TEST_F(Pair, TheBudgetNamesWhatPullsAndAddsUp) {
  const Comparison comparison = against({300}, 40.0);
  const BudgetTable table = budget_at(comparison, 2);
  ASSERT_EQ(table.sides.size(), 2U);
  double sum = 0;
  for (const BudgetRow& row : table.rows) sum += row.force[0];
  EXPECT_NEAR(sum, base.answers[2].result->drawbar_pull.value, 1e-6);
  const Table told = budget_table(comparison, 2);
  EXPECT_EQ(told.rows.at(told.rows.size() - 2).at(1).text, "0") << "rounding is no force";
}

TEST_F(Pair, PartsThatLeaveMoreThanTheirBoundAreADoubtOfThePoint) {
  std::vector<RecordedRun> runs = grain_runs(base, {300}, 40.0);
  runs[2].answer.result->budget_rest = {-30, 12};
  runs[3].answer.result->budget_rest = {11, 12};
  const Side side = side_of("dem", runs, question.study.conditions);
  EXPECT_THAT(side.points[2].doubts, Contains(test::tells(DoubtKind::budget_rest, {-30, 12})));
  EXPECT_FALSE(tell_of(side.points[3].doubts, DoubtKind::budget_rest));
  // It is told beside the parts, and no part: each side's parts and the rest are its pull.
  const Comparison comparison = compare_sides(question, {side_of(base), side});
  const Table table = budget_table(comparison, 2);
  EXPECT_EQ(budget_at(comparison, 2).rows.size() + 2, table.rows.size());
  EXPECT_EQ(table.rows[table.rows.size() - 2].back().text, "-30.00 (12.00)");
}

// Dry grains under a rigid wheel on no rig: none of these can be why the models differ.
TEST_F(Pair, TheLoopDoesNotLookForWhatGrainsCannotHave) {
  const Side dem = side_of("dem", grain_runs(base, {300}, 40.0), question.study.conditions);
  const std::set<std::string> impossible = means_of(dem, question, {}).impossible;
  for (const char* id : {"rig_friction", "sensor_offset", "drift", "tire_flexibility", "moisture"})
    EXPECT_TRUE(impossible.contains(id)) << id;
  for (const char* id : {"slip_sinkage", "lug_thrust", "rate_dependence", "multipass"})
    EXPECT_FALSE(impossible.contains(id)) << id;
  EXPECT_TRUE(means_of(side_of(base), question, {}).impossible.empty());
}

// Trapezoids behind the largest normal stress: 10 and 3; ahead of it 20 and 8.
TEST_F(Pair, ShearOverNormalStressIsToldAheadOfTheLargestPressureAndBehindIt) {
  std::vector<RecordedRun> runs = grain_runs(base, {300}, 40.0);
  runs[1].answer.result->patch = {{0, 0, 0}, {0.1, 100, 30}, {0.2, 50, 25}, {0.3, 0, 0}};
  runs[2].answer.result->patch = {{0, 100, 30}, {0.1, 50, 20}};  // nothing behind
  runs[3].answer.result->patch = {};
  const Side side = side_of("dem", runs, question.study.conditions);
  const Comparison comparison = compare_sides(question, {side_of(base), side});
  const auto ratios = shear_ratios(comparison, 1, 1);
  ASSERT_TRUE(ratios);
  EXPECT_NEAR(ratios->ahead, 0.4, 1e-12);
  EXPECT_NEAR(ratios->behind, 0.3, 1e-12);
  EXPECT_FALSE(shear_ratios(comparison, 1, 2));
  EXPECT_FALSE(shear_ratios(comparison, 1, 3));
  // The analytic wheel slides the farther the nearer the exit: Janosi's curve rises.
  const auto analytic = shear_ratios(comparison, 0, 2);
  ASSERT_TRUE(analytic);
  EXPECT_GT(analytic->behind, analytic->ahead);
}

TEST_F(Pair, SinkageIsWhatTheLoadPressesAndWhatSlipAdds) {
  const std::vector<SinkageSplit> splits = sinkage_splits(against({0}, 1.0));
  ASSERT_EQ(splits.size(), 8U);  // two sides, four slips
  const double rest = base.answers[0].result->sinkage.value;
  for (const SinkageSplit& split : splits) {
    EXPECT_NEAR(split.at_rest, rest, 1e-12);
    EXPECT_NEAR(split.at_rest + split.by_slip, base.answers[split.condition].result->sinkage.value, 1e-12);
  }
}

TEST_F(Pair, AConditionWithoutResultIsToldAndTheOthersStillCompared) {
  auto runs = grain_runs(base, {300}, 40.0);
  runs.erase(runs.begin() + 1);
  const Comparison comparison =
      compare_sides(question, {side_of(base), side_of("dem", runs, question.study.conditions)});
  EXPECT_EQ(comparison.tallies.front().values, 3U);
  ASSERT_FALSE(comparison.not_compared.empty());
  const NotCompared& missing = comparison.not_compared.back();
  EXPECT_EQ(missing.what, NotCompared::What::no_result);
  EXPECT_EQ(missing.side, 1U);
  EXPECT_THAT(missing.conditions, testing::ElementsAre(1U));
}

TEST_F(Pair, ResultsBecomeACampaignForTheLoop) {
  const Campaign campaign = as_campaign(grain_side(base, {300}, 40.0), question);
  ASSERT_EQ(campaign.runs.size(), 4U);
  EXPECT_NEAR(*campaign.runs[2].drawbar_pull, base.answers[2].result->drawbar_pull.value + 300, 1e-9);
  EXPECT_FALSE(campaign.runs[2].lateral_force) << "nothing but noise on a flat bed";
  EXPECT_EQ(campaign.soil.friction_angle.std_error, question.scenario.soil.semi_empirical->friction_angle.std_error);
}

}  // namespace
}  // namespace soilbin::compare
