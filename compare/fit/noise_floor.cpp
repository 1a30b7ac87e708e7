#include "compare/fit/noise_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "bekker_wong/gsl.hpp"
#include "compare/fit/condition_functions.hpp"
#include "compare/fit/factorizations.hpp"
#include "compare/fit/setpoint_squares.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/measured/within_run_scatter.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double ChannelNoise::sd(double prediction, double scatter) const {
  const double steady = std::hypot(floor, growth * prediction);
  return unsteady == 0.0 ? steady : std::hypot(steady, unsteady * scatter);
}

double NoiseFloor::freedom() const {
  return std::accumulate(channels.begin(), channels.end(), 0.0,
                         [](double sum, const ChannelNoise& c) { return sum + c.freedom; });
}

double NoiseFloor::typical_freedom() const {
  const auto measured = std::ranges::count_if(channels, [](const ChannelNoise& c) { return c.measured; });
  return measured > 0 ? freedom() / static_cast<double>(measured) : 1.0;
}

Whitening::Whitening(const Observations& observations, const NoiseFloor& noise, const VectorXd& prediction)
    : Whitening(observations, noise, prediction, VectorXd::Ones(prediction.size())) {}

Whitening::Whitening(const Observations& observations, const NoiseFloor& noise, const VectorXd& prediction,
                     const VectorXd& counts) {
  const std::vector<Cell>& cells = observations.cells;
  for (std::size_t first = 0; first < cells.size();) {
    std::size_t last = first;
    while (last < cells.size() && cells[last].row == cells[first].row) ++last;
    const Index n = (last - first);
    MatrixXd covariance(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const Cell &a = cells[first + i], &b = cells[first + j];
        covariance(i, j) = noise.correlation(a.channel, b.channel) *
                           noise.channels[a.channel].sd(prediction[first + i], a.spread) *
                           noise.channels[b.channel].sd(prediction[first + j], b.spread) /
                           std::sqrt(counts[first + i] * counts[first + j]);
      }
    blocks_.push_back({static_cast<Index>(first), Cholesky(covariance).half_solve(MatrixXd(MatrixXd::Identity(n, n)))});
    first = last;
  }
}

template <class Columns>
Columns Whitening::whitened(const Columns& columns) const {
  Columns white(columns.rows(), columns.cols());
  for (const Block& b : blocks_) {
    const Index n = b.inverse_factor.rows();
    white.middleRows(b.first, n).noalias() = b.inverse_factor * columns.middleRows(b.first, n);
  }
  if (term_basis_.size() > 0) white += term_basis_ * (term_change_ * (term_basis_.transpose() * white));
  return white;
}

MatrixXd Whitening::operator()(const MatrixXd& columns) const { return whitened(columns); }

VectorXd Whitening::operator()(const VectorXd& column) const { return whitened(column); }

Whitening Whitening::beside(const MatrixXd& columns) const {
  const Index wide = std::min(columns.rows(), columns.cols());
  Whitening joined = *this;
  joined.term_basis_ = leading_orthonormal(columns, wide);
  const MatrixXd r = joined.term_basis_.transpose() * columns, one = MatrixXd::Identity(wide, wide);
  joined.term_columns_ = columns;
  joined.term_change_ = Cholesky(one + r * r.transpose()).half_solve(one) - one;
  return joined;
}

PartialChi2::PartialChi2(const Whitening& whitening) : whitening_(whitening) {
  const Index n = whitening.term_columns_.cols();
  information_ = MatrixXd::Identity(n, n);
  projection_ = VectorXd::Zero(n);
}

void PartialChi2::add(Index first, const VectorXd& residual) {
  const auto block = std::lower_bound(whitening_.blocks_.begin(), whitening_.blocks_.end(), first,
                                      [](const Whitening::Block& b, Index f) { return b.first < f; });
  const VectorXd white = block->inverse_factor * residual;
  squares_ += white.squaredNorm();
  if (projection_.size() == 0) return;
  const auto term = whitening_.term_columns_.middleRows(first, white.size());
  information_.noalias() += term.transpose() * term;
  projection_.noalias() += term.transpose() * white;
}

bool PartialChi2::exceeds(double limit) const {
  if (!(squares_ > limit)) return false;
  return projection_.size() == 0 || squares_ - projection_.dot(Cholesky(information_).solve(projection_)) > limit;
}

MatrixXd Whitening::term() const {
  MatrixXd columns = term_columns_;
  for (const Block& b : blocks_) {
    if (columns.size() == 0) break;
    const Index n = b.inverse_factor.rows();
    columns.middleRows(b.first, n) = solve_lower(b.inverse_factor, term_columns_.middleRows(b.first, n));
  }
  return columns;
}

