// Bounded Levenberg-Marquardt with normal priors (Levenberg 1944, Marquardt 1963; bounds by an active set).
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "compare/loop/noise_floor.hpp"
#include "compare/loop/wheel_predictor.hpp"

namespace soilbin::compare {

/// The end of a fit. "Augmented" rows: the whitened cells, then one row a parameter with a prior.
struct Fit {
  Eigen::VectorXd theta;
  Eigen::VectorXd prediction;         ///< of the cells
  Eigen::MatrixXd jacobian;           ///< cells x parameters, unwhitened
  Eigen::VectorXd residual;           ///< augmented
  Eigen::MatrixXd columns;            ///< augmented Jacobian of the parameters that are not held by a bound,
                                      ///< in units of their scale
  std::vector<int> column_parameter;  ///< which parameter each column belongs to
  double chi2 = 0.0;                  ///< |residual|^2: cells and priors
  double chi2_cells = 0.0;
};

/// The least chi2 from `start`, or nothing where no feasible point is found.
std::optional<Fit> fit(const WheelPredictor& predictor, const Eigen::VectorXd& values, const Whitening& whitening,
                       Eigen::VectorXd start);

/// A start at which every row has a balance: the given one, or one with k_phi raised step by step. Nothing where no
/// stiffness up to a hundredfold suffices.
std::optional<Eigen::VectorXd> feasible_start(const WheelPredictor& predictor, Eigen::VectorXd start);

/// 1 sd of each parameter from the inverse of the columns' Gram matrix; 0 for those held by a bound.
Eigen::VectorXd standard_errors(const Fit& fit, const WheelPredictor& predictor);

/// 1 sd that a parameter held by a bound would have if it could move, the others free as they are.
double held_error(const Fit& fit, const WheelPredictor& predictor, const Whitening& whitening, Eigen::Index parameter);

}  // namespace soilbin::compare
