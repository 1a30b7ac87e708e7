// The loop's parts, each against what it must be: noise, signatures, p-values.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "compare/attribution/base_fit.hpp"
#include "compare/attribution/predictive_gain.hpp"
#include "compare/attribution/residual_tests.hpp"
#include "compare/attribution/signatures.hpp"
#include "compare/attribution/unnamed.hpp"
#include "compare/fit/setpoint_squares.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {
namespace {

using Eigen::VectorXd;

// Every condition reads what was set, and nothing else moved.
TEST(ConditionViews, ReadWhatTheySet) {
  for (const ConditionView& view : condition_views) {
    OperatingCondition at;
    view.set(at, 3.0);
    EXPECT_EQ(view.get(at), 3.0) << view.name;
    EXPECT_EQ(&condition_view(view.name), &view);
    for (const ConditionView& other : condition_views)
      if (&other != &view) {
        const double untouched = other.get(OperatingCondition{}), now = other.get(at);
        EXPECT_TRUE(now == untouched || (std::isnan(now) && std::isnan(untouched))) << view.name << ", " << other.name;
      }
  }
  EXPECT_THROW(condition_view("weather"), std::out_of_range);
}

// Three pairs of channels, each measured in runs of its own, that go together as no three channels can (two alike, a
// third with the one and against the other): the noise of a run that holds them all is a covariance even so.
TEST(NoiseFloor, IsOneOfAllChannelsWhereEachPairWasMeasuredApart) {
  Observations runs;
  NoiseData data;
  std::vector<double> residual;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const std::array<std::array<int, 2>, 3> pairs = {{{0, 1}, {0, 2}, {1, 2}}};
  for (int run = 0; run < 300; ++run) {
    const auto [one, other] = pairs[run % 3];
    runs.rows.emplace_back();
    runs.condition.push_back(0);
    runs.source_row.push_back(run);
    const double value = normal(random);
    for (const int channel : {one, other}) runs.cells.push_back({.row = run, .channel = channel});
    residual.push_back(value);
    residual.push_back(run % 3 == 2 ? -value : value);
  }
  runs.conditions = 1;
  data.residual = Eigen::Map<VectorXd>(residual.data(), static_cast<Eigen::Index>(residual.size()));
  data.prediction = VectorXd::Constant(data.residual.size(), 10.0);
  data.soil_columns = Eigen::MatrixXd::Zero(data.residual.size(), 0);
  const Eigen::Matrix4d correlation = estimate_noise(runs, data).floor.correlation;
  EXPECT_GT(correlation(0, 1), 0.3);
  EXPECT_LT(correlation(1, 2), -0.3);
  EXPECT_EQ(correlation.llt().info(), Eigen::Success);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(correlation).eigenvalues()[0], 0.05);
}

// The floor that is found is the floor that was put in, to the precision that 40 freedoms give (11 %; 3 sd allowed).
TEST(NoiseFloor, IsTheNoisePutIn) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 7);
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  EXPECT_EQ(base.data().noise.rerun_freedom, 21);
  for (int c = 0; c < 3; ++c) {
    const ChannelNoise& n = base.data().noise.channels[static_cast<std::size_t>(c)];
    const double typical = n.sd(base.fit().prediction.head(3)[c]);
    EXPECT_NEAR(std::log(typical / fine_noise[static_cast<std::size_t>(c)]), 0.0, 0.35)
        << channel_views[static_cast<std::size_t>(c)].name;
  }
}

/// The estimate of a channel of 12 runs of its own, with unit noise about a prediction that needs no soil.
NoiseEstimate twelve_of_one(const std::vector<double>& residual) {
  Observations runs;
  for (int run = 0; run < 12; ++run) {
    runs.rows.emplace_back().slip = 0.05 * run;
    runs.condition.push_back(run);
    runs.source_row.push_back(run);
    runs.cells.push_back({.row = run, .channel = torque});
  }
  runs.conditions = 12;
  return estimate_noise(runs, {.residual = Eigen::Map<const VectorXd>(residual.data(), 12),
                               .prediction = VectorXd::LinSpaced(12, 20, 60),
                               .soil_columns = Eigen::MatrixXd::Zero(12, 0)});
}

