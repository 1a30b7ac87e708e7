// Means and their errors: against series whose statistics are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "dem/rig/wheel_result.hpp"
#include "scenario/mean_value.hpp"

namespace soilbin::dem {
namespace {

/// x_k = a x_(k-1) + noise of deviation 1: variance 1/(1 - a^2), autocorrelation time (1 + a)/(1 - a).
std::vector<double> autoregressive(double a, std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise;
  std::vector<double> series(count);
  double x = noise(random) / std::sqrt(1 - a * a);
  for (double& value : series) value = x, x = a * x + noise(random);
  return series;
}

TEST(AutocorrelationTime, OfAnAutoregressiveSeries) {
  for (const double a : {0.0, 0.5, 0.9}) {
    const double expected = (1 + a) / (1 - a);
    EXPECT_NEAR(autocorrelation_time(autoregressive(a, 100000, 1)), expected, 0.1 * expected) << a;
  }
}

TEST(MeanWithError, CoversTheTrueMeanAsOftenAsItShould) {
  int within = 0;
  double error = 0;
  constexpr int runs = 200;
  constexpr std::size_t count = 2000;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const Estimate mean = mean_with_error(autoregressive(0.9, count, seed));
    within += std::abs(mean.value) < mean.std_error ? 1 : 0;
    error += mean.std_error / runs;
  }
  // 1/(1 - a) deviations of noise over sqrt(n); blocks of four autocorrelation times see a little less.
  EXPECT_NEAR(error, 10 / std::sqrt(count), 0.15 * 10 / std::sqrt(count));
  EXPECT_NEAR(within, 0.68 * runs, 25);
}

// A run of 10 or 5 autocorrelation times holds no eight blocks of four. The error of eight shorter ones was 0.8 and 0.6
// of the means' scatter.
TEST(MeanWithError, OfFewAutocorrelationTimesIsNotTooSmall) {
  constexpr int runs = 400;
  for (const std::size_t count : {200, 100}) {
    double means = 0, errors = 0;
    for (unsigned seed = 0; seed < runs; ++seed) {
      const Estimate mean = mean_with_error(autoregressive(0.905, count, seed));  // tau = 20
      means += mean.value * mean.value / runs, errors += mean.std_error * mean.std_error / runs;
    }
    EXPECT_NEAR(std::sqrt(errors / means), 1, 0.2) << count;
  }
}

TEST(MeanWithError, OfFewSamples) {
  EXPECT_EQ(mean_with_error({}).value, 0);
  EXPECT_EQ(mean_with_error(std::vector<double>{3}).value, 3);
  EXPECT_EQ(mean_with_error(std::vector<double>{3}).std_error, 0);
  // Two samples: the deviation |a - b|/sqrt(2) over sqrt(2).
  EXPECT_DOUBLE_EQ(mean_with_error(std::vector<double>{1, 3}).std_error, 1);
  EXPECT_EQ(mean_with_error(std::vector<double>(100, 7.0)).std_error, 0);
}

TEST(EndOfStartUp, FindsWhereADecayHasDrownedInNoise) {
  std::vector<double> series = autoregressive(0.0, 400, 3);
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += 50 * std::exp(-static_cast<double>(k) / 20);
  const std::size_t end = end_of_start_up(series);
  // 50 exp(-k/20) is 1, the noise, at k = 78; 0.1 at k = 124.
  EXPECT_GE(end, 55u);
  EXPECT_LE(end, 150u);
}

TEST(EndOfStartUp, KeepsASeriesThatIsSteady) { EXPECT_LE(end_of_start_up(autoregressive(0.0, 400, 5)), 100u); }

TEST(DriftOverError, TellsATrendFromNoise) {
  std::vector<double> series = autoregressive(0.5, 1000, 7);
  EXPECT_LT(drift_over_error(series), 3);
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += 0.004 * static_cast<double>(k);
  EXPECT_GT(drift_over_error(series), 5);
}

TEST(TrendOverError, AndThatOfTheLastFifthTellWhatHalvesDoNot) {
  // A rover's wheel that digs itself in by and by: means of the pull by fifths [N], and noise of 6 N.
  const double fifths[] = {-9, -16, -15, -19, -37};
  std::vector<double> series = autoregressive(0.7, 200, 11);
  const double size = std::sqrt(1 - 0.7 * 0.7);  // of noise that has a deviation of 1
  for (std::size_t k = 0; k < series.size(); ++k) series[k] = 6 * size * series[k] + fifths[k / 40];
  EXPECT_GT(trend_over_error(series), 3);
  EXPECT_GT(last_fifth_over_error(series), 3);
  EXPECT_GT(steady_part({series}).drift, 3);
  // A change in the last fifth alone.
  series = autoregressive(0.5, 400, 7);
  for (std::size_t k = 320; k < 400; ++k) series[k] += 3;
  EXPECT_GT(last_fifth_over_error(series), 5);
}

TEST(TrendOverError, IsRarelyLargeWithoutOne) {
  int trends = 0, fifths = 0;
  constexpr int series = 200;
  for (int k = 0; k < series; ++k) {
    const std::vector<double> noise = autoregressive(0.6, 400, 100 + k);  // 100 times of correlation
    trends += trend_over_error(noise) > 3, fifths += last_fifth_over_error(noise) > 3;
  }
  EXPECT_LE(trends, 0.03 * series);
  EXPECT_LE(fifths, 0.03 * series);
  const std::vector<double> even(64, 0.1);
  EXPECT_EQ(trend_over_error(even) + last_fifth_over_error(even), 0);
}

/// A run in which every sample is alike: the soil pushes with `force`, the axle's torque is 40 N m.
WheelRun even_run(const OperatingCondition& at, const Tire& tire, const Vec3& force) {
  const WheelMotion motion = wheel_motion(at, tire.radius);
  WheelRun run;
  for (int k = 0; k < 64; ++k) {
    WheelSample sample;
    sample.time = 0.01 * k;
    sample.force = force, sample.moment = -40.0 * motion.axle;
    sample.speed = motion.speed, sample.rotation = motion.rotation;
    run.samples.push_back(sample);
  }
  summarise(run, tire, at, {});
  return run;
}

TEST(WheelResult, EfficiencyIsOfTheWheelAndBalancesItsPowersInEitherFrame) {
  Tire tire;
  tire.radius = 0.25;
  for (const double incline : {-0.2, 0.0, 0.2}) {
    OperatingCondition at;
    at.load = 400, at.slip = 0.3, at.speed = 0.2, at.yaw = 0.5, at.longitudinal_incline = incline;
    at.transverse_incline = 0.3;
    const WheelRun travel = even_run(at, tire, {90, -60, 380});
    at.force_frame = ForceFrame::wheel;
    const WheelRun wheel = even_run(at, tire, {90, -60, 380});
    EXPECT_GT(std::abs(wheel.result.drawbar_pull.value - travel.result.drawbar_pull.value), 1.0);
    EXPECT_NEAR(wheel.result.tractive_efficiency, travel.result.tractive_efficiency, 1e-12);
    // climb [W] is what lifting the load takes; downhill it is gravity's, with the sign turned.
    const PowerBalance& power = travel.power;
    EXPECT_NEAR(travel.result.tractive_efficiency, power.pull / (power.drive + std::max(0.0, -power.climb)), 1e-12);
  }
}

}  // namespace
}  // namespace soilbin::dem
