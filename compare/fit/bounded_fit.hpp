// The fit of a model to a campaign: least chi2 inside the parameters' bounds, with normal priors.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "compare/fit/noise_floor.hpp"
#include "compare/fit/wheel_predictor.hpp"

namespace soilbin::compare {

/// The end of a fit. "Augmented" rows: the whitened cells, then one row a parameter with a prior.
struct Fit {
  Eigen::VectorXd theta;
  Eigen::VectorXd restart;            ///< where the way down ended, before the soil was made firm enough for every
                                      ///< condition: a start for the next fit, away from the bounds
  Eigen::VectorXd prediction;         ///< of the cells
  Eigen::MatrixXd jacobian;           ///< cells x parameters, unwhitened
  Eigen::VectorXd residual;           ///< augmented
  Eigen::MatrixXd columns;            ///< augmented Jacobian of the parameters that are not held by a bound, in
                                      ///< units of their scale; the wall of theta_m's law holds none
  std::vector<int> column_parameter;  ///< which parameter each column belongs to
  double chi2 = 0.0;                  ///< |residual|^2: cells and priors
  double chi2_cells = 0.0;
  BalanceMemory balance;  ///< at theta, to look from nearby; the soil may give way there
};

/// The least chi2 near `start` with a soil that carries the wheel in every condition; nothing where none is found. The
/// way there may cross soils that do not (Descent); where it ends at one, the soil is made firmer (k_phi, or where that
/// is known what costs chi2 least) until all is carried. near: what is known of the balances at the start.
std::optional<Fit> fit(const WheelPredictor& predictor, const Eigen::VectorXd& values, const Whitening& whitening,
                       const Eigen::VectorXd& start, BalanceMemory near = {});

}  // namespace soilbin::compare