// Sizes between those that are tried are found too: half a step apart, the noise is half a step larger.
TEST(NoiseFloor, HasAnySize) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> residual(12), larger;
  for (double& r : residual) r = normal(random);
  const auto floor_of = [](const std::vector<double>& of) { return twelve_of_one(of).floor.channels[torque].floor; };
  for (const double times : {1.03, 1.06, 1.09}) {
    larger.clear();
    for (const double r : residual) larger.push_back(times * r);
    EXPECT_NEAR(floor_of(larger) / floor_of(residual), times, 0.01);
  }
}

// Of runs that scatter alike in time, those of many independent samples count for more: their means' errors tell.
TEST(NoiseFloor, FollowsTheErrorsOfMeans) {
  Campaign campaign = sand_campaign();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int count = 60;
  constexpr double little = 1.5, much = 5.0, predicted = 200.0;
  VectorXd residual(count);
  for (int i = 0; i < count; ++i) {
    auto& run = campaign.runs.emplace_back();
    run.at.load = 80, run.at.slip = 0.01 * i, run.torque = predicted;
    run.within_run_sd[torque] = 10.0;
    if (i > 0) run.mean_error[torque] = i % 2 == 0 ? little : much;
    residual[i] = normal(random) * (i % 2 == 0 ? little : much);
  }
  const Observations runs = observe(campaign);
  EXPECT_EQ(runs.cells[0].spread, much) << "the median, of a run that tells none";
  EXPECT_EQ(runs.cells[1].spread, much);
  EXPECT_EQ(runs.cells[2].spread, little);
  const ChannelNoise noise = estimate_noise(runs, {.residual = residual,
                                                   .prediction = VectorXd::Constant(count, predicted),
                                                   .soil_columns = Eigen::MatrixXd::Zero(count, 0)})
                                 .floor.channels[torque];
  EXPECT_NEAR(std::log(noise.sd(predicted, much) / much), 0.0, 0.35);
  EXPECT_GT(noise.sd(predicted, much), 2 * noise.sd(predicted, little));
  for (auto& run : campaign.runs) run.mean_error = {};
  EXPECT_EQ(observe(campaign).cells[1].spread, 10.0) << "without errors the scatter in time";
}

// A value 5 sd off can't be among twelve, if its own size is in the sd: at the most it is 11/sqrt(12) = 3.2. Held
// against the others it is as far off as it is.
TEST(NoiseFloor, AMistypedValueIsHeldAgainstTheOthers) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  int below = 0, values = 0, found = 0;
  for (int campaign = 0; campaign < 60; ++campaign) {
    std::vector<double> residual(12);
    for (double& r : residual) r = normal(random);
    for (const double chance : twelve_of_one(residual).chance)
      if (chance < 1) ++values, below += chance < 0.05;
    residual[static_cast<std::size_t>(campaign) % 12] += 40;
    const std::vector<double> chances = twelve_of_one(residual).chance;
    const auto least = std::ranges::min_element(chances);
    EXPECT_EQ(least - chances.begin(), campaign % 12);
    found += *least < thresholds::outlier_level / 12;
  }
  EXPECT_LT(below, 0.07 * values) << "of noise alone, one in twenty at the most";
  EXPECT_GT(below, 0.01 * values);
  EXPECT_GE(found, 54);
}

// A channel that was measured twice in all the campaign is heard, and neither makes the noise impossible nor the fit.
TEST(NoiseFloor, StandsAChannelOfTwoValues) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 7);
  for (std::size_t i = 2; i < campaign.runs.size(); ++i) campaign.runs[i].torque.reset();
  const FittedModel base = fit_base(campaign, observe(campaign), {});
  EXPECT_TRUE(base.data().noise.channels[torque].measured);
  EXPECT_GT(base.data().noise.channels[torque].floor, 0.0);
  EXPECT_TRUE(base.fit().residual.allFinite());
}

// Runs may stand in a file in any order.
TEST(Observations, CellsStandInTheOrderOfTheRuns) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 7);
  const auto pulls = [](const Campaign& asked) {
    const Observations observations = observe(asked);
    std::vector<double> values;
    for (const Eigen::Index i : cells_in_order_of_runs(observations)) values.push_back(observations.cells[i].value);
    return values;
  };
  const std::vector<double> in_order = pulls(campaign);
  std::ranges::reverse(campaign.runs);
  EXPECT_EQ(pulls(campaign), in_order);
  campaign.runs.front().at.run.reset();
  EXPECT_EQ(pulls(campaign).front(), *campaign.runs.front().drawbar_pull) << "the order is not known: as in the file";
}

