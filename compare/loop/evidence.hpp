// A fitted model as a linear-Gaussian problem: projection off what the soil absorbs, signatures, scores, evidence.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "compare/loop/bounded_fit.hpp"

namespace soilbin::compare {

/// One column orthonormal basis of the nuisance columns: P = I - Q Q^T.
class Projector {
 public:
  explicit Projector(const Eigen::MatrixXd& columns);
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& v) const { return v - q_ * (q_.transpose() * v); }
  Eigen::VectorXd vector(const Eigen::VectorXd& v) const { return v - q_ * (q_.transpose() * v); }

 private:
  Eigen::MatrixXd q_;
};

/// Freedom that an accepted effect's form may be wrong: its contribution, channel by channel, times a smooth factor
/// 1 + g with g of this relative size. Enters every later test as columns with a unit normal prior, so that what a
/// wrong form leaves over is not taken for a second effect.
inline constexpr double form_tolerance = 0.25;

/// Columns of form_tolerance * contribution * (1, slip, slip^2, load, the other covariates) by channel, whitened.
/// contribution: of the effect to each cell, unwhitened.
Eigen::MatrixXd form_columns(const Observations& observations, const Whitening& whitening,
                             const Eigen::VectorXd& contribution);

/// A fitted model with the form tolerance of its terms, ready for tests.
struct LinearProblem {
  Eigen::VectorXd residual;   ///< augmented with the priors and with a zero a tolerance column
  Eigen::MatrixXd nuisance;   ///< augmented columns: soil, terms, tolerances
  std::vector<Eigen::Index> amplitudes;  ///< columns of nuisance that are amplitudes of terms
  Eigen::Index cells = 0;     ///< the first rows are whitened cells
  /// A whitened signature over the cells, padded with zeros.
  Eigen::VectorXd padded(const Eigen::VectorXd& signature) const;
};

/// tolerance: whitened columns over the cells (form_columns), with unit prior; may have no column.
LinearProblem linear_problem(const WheelPredictor& predictor, const Fit& fit, Eigen::Index cells,
                             const Eigen::MatrixXd& tolerance);

/// ln evidence of a fitted model up to a constant that all models of the same data share: Laplace's approximation with
/// soil, shapes and tolerances integrated out, each term's amplitude under a prior that gives every form the same
/// range of sizes `amplitude_range` in sd (so that no form is favoured by its units).
double log_evidence(const LinearProblem& problem, int terms);

/// Smooth functions of the conditions, one set a channel, whitened to about 1 sd a cell: what an unnamed effect could
/// look like.
Eigen::MatrixXd unnamed_columns(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
                                const Eigen::VectorXd& prediction);

/// ln evidence of the problem with an unnamed smooth term of the best size, its price paid by the determinant.
double log_evidence_unnamed(const LinearProblem& problem, const Eigen::MatrixXd& columns);

}  // namespace soilbin::compare
