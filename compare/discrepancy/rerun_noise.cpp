#include "compare/discrepancy/rerun_noise.hpp"

#include <cmath>

#include "compare/fit/factorizations.hpp"
#include "compare/measured/channels.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

using Setpoints = std::vector<std::vector<const Run*>>;

/// One channel's runs of one setpoint: their mean, squares about it, and how many are beyond the first.
struct Reruns {
  double mean = 0.0, squares = 0.0, freedom = 0.0;
};

std::vector<Reruns> reruns_of(const Setpoints& setpoints, std::size_t channel) {
  std::vector<Reruns> all;
  for (const auto& setpoint : setpoints) {
    const std::vector<double> values = values_of(setpoint, channel);
    if (values.size() < 2) continue;
    const double freedom = static_cast<double>(values.size() - 1);
    all.push_back({mean_of(values).value, freedom * std::pow(spread_of(values), 2), freedom});
  }
  return all;
}

/// The size of a noise of this shape that makes the re-runs likeliest, and -2 ln of their likelihood there.
std::pair<double, double> fitted_size(const std::vector<Reruns>& reruns, const ChannelNoise& shape) {
  double squares = 0.0, freedom = 0.0, log_shape = 0.0;
  for (const Reruns& r : reruns) {
    squares += r.squares / std::pow(shape.sd(r.mean), 2);
    freedom += r.freedom;
    log_shape += 2 * r.freedom * std::log(shape.sd(r.mean));
  }
  const double size = std::sqrt(squares / freedom);
  return {size, 2 * freedom * std::log(size) + log_shape};
}

ChannelNoise noise_of(const std::vector<Reruns>& reruns) {
  constexpr double enough_to_show_growth = 20, convincing = 4;  // degrees of freedom; of -2 ln likelihood
  ChannelNoise noise;
  double mean_square = 0.0;
  for (const Reruns& r : reruns) noise.freedom += r.freedom, mean_square += r.freedom * r.mean * r.mean;
  if (noise.freedom == 0.0) return noise;
  mean_square /= noise.freedom;
  ChannelNoise shape;
  shape.floor = 1.0;
  auto [size, lowest] = fitted_size(reruns, shape);
  noise.floor = noise.rerun_sd = size;
  if (noise.freedom < enough_to_show_growth || !(size > 0.0) || !(mean_square > 0.0)) return noise;
  lowest -= convincing;
  for (const double share : {0.49, 0.98}) {  // of the variance that grows, at the root mean square signal
    shape.floor = std::sqrt(1 - share), shape.growth = std::sqrt(share / mean_square);
    const auto [grown, deviance] = fitted_size(reruns, shape);
    if (deviance < lowest) lowest = deviance, noise.floor = grown * shape.floor, noise.growth = grown * shape.growth;
  }
  return noise;
}

/// Residuals about the setpoints' means in units of the noise: a row each run, NaN where a channel says nothing.
Eigen::MatrixXd residuals_of(const Setpoints& setpoints, const NoiseFloor& noise) {
  Eigen::Index rows = 0;
  for (const auto& setpoint : setpoints) rows += static_cast<Eigen::Index>(setpoint.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(rows, channel_count, not_a_number);
  Eigen::Index row = 0;
  for (const auto& setpoint : setpoints) {
    for (std::size_t c = 0; c < channel_views.size(); ++c) {
      const std::vector<double> values = values_of(setpoint, c);
      if (values.size() < 2) continue;
      const double mean = mean_of(values).value;
      for (std::size_t k = 0; k < setpoint.size(); ++k)
        if (const auto& value = setpoint[k]->*channel_views[c].measured)
          all(row + static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) =
              (*value - mean) / noise.channels[c].sd(mean);
    }
    row += static_cast<Eigen::Index>(setpoint.size());
  }
  return all;
}

Eigen::Matrix4d correlation_of(const Eigen::MatrixXd& residuals) {
  Eigen::Matrix4d correlation = Eigen::Matrix4d::Identity();
  for (Eigen::Index a = 0; a < channel_count; ++a)
    for (Eigen::Index b = 0; b < a; ++b) {
      double ab = 0, aa = 0, bb = 0;
      for (Eigen::Index i = 0; i < residuals.rows(); ++i) {
        const double x = residuals(i, a), y = residuals(i, b);
        if (std::isfinite(x) && std::isfinite(y)) ab += x * y, aa += x * x, bb += y * y;
      }
      if (aa > 0 && bb > 0) correlation(a, b) = correlation(b, a) = ab / std::sqrt(aa * bb);
    }
  // Few re-runs, or a channel computed from another, give no matrix to invert: then channels count as independent.
  const Eigen::Matrix4d above_least = correlation - 1e-6 * Eigen::Matrix4d::Identity();
  return Cholesky(above_least).exists() ? correlation : Eigen::Matrix4d::Identity();
}

}  // namespace

std::vector<double> values_of(const std::vector<const Run*>& runs, std::size_t channel) {
  std::vector<double> values;
  for (const Run* run : runs)
    if (const auto& value = run->*channel_views[channel].measured) values.push_back(*value);
  return values;
}

NoiseFloor rerun_noise(const Setpoints& setpoints) {
  NoiseFloor noise;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    noise.channels[c] = noise_of(reruns_of(setpoints, c));
    for (const auto& setpoint : setpoints)
      noise.channels[c].measured = noise.channels[c].measured || !values_of(setpoint, c).empty();
  }
  for (const auto& setpoint : setpoints) noise.rerun_freedom += static_cast<int>(setpoint.size()) - 1;
  noise.correlation = correlation_of(residuals_of(setpoints, noise));
  return noise;
}

}  // namespace soilbin::compare
