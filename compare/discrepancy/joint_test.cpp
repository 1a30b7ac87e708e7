#include "compare/discrepancy/joint_test.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/discrepancy/comparison.hpp"
#include "compare/loop/wheel_predictor.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Standard error of each cell of the reference's campaign; a value that is not above zero where one states none.
VectorXd errors_of(const Observations& observations, const Side& reference) {
  VectorXd errors(static_cast<Index>(observations.cells.size()));
  std::vector<const SidePoint*> solved;  // in the order of as_campaign's runs
  for (const SidePoint& point : reference.points)
    if (point.result) solved.push_back(&point);
  for (std::size_t k = 0; k < observations.cells.size(); ++k) {
    const Cell& cell = observations.cells[k];
    const auto run = static_cast<std::size_t>(observations.source_row[static_cast<std::size_t>(cell.row)]);
    const auto channel = static_cast<std::size_t>(cell.channel);
    errors[static_cast<Index>(k)] = ((*solved[run]->result).*channel_views[channel].predicted).std_error;
  }
  return errors;
}

}  // namespace

std::optional<JointTest> joint_test(const Side& reference, const Case& question,
                                    const std::vector<EffectChoice>& effects) {
  if (!question.scenario.soil.semi_empirical) return std::nullopt;
  const Campaign campaign = as_campaign(reference, question, effects);
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  const VectorXd errors = errors_of(observations, reference);
  if (errors.size() == 0 || !(errors.minCoeff() > 0.0)) return std::nullopt;
  VectorXd predicted;
  MatrixXd jacobian;
  if (!predictor.linearise(predictor.start(), predicted, jacobian)) return std::nullopt;
  // In units of the reference's errors, so that newtons and metres meet as equals.
  const VectorXd white = (predicted - observations.values()).cwiseQuotient(errors);
  VectorXd sd(predictor.soil_parameters());
  JointTest test;
  for (int i = 0; i < predictor.soil_parameters(); ++i) {
    const FreeParameter& parameter = predictor.parameters()[static_cast<std::size_t>(i)];
    sd[i] = parameter.prior_sd;
    test.soil.push_back(parameter.name);
  }
  const MatrixXd columns =
      errors.cwiseInverse().asDiagonal() * jacobian.leftCols(predictor.soil_parameters()) * sd.asDiagonal();
  // d' (1 + A A')^-1 d = d' d - (A' d)' (1 + A' A)^-1 (A' d): Woodbury's identity.
  const VectorXd along = columns.transpose() * white;
  MatrixXd inner = columns.transpose() * columns;
  inner.diagonal().array() += 1.0;
  test.values = static_cast<std::size_t>(white.size());
  test.chi2_soil_exact = white.squaredNorm();
  test.chi2 = test.chi2_soil_exact - along.dot(inner.ldlt().solve(along));
  test.p_value = gsl::chi_square_tail(test.chi2, static_cast<double>(test.values));
  return test;
}

}  // namespace soilbin::compare