TEST(Folds, AreNoMoreThanConditionsAndLeaveSomeOut) {
  Observations four;
  four.block = {0, 1, 2, 3};
  const Folds folds = deal_folds(four, 9, 1);
  EXPECT_EQ(folds.count, 4);
  EXPECT_EQ(std::set<int>(folds.of_condition.begin(), folds.of_condition.end()), (std::set<int>{0, 1, 2, 3}));
}

// Re-runs that nobody labelled, as instruments read them: near each other, never alike. No fold predicts one from the
// other. A label says that two conditions are two.
TEST(Folds, KeepTogetherWhatMayBeReruns) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 7);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<std::string> setpoint;
  for (compare::Run& run : campaign.runs) {
    setpoint.push_back(*run.setpoint);
    run.setpoint.reset();
    run.at.load *= 1 + 0.003 * normal(random), run.at.slip += 0.001 * normal(random);
  }
  const Observations observations = observe(campaign);
  EXPECT_EQ(observations.conditions, 42) << "each read otherwise";
  EXPECT_EQ(observations.rerun_freedom(), 0);
  EXPECT_EQ(observations.conditions_in_blocks(), 42);
  const Folds folds = deal_folds(observations, 5, 1);
  std::map<std::string, std::set<int>> folds_of_setpoint;
  for (std::size_t i = 0; i < setpoint.size(); ++i)
    folds_of_setpoint[setpoint[i]].insert(folds.of_condition[observations.condition[i]]);
  for (const auto& [name, its_folds] : folds_of_setpoint) EXPECT_EQ(its_folds.size(), 1U) << name;
  for (std::size_t i = 0; i < setpoint.size(); ++i) campaign.runs[i].setpoint = fmt::format("{}", i);
  EXPECT_EQ(observe(campaign).conditions_in_blocks(), 0);
}

FittedModel settled(const Campaign& campaign) { return fit_base(campaign, observe(campaign), {}); }

/// The base model's signatures, and what they are taken off.
struct Traced {
  FittedModel base;
  std::vector<Signature> signatures;
};

Traced traced(const Campaign& campaign) {
  const FittedModel base = settled(campaign);
  return {base, residual_signatures(base, problem_of(base))};
}

TEST(Signatures, LeaveOutWhatTheDataCannotHold) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 7);
  const auto has = [](const std::vector<Signature>& all, const std::string& id) {
    return std::ranges::any_of(all, [&](const Signature& s) { return s.term.form->id == id; });
  };
  EXPECT_TRUE(has(traced(campaign).signatures, "sensor_offset"));
  campaign.impossible = {"sensor_offset"};
  const std::vector<Signature> signatures = traced(campaign).signatures;
  EXPECT_FALSE(has(signatures, "sensor_offset"));
  EXPECT_TRUE(has(signatures, "slip_sinkage"));
}

// Without anything missing they are reached by chance as seldom as they say (or seldomer: the setpoint farthest off is
// left out, and the least of several p-values counts times their number). 3 standard errors of 120 campaigns allowed.
TEST(SlowResidualTests, KeepTheirLevels) {
  constexpr int campaigns = 120;
  constexpr double most = 0.05 * campaigns + 3 * 2.39;  // sqrt(0.05 0.95 120)
  int by_reruns = 0, by_order = 0, unnamed = 0;
  for (int k = 0; k < campaigns; ++k) {
    Campaign campaign = sand_campaign();
    measure(campaign, sweep(), {}, fine_noise, static_cast<std::uint64_t>(100 + k));
    const FittedModel base = settled(campaign);
    if (rerun_test(base).p_value < 0.05) ++by_reruns;
    if (serial_test(base, 399, 1).p_value < 0.05) ++by_order;
    if (unnamed_evidence(problem_of(base), unnamed_kinds(base)).gain > std::log(20.0)) ++unnamed;
  }
  EXPECT_LE(by_reruns, most);
  EXPECT_LE(by_order, most);
  EXPECT_LE(unnamed, most);  // a Bayes factor of 20 is reached by chance in one of twenty cases at the most
}

