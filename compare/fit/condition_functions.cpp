#include "compare/fit/condition_functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/fit/factorizations.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Adds a column scaled to mean 0 and mean square 1, unless it is (nearly) a combination of those there.
class BasisBuilder {
 public:
  BasisBuilder(Index rows, int most) : rows_(rows), most_(most) {}
  void add(VectorXd column) {
    if (static_cast<int>(columns_.size()) >= most_) return;
    column.array() -= column.mean();
    const double size = std::sqrt(column.squaredNorm() / static_cast<double>(rows_));
    if (!(size > 1e-9)) return;
    column /= size;
    VectorXd rest = column;
    for (const VectorXd& q : orthonormal_) rest -= q.dot(rest) * q;
    if (rest.squaredNorm() < 1e-4 * static_cast<double>(rows_)) return;
    orthonormal_.push_back(rest.normalized());
    columns_.push_back(std::move(column));
  }
  MatrixXd build() const {
    MatrixXd basis(rows_, columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) basis.col(i) = columns_[i];
    return basis;
  }

 private:
  Index rows_;
  int most_;
  std::vector<VectorXd> columns_, orthonormal_;
};

}  // namespace

VectorXd to_unit_interval(const VectorXd& values) {
  const double low = values.minCoeff(), high = values.maxCoeff();
  return ((values.array() - low) * (2 / (high - low)) - 1).matrix();
}

MatrixXd with_constant(const MatrixXd& functions) {
  MatrixXd all(functions.rows(), functions.cols() + 1);
  all << VectorXd::Ones(functions.rows()), functions;
  return all;
}

MatrixXd smooth_basis(const Observations& observations, int max_columns) {
  BasisBuilder basis(observations.rows.size(), max_columns);
  std::vector<VectorXd> u;
  for (const Covariate& c : covariates(observations)) u.push_back(to_unit_interval(c.values));
  for (const VectorXd& x : u) basis.add(x);
  if (!u.empty()) basis.add(u[0].array().square());
  if (!u.empty()) basis.add(u[0].array().cube());
  for (std::size_t i = 1; i < u.size(); ++i) basis.add(u[0].array() * u[i].array());
  for (std::size_t i = 1; i < u.size(); ++i) basis.add(u[i].array().square());
  for (std::size_t i = 2; i < u.size(); ++i) basis.add(u[1].array() * u[i].array());
  for (std::size_t i = 1; i < u.size(); ++i) basis.add(u[0].array().square() * u[i].array());
  return basis.build();
}

int unnamed_columns(const Observations& observations) {
  return std::clamp(static_cast<int>(observations.rows.size()) / thresholds::runs_a_smooth_function,
                    thresholds::min_smooth_functions, thresholds::max_smooth_functions);
}

MatrixXd waves(const VectorXd& values) {
  const int most = std::clamp(static_cast<int>(values.size()) / thresholds::runs_a_wave, 1, thresholds::max_waves);
  const double low = values.minCoeff(), high = values.maxCoeff();
  MatrixXd columns(values.size(), 2 * most);
  for (int k = 1; k <= most; ++k)
    for (Index i = 0; i < values.size(); ++i) {
      const double phase = 2 * std::numbers::pi * k * (values[i] - low) / (1.05 * (high - low));
      columns(i, 2 * k - 2) = std::sqrt(2.0) * std::sin(phase);
      columns(i, 2 * k - 1) = std::sqrt(2.0) * std::cos(phase);
    }
  return columns;
}

namespace {

/// Weights of the columns with normal priors of the size of largest evidence, noise of 1.
VectorXd ridge(const MatrixXd& columns, const VectorXd& residual) {
  const MatrixXd gram = columns.transpose() * columns;
  const VectorXd seen = columns.transpose() * residual;
  VectorXd weights = VectorXd::Zero(columns.cols());
  double most = 0.0;  // ln evidence over no term at all
  for (const double size : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    MatrixXd m = gram;
    m.diagonal().array() += 1 / (size * size);
    const Cholesky factor(m);
    const VectorXd found = factor.solve(seen);
    const double gain =
        0.5 * seen.dot(found) - factor.half_log_determinant() - static_cast<double>(columns.cols()) * std::log(size);
    if (gain > most) most = gain, weights = found;
  }
  return weights;
}

}  // namespace

VectorXd smooth_term(const Observations& all, const std::vector<bool>& kept, const VectorXd& prediction,
                     const NoiseFloor& noise) {
  const MatrixXd basis = with_constant(smooth_basis(all, unnamed_columns(all)));
  VectorXd term = VectorXd::Zero(prediction.size());
  for (int channel = 0; channel < channel_count; ++channel) {
    std::vector<Index> training;
    for (Index i = 0; i < prediction.size(); ++i) {
      const Cell& cell = all.cells[i];
      if (cell.channel == channel && kept[cell.row] && std::isfinite(prediction[i])) training.push_back(i);
    }
    MatrixXd columns(training.size(), basis.cols());
    VectorXd residual(columns.rows());
    const auto sd = [&](Index i) { return noise.channels[channel].sd(prediction[i], all.cells[i].spread); };
    for (Index k = 0; k < columns.rows(); ++k) {
      const Index i = training[k];
      const Cell& cell = all.cells[i];
      columns.row(k) = basis.row(cell.row);
      residual[k] = (cell.value - prediction[i]) / sd(i);
    }
    if (training.empty()) continue;
    const VectorXd weights = ridge(columns, residual);
    for (Index i = 0; i < prediction.size(); ++i) {
      const Cell& cell = all.cells[i];
      if (cell.channel == channel) term[i] = sd(i) * basis.row(cell.row).dot(weights);
    }
  }
  return term;
}

}  // namespace soilbin::compare
