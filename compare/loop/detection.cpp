#include "compare/loop/detection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "bekker_wong/gsl.hpp"
#include "compare/loop/evidence.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LackOfFit lack_of_fit(const Fit& fit, const NoiseFloor& noise, Index cells) {
  LackOfFit test;
  const MatrixXd data = fit.columns.topRows(cells);
  MatrixXd gram = fit.columns.transpose() * fit.columns;
  gram.diagonal().array() += 1e-12;
  const double absorbed = (gram.ldlt().solve(data.transpose() * data)).trace();  // freedom that the soil takes
  test.freedom = std::max(1.0, static_cast<double>(cells) - absorbed);
  test.noise_freedom = std::max(1.0, noise.freedom());
  test.f = fit.chi2_cells / test.freedom;
  test.p_value = gsl::f_tail(test.f, test.freedom, test.noise_freedom);
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
    std::vector<int> rows;
    for (std::size_t i = 0; i < observations.cells.size(); ++i)
      if (observations.cells[i].channel == channel) {
        values.push_back(residual[static_cast<Index>(i)]);
        rows.push_back(observations.cells[i].row);
      }
    if (values.size() < 6) continue;
    const VectorXd r = Eigen::Map<VectorXd>(values.data(), static_cast<Index>(values.size()));
    for (const Covariate& variable : variables) {
      std::vector<double> u;
      for (const int row : rows) u.push_back(variable.values[row]);
      const MatrixXd q = parabola(u);
      if (q.cols() < 2) continue;
      Dependence d{channel, variable.name, explained(q, r, r.mean()), 1.0};
      VectorXd shuffled = r;
      int reached = 0;
      for (int k = 0; k < permutations; ++k) {
        for (Index i = shuffled.size() - 1; i > 0; --i)
          std::swap(shuffled[i], shuffled[static_cast<Index>(random() % static_cast<std::uint64_t>(i + 1))]);
        if (explained(q, shuffled, r.mean()) >= d.share) ++reached;
      }
      d.p_value = (reached + 1.0) / (permutations + 1.0);
      table.push_back(d);
    }
  }
  return table;
}

}  // namespace soilbin::compare
