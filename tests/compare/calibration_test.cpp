// Calibration, on stand-ins whose answers are formulas.
#include "compare/calibrate/calibration.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "compare/telling/calibration_report.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/compare/stand_in_board.hpp"
#include "tests/dem/archive_scene.hpp"

namespace soilbin::compare {
namespace {

using dem::test::Folder;
using Eigen::VectorXd;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A tilting board in one line: grains slide where friction gives way or roll where rolling friction does; restitution
/// does nothing. Noise of 0.2 deg, told as such.
double board_angle(const VectorXd& v) {
  const double slide = std::atan(v[1]), roll = std::atan(0.25 + 0.7 * v[2]);
  return (slide * roll) / std::hypot(slide, roll) * 1.35;
}

VirtualTest board(double noise = 0.2 * degree, int* calls = nullptr) {
  VirtualTest test = stand_in_board(
      {{"restitution", 0.3, 0.7, "-"}, {"sliding_friction", 0.3, 0.9, "-"}, {"rolling_friction", 0.1, 0.7, "-"}});
  test.run = [=](const VectorXd& v, std::uint64_t seed) -> std::vector<Estimate> {
    if (calls != nullptr) ++*calls;
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(1e6 * v.sum()));
    return {{board_angle(v) + noise * std::normal_distribution<double>()(random), noise}};
  };
  return test;
}

/// Two targets: friction angle from friction, cohesion from cohesion and friction.
VirtualTest shear_box() {
  VirtualTest test;
  test.identity = "stand-in shear box";
  test.factors = {
      {"sliding_friction", 0.2, 1.0, "-"}, {"rolling_friction", 0.0, 0.4, "-"}, {"cohesion", 0.0, 4e5, "kJ/m^3"}};
  test.targets = {{"friction_angle", {30.72 * degree, 0.5 * degree}, "deg"}, {"cohesion", {3630, 200}, "kPa"}};
  test.run = [](const VectorXd& v, std::uint64_t) -> std::vector<Estimate> {
    const double phi = std::atan(0.25 + 0.5 * std::tanh(1.5 * v[0]) * (0.6 + v[1]));
    return {{phi, 0.1 * degree}, {0.02 * v[2] * std::tan(phi), 30}};
  };
  return test;
}

/// The board's, as it comes: made once.
const Calibration& of_the_board() {
  static const Calibration found = [] {
    ExperimentStore store;
    return calibrate(board(), {}, store);
  }();
  return found;
}

/// For tests of what is asked and kept, where few points of the box do.
constexpr int few_points = 400;

TEST(Calibration, FindsABoardsAngleWithinThreePercent) {
  const Calibration& found = of_the_board();
  EXPECT_TRUE(found.reached);
  EXPECT_GE(found.best.runs, 1);
  EXPECT_NEAR(board_angle(found.best.values), 31.47 * degree, 0.03 * 31.47 * degree);  // the truth, not the surrogate
  EXPECT_GE(found.best.chance, 0.9);
  EXPECT_LT(found.runs.size(), 20U);
}

TEST(Calibration, RangeAnalysisSeesWhichFactorDoesNothing) {
  const Calibration& found = of_the_board();
  ASSERT_EQ(found.analyses.size(), 1U);
  EXPECT_EQ(found.analyses[0].ranges.order.back(), 0);  // restitution
  const AnalysisOfVariance& variance = found.analyses[0].variance;
  EXPECT_EQ(variance.error_from, ErrorFrom::free_columns);
  EXPECT_GT(variance.factors[0].p_value, 0.05);
  EXPECT_GT(variance.factors[1].f, 5 * variance.factors[0].f);
  EXPECT_LT(found.learned[0], 0.15);  // one angle can't tell three numbers
  EXPECT_GT(found.learned[1], found.learned[0]);
}

TEST(Calibration, CandidatesAreRunNearAndDifferent) {
  const Calibration& found = of_the_board();
  ASSERT_GE(found.candidates.size(), 3U);
  for (const Candidate& candidate : found.candidates) {
    EXPECT_GE(candidate.runs, 1);
    EXPECT_NEAR(candidate.predicted[0].value, 31.47 * degree, 0.05 * 31.47 * degree);
  }
}

TEST(SlowCalibration, MeetsTwoTargetsAtOnce) {
  ExperimentStore store;
  const VirtualTest test = shear_box();
  const Calibration found = calibrate(test, {.most_runs = 40}, store);
  EXPECT_TRUE(found.reached);
  const std::vector<Estimate> truth = test.run(found.best.values, 1);
  EXPECT_NEAR(truth[0].value / degree, 30.72, 0.03 * 30.72);
  EXPECT_NEAR(truth[1].value, 3630, 0.03 * 3630);
  // Cohesion is what 3.63 kPa need at tan phi = 0.594: 3630/(0.02 * 0.594) = 305 kJ/m^3.
  EXPECT_NEAR(found.parameters[2].value, 3630 / (0.02 * std::tan(30.72 * degree)), 3 * found.parameters[2].std_error);
  EXPECT_GT(found.learned[2], 0.7);
}

TEST(SlowCalibration, ChancesAreWhatTheySay) {
  // Of fifty calibrations with other noise that claim at least 90 %, at most a share of 10 % and its scatter are wrong.
  int claimed = 0, wrong = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    ExperimentStore store;
    const Calibration found = calibrate(board(0.4 * degree), {.seed = 1000 * seed, .cloud = 400}, store);
    claimed += found.reached;
    wrong += found.reached && std::abs(board_angle(found.best.values) / degree - 31.47) > 0.03 * 31.47;
  }
  EXPECT_GT(claimed, 40);
  EXPECT_LE(wrong, 0.1 * claimed + 2 * std::sqrt(0.09 * claimed));
}

