#include "compare/design/gaussian_process.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <random>

#include "bekker_wong/gsl.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const double root5 = std::sqrt(5.0);
/// Part of s^2 added to each point's variance, so that points near each other don't make K singular.
constexpr double jitter = 1e-10;

double matern(double r) { return (1 + root5 * r + 5 * r * r / 3) * std::exp(-root5 * r); }
/// -(dm/dr)/r
double matern_slope(double r) { return 5.0 / 3.0 * (1 + root5 * r) * std::exp(-root5 * r); }

double scaled_distance(const auto& a, const auto& b, const VectorXd& lengths) {
  return ((a - b).array() / lengths.array()).matrix().norm();
}

MatrixXd distances(const MatrixXd& x, const VectorXd& lengths) {
  const MatrixXd points = x.transpose();  // a column each: no copy a pair
  MatrixXd r = MatrixXd::Zero(x.rows(), x.rows());
  for (Index i = 0; i < x.rows(); ++i)
    for (Index j = 0; j < i; ++j) r(i, j) = r(j, i) = scaled_distance(points.col(i), points.col(j), lengths);
  return r;
}

double log_determinant(const Eigen::LLT<MatrixXd>& chol) { return 2 * chol.matrixLLT().diagonal().array().log().sum(); }

void check(const Samples& samples, const Hyperparameters& hyper) {
  const bool sizes = samples.x.rows() == samples.size() && samples.variance.size() == samples.size() &&
                     hyper.lengths.size() == samples.x.cols() && samples.x.cols() > 0;
  if (!sizes) throw std::invalid_argument("surrogate: points, values, variances and lengths differ in number");
  const bool values = samples.x.allFinite() && samples.y.allFinite() && samples.variance.allFinite() &&
                      hyper.lengths.allFinite() && std::isfinite(hyper.sd) && std::isfinite(hyper.extra_sd);
  if (!values) throw std::invalid_argument("surrogate: a value is not finite");
  if (!(samples.variance.array() >= 0).all() || !(hyper.lengths.array() > 0).all() || !(hyper.sd > 0) ||
      !(hyper.extra_sd >= 0))
    throw std::invalid_argument("surrogate: variances are 0 or more, lengths and sd above 0");
}

}  // namespace

double LeaveOneOut::rms() const { return std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size())); }

GaussianProcess::GaussianProcess(Samples samples, Trend trend, Hyperparameters hyperparameters)
    : samples_(std::move(samples)), trend_(trend), hyper_(std::move(hyperparameters)) {
  check(samples_, hyper_);
  terms_ = trend_terms(samples_.x);
  const Index n = samples_.size(), p = terms_.cols();
  if (n <= p) throw std::invalid_argument("surrogate: fewer points than the trend needs");
  const double s2 = hyper_.sd * hyper_.sd;
  MatrixXd k = distances(samples_.x, hyper_.lengths).unaryExpr([s2](double r) { return s2 * matern(r); });
  k.diagonal().array() += samples_.variance.array() + hyper_.extra_sd * hyper_.extra_sd + jitter * s2;
  chol_.compute(k);
  if (chol_.info() != Eigen::Success) throw std::runtime_error("surrogate: the covariance is not positive definite");
  q_ = chol_.solve(MatrixXd::Identity(n, n));
  log_likelihood_ = -0.5 * (log_determinant(chol_) + static_cast<double>(n - p) * std::log(2 * std::numbers::pi));
  if (p > 0) {
    const MatrixXd solved = chol_.solve(terms_);
    inner_.compute(terms_.transpose() * solved);
    if (inner_.info() != Eigen::Success) throw std::runtime_error("surrogate: the points don't determine the trend");
    trend_value_ = inner_.solve(solved.transpose() * samples_.y);
    q_ -= solved * inner_.solve(solved.transpose());
    // The constant ln det H'H makes the likelihood that of orthonormal contrasts (Harville 1974).
    const Eigen::LLT<MatrixXd> gram(terms_.transpose() * terms_);
    log_likelihood_ += 0.5 * (log_determinant(gram) - log_determinant(inner_));
  }
  alpha_ = q_ * samples_.y;
  log_likelihood_ -= 0.5 * samples_.y.dot(alpha_);
}

MatrixXd GaussianProcess::trend_terms(const MatrixXd& x) const {
  if (trend_ == Trend::zero) return MatrixXd(x.rows(), 0);
  if (trend_ == Trend::constant) return MatrixXd::Ones(x.rows(), 1);
  MatrixXd terms(x.rows(), x.cols() + 1);
  terms << VectorXd::Ones(x.rows()), x;
  return terms;
}

