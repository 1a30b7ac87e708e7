// The evidence for a set of effects whose equations nature need not share.
#include "compare/loop/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/loop/loop.hpp"
#include "compare/loop_fixture.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd normal_matrix(Index rows, Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// Cells off by `residual`, with soil values under unit priors whose columns are `soil`.
LinearProblem problem_with(const VectorXd& residual, const MatrixXd& soil) {
  LinearProblem problem;
  problem.cells = residual.size();
  problem.residual = VectorXd::Zero(residual.size() + soil.cols());
  problem.residual.head(residual.size()) = residual;
  problem.nuisance = MatrixXd(residual.size() + soil.cols(), soil.cols());
  problem.nuisance << soil, MatrixXd::Identity(soil.cols(), soil.cols());
  return problem;
}

/// ln N(r; 0, C) without the constant that all densities of r share.
double log_density(const VectorXd& r, const MatrixXd& covariance) {
  const Eigen::LLT<MatrixXd> factor(covariance);
  return -0.5 * r.dot(factor.solve(r)) - factor.matrixLLT().diagonal().array().log().sum();
}

// With soil and tolerances normal, the evidence is the mean of normal densities over every choice of a scale for each
// term; another term costs its range of amplitudes, twelve standard deviations.
TEST(Evidence, IsTheMeanOverTheTolerancesOfTheJointDensity) {
  const VectorXd r = 2 * normal_matrix(12, 1, 1);
  const MatrixXd soil = normal_matrix(12, 3, 2), first = 0.5 * normal_matrix(12, 2, 3),
                 second = normal_matrix(12, 4, 4);
  const MatrixXd bare = MatrixXd::Identity(12, 12) + soil * soil.transpose();
  double mean = 0.0;
  for (const double a : tolerance_scales)
    for (const double b : narrow_tolerance_scales)
      mean += std::exp(log_density(r, bare + a * a * first * first.transpose() + b * b * second * second.transpose()));
  mean /= static_cast<double>(tolerance_scales.size() * narrow_tolerance_scales.size());
  EXPECT_NEAR(log_evidence(problem_with(r, soil), {{first, tolerance_scales}, {second, narrow_tolerance_scales}}),
              std::log(mean) - 2 * std::log(12.0), 1e-9);
  EXPECT_NEAR(log_evidence(problem_with(r, soil), {}), log_density(r, bare), 1e-9);
}

// An amplitude has no prior of its own: what its column explains is taken off, whatever the column's unit.
TEST(Evidence, OfAnAmplitudeDoesNotHangOnItsUnit) {
  const VectorXd r = 2 * normal_matrix(12, 1, 5);
  LinearProblem problem = problem_with(r, normal_matrix(12, 3, 6));
  problem.nuisance.bottomRows(3).col(0).setZero();
  problem.amplitudes = {0};
  const MatrixXd tolerance = normal_matrix(12, 2, 7);
  const double in_metres = log_evidence(problem, {{tolerance, tolerance_scales}});
  problem.nuisance.col(0) *= 1e3;
  EXPECT_NEAR(log_evidence(problem, {{tolerance, tolerance_scales}}), in_metres, 1e-7);
}

// Nature's wheel digs by the catalogue's equation times 0.7 .. 1.3, the more the heavier it is: no second effect.
TEST(SlowEvidence, AFormThatIsAThirdOffIsStillOneEffect) {
  Campaign campaign = sand_campaign(), bare = sand_campaign();
  const std::vector<EffectChoice> digging = {{"slip_sinkage", "linear", {{"S", 0.6}}}};
  measure(campaign, sweep(), digging, fine_noise, 47);
  measure(bare, sweep(), {}, fine_noise, 47);
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    compare::Run& run = campaign.runs[i];
    const double share = 0.3 * (run.at.load - 1050) / 450;
    *run.drawbar_pull += share * (*run.drawbar_pull - *bare.runs[i].drawbar_pull);
    *run.torque += share * (*run.torque - *bare.runs[i].torque);
    *run.sinkage += share * (*run.sinkage - *bare.runs[i].sinkage);
  }
  LoopOptions options;
  options.identify.simulations = 1000;
  options.validate = false;
  const LoopAnswer answer = run_loop(campaign, options);
  ASSERT_TRUE(answer.details.best);
  EXPECT_EQ(answer.details.weights.front().ids, std::set<std::string>{"slip_sinkage"}) << answer.reason;
}

}  // namespace
}  // namespace soilbin::compare
