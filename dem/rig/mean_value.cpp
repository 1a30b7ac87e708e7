#include "dem/rig/mean_value.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace soilbin::dem {
namespace {

double mean(std::span<const double> series) {
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

/// Sum of squares about the mean.
double scatter(std::span<const double> series) {
  const double middle = mean(series);
  double sum = 0;
  for (const double x : series) sum += (x - middle) * (x - middle);
  return sum;
}

std::vector<double> block_means(std::span<const double> series, std::size_t block) {
  std::vector<double> means;
  for (std::size_t k = 0; k + block <= series.size(); k += block) means.push_back(mean(series.subspan(k, block)));
  return means;
}

}  // namespace

double autocorrelation_time(std::span<const double> series) {
  const std::size_t n = series.size();
  if (n < 4) return 1;
  const double middle = mean(series), zero = scatter(series);
  if (!(zero > 0)) return 1;
  double tau = 1;
  for (std::size_t lag = 1; lag < n / 2; ++lag) {
    double sum = 0;
    for (std::size_t k = 0; k + lag < n; ++k) sum += (series[k] - middle) * (series[k + lag] - middle);
    tau += 2 * sum / zero;
    if (static_cast<double>(lag) >= 6 * tau) break;
  }
  return std::max(tau, 1.0);
}

Estimate mean_with_error(std::span<const double> series) {
  const std::size_t n = series.size();
  if (n == 0) return {};
  if (n == 1) return {series[0], 0};
  std::size_t block = 1;
  if (n >= 8) block = std::clamp<std::size_t>(std::llround(4 * autocorrelation_time(series)), 1, n / 8);
  const std::vector<double> means = block_means(series, block);
  const double blocks = static_cast<double>(means.size());
  return {mean(series), std::sqrt(scatter(means) / (blocks * (blocks - 1)))};
}

std::size_t end_of_start_up(std::span<const double> series) {
  constexpr std::size_t five = 5;
  const std::vector<double> means = block_means(series, five);
  if (means.size() < 4) return 0;
  std::size_t best = 0;
  double least = 0;
  for (std::size_t cut = 0; cut <= means.size() / 2; ++cut) {
    const std::span<const double> rest(means.begin() + cut, means.end());
    const double n = static_cast<double>(rest.size()), variance = scatter(rest) / (n * n);
    if (cut == 0 || variance < least) least = variance, best = cut;
  }
  return best * five;
}

double drift_over_error(std::span<const double> series) {
  const std::size_t half = series.size() / 2;
  if (half < 8) return 0;
  const Estimate first = mean_with_error(series.first(half)), last = mean_with_error(series.last(half));
  const double error = std::hypot(first.std_error, last.std_error);
  const double difference = std::abs(last.value - first.value);
  return error > 0 ? difference / error : (difference > 0 ? 1e300 : 0);
}

SteadyPart steady_part(const std::vector<std::vector<double>>& series) {
  SteadyPart part;
  for (const std::vector<double>& one : series) part.from = std::max(part.from, end_of_start_up(one));
  for (const std::vector<double>& one : series)
    part.drift = std::max(part.drift, drift_over_error(std::span(one).subspan(part.from)));
  return part;
}

}  // namespace soilbin::dem