// Amplifiers that are warm and cold by turns, 4 % either way for seven runs: the noise grows by it, so that the lack of
// fit against it says nothing. The order of the runs does; where that is not known, nothing can.
TEST(SerialTest, SeesWarmAndColdDays) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 8);
  for (compare::Run& run : campaign.runs) {
    const double gain = (*run.at.run - 1) / 7 % 2 == 0 ? 1.04 : 0.96;
    *run.torque *= gain, *run.drawbar_pull *= gain;
  }
  const FittedModel warm_and_cold = settled(campaign);
  const SerialTest test = serial_test(warm_and_cold, 3999, 1);
  EXPECT_LT(test.p_value, 0.005);
  EXPECT_NE(test.channel, sinkage);
  EXPECT_EQ(test.p_value, serial_test(warm_and_cold, 3999, 1).p_value);
  for (compare::Run& run : campaign.runs) *run.at.run += 20261101;  // numbered from a date
  EXPECT_EQ(test.p_value, serial_test(settled(campaign), 3999, 1).p_value);
  for (compare::Run& run : campaign.runs) run.at.run.reset();
  EXPECT_EQ(serial_test(settled(campaign), 399, 1).p_value, 1.0);
}

// Setpoints that are off by chance, but alike in both of their runs, pass for noise beside any smooth function: the
// lack of fit against that noise says nothing, the re-runs do. A single setpoint that is off is not enough: an outlier.
TEST(RerunTest, SeesWhatNoSmoothFunctionFollows) {
  const auto made = [](auto moved) {
    Campaign campaign = sand_campaign();
    measure(campaign, sweep(), {}, fine_noise, 8);
    for (compare::Run& run : campaign.runs) *run.torque += moved(std::stoi(run.setpoint->substr(1)));
    return settled(campaign);
  };
  const FittedModel scattered = made([](int s) { return 4 * fine_noise[1] * ((s * s + s / 3) % 3 - 1.0); });
  const FittedModel one_off = made([](int s) { return s == 9 ? 4 * fine_noise[1] : 0.0; });
  EXPECT_LT(rerun_test(scattered).p_value, 1e-4);
  EXPECT_GT(lack_of_fit(scattered).p_value, 10 * rerun_test(scattered).p_value);
  EXPECT_GT(rerun_test(one_off).p_value, 0.05);
}

// An instrument that reads to 10 N m: re-runs agree to the digit, and are not without noise for that.
TEST(RerunTest, KnowsThatValuesAreRead) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, {0.5, 0.2, 1e-4, 0.5}, 8);
  for (compare::Run& run : campaign.runs) *run.torque = 10 * std::round(*run.torque / 10);
  EXPECT_GT(rerun_test(settled(campaign)).p_value, 0.01);
}

// A signature's direction has nothing left that the soil could do, and unit length.
TEST(Trace, DirectionsAreOffTheSoilsColumns) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 9);
  const auto [base, signatures] = traced(campaign);
  int seen = 0;
  for (const Signature& s : signatures) {
    if (s.projected_norm == 0.0) continue;
    ++seen;
    EXPECT_NEAR(s.direction.norm(), 1.0, 1e-9);
    EXPECT_LT((base.fit().columns.transpose() * s.direction).cwiseAbs().maxCoeff(), 1e-6 * base.fit().columns.norm());
    // The prior's rows of d are 0, and P is a symmetric projector: (P d/|P d|)'d = |P d|.
    const double kept = s.direction.head(s.white.size()).dot(s.white);
    EXPECT_NEAR(kept, s.projected_norm, 1e-6 * s.white.norm());
    EXPECT_NEAR(s.share_kept, kept / s.white.norm(), 1e-6);
  }
  EXPECT_GT(seen, 40);
}

// A torque cell zeroed before the first run that warms up as the root of time. About the mean run, a drift's trace is
// far from that and an offset's nearer; counted from the first run the drift's is the nearest of all.
TEST(Trace, SeesADriftFromTheFirstRun) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 9);
  const double runs = static_cast<double>(campaign.runs.size());
  for (compare::Run& run : campaign.runs) *run.torque -= 25 * std::sqrt(*run.at.run / runs);
  const auto [base, signatures] = traced(campaign);
  const auto strongest = [&](const std::string& effect, auto&& counts) {
    double most = 0.0;
    for (const Signature& s : signatures)
      if (s.term.form->id == effect && s.projected_norm > 0 && counts(s)) most = std::max(most, s.strength());
    return most;
  };
  const auto any = [](const Signature&) { return true; };
  const auto about_the_mean = [&](const Signature& s) { return s.term.defaults[1] == 0.5 * (runs + 1); };
  const auto from_the_first = [](const Signature& s) { return s.term.defaults[1] == 1.0; };
  EXPECT_LT(strongest("drift", about_the_mean), strongest("sensor_offset", any));
  EXPECT_GT(strongest("drift", from_the_first), strongest("sensor_offset", any));
}

