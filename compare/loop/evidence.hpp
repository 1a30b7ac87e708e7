// A fitted model as a linear-Gaussian problem: projection off what the soil absorbs, signatures, scores, evidence.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "compare/loop/bounded_fit.hpp"

namespace soilbin::compare {

/// Orthonormal columns that span these; fewer where some are combinations of others.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// One column orthonormal basis of the nuisance columns: P = I - Q Q^T.
class Projector {
 public:
  explicit Projector(const Eigen::MatrixXd& columns);
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& v) const { return v - q_ * (q_.transpose() * v); }
  Eigen::VectorXd vector(const Eigen::VectorXd& v) const { return v - q_ * (q_.transpose() * v); }

 private:
  Eigen::MatrixXd q_;
};

/// Freedom that an effect's form may be wrong: its contribution, channel by channel, times a smooth factor 1 + g of the
/// conditions, with g of the relative size `tolerance`. Such columns enter every later test with a unit normal prior,
/// so that what a wrong form leaves over is not taken for a second effect. Whitened; contribution: of the effect to
/// each cell, unwhitened.
Eigen::MatrixXd form_columns(const Observations& observations, const Whitening& whitening,
                             const Eigen::VectorXd& contribution, double tolerance);

/// A fitted model with the form tolerance of its terms, ready for tests.
struct LinearProblem {
  Eigen::VectorXd residual;              ///< augmented with the priors and with a zero a tolerance column
  Eigen::MatrixXd nuisance;              ///< augmented columns: soil, terms, tolerances
  std::vector<Eigen::Index> amplitudes;  ///< columns of nuisance that are amplitudes of terms
  Eigen::Index cells = 0;                ///< the first rows are whitened cells
  /// A whitened signature over the cells, padded with zeros.
  Eigen::VectorXd padded(const Eigen::VectorXd& signature) const;
};

/// tolerance: whitened columns over the cells (form_columns), with unit prior; may have no column.
LinearProblem linear_problem(const WheelPredictor& predictor, const Fit& fit, Eigen::Index cells,
                             const Eigen::MatrixXd& tolerance);

/// How far nature's equation may be from ours, in units of a form's tolerance. Nobody knows, so each is tried; the
/// narrow ones for an instrument's zero or a tilt, which is what it is said to be, and for fits that are far from the
/// noise, where twice the tolerance would let any form take over what is left.
inline constexpr std::array<double, 3> tolerance_scales = {0.3, 1.0, 2.0};
inline constexpr std::array<double, 2> narrow_tolerance_scales = {0.3, 1.0};

/// Freedom of one term's form.
struct Tolerance {
  Eigen::MatrixXd columns;         ///< form_columns
  std::span<const double> scales;  ///< of their unit weights
};

/// ln evidence of a fitted model up to a constant that all models of the same data share: Laplace's approximation with
/// soil, shapes and tolerances integrated out, each term's amplitude under a prior that gives every form the same
/// range of sizes `amplitude_range` in sd (so that no form is favoured by its units). exact: without any tolerance;
/// tolerances: of each term, averaged over every choice of a scale for each.
double log_evidence(const LinearProblem& exact, const std::vector<Tolerance>& tolerances);

/// The same where no model comes near the noise: what is left is then not noise of a known size, and forms that could
/// take it over within their tolerance say nothing. With the residual's variance unknown: -N/2 ln(chi2) - k/2 ln N
/// (Schwarz 1978), k free parameters.
double schwarz_log_evidence(const Fit& fit, Eigen::Index cells);

/// The columns of all tolerances as one matrix.
Eigen::MatrixXd side_by_side(Eigen::Index cells, const std::vector<Tolerance>& tolerances);

/// What an unnamed effect could look like: families of functions of the conditions (smooth; waves in slip, in position,
/// in time; what the run before left behind), each in every channel, whitened to about 1 sd a cell.
std::vector<Eigen::MatrixXd> unnamed_families(const Observations& observations, const NoiseFloor& noise,
                                              const Whitening& whitening, const Eigen::VectorXd& prediction);

/// Functions of the rows as whitened columns of the cells: each in every channel, of 1 sd of its noise a cell.
Eigen::MatrixXd in_every_channel(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
                                 const Eigen::VectorXd& prediction, const Eigen::MatrixXd& functions);

/// Sizes that an unnamed term is tried at: sd of its columns' weights.
inline constexpr std::array<double, 6> term_sizes = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0};

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

/// ln of the factor by which a normal density narrows when columns of this Gram matrix, their weights normal with these
/// sd, join its unit covariance: ln det(1 + S G S)/2.
double log_narrowing(const Eigen::MatrixXd& gram, const Eigen::VectorXd& sd);

/// ln evidence that an unnamed term adds to the problem: the mean over families and sizes, so that it is a Bayes factor
/// whose price is paid (reached by chance with probability at most its inverse).
double unnamed_gain(const LinearProblem& problem, const std::vector<Eigen::MatrixXd>& families);

}  // namespace soilbin::compare