namespace {

/// Noise + random columns of given variances, for one channel: -2 ln likelihood and what follows from the best fit.
class VarianceComponents {
 public:
  VarianceComponents(const VectorXd& e, const MatrixXd& soil, const MatrixXd& smooth, const VectorXd& shape)
      : n_(e.size()), soil_(soil.cols()), q_(soil.cols() + smooth.cols()), root_shape_(shape.cwiseSqrt()) {
    a_.resize(n_, q_);
    a_ << soil, smooth;
    a_ = root_shape_.cwiseInverse().asDiagonal() * a_;
    e_ = e.cwiseQuotient(root_shape_);
    gram_ = a_.transpose() * a_;
    projected_ = a_.transpose() * e_;
    log_shape_ = 2 * root_shape_.array().log().sum();
  }

  double deviance(double sigma, double tau) const {
    const VectorXd d = weights(tau);
    MatrixXd m = d.asDiagonal() * gram_ * d.asDiagonal() / (sigma * sigma);
    m.diagonal().array() += 1.0;
    const Cholesky factor(m);
    const VectorXd b = d.cwiseProduct(projected_) / sigma;
    const double fit = (e_.squaredNorm() - factor.half_solve(b).squaredNorm()) / (sigma * sigma);
    const double log_det = 2 * factor.half_log_determinant();
    return 2 * static_cast<double>(n_) * std::log(sigma) + log_shape_ + log_det + fit;
  }

  /// Each value's chance of one farther off the smooth fit of the others: its residual in sd of its own, with the
  /// noise of the others, is Student's t (externally studentised; Cook and Weisberg 1982, ch. 2). Also the trace of the
  /// smoother, and the residuals themselves.
  VectorXd chances(double sigma, double tau, double& trace, VectorXd& plain) const {
    const VectorXd d = weights(tau);
    MatrixXd m = d.asDiagonal() * gram_ * d.asDiagonal() / (sigma * sigma);
    m.diagonal().array() += 1.0;
    const Cholesky factor(m);
    const MatrixXd scaled = a_ * d.asDiagonal() / sigma;                    // n x q
    const MatrixXd half = factor.half_solve(MatrixXd(scaled.transpose()));  // q x n; smoother = half' half
    plain = e_ - half.transpose() * (half * e_);
    const VectorXd leverage = half.colwise().squaredNorm();
    trace = leverage.sum();
    const VectorXd squares = plain.array().square() / (sigma * sigma * (1 - leverage.array()).max(0.02));
    const double freedom = std::max(2.0, static_cast<double>(n_) - trace);
    const double all = std::max(freedom, e_.dot(plain) / (sigma * sigma));  // squares of the fit and of its columns
    VectorXd chance(n_);
    for (Index i = 0; i < n_; ++i) {
      const double others = all - squares[i];  // what they come to without the value
      chance[i] = others > 0 ? gsl::f_tail(squares[i] * (freedom - 1) / others, 1, freedom - 1) : 0.0;
    }
    plain = plain.cwiseProduct(root_shape_);
    return chance;
  }

 private:
  VectorXd weights(double tau) const {
    VectorXd d = VectorXd::Ones(q_);
    d.tail(q_ - soil_).setConstant(tau);
    return d;
  }