VectorXd GaussianProcess::covariance_with(const VectorXd& x) const {
  VectorXd k(samples_.size());
  for (Index i = 0; i < k.size(); ++i)
    k[i] = hyper_.sd * hyper_.sd * matern(scaled_distance(VectorXd(samples_.x.row(i)), x, hyper_.lengths));
  return k;
}

Estimate GaussianProcess::predict(const VectorXd& x) const {
  const VectorXd k = covariance_with(x), solved = chol_.solve(k);
  Estimate answer{k.dot(alpha_), hyper_.sd * hyper_.sd - k.dot(solved)};
  if (terms_.cols() > 0) {
    const VectorXd h = trend_terms(x.transpose()).row(0);
    const VectorXd missed = h - terms_.transpose() * solved;
    answer.value += h.dot(trend_value_);
    answer.std_error += missed.dot(inner_.solve(missed));
  }
  answer.std_error = std::sqrt(std::max(0.0, answer.std_error));
  return answer;
}

VectorXd GaussianProcess::gradient() const {
  const MatrixXd r = distances(samples_.x, hyper_.lengths);
  const double s2 = hyper_.sd * hyper_.sd;
  const auto along = [&](const MatrixXd& dk) {
    return 0.5 * (alpha_.dot(dk * alpha_) - (q_.array() * dk.array()).sum());
  };
  const Index d = samples_.x.cols(), n = samples_.size();
  VectorXd gradient(d + 2);
  MatrixXd dk = r.unaryExpr([s2](double distance) { return 2 * s2 * matern(distance); });
  dk.diagonal().array() += 2 * jitter * s2;
  gradient[0] = along(dk);
  const MatrixXd slope = r.unaryExpr([s2](double distance) { return s2 * matern_slope(distance); });
  for (Index c = 0; c < d; ++c) {
    const VectorXd u = samples_.x.col(c) / hyper_.lengths[c];
    const MatrixXd apart = (u.replicate(1, n) - u.transpose().replicate(n, 1)).array().square();
    gradient[1 + c] = along(slope.array() * apart.array());
  }
  gradient[d + 1] = along(2 * hyper_.extra_sd * hyper_.extra_sd * MatrixXd::Identity(n, n));
  return gradient;
}

LeaveOneOut GaussianProcess::leave_one_out() const {
  LeaveOneOut left;
  left.residual = alpha_.array() / q_.diagonal().array();
  left.sd = q_.diagonal().array().rsqrt();
  left.standardised = left.residual.array() / left.sd.array();
  return left;
}

double chance_within(const Estimate& predicted, double target, double half_width) {
  const double off = predicted.value - target, sd = predicted.std_error;
  if (sd <= 0) return std::abs(off) <= half_width ? 1.0 : 0.0;
  return gsl::normal_tail((-half_width - off) / sd) - gsl::normal_tail((half_width - off) / sd);
}

double straddle(const Estimate& predicted, double limit) {
  return 1.96 * predicted.std_error - std::abs(std::abs(predicted.value) - limit);
}

// Hyperparameters of a surrogate: the search.

namespace {

/// The search's unknowns: ln s, ln l_k, and ln t where it is sought; with normal priors.
struct Unknowns {
  VectorXd middle, spread;
  bool extra;

  Unknowns(const Samples& samples, const SurrogateOptions& options) : extra(options.extra_noise) {
    const Index d = samples.x.cols();
    const double scatter = std::sqrt((samples.y.array() - samples.y.mean()).square().mean());
    const double sd = scatter > 0 ? scatter : std::max(1e-6, std::abs(samples.y.mean()) * 1e-6);
    middle = VectorXd::Constant(d + 1 + (extra ? 1 : 0), std::log(options.length));
    spread = VectorXd::Constant(middle.size(), options.length_spread);
    middle[0] = std::log(sd), spread[0] = options.sd_spread;
    if (extra) middle[d + 1] = std::log(options.extra_median * sd), spread[d + 1] = options.extra_spread;
  }

  Hyperparameters at(const VectorXd& theta) const {
    const Index d = theta.size() - 1 - (extra ? 1 : 0);
    return {std::exp(theta[0]), theta.segment(1, d).array().exp(), extra ? std::exp(theta[d + 1]) : 0.0};
  }
};

/// Beyond so many spreads of its prior nothing is worth a look.
constexpr double far = 12.0;

/// -ln(posterior density) of the unknowns and its slope; infinite where the covariance can't be factored.
class Cost {
 public:
  Cost(const Samples& samples, const SurrogateOptions& options)
      : samples_(samples), options_(options), unknowns_(samples, options) {}

  const Unknowns& unknowns() const { return unknowns_; }
  GaussianProcess process(const VectorXd& theta) const { return {samples_, options_.trend, unknowns_.at(theta)}; }

