// A campaign ready for fits, and a model fitted to it: predictor, terms, fit and covariance as one value.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "compare/fit/bounded_fit.hpp"
#include "compare/fit/factorizations.hpp"

namespace soilbin::compare {

/// What the means of pooled runs do not show of all of them.
struct WithinPools {
  double cells = 0.0, chi2 = 0.0;
};

/// What every model of a campaign is fitted to. Made by the base fit and never changed after; the models that compete
/// share one, so that their chi2 can be compared.
struct Dataset {
  std::shared_ptr<const Campaign> campaign;
  Observations observations;  ///< without the outliers
  std::vector<bool> outlier;  ///< of the cells given: set aside
  NoiseFloor noise;
  Whitening whitening;         ///< takes that noise off, at the base model's predictions
  WithinPools within_pools{};  ///< where the observations are pooled runs
  /// The declared model over these observations, where every fit begins; the data set must outlive it.
  WheelPredictor declared_model() const { return {*campaign, observations}; }
  int outliers() const { return static_cast<int>(std::ranges::count(outlier, true)); }
  Eigen::Index cells() const { return static_cast<Eigen::Index>(observations.cells.size()); }
};

/// What a model predicts for runs that it was not fitted to, and how well it knows that: var(f) = J C J', with J the
/// slopes over the free parameters and C their covariance.
struct Forecast {
  Eigen::VectorXd prediction;
  Eigen::MatrixXd slopes;  ///< J, in units of the parameters' scale
  Eigen::MatrixXd solved;  ///< C J'
  double variance(Eigen::Index cell) const { return slopes.row(cell).dot(solved.col(cell)); }
  Eigen::MatrixXd covariance() const { return slopes * solved; }
};

/// The wheel with some effects (terms), fitted to a data set. A value: cheap to copy beside a fit, never changed.
///
///     const FittedModel base = fit_base(campaign, observe(campaign), {});
///     const Eigen::VectorXd sd = base.standard_errors();             // of the soil's free values [SI]
///     const auto wider = fitted(base.shared_data(), base.predictor().with({term}), start);
///     const double gained = base.fit().chi2 - wider->fit().chi2;
class FittedModel {
 public:
  FittedModel(std::shared_ptr<const Dataset> data, WheelPredictor predictor, Fit fit);

  const Dataset& data() const { return *data_; }
  const std::shared_ptr<const Dataset>& shared_data() const { return data_; }
  const WheelPredictor& predictor() const { return predictor_; }
  const std::vector<Term>& terms() const { return predictor_.terms(); }
  const Fit& fit() const { return fit_; }
  /// The whitened residual of the cells, without the rows of the priors.
  Eigen::VectorXd cell_residual() const { return fit_.residual.head(data_->cells()); }

  /// 1 sd of each parameter [SI], from the inverse of the columns' Gram matrix; 0 for those held by a bound.
  Eigen::VectorXd standard_errors() const;
  /// 1 sd that a parameter held by a bound would have if it could move, the others free as they are [SI].
  double held_error(Eigen::Index parameter) const;
  /// standard_errors(), with held_error() of each parameter that its bound holds: no exact value.
  Eigen::VectorXd errors_held_or_free() const;
  /// Degrees of freedom of the cells that the parameters take, as far as their priors let them.
  double absorbed_freedom() const;
  /// What a term adds to each cell, the other parameters as fitted; zeros where the soil carries nothing without it.
  Eigen::VectorXd contribution(int term) const;
  /// The campaign's soil with the fitted values and their standard errors.
  SemiEmpiricalSoil soil() const;
  /// The campaign's wheel, with the fitted carcass pressure and its standard error where that is free.
  Tire wheel() const;
  /// The parameters that no bound holds, and how they err together; effects named as among the campaign's and the
  /// terms', in this order.
  std::vector<FittedError> errors() const;

  /// Predictions of other runs; nothing where one has no balance (memory.gives_way: is carried by less than a fifth).
  std::optional<Forecast> forecast(const Observations& runs, BalanceMemory memory = {}) const;

 private:
  /// C^-1 of the free parameters in units of their scale: G'G + ridge.
  Ldlt information(double ridge) const;
  Eigen::MatrixXd covariance() const;  ///< C, in units of the parameters' scale

  std::shared_ptr<const Dataset> data_;
  WheelPredictor predictor_;
  Fit fit_;
};

/// The least chi2 near `start` (bounded_fit.hpp); nothing where no soil near it carries the wheel in every run.
std::optional<FittedModel> fitted(const std::shared_ptr<const Dataset>& data, const WheelPredictor& predictor,
                                  const Eigen::VectorXd& start, BalanceMemory near = {});

// Large campaigns: runs that lie near each other taken as one, so that the search for candidates costs the same on two
// thousand runs as on two hundred.

/// Deals rows to groups of rows that lie near each other, at most so many, of one pass each. Groups are halved at the
/// mean of the variable in which they scatter most, in sd of the campaign, the widest group first. Deterministic.
std::vector<std::vector<int>> near_rows(const Observations& observations, int most_groups);

/// The base model beside runs pooled to at most `most_rows`; nothing where no soil carries the wheel at their means.
///
/// A group stands at the mean of its conditions, and its value in a channel is what the base model predicts there plus
/// the mean residual of its k cells, with noise of sd/sqrt(k). So to first order in the spread of a group's conditions
/// chi2 between two models differs as it does on all runs; what the means hide is kept beside (Dataset::within_pools).
/// What is fitted so is where a fit of all runs starts, never an answer.
///
///     const auto small = pooled(base, thresholds::max_searched_rows);
///     small->data().observations.rows.size();   // that or less, of any number
std::optional<FittedModel> pooled(const FittedModel& base, int most_rows);

}  // namespace soilbin::compare
