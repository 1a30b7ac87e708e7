#include "compare/attribution/unnamed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "compare/fit/condition_functions.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd in_every_channel(const Dataset& data, const VectorXd& prediction, const MatrixXd& functions) {
  const Index cells = prediction.size(), width = functions.cols();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count * width);
  for (Index i = 0; i < cells; ++i) {
    const Cell& cell = data.observations.cells[i];
    const double sd = data.noise.channels[cell.channel].sd(prediction[i], cell.spread);
    columns.row(i).segment(cell.channel * width, width) = sd * functions.row(cell.row);
  }
  return data.whitening(columns);
}

namespace {

/// Columns at the size of 1 sd a cell, where they are more than nothing.
MatrixXd of_unit_size(MatrixXd white) {
  const double size = std::sqrt(white.squaredNorm() / static_cast<double>(std::max<Index>(1, white.size())));
  return size > 0 ? MatrixXd(white / size) : white;
}

bool may_wave(const Covariate& c) {
  return c.name == "slip" || c.name == "load" || c.name == "position" || c.name == "run";
}

/// Each channel's prediction in the run before, less that of the run: what a lagging instrument or bed would carry
/// over. Two sd of the channel's noise, at the mean size of its predictions, where it is largest.
MatrixXd carried_over(const Dataset& data, const VectorXd& prediction) {
  const Index cells = prediction.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count);
  std::array<double, channel_count> before{}, sizes{}, counts{};
  for (const Index i : cells_in_order_of_runs(data.observations)) {
    const std::size_t c = (data.observations.cells[i].channel);
    if (counts[c] > 0) columns(i, c) = before[c] - prediction[i];
    before[c] = prediction[i];
    sizes[c] += std::abs(prediction[i]);
    ++counts[c];
  }
  for (std::size_t c = 0; c < channel_count; ++c) {
    auto column = columns.col(c);
    const double largest = column.cwiseAbs().maxCoeff();
    if (largest > 0)
      column *= 2 * data.noise.channels[c].sd(sizes[c] / counts[c], data.noise.channels[c].spread) / largest;
  }
  return data.whitening(columns);
}

/// A gain of all forces that waves with a covariate: an amplifier warming from day to day, a frame that gives way.
MatrixXd common_gain(const Dataset& data, const VectorXd& prediction, const VectorXd& values) {
  const MatrixXd functions = waves(values);
  MatrixXd columns = MatrixXd::Zero(prediction.size(), functions.cols());
  for (Index i = 0; i < prediction.size(); ++i) {
    const Cell& cell = data.observations.cells[i];
    if (cell.channel != sinkage) columns.row(i) = prediction[i] * functions.row(cell.row);
  }
  return of_unit_size(data.whitening(columns));
}

/// Each channel bent over its own range: Legendre's polynomials of the prediction of order 2 to 4. An instrument that
/// is not linear, whatever the conditions.
MatrixXd bent(const Dataset& data, const VectorXd& prediction) {
  constexpr int bends = 3;
  std::array<double, channel_count> low, high;
  low.fill(std::numeric_limits<double>::infinity()), high.fill(-std::numeric_limits<double>::infinity());
  const auto channel_of = [&](Index i) { return (data.observations.cells[i].channel); };
  for (Index i = 0; i < prediction.size(); ++i) {
    double &least = low[channel_of(i)], &most = high[channel_of(i)];
    least = std::min(least, prediction[i]), most = std::max(most, prediction[i]);
  }
  MatrixXd columns = MatrixXd::Zero(prediction.size(), channel_count * bends);
  for (Index i = 0; i < prediction.size(); ++i) {
    const std::size_t c = channel_of(i);
    if (!(high[c] > low[c])) continue;
    const double x = 2 * (prediction[i] - low[c]) / (high[c] - low[c]) - 1;
    for (int k = 0; k < bends; ++k)
      columns(i, c * bends + k) = data.noise.channels[c].sd(prediction[i], data.observations.cells[i].spread) *
                                  std::sqrt(2.0 * k + 5) * std::legendre(static_cast<unsigned>(k) + 2, x);
  }
  return data.whitening(columns);
}