// Under no effect the family-wise p is uniform: of 200 simulated residuals about 5 % fall below 0.05.
TEST(FamilyWiseP, IsUniformWithoutEffects) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 9);
  const auto [base, signatures] = traced(campaign);
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  int small = 0;
  constexpr int trials = 200;
  for (int k = 0; k < trials; ++k) {
    VectorXd e(signatures.front().direction.size());
    for (Eigen::Index i = 0; i < e.size(); ++i) e[i] = normal(random);
    double most = 0.0;
    for (const Signature& s : signatures) {
      if (s.projected_norm == 0.0) continue;
      const double t = s.direction.dot(e);
      most = std::max(most, s.one_sided ? t : std::abs(t));
    }
    if (family_wise_p(signatures, most, 1e6, 300, 1000 + static_cast<std::uint64_t>(k)) < 0.05) ++small;
  }
  EXPECT_GE(small, 2);   // P(X <= 1) = 4e-4 for binomial(200, .05)
  EXPECT_LE(small, 20);  // P(X >= 21) = 1e-3
}

/// A residual of unit noise and, in each cell, of what `of_cell` tells.
VectorXd made_residual(const Observations& observations, std::uint64_t seed,
                       const std::function<double(const Cell&, const OperatingCondition&)>& of_cell) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  VectorXd r(static_cast<Eigen::Index>(observations.cells.size()));
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const Cell& cell = observations.cells[static_cast<std::size_t>(i)];
    r[i] = normal(random) + of_cell(cell, observations.rows[static_cast<std::size_t>(cell.row)]);
  }
  return r;
}

// A residual made of the run number is seen against the run number and nothing else.
TEST(Dependences, FindTheVariable) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 13);
  const Observations observations = observe(campaign);
  const VectorXd r = made_residual(observations, 2, [](const Cell& cell, const OperatingCondition& at) {
    return cell.channel == torque ? 0.08 * *at.run : 0.0;
  });
  int others = 0;
  std::optional<double> on_the_run;
  for (const Dependence& d : dependences(observations, r, 499, 1)) {
    if (d.channel == torque && d.variable == "run") {
      on_the_run = d.p_value;
    } else {
      ++others;
      EXPECT_GT(d.p_value, 0.002) << d.variable;
    }
  }
  ASSERT_TRUE(on_the_run);
  EXPECT_LE(*on_the_run, 0.01);
  EXPECT_GE(others, 5) << "load, slip and run, each in four channels or three";
}

// Benjamini and Hochberg's step-up: of m p-values, the least m p/rank among those that are no smaller.
TEST(Dependences, FalseDiscoveryRateByDefinition) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 13);
  const Observations observations = observe(campaign);
  const VectorXd r = made_residual(observations, 4, [](const Cell& cell, const OperatingCondition& at) {
    return cell.channel == sinkage ? 3 * at.slip : 0.0;
  });
  const std::vector<Dependence> table = dependences(observations, r, 1999, 1);
  ASSERT_GE(table.size(), 9u);
  int sure = 0;
  for (const Dependence& d : table) {
    double least = 1.0;
    for (const Dependence& other : table) {
      if (other.p_value < d.p_value) continue;
      const auto rank =
          std::count_if(table.begin(), table.end(), [&](const Dependence& o) { return o.p_value <= other.p_value; });
      least = std::min(least, other.p_value * static_cast<double>(table.size()) / static_cast<double>(rank));
    }
    EXPECT_NEAR(d.false_discovery_rate, least, 1e-12) << d.variable;
    if (d.false_discovery_rate <= 0.05) ++sure;
  }
  EXPECT_GE(sure, 1) << "p = 1/2000 of the sinkage on slip, times some 12 tests";
}

/// Setpoints of 1, 2, 3, 1, 2, 3, ... or of `each` re-runs over slip, two channels measured.
Observations rerun_observations(int setpoints, int each = 0) {
  Observations made;
  made.conditions = setpoints;
  for (int s = 0; s < setpoints; ++s)
    for (int k = 0; k < (each > 0 ? each : 1 + s % 3); ++k) {
      OperatingCondition at;
      at.slip = 0.05 * (s + 1);
      const int row = static_cast<int>(made.rows.size());
      made.rows.push_back(at), made.condition.push_back(s), made.source_row.push_back(row);
      for (const int channel : {drawbar_pull, torque}) made.cells.push_back({row, channel, 0.0});
    }
  return made;
}

