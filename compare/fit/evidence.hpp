// A fitted model as a linear problem with normal errors, and the evidence for it.
//
// About its fit a model is f = f0 + J (theta - theta0). With normal noise and normal priors everything that a test asks
// is then linear algebra: r, the whitened residual over rows of cells and priors, and N, the columns of all that may
// move beside what is tested (docs/theory/loop.md).
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "compare/fit/factorizations.hpp"
#include "compare/fit/fitted_model.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

/// P = I - Q Q', Q an orthonormal basis of the columns: what is left of a vector that they cannot make.
class Projector {
 public:
  explicit Projector(const Eigen::MatrixXd& columns) : q_(orthonormal(columns)) {}
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& v) const { return v - q_ * (q_.transpose() * v); }
  Eigen::VectorXd vector(const Eigen::VectorXd& v) const { return v - q_ * (q_.transpose() * v); }

 private:
  Eigen::MatrixXd q_;
};

/// A fitted model with the form tolerance of its terms, ready for tests.
struct LinearProblem {
  Eigen::VectorXd residual;              ///< augmented with the priors and with a zero a tolerance column
  Eigen::MatrixXd nuisance;              ///< augmented columns: soil, terms, tolerances
  std::vector<Eigen::Index> amplitudes;  ///< columns of nuisance that are amplitudes of terms
  Eigen::Index cells = 0;                ///< the first rows are whitened cells
  /// A whitened signature over the cells, padded with zeros.
  Eigen::VectorXd padded(const Eigen::VectorXd& signature) const;
};

/// The model's, with the tolerance of its terms' forms.
LinearProblem problem_of(const FittedModel& model);

/// Freedom of one term's form to be wrong: its contribution, channel by channel, times a smooth factor 1 + g of the
/// conditions, with g of the relative size of the form's tolerance. Such columns enter every later test with a unit
/// normal prior, so that what a wrong form leaves over is not taken for a second effect.
struct Tolerance {
  Eigen::MatrixXd columns;         ///< whitened
  std::span<const double> scales;  ///< of their unit weights
};

/// ln evidence of a fitted model up to a constant that all models of the same data share: Laplace's approximation with
/// soil, shapes and tolerances integrated out, each term's amplitude under a prior that gives every form the same
/// range of sizes `amplitude_range` in sd (so that no form is favoured by its units). exact: without any tolerance;
/// tolerances: of each term, averaged over every choice of a scale for each.
double log_evidence(const LinearProblem& exact, const std::vector<Tolerance>& tolerances);

/// Whether a fit leaves so much that it is no noise: then neither is it a form's own doing.
bool far_from_noise(const FittedModel& model);

/// ln evidence of a fitted model. none_near_noise: no candidate comes near the noise, so what is left is not noise of a
/// known size, and forms that could take it over within their tolerance say nothing. Then, the residual's variance
/// unknown: -N/2 ln(chi2) - k/2 ln N, N cells, k free parameters (Schwarz 1978, Ann. Stat. 6:461).
double log_evidence(const FittedModel& model, bool none_near_noise);

/// Whitened columns over the cells that join a problem, with weights that are normal about 0.
class JoinedColumns {
 public:
  JoinedColumns(const LinearProblem& problem, const Eigen::MatrixXd& columns);
  /// chi2 that the problem leaves without them.
  double chi2() const { return chi2_; }
  /// Half of what they take off it, each weight with its sd.
  double taken(const Eigen::VectorXd& sd) const;
  /// ln evidence that they add, all weights with the same sd.
  double gain(double size) const;

 private:
  Eigen::MatrixXd gram_;  ///< off what the problem's columns absorb
  Eigen::VectorXd seen_;
  double chi2_ = 0.0;
};

/// X'X + ridge: the ridge for a column that the data do not see at all.
Eigen::MatrixXd gram_matrix(const Eigen::MatrixXd& columns, double ridge);

/// ln of the factor by which a normal density narrows when columns of this Gram matrix, their weights normal with these
/// sd, join its unit covariance: ln det(1 + S G S)/2.
double log_narrowing(const Eigen::MatrixXd& gram, const Eigen::VectorXd& sd);

/// ln of the mean of these, given as logarithms.
double log_mean_exp(const std::vector<double>& logs);

}  // namespace soilbin::compare