TEST(SlowCalibration, ATargetOutOfReachIsNotReached) {
  ExperimentStore store;
  VirtualTest test = board();
  test.targets[0].measured = {60 * degree, 0};
  const Calibration found = calibrate(test, {.most_runs = 14}, store);
  EXPECT_FALSE(found.reached);
  EXPECT_TRUE(found.candidates.empty());
  EXPECT_LT(found.best.chance, 0.01);
  EXPECT_EQ(found.runs.size(), 14U);
}

TEST(Calibration, ATargetWithAToleranceMayBeZero) {
  ExperimentStore store;
  VirtualTest test;
  test.identity = "stand-in volume";
  test.factors = {{"sliding_friction", 0, 1, "-"}, {"settling_friction", 0, 1, "-"}};
  test.targets = {{"volume", {0, 0.005}, "%", 0.01}};
  test.run = [](const VectorXd& v, std::uint64_t) -> std::vector<Estimate> { return {{0.1 * (v.sum() - 0.8), 1e-4}}; };
  const Calibration found = calibrate(test, {}, store);
  EXPECT_TRUE(found.reached);
  EXPECT_NEAR(found.best.values.sum(), 0.8, 0.1);
  // Only the sum is determined: with it, what one factor has the other one lacks.
  EXPECT_LT(found.correlations(0, 1), -0.9);
  EXPECT_EQ(found.correlations(0, 1), found.correlations(1, 0));
  EXPECT_EQ(found.correlations(0, 0), 1);
}

