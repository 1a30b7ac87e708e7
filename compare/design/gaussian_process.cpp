#include "compare/design/gaussian_process.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

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

double scaled_distance(const VectorXd& a, const VectorXd& b, const VectorXd& lengths) {
  return ((a - b).array() / lengths.array()).matrix().norm();
}

MatrixXd distances(const MatrixXd& x, const VectorXd& lengths) {
  MatrixXd r = MatrixXd::Zero(x.rows(), x.rows());
  for (Index i = 0; i < x.rows(); ++i)
    for (Index j = 0; j < i; ++j) r(i, j) = r(j, i) = scaled_distance(x.row(i), x.row(j), lengths);
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
    k[i] = hyper_.sd * hyper_.sd * matern(scaled_distance(samples_.x.row(i), x, hyper_.lengths));
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

}  // namespace soilbin::compare