  double operator()(const VectorXd& theta, VectorXd& slope) const {
    options_.look();
    const VectorXd off = (theta - unknowns_.middle).array() / unknowns_.spread.array();
    slope = off.array() / unknowns_.spread.array();
    if (!(off.array().abs() < far).all()) return std::numeric_limits<double>::infinity();
    try {
      const GaussianProcess tried = process(theta);
      slope -= tried.gradient().head(theta.size());
      return 0.5 * off.squaredNorm() - tried.log_likelihood();
    } catch (const std::runtime_error&) {
      return std::numeric_limits<double>::infinity();
    }
  }

 private:
  const Samples& samples_;
  const SurrogateOptions& options_;
  Unknowns unknowns_;
};

VectorXd mode_of(const Cost& cost, const SurrogateOptions& options) {
  const Unknowns& unknowns = cost.unknowns();
  // A first look throws for samples that make no sense, before the search hides it.
  static_cast<void>(cost.process(unknowns.middle));
  VectorXd last, slope;  // the search asks for value and slope of one place one after the other
  double value = 0.0;
  std::exception_ptr thrown;
  const gsl::Slope function = [&](std::span<const double> x, std::span<double> gradient) {
    const Eigen::Map<const VectorXd> theta(x.data(), static_cast<Index>(x.size()));
    if (!thrown && (last.size() != theta.size() || last != theta)) {
      last = theta;
      try {
        value = cost(last, slope);
      } catch (...) {  // no exception passes through C
        thrown = std::current_exception();
        value = std::numeric_limits<double>::infinity(), slope = VectorXd::Zero(theta.size());
      }
    }
    Eigen::Map<VectorXd>(gradient.data(), slope.size()) = slope;
    return value;
  };
  std::mt19937_64 random(options.seed);
  VectorXd best = unknowns.middle;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < options.starts; ++start) {
    VectorXd theta = unknowns.middle;
    for (Index k = 0; k < theta.size() && start > 0; ++k)
      theta[k] += unknowns.spread[k] * (2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1);
    const double found = gsl::minimise(function, {theta.data(), static_cast<std::size_t>(theta.size())}, 1e-5, 200);
    if (thrown) std::rethrow_exception(thrown);
    if (found < least) least = found, best = theta;
  }
  return best;
}

/// Columns that turn standard normal numbers into steps from the mode. Where the surface bends less than its priors do,
/// the priors' curvature is taken.
MatrixXd steps_at(const Cost& cost, const VectorXd& mode) {
  const Index n = mode.size();
  constexpr double by = 1e-4;
  MatrixXd curvature(n, n);
  for (Index k = 0; k < n; ++k) {
    VectorXd up, down, theta = mode;
    theta[k] += by, cost(theta, up);
    theta[k] -= 2 * by, cost(theta, down);
    curvature.col(k) = (up - down) / (2 * by);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (curvature + curvature.transpose()));
  const double least = 1 / cost.unknowns().spread.array().square().maxCoeff();
  const VectorXd sizes = eigen.eigenvalues().array().max(least).rsqrt();
  return eigen.eigenvectors() * sizes.asDiagonal();
}

}  // namespace

GaussianProcess fit_surrogate(const Samples& samples, const SurrogateOptions& options) {
  const Cost cost(samples, options);
  return cost.process(mode_of(cost, options));
}

Surrogate::Surrogate(const Samples& samples, const SurrogateOptions& options, int draws) {
  const Cost cost(samples, options);
  const VectorXd mode = mode_of(cost, options);
  const MatrixXd steps = steps_at(cost, mode);
  VectorXd unused;
  const double least = cost(mode, unused);
  members_.push_back(cost.process(mode));
  weights_.push_back(1.0);
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k + 1 < draws; k += 2) {
    const VectorXd z = VectorXd::NullaryExpr(mode.size(), [&](Index) { return normal(random); });
    for (const double sign : {1.0, -1.0}) {
      const VectorXd theta = mode + sign * (steps * z);
      const double value = cost(theta, unused);
      if (!std::isfinite(value)) continue;
      members_.push_back(cost.process(theta));
      weights_.push_back(std::exp(std::min(3.0, least - value + 0.5 * z.squaredNorm())));
    }
  }
  double sum = 0.0;
  for (const double weight : weights_) sum += weight;
  for (double& weight : weights_) weight /= sum;
}

Estimate Surrogate::predict(const VectorXd& x) const {
  double mean = 0.0, square = 0.0;
  const double about = members_.front().predict(x).value;  // differences from it, so that nothing cancels
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Estimate one = members_[k].predict(x);
    mean += weights_[k] * (one.value - about);
    square += weights_[k] * (std::pow(one.value - about, 2) + one.std_error * one.std_error);
  }
  return {about + mean, std::sqrt(std::max(0.0, square - mean * mean))};
}

}  // namespace soilbin::compare