// A sentence holds three targets; more stand in a table, and what each factor does to them on the page alone.
TEST(SlowCalibration, ManyTargetsAreToldInATable) {
  VirtualTest test;
  test.identity = "stand-in curves";
  test.factors = {{"sliding_friction", 0, 1, "-"}, {"youngs_modulus", 1e9, 2e9, "GPa"}};
  for (const char* name : {"peak_angle.A", "end_angle.A", "volume.A", "half_strain.A"})
    test.targets.push_back({name, {0.5, 0.01}, "-", 0.02});
  test.run = [](const VectorXd& v, std::uint64_t) {
    return std::vector<Estimate>(4, Estimate{0.2 + 0.6 * v[0], 0.001});
  };
  ExperimentStore store;
  const CalibrationOptions options;
  const Calibration found = calibrate(test, options, store);
  for (const std::string& sentence : calibration_sentences(test, options, found))
    EXPECT_THAT(sentence, testing::Not(HasSubstr("end_angle.A")));
  const std::string text = text_of(report_on(test, options, found, false));
  EXPECT_THAT(text, HasSubstr("Targets at the chosen point"));
  EXPECT_THAT(text, HasSubstr("What the targets alone allow"));
  EXPECT_THAT(text, testing::Not(HasSubstr("sum of squares")));
}

TEST(Calibration, StoppedAndResumedIsTheSameAndDoesNoWorkTwice) {
  const Folder folder;
  ExperimentStore fresh;
  int calls_whole = 0, calls_parts = 0;
  const Calibration whole = calibrate(board(0.2 * degree, &calls_whole), {.cloud = few_points}, fresh);
  struct Stopped {};
  CalibrationOptions stopping{.cloud = few_points};
  for (const int after : {3, 7, 11}) {
    stopping.watch = [after](const dem::Progress& progress) {
      if (std::lround(30 * progress.done) == after) throw Stopped();
    };
    ExperimentStore store(folder / "store.json");
    EXPECT_THROW(calibrate(board(0.2 * degree, &calls_parts), stopping, store), Stopped);
  }
  ExperimentStore store(folder / "store.json");
  EXPECT_EQ(store.size(), 11U);
  const Calibration resumed = calibrate(board(0.2 * degree, &calls_parts), {.cloud = few_points}, store);
  EXPECT_EQ(calls_parts, calls_whole);
  EXPECT_EQ(resumed.best.values, whole.best.values);
  EXPECT_EQ(resumed.best.chance, whole.best.chance);
  EXPECT_TRUE(resumed.runs[10].experiment.from_store);
}

// As where it is answered from what others made, and they did not make all of it.
TEST(Calibration, OfAStoreAloneItEndsWhereTheStoreDoes) {
  ExperimentStore store;
  struct Stopped {};
  CalibrationOptions options{.cloud = few_points};
  options.watch = [](const dem::Progress& progress) {
    if (std::lround(30 * progress.done) == 11) throw Stopped();
  };
  EXPECT_THROW(calibrate(board(), options, store), Stopped);
  int told = 0;
  options.watch = [&](const dem::Progress&) {
    if (++told > 100) throw Stopped();
  };
  VirtualTest asks_nobody = board();
  asks_nobody.run = {};
  const Calibration found = calibrate(asks_nobody, options, store);
  EXPECT_EQ(found.runs.size(), 11U);
  EXPECT_FALSE(found.reached);
}

TEST(Calibration, AnotherTestDoesNotTakeFromTheStore) {
  const Folder folder;
  int calls = 0;
  {
    ExperimentStore store(folder / "store.json");
    calibrate(board(0.2 * degree, &calls), {.most_runs = 9, .cloud = few_points}, store);
  }
  ExperimentStore store(folder / "store.json");
  VirtualTest other = board(0.2 * degree, &calls);
  other.identity = "another rate of tilt";
  calibrate(other, {.most_runs = 9, .cloud = few_points}, store);
  EXPECT_EQ(calls, 18);
}

