#include "compare/loop/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Projector::Projector(const MatrixXd& columns) {
  if (columns.cols() == 0) {
    q_.resize(columns.rows(), 0);
    return;
  }
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  q_ = qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

MatrixXd form_columns(const Observations& observations, const Whitening& whitening, const VectorXd& contribution) {
  constexpr int smooth_columns = 6;
  const MatrixXd basis = smooth_basis(observations, smooth_columns);
  const Index cells = contribution.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count * (basis.cols() + 1));
  Index used = 0;
  for (int channel = 0; channel < channel_count; ++channel)
    for (Index b = -1; b < basis.cols(); ++b) {
      for (Index i = 0; i < cells; ++i) {
        const Cell& cell = observations.cells[static_cast<std::size_t>(i)];
        if (cell.channel == channel) columns(i, used) = contribution[i] * (b < 0 ? 1.0 : basis(cell.row, b));
      }
      if (columns.col(used).squaredNorm() > 0) ++used;
    }
  const double each = form_tolerance / std::sqrt(static_cast<double>(basis.cols() + 1));
  return each * whitening(MatrixXd(columns.leftCols(used)));
}

VectorXd LinearProblem::padded(const VectorXd& signature) const {
  VectorXd full = VectorXd::Zero(residual.size());
  full.head(signature.size()) = signature;
  return full;
}

LinearProblem linear_problem(const WheelPredictor& predictor, const Fit& fit, Index cells,
                             const MatrixXd& tolerance) {
  const Index rows = fit.residual.size(), extra = tolerance.cols();
  LinearProblem p;
  p.cells = cells;
  for (std::size_t c = 0; c < fit.column_parameter.size(); ++c)
    for (int t = 0; t < static_cast<int>(predictor.terms().size()); ++t)
      if (fit.column_parameter[c] == predictor.amplitude_index(t)) p.amplitudes.push_back(static_cast<Index>(c));
  p.residual = VectorXd::Zero(rows + extra);
  p.residual.head(rows) = fit.residual;
  p.nuisance = MatrixXd::Zero(rows + extra, fit.columns.cols() + extra);
  p.nuisance.topLeftCorner(rows, fit.columns.cols()) = fit.columns;
  if (extra > 0) {
    p.nuisance.topRightCorner(cells, extra) = tolerance;
    p.nuisance.bottomRightCorner(extra, extra).setIdentity();
  }
  return p;
}

namespace {

constexpr double amplitude_range = 12.0;  // sd: effects worth naming are a few to a few tens of sd in all

/// ln det of the Gram matrix of all columns but the amplitudes: with an amplitude's column scaled to unit length off
/// the others, the determinant of all is that of the others.
double log_determinant(const LinearProblem& problem) {
  std::vector<Index> others;
  for (Index c = 0; c < problem.nuisance.cols(); ++c)
    if (std::find(problem.amplitudes.begin(), problem.amplitudes.end(), c) == problem.amplitudes.end())
      others.push_back(c);
  MatrixXd columns(problem.nuisance.rows(), static_cast<Index>(others.size()));
  for (std::size_t c = 0; c < others.size(); ++c) columns.col(static_cast<Index>(c)) = problem.nuisance.col(others[c]);
  MatrixXd gram = columns.transpose() * columns;
  gram.diagonal().array() += 1e-9;
  return 2 * gram.llt().matrixLLT().diagonal().array().log().sum();
}

}  // namespace

double log_evidence(const LinearProblem& problem, int terms) {
  const double chi2 = Projector(problem.nuisance).vector(problem.residual).squaredNorm();
  return -0.5 * chi2 - 0.5 * log_determinant(problem) - terms * std::log(amplitude_range);
}

MatrixXd unnamed_columns(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
                         const VectorXd& prediction) {
  const int most = std::clamp(static_cast<int>(observations.rows.size()) / 4, 2, 14);
  const MatrixXd basis = smooth_basis(observations, most);
  const Index cells = prediction.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count * (basis.cols() + 1));
  for (Index i = 0; i < cells; ++i) {
    const Cell& cell = observations.cells[static_cast<std::size_t>(i)];
    const double sd = noise.channels[static_cast<std::size_t>(cell.channel)].sd(prediction[i]);
    const Index first = cell.channel * (basis.cols() + 1);
    columns(i, first) = sd;
    for (Index b = 0; b < basis.cols(); ++b) columns(i, first + 1 + b) = sd * basis(cell.row, b);
  }
  std::vector<Index> kept;
  for (Index c = 0; c < columns.cols(); ++c)
    if (columns.col(c).squaredNorm() > 0) kept.push_back(c);
  MatrixXd present(cells, static_cast<Index>(kept.size()));
  for (std::size_t c = 0; c < kept.size(); ++c) present.col(static_cast<Index>(c)) = columns.col(kept[c]);
  return whitening(present);
}

double log_evidence_unnamed(const LinearProblem& problem, const MatrixXd& columns) {
  const Projector off(problem.nuisance);
  const VectorXd r = off.vector(problem.residual);
  MatrixXd full = MatrixXd::Zero(problem.residual.size(), columns.cols());
  full.topRows(columns.rows()) = columns;
  const MatrixXd b = off(full);
  const MatrixXd gram = b.transpose() * b;
  const VectorXd seen = b.transpose() * r;
  const double base = -0.5 * r.squaredNorm() - 0.5 * log_determinant(problem);
  double best = -std::numeric_limits<double>::infinity();
  for (const double size : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
    MatrixXd m = size * size * gram;
    m.diagonal().array() += 1.0;
    const Eigen::LLT<MatrixXd> llt(m);
    const double gain = 0.5 * size * size * llt.matrixL().solve(seen).squaredNorm();
    best = std::max(best, base + gain - llt.matrixLLT().diagonal().array().log().sum() - std::log(6.0));
  }
  return best;
}

}  // namespace soilbin::compare