/// Of 400 residuals that share an error within each setpoint and between the channels of a row, and depend on nothing:
/// how many find slip at 5 % in one channel or the other.
std::array<int, 2> found_by_chance(const Observations& made, double shared) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::array<int, 2> found{};
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> of_setpoint, of_row;
    for (int s = 0; s < made.conditions; ++s) of_setpoint.push_back(shared * normal(random));
    for (std::size_t r = 0; r < made.rows.size(); ++r) of_row.push_back(0.5 * normal(random));
    VectorXd residual(static_cast<Eigen::Index>(made.cells.size()));
    for (std::size_t i = 0; i < made.cells.size(); ++i) {
      const auto row = static_cast<std::size_t>(made.cells[i].row);
      residual[static_cast<Eigen::Index>(i)] =
          of_setpoint[static_cast<std::size_t>(made.condition[row])] + of_row[row] + 0.3 * normal(random);
    }
    for (const Dependence& d : dependences(made, residual, 99, static_cast<std::uint64_t>(trial)))
      if (d.variable == "slip" && d.p_value <= 0.05) ++found[static_cast<std::size_t>(d.channel)];
  }
  return found;
}

// p <= 0.05 by chance in 5 % of 400 campaigns, 20 +- 4.4: with setpoints that are off by twice what their re-runs
// differ, too (cells permuted one by one would find slip in every third of these), and with unequal numbers of
// re-runs.
TEST(Dependences, KeepTheirLevelWhereRerunsShareAnError) {
  const std::vector<std::pair<Observations, double>> designs = {
      {rerun_observations(12, 3), 1.2}, {rerun_observations(24), 1.2}, {rerun_observations(20, 1), 0.0}};
  for (const auto& [made, shared] : designs)
    for (const int found : found_by_chance(made, shared)) {
      EXPECT_LE(found, 33) << made.rows.size() << " runs";
      EXPECT_GE(found, 7) << made.rows.size() << " runs";
    }
}

// A torque that grows with the setpoints' slip is found all the same.
TEST(Dependences, FindWhatSetpointsFollow) {
  const Observations made = rerun_observations(12, 3);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  VectorXd residual(static_cast<Eigen::Index>(made.cells.size()));
  for (std::size_t i = 0; i < made.cells.size(); ++i) {
    const auto row = static_cast<std::size_t>(made.cells[i].row);
    residual[static_cast<Eigen::Index>(i)] =
        0.3 * normal(random) + (made.cells[i].channel == torque ? 8 * (made.rows[row].slip - 0.3) : 0.0);
  }
  std::map<std::string, double> of_torque;
  for (const Dependence& d : dependences(made, residual, 999, 1))
    if (d.channel == torque) of_torque[d.variable] = d.p_value;
  EXPECT_LE(of_torque.at("slip"), 0.002);
}

// Every value stays in some place, the re-runs of a setpoint stay together, and a setpoint without another of its size
// stays where it is.
TEST(SetpointPermutation, KeepsRerunsTogether) {
  const std::vector<int> setpoint = {4, 7, 7, 4, 9, 9, 9, 5, 5};
  const SetpointPermutation permuted(setpoint);
  VectorXd values(9);
  for (Eigen::Index i = 0; i < 9; ++i) values[i] = 10 * setpoint[static_cast<std::size_t>(i)] + static_cast<double>(i);
  std::mt19937_64 random(5);
  std::set<int> at_the_first;
  for (int k = 0; k < 200; ++k) {
    const VectorXd moved = permuted(values, random);
    std::vector<double> sorted(moved.begin(), moved.end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> all(values.begin(), values.end());
    std::sort(all.begin(), all.end());
    EXPECT_EQ(sorted, all);
    const auto from = [&](Eigen::Index i) { return static_cast<int>(moved[i]) / 10; };
    EXPECT_EQ(from(0), from(3));
    EXPECT_EQ(from(1), from(2));
    EXPECT_EQ(from(7), from(8));
    for (const Eigen::Index i : {4, 5, 6}) EXPECT_EQ(from(i), 9);
    at_the_first.insert(from(0));
  }
  EXPECT_EQ(at_the_first, (std::set<int>{4, 5, 7}));
}

}  // namespace
}  // namespace soilbin::compare
