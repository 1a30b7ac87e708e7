// Hyperparameters of a surrogate: the search.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "bekker_wong/gsl.hpp"
#include "compare/design/gaussian_process.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
  const gsl::Slope function = [&](std::span<const double> x, std::span<double> gradient) {
    VectorXd slope;
    const double value = cost(Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size())), slope);
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
