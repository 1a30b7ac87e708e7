// The evidence for a set of effects whose equations nature need not share.
#include "compare/fit/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/attribution/unnamed.hpp"
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
  for (const double a : thresholds::tolerance_scales)
    for (const double b : thresholds::narrow_tolerance_scales)
      mean += std::exp(log_density(r, bare + a * a * first * first.transpose() + b * b * second * second.transpose()));
  mean /= static_cast<double>(thresholds::tolerance_scales.size() * thresholds::narrow_tolerance_scales.size());
  EXPECT_NEAR(log_evidence(problem_with(r, soil),
                           {{first, thresholds::tolerance_scales}, {second, thresholds::narrow_tolerance_scales}}),
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
  const double in_metres = log_evidence(problem, {{tolerance, thresholds::tolerance_scales}});
  problem.nuisance.col(0) *= 1e3;
  EXPECT_NEAR(log_evidence(problem, {{tolerance, thresholds::tolerance_scales}}), in_metres, 1e-7);
}

// A family of functions is the same whatever the units that a channel is told in: what it may be off by is measured in
// that channel's own noise, at the size of its own predictions.
TEST(UnnamedFamilies, DoNotHangOnTheUnitsOfAChannel) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 8);
  const auto shared = std::make_shared<const Campaign>(campaign);
  const Observations observations = observe(campaign);
  NoiseFloor noise;
  for (int c = 0; c < 3; ++c)
    noise.channels[static_cast<std::size_t>(c)] = {
        .measured = true, .floor = fine_noise[static_cast<std::size_t>(c)], .growth = 0.05};
  const auto families = [&](double sinkage_unit) {
    NoiseFloor scaled = noise;
    scaled.channels[sinkage].floor *= sinkage_unit;
    VectorXd prediction = observations.values();
    for (Index i = 0; i < prediction.size(); ++i)
      if (observations.cells[static_cast<std::size_t>(i)].channel == sinkage) prediction[i] *= sinkage_unit;
    std::vector<MatrixXd> all;
    for (const UnnamedKind& kind :
         unnamed_functions({shared, observations, {}, scaled, Whitening(observations, scaled, prediction)}, prediction))
      all.insert(all.end(), kind.families.begin(), kind.families.end());
    return all;
  };
  const std::vector<MatrixXd> in_metres = families(1.0), in_millimetres = families(1000.0);
  ASSERT_EQ(in_metres.size(), in_millimetres.size());
  for (std::size_t f = 0; f < in_metres.size(); ++f)
    EXPECT_LT((in_metres[f] - in_millimetres[f]).norm(), 1e-9 * in_metres[f].norm()) << "family " << f;
}

// What a lagging channel carries over is 2 sd of its noise where it is largest: here every prediction has the same
// size.
TEST(UnnamedFamilies, CarryOverTwoStandardDeviationsAtTheMost) {
  Observations observations;
  VectorXd prediction(12);
  NoiseFloor noise;
  noise.channels[torque] = {.measured = true, .floor = 0.3, .growth = 0.1};
  noise.channels[sinkage] = {.measured = true, .floor = 1e-3, .growth = 0.2};
  for (int row = 0; row < 6; ++row) {
    OperatingCondition at;
    at.slip = 0.1 * row;
    observations.rows.push_back(at), observations.condition.push_back(row), observations.source_row.push_back(row);
    observations.cells.push_back({row, torque, 0.0}), observations.cells.push_back({row, sinkage, 0.0});
    const double sign = row % 2 == 0 ? 1.0 : -1.0;
    prediction[2 * row] = sign * 40.0, prediction[2 * row + 1] = -sign * 5e-3;
  }
  observations.conditions = 6;
  const std::vector<UnnamedKind> kinds =
      unnamed_functions({nullptr, observations, {}, noise, Whitening(observations, noise, prediction)}, prediction);
  const auto carried = std::ranges::find(kinds, Unnamed::run_before, &UnnamedKind::kind);
  ASSERT_NE(carried, kinds.end());
  EXPECT_NEAR(carried->families.front().col(torque).cwiseAbs().maxCoeff(), 2.0, 1e-9);
  EXPECT_NEAR(carried->families.front().col(sinkage).cwiseAbs().maxCoeff(), 2.0, 1e-9);
}

// An encoder that loses slip in proportion to the load: the campaign says 5 % of slip more under the heaviest load than
// there was, and as much less under the lightest. No effect of the catalogue does that, and it is told for what it is.
TEST(UnnamedFamilies, TellAMisreadSlip) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 8);
  const auto evidence = [](const Campaign& c) {
    const FittedModel base = fit_base(c, observe(c), {});
    return unnamed_evidence(problem_of(base), unnamed_kinds(base));
  };
  EXPECT_LT(evidence(campaign).gain, 0.0);
  for (compare::Run& run : campaign.runs) run.at.slip += 0.05 * (run.at.load - 1050.0) / 450.0;
  const UnnamedEvidence misread = evidence(campaign);
  EXPECT_GT(misread.gain, std::log(1000.0));
  EXPECT_EQ(misread.most_likely, Unnamed::misread_condition);
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
  options.attribution.simulations = 1000;
  options.validate = false;
  const LoopAnswer answer = run_loop(campaign, options);
  ASSERT_TRUE(answer.judgement() && answer.found().candidates.best);
  EXPECT_EQ(answer.found().candidates.sets.front().ids, std::set<std::string>{"slip_sinkage"});
}

}  // namespace
}  // namespace soilbin::compare
