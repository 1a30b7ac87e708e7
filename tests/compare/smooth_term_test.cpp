// The smooth term, on residuals that are smooth and on residuals that are not.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/fit/condition_functions.hpp"
#include "compare/loop_fixture.hpp"

namespace soilbin::compare {
namespace {

constexpr double sd = 2.0;

/// One channel whose residual is bend*load^2 (load in kN) plus noise; the last third of the rows left out.
double error_left(double bend, double& before) {
  Observations observations;
  NoiseFloor noise;
  noise.channels[torque] = {.measured = true, .floor = sd};
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const OperatingCondition& at : sweep()) {
    const int row = static_cast<int>(observations.rows.size());
    observations.rows.push_back(at);
    observations.condition.push_back(row);
    observations.cells.push_back({row, torque, bend * at.load * at.load * 1e-6 + sd * normal(random)});
  }
  std::vector<bool> kept(observations.rows.size());
  for (std::size_t r = 0; r < kept.size(); ++r) kept[r] = r % 3 != 2;
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.cells.size()));
  const Eigen::VectorXd term = smooth_term(observations, kept, nothing, noise);
  double after = 0.0;
  before = 0.0;
  for (std::size_t r = 0; r < kept.size(); ++r) {
    if (kept[r]) continue;
    const double value = observations.cells[r].value;
    before += value * value;
    after += std::pow(value - term[static_cast<Eigen::Index>(r)], 2);
  }
  return after;
}

TEST(SmoothTerm, LearnsASmoothResidual) {
  double before = 0.0;
  const double after = error_left(20.0, before);
  EXPECT_LT(after, 0.1 * before);
}

TEST(SmoothTerm, LeavesNoiseAlone) {
  double before = 0.0;
  const double after = error_left(0.0, before);
  EXPECT_NEAR(after / before, 1.0, 0.3);
}

}  // namespace
}  // namespace soilbin::compare
