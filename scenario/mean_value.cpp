#include "scenario/mean_value.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace soilbin {
namespace {

double mean_of_series(std::span<const double> series) {
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

/// Sum of squares about the mean.
double scatter(std::span<const double> series) {
  const double middle = mean_of_series(series);
  double sum = 0;
  for (const double x : series) sum += (x - middle) * (x - middle);
  return sum;
}

std::vector<double> block_means(std::span<const double> series, std::size_t block) {
  std::vector<double> means;
  for (std::size_t k = 0; k + block <= series.size(); k += block)
    means.push_back(mean_of_series(series.subspan(k, block)));
  return means;
}

}  // namespace

namespace {

/// Autocorrelations of a series, each made when it is first asked for; of a constant one none may be asked for.
class Autocorrelations {
 public:
  explicit Autocorrelations(std::span<const double> series)
      : series_(series), middle_(mean_of_series(series)), zero_(scatter(series)) {}
  /// lag: 1 .. n/2 - 1, or one more than the largest asked for before.
  double operator()(std::size_t lag) {
    while (found_.size() < lag) {
      double sum = 0;
      for (std::size_t k = 0, next = found_.size() + 1; k + next < series_.size(); ++k)
        sum += (series_[k] - middle_) * (series_[k + next] - middle_);
      found_.push_back(sum / zero_);
    }
    return found_[lag - 1];
  }
  std::size_t samples() const { return series_.size(); }