  Index n_, soil_, q_;
  VectorXd root_shape_, e_, projected_;
  MatrixXd a_, gram_;
  double log_shape_ = 0.0;
};

struct ChannelFit {
  ChannelNoise noise;
  VectorXd chance, plain;
};

struct ChannelCells {
  std::vector<Index> cell;
  std::vector<int> row;
};

ChannelCells gather(const Observations& observations, int channel) {
  ChannelCells found;
  for (std::size_t i = 0; i < observations.cells.size(); ++i)
    if (observations.cells[i].channel == channel) {
      found.cell.push_back(i);
      found.row.push_back(observations.cells[i].row);
    }
  return found;
}

double pooled_rerun_sd(const Observations& observations, const ChannelCells& cells, const VectorXd& residual) {
  SetpointSquares squares(observations.conditions);
  for (std::size_t i = 0; i < cells.cell.size(); ++i)
    squares.add(observations.condition[cells.row[i]], residual[cells.cell[i]]);
  return squares.reruns() > 0 ? std::sqrt(squares.within() / squares.reruns()) : 0.0;
}

/// Median of the noise's prior: a share of the predictions' range; where the model predicts next to nothing (a lateral
/// force without yaw), the spread of the residuals.
double typical_noise(const VectorXd& residual, const VectorXd& prediction) {
  const double range = std::max(prediction.maxCoeff() - prediction.minCoeff(), 0.2 * prediction.cwiseAbs().maxCoeff());
  const double spread = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  return std::max(spread > range ? spread : thresholds::typical_noise_share * range, 1e-12);
}

/// A guess for a channel whose one or two values estimate nothing, on no degree of freedom.
ChannelNoise guessed_noise(const VectorXd& residual, const VectorXd& prediction) {
  if (residual.size() == 0) return {};
  const double size = thresholds::first_noise_share * prediction.cwiseAbs().maxCoeff();
  return {.measured = true, .floor = std::max({residual.cwiseAbs().maxCoeff(), size, 1e-12})};
}

/// What the cells of one channel are made of, and the columns that may explain them.
struct ChannelData {
  VectorXd e, f;    ///< residuals about the declared soil's prediction, and the predictions
  VectorXd spread;  ///< Cell::spread
  MatrixXd soil, smooth;
};

ChannelData channel_data(const Observations& observations, const ChannelCells& cells, const NoiseData& data,
                         const MatrixXd& basis) {
  const Index n = cells.cell.size();
  VectorXd spread(n);
  for (Index i = 0; i < n; ++i) spread[i] = observations.cells[cells.cell[i]].spread;
  const Index columns = std::clamp<Index>(n / thresholds::values_a_noise_function - 1, 0, basis.cols());
  const MatrixXd functions = basis(cells.row, Eigen::seqN(0, columns));
  return {.e = data.residual(cells.cell),
          .f = data.prediction(cells.cell),
          .spread = spread,
          .soil = data.soil_columns(cells.cell, Eigen::all),
          .smooth = with_constant(functions)};
}

/// The likeliest sizes of noise and smooth function, and how the noise grows with the prediction.
struct ChannelSizes {
  double sigma = 0.0, tau = 0.0;
  double share = 0.0;  ///< of the variance at the mean square prediction that grows with its square
  double part = 0.0;   ///< of the variance at the mean square scatter in time that grows with its square
  double deviance = std::numeric_limits<double>::infinity();
};

constexpr double constant_share = thresholds::min_constant_share, growing_share = 1 - constant_share;

/// How the noise's variance is spread over the cells: `share` of it grows with the prediction, and `part` of the whole
/// with the scatter in time.
VectorXd variance_shape(const ChannelData& data, double mean_square, double share, double part) {
  VectorXd shape =
      (1 - share) + share * (constant_share + growing_share * data.f.array().square() / std::max(mean_square, 1e-300));
  if (part == 0.0) return shape;
  const double scatter = data.spread.squaredNorm() / static_cast<double>(data.spread.size());
  return (1 - part) * shape.array() + part * (constant_share + growing_share * data.spread.array().square() / scatter);
}

/// -2 ln of the likelihood of these sizes, and what a size far from the typical one and growth cost.
double price_of(const VarianceComponents& model, const ChannelSizes& sizes, double typical) {
  return model.deviance(sizes.sigma, sizes.tau) + std::pow(std::log(sizes.sigma / typical), 2) +
         thresholds::price_of_growth * sizes.share + thresholds::price_of_growth * sizes.part;
}

constexpr double sigma_step = 0.12, ratio_step = 1.2;  // of ln sigma, and about that of ln(tau/sigma), on the grid

/// The top near a point of the grid: a step apart is a share of the noise that chi2 and errors would show.
ChannelSizes refined(const VarianceComponents& model, ChannelSizes sizes, double typical) {
  const auto climb = [&](const auto& at, double step, double x_tol) {
    const auto height = [&](double by) { return -price_of(model, at(by), typical); };
    const gsl::Sample top =
        gsl::bracketed_maximum(height, {{-step, height(-step)}, {0.0, height(0.0)}, {step, height(step)}}, x_tol,
                               std::numeric_limits<double>::infinity(), "the size of a channel's noise");
    sizes = at(top.x);
    sizes.deviance = -top.f;
  };
  const auto both = [&](double by) {
    ChannelSizes other = sizes;
    other.sigma *= std::exp(by), other.tau *= std::exp(by);
    return other;
  };
  const auto smooth_alone = [&](double by) {
    ChannelSizes other = sizes;
    other.tau *= std::exp(by);
    return other;
  };
  climb(both, sigma_step, 1e-3);
  if (sizes.tau == 0.0) return sizes;
  climb(smooth_alone, ratio_step, 1e-2);
  climb(both, sigma_step, 1e-3);
  return sizes;
}

ChannelSizes likeliest(const ChannelData& data, double mean_square) {
  const double typical = typical_noise(data.e, data.f);
  const bool enough = data.e.size() >= thresholds::min_growth_values;
  std::span<const double> shares = thresholds::growing_shares, parts = thresholds::unsteady_shares;
  if (!enough || mean_square <= 0) shares = shares.first(1);
  if (!enough || data.spread.squaredNorm() <= 0) parts = parts.first(1);
  ChannelSizes best{.sigma = typical};
  for (const double part : parts)
    for (const double share : shares) {
      const VarianceComponents model(data.e, data.soil, data.smooth, variance_shape(data, mean_square, share, part));
      for (int i = -32; i <= 20; ++i)
        for (const double ratio : {0.0, 0.3, 1.0, 3.0, 10.0, 40.0}) {
          ChannelSizes sizes{.sigma = typical * std::exp(sigma_step * i), .share = share, .part = part};
          sizes.tau = ratio * sizes.sigma;
          sizes.deviance = price_of(model, sizes, typical);
          if (sizes.deviance < best.deviance) best = sizes;
        }
    }
  if (!std::isfinite(best.deviance)) return best;
  return refined({data.e, data.soil, data.smooth, variance_shape(data, mean_square, best.share, best.part)}, best,
                 typical);
}

ChannelFit fit_channel(const Observations& observations, const NoiseData& data, const ChannelCells& cells,
                       const MatrixXd& basis) {
  const ChannelData channel = channel_data(observations, cells, data, basis);
  const double n = static_cast<double>(cells.cell.size()), mean_square = channel.f.squaredNorm() / n;
  const auto [sigma, tau, share, part, deviance] = likeliest(channel, mean_square);
  const VarianceComponents model(channel.e, channel.soil, channel.smooth,
                                 variance_shape(channel, mean_square, share, part));
  const double scatter = channel.spread.squaredNorm() / n;
  ChannelFit fit;
  double trace = 0.0;
  fit.chance = model.chances(sigma, tau, trace, fit.plain);
  fit.noise = {.measured = true,
               .floor = sigma * std::sqrt((1 - part) * (1 - growing_share * share) + constant_share * part),
               .growth = share > 0 ? sigma * std::sqrt((1 - part) * (growing_share * share / mean_square)) : 0.0,
               .unsteady = part > 0 ? sigma * std::sqrt(growing_share * part / scatter) : 0.0,
               .spread = upper_median({channel.spread.begin(), channel.spread.end()}),
               .freedom = std::max(1.0, n - trace),
               .rerun_sd = pooled_rerun_sd(observations, cells, data.residual)};
  return fit;
}

/// Correlation of the channels' noise. standard: rows x channels, in sd; not finite where a row has no such value.
Eigen::Matrix4d correlation_of(const MatrixXd& standard) {
  using namespace thresholds;
  Eigen::Matrix4d correlation = Eigen::Matrix4d::Identity();
  for (int a = 0; a < channel_count; ++a)
    for (int b = 0; b < a; ++b) {
      double ab = 0, aa = 0, bb = 0, n = 0;
      for (Index i = 0; i < standard.rows(); ++i) {
        const double x = standard(i, a), y = standard(i, b);
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        ab += x * y, aa += x * x, bb += y * y, n += 1;
      }
      const double shrink = n / (n + correlation_shrinkage);  // toward independence, where few runs tell
      const double rho = aa > 0 && bb > 0 ? shrink * ab / std::sqrt(aa * bb) : 0.0;
      correlation(a, b) = correlation(b, a) = std::clamp(rho, -max_correlation, max_correlation);
    }
  // Pairs of channels that were never measured together with a third one need not go together: shrunk until they do.
  // Cholesky tells the smallest eigenvalue, at ten seconds less to compile than eigenvalues.
  const auto possible = [&] {
    const Eigen::Matrix4d above = correlation - min_correlation_eigenvalue * Eigen::Matrix4d::Identity();
    return Cholesky(above).exists();
  };
  while (!possible()) {
    correlation *= 0.7;
    correlation.diagonal().setOnes();
  }
  return correlation;
}

}  // namespace

