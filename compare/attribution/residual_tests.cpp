#include "compare/attribution/residual_tests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "bekker_wong/gsl.hpp"
#include "compare/fit/setpoint_squares.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LackOfFit lack_of_fit(const FittedModel& model) {
  LackOfFit test;
  test.freedom = std::max(1.0, static_cast<double>(model.data().cells()) - model.absorbed_freedom());
  test.noise_freedom = std::max(1.0, model.data().noise.freedom());
  test.f = model.fit().chi2_cells / test.freedom;
  test.p_value = gsl::f_tail(test.f, test.freedom, test.noise_freedom);
  return test;
}

namespace {

/// h^2/12 of each channel, the variance of what is read to steps of h, with h the smallest step between two of its
/// values; 0 where all are alike. Re-runs that read alike are no re-runs without noise.
std::array<double, channel_count> reading_variance(const Observations& observations) {
  std::array<std::vector<double>, channel_count> values;
  for (const Cell& cell : observations.cells) values[cell.channel].push_back(cell.value);
  std::array<double, channel_count> variance{};
  for (int c = 0; c < channel_count; ++c) {
    std::ranges::sort(values[c]);
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < values[c].size(); ++i)
      if (const double gap = values[c][i] - values[c][i - 1]; gap > 0.0) step = std::min(step, gap);
    if (std::isfinite(step)) variance[c] = step * step / 12;
  }
  return variance;
}

}  // namespace

RerunTest rerun_test(const FittedModel& model) {
  const Observations& observations = model.data().observations;
  std::vector<SetpointSquares> channels(channel_count, SetpointSquares(observations.conditions));
  const std::array<double, channel_count> read_to = reading_variance(observations);
  std::array<double, channel_count> rounding{};  // summed over the values, in the noise's unit
  for (std::size_t i = 0; i < observations.cells.size(); ++i) {
    const Cell& cell = observations.cells[i];
    const double f = model.fit().prediction[i];
    const auto c = cell.channel;
    const double sd = model.data().noise.channels[c].sd(f, cell.spread);
    channels[c].add(observations.condition[cell.row], (cell.value - f) / sd);
    rounding[c] += read_to[c] / (sd * sd);
  }
  double setpoints = 0.0;
  for (const SetpointSquares& s : channels) setpoints += s.setpoints();
  const double taken = model.absorbed_freedom() / std::max(1.0, setpoints);  // of each setpoint's freedom
  RerunTest test;
  int tested = 0;
  double least = 1.0;
  for (int c = 0; c < channel_count; ++c) {
    const SetpointSquares& s = channels[c];
    const double freedom = s.setpoints() * (1 - taken) - 1, reruns = s.reruns();
    const double pure = s.within() / reruns + rounding[c] / (s.setpoints() + reruns);
    if (reruns < thresholds::min_reruns || freedom < 1.0 || !(pure > 0.0)) continue;
    ++tested;
    const double between = s.between() - s.largest();
    test.excess += std::max(0.0, between - freedom * pure);
    least = std::min(least, gsl::f_tail(between / freedom / pure, freedom, reruns));
  }
  if (tested > 0) test.p_value = std::min(1.0, tested * least);
  return test;
}

namespace {

/// Residuals in the order of the runs, of one channel or of a gain, of unit size where only noise is there.
struct RunSeries {
  std::optional<int> channel{};  ///< none: of a gain
  std::vector<double> values{};
};

std::vector<RunSeries> run_series(const FittedModel& model) {
  const Observations& observations = model.data().observations;
  const std::vector<Index> by_run = cells_in_order_of_runs(observations);
  std::vector<RunSeries> all(channel_count + 1);
  for (int c = 0; c < channel_count; ++c) all[c].channel = c;
  RunSeries& gain = all.back();
  double score = 0.0, weight = 0.0;
  for (std::size_t k = 0; k < by_run.size(); ++k) {
    const Cell& cell = observations.cells[by_run[k]];
    const double f = model.fit().prediction[by_run[k]];
    const double sd = model.data().noise.channels[cell.channel].sd(f, cell.spread);
    all[cell.channel].values.push_back((cell.value - f) / sd);
    if (cell.channel != sinkage) score += (cell.value - f) * f / (sd * sd), weight += f * f / (sd * sd);
    const bool last = k + 1 == by_run.size() || observations.cells[by_run[k + 1]].row != cell.row;
    if (!last) continue;
    if (weight > 0) gain.values.push_back(score / std::sqrt(weight));
    score = weight = 0.0;
  }
  return all;
}

/// Sum of the products with the 1, 2, .. lags values before, Bartlett's weights 1 - k/(lags + 1): half of the squared
/// sums of lags + 1 neighbours (beyond the ends are zeros) over their number, less the squares that are in them.
double serial_correlation(const VectorXd& r, Index lags) {
  const Index n = r.size(), width = lags + 1;
  double window = 0.0, squares = 0.0;
  for (Index last = 0; last < n + lags; ++last) {
    if (last < n) window += r[last];
    if (last >= width) window -= r[last - width];
    squares += window * window;
  }
  return 0.5 * (squares / static_cast<double>(width) - r.squaredNorm());
}

}  // namespace