TEST(Calibration, FailedExperimentsAreLeftOutAndKept) {
  ExperimentStore store;
  VirtualTest test = board();
  const auto works = test.run;
  test.run = [works](const VectorXd& v, std::uint64_t seed) {
    if (v[1] > 0.8 && v[2] > 0.6) throw NoSolution("the sand never slides\n  hint: less friction");
    return works(v, seed);
  };
  const Calibration found = calibrate(test, {.cloud = few_points}, store);
  EXPECT_TRUE(found.reached);
  EXPECT_TRUE(found.analyses.empty());  // an unbalanced design has no range analysis
  EXPECT_TRUE(std::any_of(found.runs.begin(), found.runs.end(), [](const CalibrationRun& run) {
    return run.experiment.error.starts_with("the sand never");
  }));
  EXPECT_THAT(as_text(runs_table(test, found)),
              testing::AllOf(HasSubstr("-  the sand never slides; hint: less"), testing::Not(HasSubstr("\n  hint"))));
  test.run = [](const VectorXd&, std::uint64_t) -> std::vector<Estimate> { throw NoSolution("never"); };
  test.identity = "never";
  EXPECT_THROW(calibrate(test, {}, store), NoSolution);
}

// A board that falls over wherever it has the right angle by more than a little friction: no point is asked twice
// without an answer.
TEST(SlowCalibration, APointThatFailsIsNotAskedAgain) {
  VirtualTest test = board();
  const auto angle = test.run;
  test.run = [=](const VectorXd& v, std::uint64_t seed) {
    if (v[1] > 0.45 && std::abs(board_angle(v) - 31.47 * degree) < 2 * degree) throw NoSolution("the board fell over");
    return angle(v, seed);
  };
  ExperimentStore store;
  CalibrationOptions options;
  options.probability = 0.9999;  // until the budget's end
  const Calibration found = calibrate(test, options, store);
  std::vector<VectorXd> failed;
  for (const CalibrationRun& run : found.runs) {
    if (!run.experiment.results.empty()) continue;
    EXPECT_EQ(std::ranges::count(failed, run.experiment.values), 0);
    failed.push_back(run.experiment.values);
  }
  EXPECT_GE(failed.size(), 2U);
}

TEST(Calibration, AnotherExperimentDecides) {
  ExperimentStore store;
  std::size_t asked = 0;
  CalibrationOptions options;
  options.decide = [&](const std::vector<Candidate>& candidates) {
    asked = candidates.size();
    Decision decision;
    for (const Candidate& candidate : candidates) {
      decision.trials.emplace_back().error = {std::abs(candidate.values[0] - 0.45), 0};
      if (decision.trials.back().error->value < decision.trials[decision.chosen].error->value)
        decision.chosen = decision.trials.size() - 1;
    }
    return decision;
  };
  const Calibration found = calibrate(board(), options, store);
  EXPECT_EQ(asked, found.candidates.size());
  for (const Candidate& other : found.candidates)
    EXPECT_LE(std::abs(found.best.values[0] - 0.45), std::abs(other.values[0] - 0.45));
}

TEST(Calibration, WhereNothingIsDecidedTheLikeliestStays) {
  ExperimentStore store;
  CalibrationOptions options;
  options.decide = [](const std::vector<Candidate>& candidates) {
    Decision decision;
    decision.trials.resize(candidates.size());  // none has an error
    decision.chosen = candidates.size() - 1;
    return decision;
  };
  const Calibration found = calibrate(board(), options, store);
  EXPECT_EQ(found.best.values, of_the_board().best.values);
}

TEST(Calibration, WhatMakesNoSenseIsRefused) {
  ExperimentStore store;
  VirtualTest test = board();
  test.targets[0].measured.value = 0;
  EXPECT_THROW(calibrate(test, {}, store), InputError);
  test = board(), std::swap(test.factors[0].lower, test.factors[0].upper);
  EXPECT_THROW(calibrate(test, {}, store), InputError);
  EXPECT_THROW(calibrate(board(), {.design = "L10"}, store), InputError);
  EXPECT_THROW(calibrate(board(), {.most_runs = 8}, store), InputError);
  EXPECT_THROW(calibrate(board(), {.probability = 1.0}, store), InputError);
}

}  // namespace
}  // namespace soilbin::compare
