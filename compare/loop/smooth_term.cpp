#include "compare/loop/smooth_term.hpp"

#include <algorithm>
#include <cmath>

#include "compare/loop/condition_functions.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
    const Eigen::LLT<MatrixXd> llt(m);
    const VectorXd found = llt.solve(seen);
    const double gain = 0.5 * seen.dot(found) - llt.matrixLLT().diagonal().array().log().sum() -
                        static_cast<double>(columns.cols()) * std::log(size);
    if (gain > most) most = gain, weights = found;
  }
  return weights;
}

}  // namespace

VectorXd smooth_term(const Observations& all, const std::vector<bool>& kept, const VectorXd& prediction,
                     const NoiseFloor& noise) {
  const int most = std::clamp(static_cast<int>(all.rows.size()) / 4, 2, 14);
  const MatrixXd basis = with_constant(smooth_basis(all, most));
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
