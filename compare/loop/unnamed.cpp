#include "compare/loop/unnamed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/loop/condition_functions.hpp"

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

/// Functions of the rows, family by family.
std::vector<MatrixXd> row_families(const Observations& observations) {
  const int most = std::clamp(static_cast<int>(observations.rows.size()) / 4, 2, 14);
  std::vector<MatrixXd> families = {with_constant(smooth_basis(observations, most))};
  for (const Covariate& c : covariates(observations))
    if (c.name == "slip" || c.name == "load" || c.name == "position" || c.name == "run")
      families.push_back(waves(c.values));
  return families;
}

/// Each channel's prediction in the run before, less that of the run: what a lagging instrument or bed would carry
/// over. Two sd of the channel's noise, at the mean size of its predictions, where it is largest.
MatrixXd carried_over(const Dataset& data, const VectorXd& prediction) {
  const Index cells = prediction.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count);
  std::array<double, channel_count> before{}, sizes{}, counts{};
  for (Index i = 0; i < cells; ++i) {
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
  const MatrixXd white = data.whitening(columns);
  const double size = std::sqrt(white.squaredNorm() / static_cast<double>(white.size()));
  return size > 0 ? MatrixXd(white / size) : white;
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

}  // namespace

std::vector<MatrixXd> unnamed_families(const Dataset& data, const VectorXd& prediction) {
  std::vector<MatrixXd> families;
  for (const MatrixXd& functions : row_families(data.observations))
    families.push_back(in_every_channel(data, prediction, functions));
  families.push_back(carried_over(data, prediction));
  families.push_back(bent(data, prediction));
  for (const Covariate& c : covariates(data.observations))
    if (c.name == "run" || c.name == "load") families.push_back(common_gain(data, prediction, c.values));
  return families;
}

double unnamed_gain(const LinearProblem& problem, const std::vector<MatrixXd>& families) {
  std::vector<double> gains;
  for (const MatrixXd& columns : families) {
    const JoinedColumns joined(problem, columns);
    for (const double size : thresholds::term_sizes) gains.push_back(joined.gain(size));
  }
  return log_mean_exp(gains);
}

}  // namespace soilbin::compare
