#include "compare/fit/fitted_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/fit/evidence.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Added to the Gram matrix of a fit's columns (each in units of its scale), for a column that the data do not see at
// all. A forecast is the bolder of the two: there such a parameter may move what the fit has never seen.
constexpr double ridge_of_errors = 1e-12, ridge_of_forecasts = 1e-9;

}  // namespace

FittedModel::FittedModel(std::shared_ptr<const Dataset> data, WheelPredictor predictor, Fit fit)
    : data_(std::move(data)), predictor_(std::move(predictor)), fit_(std::move(fit)) {}

Ldlt FittedModel::information(double ridge) const { return Ldlt(gram_matrix(fit_.columns, ridge)); }

MatrixXd FittedModel::covariance() const {
  const Index free = fit_.columns.cols();
  return information(ridge_of_errors).solve(MatrixXd(MatrixXd::Identity(free, free)));
}

VectorXd FittedModel::standard_errors() const {
  VectorXd errors = VectorXd::Zero(fit_.theta.size());
  const MatrixXd covariance = this->covariance();
  for (Index i = 0; i < covariance.cols(); ++i) {
    const int p = fit_.column_parameter[i];
    errors[p] = std::sqrt(std::max(0.0, covariance(i, i))) * predictor_.parameters()[p].scale;
  }
  return errors;
}

double FittedModel::held_error(Index parameter) const {
  VectorXd column = VectorXd::Zero(fit_.columns.rows());
  column.head(fit_.jacobian.rows()) = data_->whitening(VectorXd(fit_.jacobian.col(parameter)));
  const double prior_sd = predictor_.parameters()[parameter].prior_sd;
  const double known = Projector(fit_.columns).vector(column).squaredNorm() + 1 / (prior_sd * prior_sd);
  return known > 0 ? 1 / std::sqrt(known) : std::numeric_limits<double>::infinity();
}

VectorXd FittedModel::errors_held_or_free() const {
  VectorXd errors = standard_errors();
  for (Index i = 0; i < errors.size(); ++i)
    if (errors[i] == 0.0) errors[i] = held_error(i);
  return errors;
}

double FittedModel::absorbed_freedom() const {
  const MatrixXd seen = fit_.columns.topRows(data_->cells());
  return information(ridge_of_errors).solve(MatrixXd(seen.transpose() * seen)).trace();
}

VectorXd FittedModel::contribution(int term) const {
  VectorXd theta = fit_.theta, without;
  theta[predictor_.amplitude_index(term)] = 0.0;
  BalanceMemory memory = fit_.balance;
  if (!predictor_.predict(theta, without, memory)) return VectorXd::Zero(fit_.prediction.size());
  return fit_.prediction - without;
}

SemiEmpiricalSoil FittedModel::soil() const {
  SemiEmpiricalSoil soil = data_->campaign->soil;
  const VectorXd errors = errors_held_or_free();
  for (int i = 0; i < predictor_.soil_parameters(); ++i)
    if (const std::string& name = predictor_.parameters()[i].name; name != carcass_pressure_key)
      soil.*soil_parameter(name).value = {fit_.theta[i], errors[i]};
  const double follows = modulus_factor(soil, data_->campaign->soil.exponent.value, soil.exponent.value);
  for (Estimate* modulus : {&soil.k_c, &soil.k_phi}) modulus->value *= follows, modulus->std_error *= follows;
  return soil;
}

Tire FittedModel::wheel() const {
  Tire wheel = predictor_.wheel(fit_.theta);
  const VectorXd errors = errors_held_or_free();
  for (int i = 0; i < predictor_.soil_parameters(); ++i)
    if (predictor_.parameters()[i].name == carcass_pressure_key) wheel.carcass_pressure->std_error = errors[i];
  return wheel;
}

std::vector<FittedError> FittedModel::errors() const {
  const MatrixXd covariance = this->covariance();
  const VectorXd sd = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const std::vector<EffectChoice> effects = predictor_.choices(fit_.theta);
  std::vector<FittedError> errors;
  for (Index i = 0; i < covariance.cols(); ++i) {
    const int p = fit_.column_parameter[i];
    FittedError error;
    error.parameter = predictor_.name_among(effects, p);
    if (p >= predictor_.soil_parameters()) error.std_error = sd[i] * predictor_.parameters()[p].scale;
    for (Index k = 0; k < i; ++k)
      error.correlations.push_back(sd[i] > 0 && sd[k] > 0 ? covariance(i, k) / (sd[i] * sd[k]) : 0.0);
    errors.push_back(std::move(error));
  }
  return errors;
}

std::optional<Forecast> FittedModel::forecast(const Observations& runs, BalanceMemory memory) const {
  const WheelPredictor predictor = predictor_.over(runs);
  Forecast forecast;
  if (!predictor.predict(fit_.theta, forecast.prediction, memory)) return std::nullopt;
  const auto slopes = predictor.linearise(fit_.theta, memory);
  if (!slopes) return std::nullopt;
  forecast.slopes.resize(slopes->jacobian.rows(), fit_.columns.cols());
  for (Index c = 0; c < forecast.slopes.cols(); ++c) {
    const int p = fit_.column_parameter[c];
    forecast.slopes.col(c) = slopes->jacobian.col(p) * predictor_.parameters()[p].scale;
  }
  forecast.solved = information(ridge_of_forecasts).solve(MatrixXd(forecast.slopes.transpose()));
  return forecast;
}

std::optional<FittedModel> fitted(const std::shared_ptr<const Dataset>& data, const WheelPredictor& predictor,
                                  const VectorXd& start, BalanceMemory near) {
  auto found = fit(predictor, data->observations.values(), data->whitening, start, std::move(near));
  if (!found) return std::nullopt;
  return FittedModel(data, predictor, std::move(*found));
}

}  // namespace soilbin::compare