NoiseEstimate estimate_noise(const Observations& observations, const NoiseData& data) {
  NoiseEstimate estimate;
  estimate.floor.rerun_freedom = observations.rerun_freedom();
  estimate.chance.assign(observations.cells.size(), 1.0);
  const MatrixXd basis = smooth_basis(observations, thresholds::noise_functions);
  const Index rows = observations.rows.size();
  MatrixXd standard = MatrixXd::Constant(rows, channel_count, not_a_number);
  for (int channel = 0; channel < channel_count; ++channel) {
    const ChannelCells cells = gather(observations, channel);
    if (cells.cell.size() < 3) {
      estimate.floor.channels[channel] = guessed_noise(data.residual(cells.cell), data.prediction(cells.cell));
      continue;
    }
    const ChannelFit fit = fit_channel(observations, data, cells, basis);
    estimate.floor.channels[channel] = fit.noise;
    for (std::size_t i = 0; i < cells.cell.size(); ++i) {
      const Index k = i;
      estimate.chance[cells.cell[i]] = fit.chance[k];
      standard(cells.row[i], channel) =
          fit.plain[k] / fit.noise.sd(data.prediction[cells.cell[i]], observations.cells[cells.cell[i]].spread);
    }
  }
  estimate.floor.correlation = correlation_of(standard);
  return estimate;
}

}  // namespace soilbin::compare
