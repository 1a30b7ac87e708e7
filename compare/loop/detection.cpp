#include "compare/loop/detection.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "bekker_wong/gsl.hpp"
#include "compare/loop/evidence.hpp"
#include "compare/loop/setpoint_permutation.hpp"
#include "compare/loop/setpoint_squares.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Degrees of freedom of the cells that the soil's values and the terms take, as far as their priors let them.
double absorbed_freedom(const Fit& fit, Index cells) {
  const MatrixXd data = fit.columns.topRows(cells);
  MatrixXd gram = fit.columns.transpose() * fit.columns;
  gram.diagonal().array() += 1e-12;
  return (gram.ldlt().solve(data.transpose() * data)).trace();
}

}  // namespace

LackOfFit lack_of_fit(const Fit& fit, const NoiseFloor& noise, Index cells) {
  LackOfFit test;
  test.freedom = std::max(1.0, static_cast<double>(cells) - absorbed_freedom(fit, cells));
  test.noise_freedom = std::max(1.0, noise.freedom());
  test.f = fit.chi2_cells / test.freedom;
  test.p_value = gsl::f_tail(test.f, test.freedom, test.noise_freedom);
  return test;
}

RerunTest rerun_test(const Observations& observations, const NoiseFloor& noise, const Fit& fit) {
  constexpr double least_reruns = 4.0;  // fewer tell next to nothing of the noise
  std::vector<SetpointSquares> channels(channel_count, SetpointSquares(observations.conditions));
  for (std::size_t i = 0; i < observations.cells.size(); ++i) {
    const Cell& cell = observations.cells[i];
    const double f = fit.prediction[static_cast<Index>(i)];
    const auto c = static_cast<std::size_t>(cell.channel);
    channels[c].add(observations.condition[static_cast<std::size_t>(cell.row)],
                    (cell.value - f) / noise.channels[c].sd(f));
  }
  const auto cells = static_cast<Index>(observations.cells.size());
  double setpoints = 0.0;
  for (const SetpointSquares& s : channels) setpoints += s.setpoints();
  const double taken = absorbed_freedom(fit, cells) / std::max(1.0, setpoints);  // of each setpoint's freedom
  RerunTest test;
  int tested = 0;
  double least = 1.0;
  for (const SetpointSquares& s : channels) {
    const double freedom = s.setpoints() * (1 - taken) - 1, reruns = s.reruns();
    if (reruns < least_reruns || freedom < 1.0) continue;
    ++tested;
    const double pure = s.within() / reruns, between = s.between() - s.largest();
    test.excess += std::max(0.0, between - freedom * pure);
    least = std::min(least, gsl::f_tail(between / freedom / pure, freedom, reruns));
  }
  if (tested > 0) test.p_value = std::min(1.0, tested * least);
  return test;
}

namespace {

/// Orthonormal columns of 1, u, u^2 over one channel's cells; empty where the variable takes one value there.
MatrixXd parabola(const std::vector<double>& u) {
  const Index n = static_cast<Index>(u.size());
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  if (!(*high > *low)) return MatrixXd(n, 0);
  MatrixXd columns(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double x = 2 * (u[static_cast<std::size_t>(i)] - *low) / (*high - *low) - 1;
    columns.row(i) << 1.0, x, x * x;
  }
  return orthonormal(columns);
}

double explained(const MatrixXd& q, const VectorXd& r, double mean) {
  const VectorXd centred = r.array() - mean;
  const double whole = centred.squaredNorm();
  return whole > 0 ? (q.transpose() * centred).squaredNorm() / whole : 0.0;
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
        values.push_back(residual[static_cast<Index>(i)]);
        rows.push_back(observations.cells[i].row);
        setpoints.push_back(observations.condition[static_cast<std::size_t>(rows.back())]);
      }
    if (values.size() < 6) continue;
    const VectorXd r = Eigen::Map<VectorXd>(values.data(), static_cast<Index>(values.size()));
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
  return table;
}

}  // namespace soilbin::compare
