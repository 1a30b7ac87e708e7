// A smooth function known at some points with errors: what it is elsewhere, and how sure that is (kriging; Rasmussen
// and Williams 2006, Gaussian Processes for Machine Learning, chapters 2 and 5).
//
//   y_i = h(x_i)' b + f(x_i) + e_i,   cov f = s^2 m(r),   r^2 = sum over k of ((x_k - x'_k)/l_k)^2
//   m(r) = (1 + sqrt(5) r + 5 r^2/3) exp(-sqrt(5) r)          Matern 5/2, eq. 4.17
//   var e_i = variance_i + t^2                                the data's own error, and an unexplained one
//
// b has a flat prior and is integrated out: with K = cov y, all below follows from
//   Q = K^-1 - K^-1 H (H' K^-1 H)^-1 H' K^-1,   alpha = Q y.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include "scenario/estimate.hpp"

namespace soilbin::compare {

/// What was seen: a row of x, a value and the variance of its error (0: exact) for each point. x is best scaled to the
/// unit cube (factor.hpp), on which the priors below are chosen.
struct Samples {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
  Eigen::VectorXd variance;

  Eigen::Index size() const { return y.size(); }
};

/// h(x): nothing (the mean is 0), 1, or 1 and every coordinate.
enum class Trend { zero, constant, linear };

struct Hyperparameters {
  double sd = 1.0;          ///< s, in y's unit
  Eigen::VectorXd lengths;  ///< l_k, in x's units
  double extra_sd = 0.0;    ///< t, in y's unit
};

/// Each point predicted from all others, hyperparameters held.
struct LeaveOneOut {
  Eigen::VectorXd residual;      ///< y_i less its prediction
  Eigen::VectorXd sd;            ///< of the residual: prediction and the point's own error
  Eigen::VectorXd standardised;  ///< residual/sd; standard normal if the model is right
  double rms() const;            ///< of the residuals
};

class GaussianProcess {
 public:
  /// Throws std::invalid_argument for sizes that don't agree, fewer points than the trend has terms plus one, values
  /// that aren't finite or positive where they must be; std::runtime_error where the covariance isn't positive
  /// definite.
  GaussianProcess(Samples samples, Trend trend, Hyperparameters hyperparameters);

  /// h'b + f at x, without the error of a new measurement (eq. 2.42).
  Estimate predict(const Eigen::VectorXd& x) const;

  /// Restricted likelihood: of what the trend can't absorb (Patterson and Thompson 1971; eq. 2.45). For Trend::zero the
  /// plain one (eq. 2.30).
  double log_likelihood() const { return log_likelihood_; }
  /// Its derivatives by ln s, ln l_k, ln t: 1/2 (alpha' dK alpha - tr(Q dK)) (after eq. 5.9). By ln t: 0 where t is 0.
  Eigen::VectorXd gradient() const;

  /// Closed form: residual_i = alpha_i/Q_ii, its variance 1/Q_ii (Dubrule 1983, Math. Geol. 15:687; eqs. 5.10 - 5.12).
  LeaveOneOut leave_one_out() const;

  const Samples& samples() const { return samples_; }
  Trend trend() const { return trend_; }
  const Hyperparameters& hyperparameters() const { return hyper_; }

 private:
  Eigen::MatrixXd trend_terms(const Eigen::MatrixXd& x) const;
  Eigen::VectorXd covariance_with(const Eigen::VectorXd& x) const;

  Samples samples_;
  Trend trend_;
  Hyperparameters hyper_;
  Eigen::MatrixXd terms_;              ///< H
  Eigen::MatrixXd q_;                  ///< Q
  Eigen::VectorXd alpha_;              ///< Q y
  Eigen::VectorXd trend_value_;        ///< b
  Eigen::LLT<Eigen::MatrixXd> chol_;   ///< of K
  Eigen::LLT<Eigen::MatrixXd> inner_;  ///< of H' K^-1 H
  double log_likelihood_ = 0.0;
};

/// How hyperparameters are found. Priors are normal in the logarithms and weak; they keep few points from an answer
/// such as a length of a thousand cubes. They stand for x in the unit cube.
struct SurrogateOptions {
  Trend trend = Trend::constant;
  bool extra_noise = true;  ///< whether t is sought; else it is 0
  int starts = 6;           ///< of the search: one at the priors' middle, the others seeded around it
  std::uint64_t seed = 1;
  double length = 1.0;         ///< median of l_k, in cubes
  double length_spread = 1.2;  ///< sd of ln l_k
  double sd_spread = 2.0;      ///< sd of ln s, about the data's own standard deviation
  double extra_median = 0.1;   ///< median of t, in the data's standard deviation
  double extra_spread = 1.5;   ///< sd of ln t
  /// Called before each process that is tried; may throw to stop.
  std::function<void()> look = [] {};
};

/// The process of the largest restricted likelihood times priors, by BFGS from several starts: some thousand processes
/// of n points are tried, each at a cost of n^3. 100 points take a second, 400 half a minute. The same input gives the
/// same bits. Throws as the constructor. With few points it is too sure: it takes its hyperparameters for known.
GaussianProcess fit_surrogate(const Samples& samples, const SurrogateOptions& options = {});

/// Processes of several hyperparameters, each with the weight of its posterior density: what is known when they are not
/// known exactly.
class Surrogate {
 public:
  /// Importance sampling about the mode: `draws` seeded points, in pairs, of the normal distribution with the curvature
  /// of the log posterior there, weighted by posterior over that density (Laplace's approximation corrected).
  explicit Surrogate(const Samples& samples, const SurrogateOptions& options = {}, int draws = 24);

  /// Mean and standard deviation of the mixture.
  Estimate predict(const Eigen::VectorXd& x) const;
  /// The most likely member.
  const GaussianProcess& mode() const { return members_.front(); }

 private:
  std::vector<GaussianProcess> members_;
  std::vector<double> weights_;
};

// Which point to look at next, where runs are dear and a surrogate knows how sure it is (gaussian_process.hpp).

/// What each rule likes best; all are largest at the point to choose, for a function that the surrogate predicts as
/// value +- std_error there.

/// How likely the function lies within `half_width` of `target`.
double chance_within(const Estimate& predicted, double target, double half_width);

/// Where the boundary |function| = limit of an excess set may be: 1.96 std_error - distance of the value to the
/// nearer of +-limit (the straddle of Bryan et al. 2005, Active learning for identifying function threshold
/// boundaries).
double straddle(const Estimate& predicted, double limit);

/// The candidate (a row each) of which `score` likes the prediction best; the first of equals. Throws
/// std::invalid_argument for no candidates.
Eigen::Index next_point(const GaussianProcess& surrogate, const Eigen::MatrixXd& candidates, const auto& score) {
  if (candidates.rows() == 0) throw std::invalid_argument("no candidates to choose from");
  Eigen::Index best = 0;
  double most = score(surrogate.predict(candidates.row(0)));
  for (Eigen::Index i = 1; i < candidates.rows(); ++i)
    if (const double s = score(surrogate.predict(candidates.row(i))); s > most) most = s, best = i;
  return best;
}

}  // namespace soilbin::compare