 private:
  std::span<const double> series_;
  double middle_, zero_;
  std::vector<double> found_;
};

/// 1 + 2 sum of weighted(lag, rho), up to the first lag that is at least six times the sum so far; 1 at least.
double summed(Autocorrelations& rho, const auto& weighted) {
  double tau = 1;
  for (std::size_t lag = 1; lag < rho.samples() / 2; ++lag) {
    tau += 2 * weighted(static_cast<double>(lag), rho(lag));
    if (static_cast<double>(lag) >= 6 * tau) break;
  }
  return std::max(tau, 1.0);
}

double as_found(double, double rho) { return rho; }

/// Variance of a series and its autocorrelation time, from what is left of few autocorrelation times once `fitted`
/// numbers are fitted to them. Such samples look more alike and less correlated than they are: sum (x - fit)^2 = (n -
/// fitted tau) variance, and each autocorrelation comes out too small by about fitted tau/n. Both are put right, with
/// the tau found, n/(3 fitted) samples at most.
struct Fluctuation {
  double variance, tau;
};
Fluctuation fluctuation_of_few(std::span<const double> series, Autocorrelations& correlations, double fitted) {
  const double n = static_cast<double>(series.size());
  constexpr int rounds = 8;
  double tau = 1;
  for (int round = 0; round < rounds; ++round) {
    const double bias = std::min(fitted * tau / n, 0.5);
    tau = summed(correlations, [&](double lag, double rho) { return (1 - bias) * rho + (1 - lag / n) * bias; });
  }
  tau = std::min(tau, n / (3 * fitted));
  return {scatter(series) / (n - fitted * tau), tau};
}

/// The standard error of a mean over few autocorrelation times.
double error_of_few(std::span<const double> series, Autocorrelations& correlations) {
  const double n = static_cast<double>(series.size());
  const auto [variance, tau] = fluctuation_of_few(series, correlations, 1);
  return std::sqrt(variance * tau / n);
}

constexpr std::size_t fewest_for_trend = 16;  // samples

struct BlockAverage {
  Estimate mean;
  bool enough = true;  ///< eight blocks of four autocorrelation times fit; else they were shorter
};

/// series: not empty; rho: its own.
BlockAverage block_average(std::span<const double> series, Autocorrelations& rho) {
  constexpr std::size_t fewest = 8;
  const std::size_t n = series.size();
  if (n == 1) return {{series[0], 0}};
  std::size_t wanted = 1;
  if (n >= fewest && scatter(series) > 0) wanted = static_cast<std::size_t>(std::llround(4 * summed(rho, as_found)));
  const std::size_t most = std::max<std::size_t>(n / fewest, 1);
  const std::vector<double> means = block_means(series, std::min(wanted, most));
  const double blocks = static_cast<double>(means.size());
  return {{mean_of_series(series), std::sqrt(scatter(means) / (blocks * (blocks - 1)))}, wanted <= most};
}

BlockAverage block_average(std::span<const double> series) {
  Autocorrelations rho(series);
  return block_average(series, rho);
}

}  // namespace

double autocorrelation_time(std::span<const double> series) {
  if (series.size() < 4 || !(scatter(series) > 0)) return 1;
  Autocorrelations correlations(series);
  return summed(correlations, as_found);
}

Estimate mean_with_error(std::span<const double> series) {
  if (series.empty()) return {};
  Autocorrelations rho(series);
  BlockAverage average = block_average(series, rho);
  if (!average.enough) average.mean.std_error = std::max(average.mean.std_error, error_of_few(series, rho));
  return average.mean;
}

Estimate mean_of_repeats(std::span<const Estimate> repeats) {
  std::vector<double> values;
  double squares = 0.0;
  for (const Estimate& one : repeats) values.push_back(one.value), squares += one.std_error * one.std_error;
  const Estimate mean = mean_of(values);
  return {mean.value, std::max(mean.std_error, std::sqrt(squares) / static_cast<double>(values.size()))};
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
  // A trend within a half is no few times of correlation: it is what is asked for.
  const Estimate first = block_average(series.first(half)).mean, last = block_average(series.last(half)).mean;
  const double error = std::hypot(first.std_error, last.std_error);
  const double difference = std::abs(last.value - first.value);
  return error > 0 ? difference / error : (difference > 0 ? 1e300 : 0);
}

namespace {

/// The fluctuation of a series less each fifth's mean: a trend over the whole, or a last fifth that differs, is not in
/// it.
Fluctuation fluctuation_within_fifths(std::span<const double> series) {
  constexpr std::size_t fifths = 5;
  std::vector<double> rest;
  for (std::size_t k = 0; k < fifths; ++k) {
    const std::size_t from = series.size() * k / fifths, to = series.size() * (k + 1) / fifths;
    const double middle = mean_of_series(series.subspan(from, to - from));
    for (std::size_t at = from; at < to; ++at) rest.push_back(series[at] - middle);
  }
  if (!(scatter(rest) > 0)) return {0, 1};
  Autocorrelations rho(rest);
  return fluctuation_of_few(rest, rho, fifths);
}

/// A change of the mean within a series over its standard error; `independent`: it has the variance of a mean of so
/// many independent samples. 0 for a change that rounding makes.
double over_error(double change, std::span<const double> series, double independent) {
  constexpr double rounding = 1e-12;
  const auto [lowest, highest] = std::ranges::minmax(series);
  if (std::abs(change) <= rounding * std::max(std::abs(lowest), std::abs(highest))) return 0;
  const auto [variance, tau] = fluctuation_within_fifths(series);
  const double error = std::sqrt(variance * tau / independent);
  return error > 0 ? std::abs(change) / error : 1e300;
}

}  // namespace

double trend_over_error(std::span<const double> series) {
  if (series.size() < fewest_for_trend) return 0;
  const double middle = mean_of_series(series), centre = static_cast<double>(series.size() - 1) / 2;
  double products = 0, squares = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double at = static_cast<double>(k) - centre;
    products += at * (series[k] - middle), squares += at * at;
  }
  const double length = static_cast<double>(series.size() - 1);
  return over_error(length * products / squares, series, squares / (length * length));
}

double last_fifth_over_error(std::span<const double> series) {
  if (series.size() < fewest_for_trend) return 0;
  const std::size_t last = series.size() / 5, before = series.size() - last;
  const double difference = mean_of_series(series.last(last)) - mean_of_series(series.first(before));
  const double independent = 1 / (1 / static_cast<double>(before) + 1 / static_cast<double>(last));
  return over_error(difference, series, independent);
}

SteadyPart steady_part(const std::vector<std::vector<double>>& series) {
  SteadyPart part;
  for (const std::vector<double>& one : series) part.from = std::max(part.from, end_of_start_up(one));
  for (const std::vector<double>& one : series) {
    const std::span<const double> kept = std::span(one).subspan(part.from);
    part.drift = std::max({part.drift, drift_over_error(kept), trend_over_error(kept), last_fifth_over_error(kept)});
  }
  return part;
}

}  // namespace soilbin
