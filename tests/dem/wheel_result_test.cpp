// From samples to the answer: runs whose every sample is written by hand.
#include "dem/rig/wheel_result.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenario/unit.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

OperatingCondition yawed() {
  OperatingCondition at;
  at.load = 100, at.slip = 0.2, at.speed = 0.5, at.yaw = 30 * degree, at.longitudinal_incline = 5 * degree;
  return at;
}

/// Over its steps the soil pushes with (40, 10, 0) N; at the samples' ends by turns with 5 N more and 5 N less, and
/// with `shift` more in all of them, along the wheel's heading.
WheelRun made_run(const OperatingCondition& at, std::size_t samples, double shift = 0) {
  const WheelMotion motion = wheel_motion(at, test::small_wheel().radius);
  const Vec3 mean{40, 10, 0};
  WheelRun run;
  for (std::size_t k = 0; k < samples; ++k) {
    WheelSample sample;
    sample.time = 0.01 * static_cast<double>(k), sample.speed = at.speed, sample.rotation = motion.rotation;
    sample.force = mean, sample.moment = -3 * motion.axle, sample.sinkage = 0.01;
    sample.tread.resistance = -20;
    sample.tread.thrust = dot(mean, motion.heading) + 20 + (k % 2 == 0 ? 5 : -5) + shift;
    sample.tread.side = dot(mean, motion.axle);
    run.samples.push_back(sample);
  }
  summarise(run, test::small_wheel(), at, Rig{});
  return run;
}

double sum_of_parts(const TractionResult& result) {
  double sum = 0;
  for (const Contribution& part : result.budget) sum += part.force;
  return sum;
}

// In forty samples the ends' 5 N more and 5 N less cancel.
TEST(WheelResult, PartsAndPullDifferByWhatSamplingMisses) {
  for (const ForceFrame frame : {ForceFrame::travel, ForceFrame::wheel}) {
    OperatingCondition at = yawed();
    at.force_frame = frame;
    const TractionResult result = made_run(at, 40).result;
    const double slope = -100 * std::sin(5 * degree);
    const double pull =
        frame == ForceFrame::travel ? 40 + slope : (40 + slope) * std::cos(30 * degree) + 10 * std::sin(30 * degree);
    EXPECT_NEAR(result.drawbar_pull.value, pull, 1e-12);
    EXPECT_NEAR(sum_of_parts(result), pull, 1e-12);
    EXPECT_NEAR(result.budget_rest.force, 0, 1e-12);
  }
}

TEST(WheelResult, TheBoundIsFourErrorsOfTheDifference) {
  // Five samples: ends of 5, -5, 5, -5, 5 N about 1 N; deviation sqrt(30), error sqrt(30/5).
  OperatingCondition at = yawed();
  at.force_frame = ForceFrame::wheel;
  const BudgetRest rest = made_run(at, 5).result.budget_rest;
  EXPECT_NEAR(rest.force, -1, 1e-12);
  EXPECT_NEAR(rest.bound, 4 * std::sqrt(30.0 / 5), 1e-12);
}

// A force that is missing in every sample's parts is no scatter: the bound stays and the rest passes it.
TEST(WheelResult, AForceThatNoPartNamesPassesTheBound) {
  OperatingCondition at = yawed();
  at.force_frame = ForceFrame::wheel;
  const BudgetRest rest = made_run(at, 5, -30).result.budget_rest;
  EXPECT_NEAR(rest.force, 29, 1e-12);
  EXPECT_NEAR(rest.bound, 4 * std::sqrt(30.0 / 5), 1e-12);
}

TEST(WheelResult, OneSampleHasNoBound) { EXPECT_TRUE(std::isnan(made_run(yawed(), 1).result.budget_rest.bound)); }

}  // namespace
}  // namespace soilbin::dem
