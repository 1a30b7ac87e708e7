// The joint test of a comparison.
#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "bekker_wong/gsl.hpp"
#include "compare/discrepancy/comparison.hpp"
#include "compare/fit/factorizations.hpp"
#include "compare/fit/wheel_predictor.hpp"
#include "scenario/errors.hpp"
#include "scenario/fitted_errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// What the cells of the reference's campaign rest on.
struct Estimated {
  VectorXd errors;        ///< of each cell; a value that is not above zero where none is stated
  double channels = 0.0;  ///< whose correlation is estimated with them; 1 where each stands by itself
  double freedom = std::numeric_limits<double>::infinity();  ///< the fewest behind any of their errors
};

Estimated estimated_of(const Observations& observations, const Side& reference) {
  std::vector<const SidePoint*> solved;  // in the order of as_campaign's runs
  for (const SidePoint& point : reference.points)
    if (point.result) solved.push_back(&point);
  Estimated all{.errors = VectorXd(static_cast<Index>(observations.cells.size()))};
  std::set<int> channels;
  for (std::size_t k = 0; k < observations.cells.size(); ++k) {
    const Cell& cell = observations.cells[k];
    const SidePoint& point = *solved[static_cast<std::size_t>(observations.source_row[cell.row])];
    all.errors[static_cast<Index>(k)] = ((*point.result).*channel_views[cell.channel].predicted).std_error;
    all.freedom = std::min(all.freedom, point.freedom[cell.channel]);
    channels.insert(cell.channel);
  }
  all.channels = reference.noise ? static_cast<double>(channels.size()) : 1.0;
  return all;
}

/// Turns columns over the cells into units of the reference's errors, so that newtons and metres meet as equals, and
/// takes the correlation between a measured run's channels out.
class InErrors {
 public:
  InErrors(const Observations& observations, const Side& reference, const VectorXd& errors)
      : errors_(errors), correlation_(observations, of_size_one(reference), VectorXd::Zero(errors.size())) {}
  MatrixXd operator()(const MatrixXd& columns) const {
    return correlation_(MatrixXd(errors_.cwiseInverse().asDiagonal() * columns));
  }

 private:
  static NoiseFloor of_size_one(const Side& reference) {
    NoiseFloor noise;
    for (ChannelNoise& channel : noise.channels) channel.floor = 1.0;
    if (reference.noise) noise.correlation = reference.noise->correlation;
    return noise;
  }

  VectorXd errors_;
  Whitening correlation_;
};

/// R^(1/2) of the parameters' correlation matrix R.
MatrixXd root_of_correlation(const std::vector<std::string>& parameters, const std::vector<FittedError>& errors) {
  const Index n = std::ssize(parameters);
  MatrixXd together = MatrixXd::Identity(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < i; ++k) together(i, k) = together(k, i) = correlation(errors, parameters[i], parameters[k]);
  return Ldlt(together).square_root();
}

std::string why_not_tested(const Estimated& estimated) {
  if (estimated.errors.size() == 0) return "no value to test";
  if (!(estimated.errors.minCoeff() > 0.0)) return "a value has no standard error";
  const double needed = estimated.channels > 1 ? estimated.channels + 4 : 1;
  if (estimated.freedom < needed)
    return fmt::format("{:.0f} runs beyond the first of a condition; {:.0f} are needed for {:.0f} channels",
                       estimated.freedom, needed, estimated.channels);
  return "";
}

}  // namespace

double trace_tail(double trace, double values, double channels, double freedom) {
  if (channels == 1) return gsl::f_tail(trace / values, values, freedom);
  const double m = values / channels, rest = freedom - channels;
  const double b = (rest + m - 1) * (freedom - 1) / ((rest - 3) * rest);
  const double denominator = 4 + (values + 2) / (b - 1);
  const double size = values * (denominator - 2) / (denominator * (rest - 1));
  return gsl::f_tail(trace / (freedom * size), values, denominator);
}

JointOutcome joint_test(const Side& reference, const Case& question, const ModelChoice& model) {
  if (!question.scenario.soil.semi_empirical) return {std::nullopt, "the soil has no semi_empirical values"};
  const Campaign campaign = means_of(reference, question, model.effects);
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  const Estimated estimated = estimated_of(observations, reference);
  if (reference.kind == SideKind::grains && !reference.scatter_known && std::isinf(estimated.freedom))
    return {std::nullopt, "the scatter between bed samples is unknown: run two or more at some conditions"};
  if (std::string why = why_not_tested(estimated); !why.empty()) return {std::nullopt, why};
  VectorXd predicted;
  BalanceMemory balanced;
  const bool balances = predictor.predict(predictor.start(), predicted, balanced);
  const auto slopes = balances ? predictor.linearise(predictor.start(), balanced) : std::nullopt;
  if (!slopes) return {std::nullopt, "the model has no balance at some condition"};
  JointTest test;
  VectorXd sd(predictor.soil_parameters());
  for (int i = 0; i < predictor.soil_parameters(); ++i) {
    const FreeParameter& parameter = predictor.parameters()[i];
    sd[i] = parameter.prior_sd;
    test.soil.push_back(parameter.name);
  }
  const InErrors in_errors(observations, reference, estimated.errors);
  const VectorXd white = in_errors(predicted - observations.values());
  const MatrixXd columns = in_errors(slopes->jacobian.leftCols(predictor.soil_parameters()) * sd.asDiagonal() *
                                     root_of_correlation(test.soil, model.errors));
  // d' (1 + A A')^-1 d = d' d - (A' d)' (1 + A' A)^-1 (A' d): Woodbury's identity.
  const VectorXd along = columns.transpose() * white;
  MatrixXd inner = columns.transpose() * columns;
  inner.diagonal().array() += 1.0;
  test.values = static_cast<std::size_t>(white.size());
  test.chi2_soil_exact = white.squaredNorm();
  test.chi2 = test.chi2_soil_exact - along.dot(Ldlt(inner).solve(along));
  test.freedom = estimated.freedom;
  const auto values = static_cast<double>(test.values);
  test.p_errors_known = gsl::chi_square_tail(test.chi2, values);
  test.p_value =
      std::isinf(test.freedom) ? test.p_errors_known : trace_tail(test.chi2, values, estimated.channels, test.freedom);
  return {test, ""};
}

}  // namespace soilbin::compare