SerialTest serial_test(const FittedModel& model, int permutations, std::uint64_t seed) {
  SerialTest test;
  const std::vector<Covariate> variables = covariates(model.data().observations);
  if (std::ranges::find(variables, "run", &Covariate::name) == variables.end()) return test;
  std::mt19937_64 random(seed);
  int tested = 0;
  double least = 2.0;
  for (const RunSeries& series : run_series(model)) {
    if (series.values.size() < thresholds::min_serial_runs) continue;
    ++tested;
    VectorXd r = Eigen::Map<const VectorXd>(series.values.data(), static_cast<Index>(series.values.size()));
    r.array() -= r.mean();
    const Index lags = std::max<Index>(1, r.size() / thresholds::serial_runs_a_lag);
    const double seen = serial_correlation(r, lags);
    int reached = 0;
    for (int k = 0; k < permutations; ++k) {
      std::shuffle(r.begin(), r.end(), random);
      if (serial_correlation(r, lags) >= seen) ++reached;
    }
    const double p = (reached + 1.0) / (permutations + 1.0);
    if (p < least) least = p, test.channel = series.channel;
  }
  if (tested > 0) test.p_value = std::min(1.0, tested * least);
  return test;
}

namespace {

/// Orthonormal columns of 1, u, u^2 over one channel's cells; empty where the variable takes one value there.
MatrixXd parabola(const std::vector<double>& u) {
  const Index n = u.size();
  const auto [low, high] = std::ranges::minmax_element(u);
  if (!(*high > *low)) return MatrixXd(n, 0);
  MatrixXd columns(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double x = 2 * (u[i] - *low) / (*high - *low) - 1;
    columns.row(i) << 1.0, x, x * x;
  }
  return orthonormal(columns);
}

double explained(const MatrixXd& q, const VectorXd& r, double mean) {
  const VectorXd centred = r.array() - mean;
  const double whole = centred.squaredNorm();
  return whole > 0 ? (q.transpose() * centred).squaredNorm() / whole : 0.0;
}

/// False-discovery rates: the least m p/rank of m p-values among those no smaller than a p-value.
void tell_false_discovery_rates(std::vector<Dependence>& table) {
  std::vector<Dependence*> by_p;
  for (Dependence& d : table) by_p.push_back(&d);
  std::ranges::stable_sort(by_p, [](const Dependence* a, const Dependence* b) { return a->p_value < b->p_value; });
  double least = 1.0;
  for (std::size_t i = by_p.size(); i-- > 0;) {
    least = std::min(least, by_p[i]->p_value * static_cast<double>(by_p.size()) / static_cast<double>(i + 1));
    by_p[i]->false_discovery_rate = least;
  }
}

}  // namespace

std::vector<Dependence> dependences(const Observations& observations, const VectorXd& residual, int permutations,
                                    std::uint64_t seed) {
  std::vector<Dependence> table;
  std::mt19937_64 random(seed);
  const std::vector<Covariate> variables = covariates(observations);
  for (int channel = 0; channel < channel_count; ++channel) {
    std::vector<double> values;
    std::vector<int> rows, setpoints;
    for (std::size_t i = 0; i < observations.cells.size(); ++i)
      if (observations.cells[i].channel == channel) {
        values.push_back(residual[i]);
        rows.push_back(observations.cells[i].row);
        setpoints.push_back(observations.condition[rows.back()]);
      }
    if (values.size() < 6) continue;
    const VectorXd r = Eigen::Map<VectorXd>(values.data(), values.size());
    const SetpointPermutation rearranged(setpoints);
    for (const Covariate& variable : variables) {
      std::vector<double> u;
      for (const int row : rows) u.push_back(variable.values[row]);
      const MatrixXd q = parabola(u);
      if (q.cols() < 2) continue;
      Dependence d{channel, variable.name, explained(q, r, r.mean()), 1.0};
      constexpr double same = 1 - 1e-12;  // the same values in other places, summed in another order
      int reached = 0;
      for (int k = 0; k < permutations; ++k)
        if (explained(q, rearranged(r, random), r.mean()) >= same * d.share) ++reached;
      d.p_value = (reached + 1.0) / (permutations + 1.0);
      table.push_back(d);
    }
  }
  tell_false_discovery_rates(table);
  return table;
}

ResidualTests test_residual(const FittedModel& model, std::uint64_t seed) {
  return {lack_of_fit(model), rerun_test(model), serial_test(model, thresholds::serial_rearrangements, seed)};
}

}  // namespace soilbin::compare