/// Slopes of the predictions over one of the conditions, by a step toward 0: a slip stays between -1 and 1.
std::optional<VectorXd> slope_over(const FittedModel& base, double OperatingCondition::*condition, double step) {
  const Observations& observations = base.data().observations;
  const auto step_of = [&](const OperatingCondition& at) { return at.*condition > 0.0 ? -step : step; };
  Observations moved = observations;
  for (OperatingCondition& at : moved.rows) at.*condition += step_of(at);
  BalanceMemory memory = base.fit().balance;
  VectorXd slope;
  if (!base.predictor().over(moved).predict(base.fit().theta, slope, memory)) return std::nullopt;
  slope -= base.fit().prediction;
  for (Index i = 0; i < slope.size(); ++i) slope[i] /= step_of(observations.rows[observations.cells[i].row]);
  return slope;
}

/// Slopes times 1 and times each condition that varies, taken to -1 .. 1.
MatrixXd misread(const FittedModel& base, const VectorXd& slope) {
  const Observations& observations = base.data().observations;
  const std::vector<Covariate> variables = covariates(observations);
  MatrixXd columns(slope.size(), 1 + static_cast<Index>(variables.size()));
  columns.col(0) = slope;
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const VectorXd u = to_unit_interval(variables[v].values);
    for (Index i = 0; i < slope.size(); ++i)
      columns(i, static_cast<Index>(v) + 1) = slope[i] * u[observations.cells[i].row];
  }
  return of_unit_size(base.data().whitening(columns));
}

}  // namespace

std::vector<UnnamedKind> unnamed_functions(const Dataset& data, const VectorXd& prediction) {
  const Observations& observations = data.observations;
  UnnamedKind smooth{Unnamed::smooth, {}};
  smooth.families.push_back(
      in_every_channel(data, prediction, with_constant(smooth_basis(observations, unnamed_columns(observations)))));
  UnnamedKind wave{Unnamed::wave, {}}, wave_of_one{Unnamed::wave_of_one_channel, {}};
  UnnamedKind gain{Unnamed::gain_of_forces, {}};
  for (const Covariate& c : covariates(observations)) {
    if (!may_wave(c)) continue;
    const MatrixXd functions = waves(c.values);
    wave.families.push_back(in_every_channel(data, prediction, functions));
    for (Index channel = 0; channel < channel_count; ++channel) {
      const auto own = wave.families.back().middleCols(channel * functions.cols(), functions.cols());
      if (own.squaredNorm() > 0) wave_of_one.families.emplace_back(own);
    }
    if (c.name == "run" || c.name == "load") gain.families.push_back(common_gain(data, prediction, c.values));
  }
  UnnamedKind before{Unnamed::run_before, {carried_over(data, prediction)}};
  UnnamedKind bend{Unnamed::bent_channel, {bent(data, prediction)}};
  std::vector<UnnamedKind> kinds = {smooth, wave, wave_of_one, gain, before, bend};
  std::erase_if(kinds, [](const UnnamedKind& kind) { return kind.families.empty(); });
  return kinds;
}

std::vector<UnnamedKind> unnamed_kinds(const FittedModel& base) {
  std::vector<UnnamedKind> kinds = unnamed_functions(base.data(), base.fit().prediction);
  UnnamedKind misreads{Unnamed::misread_condition, {}};
  const double load = base.data().observations.rows.front().load;
  if (const auto slope = slope_over(base, &OperatingCondition::slip, 1e-4))
    misreads.families.push_back(misread(base, *slope));
  if (const auto slope = slope_over(base, &OperatingCondition::load, 1e-4 * load))
    misreads.families.push_back(misread(base, *slope));
  if (!misreads.families.empty()) kinds.push_back(std::move(misreads));
  return kinds;
}

UnnamedEvidence unnamed_evidence(const LinearProblem& problem, const std::vector<UnnamedKind>& kinds) {
  std::vector<double> of_kinds;
  for (const UnnamedKind& kind : kinds) {
    std::vector<double> gains;
    for (const MatrixXd& columns : kind.families) {
      const JoinedColumns joined(problem, columns);
      for (const double size : thresholds::term_sizes) gains.push_back(joined.gain(size));
    }
    of_kinds.push_back(log_mean_exp(gains));
  }
  const auto most_likely = std::ranges::max_element(of_kinds) - of_kinds.begin();
  return {log_mean_exp(of_kinds), kinds[static_cast<std::size_t>(most_likely)].kind};
}

}  // namespace soilbin::compare
