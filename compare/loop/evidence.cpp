#include "compare/loop/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd orthonormal(const MatrixXd& columns) {
  if (columns.cols() == 0) return MatrixXd(columns.rows(), 0);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

Projector::Projector(const MatrixXd& columns) : q_(orthonormal(columns)) {}

MatrixXd form_columns(const Observations& observations, const Whitening& whitening, const VectorXd& contribution,
                      double tolerance) {
  constexpr int smooth_columns = 6;
  const MatrixXd basis = with_constant(smooth_basis(observations, smooth_columns));
  const Index cells = contribution.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count * basis.cols());
  Index used = 0;
  for (int channel = 0; channel < channel_count; ++channel)
    for (Index b = 0; b < basis.cols(); ++b) {
      for (Index i = 0; i < cells; ++i) {
        const Cell& cell = observations.cells[static_cast<std::size_t>(i)];
        if (cell.channel == channel) columns(i, used) = contribution[i] * basis(cell.row, b);
      }
      if (columns.col(used).squaredNorm() > 0) ++used;
    }
  const double each = tolerance / std::sqrt(static_cast<double>(basis.cols()));
  return each * whitening(MatrixXd(columns.leftCols(used)));
}

VectorXd LinearProblem::padded(const VectorXd& signature) const {
  VectorXd full = VectorXd::Zero(residual.size());
  full.head(signature.size()) = signature;
  return full;
}

LinearProblem linear_problem(const WheelPredictor& predictor, const Fit& fit, Index cells, const MatrixXd& tolerance) {
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

double foreign_log_evidence(const Fit& fit, Index cells) {
  const double n = static_cast<double>(cells), k = static_cast<double>(fit.column_parameter.size());
  return -0.5 * n * std::log(fit.chi2) - 0.5 * k * std::log(n);
}

MatrixXd in_every_channel(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
                          const VectorXd& prediction, const MatrixXd& functions) {
  const Index cells = prediction.size(), width = functions.cols();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count * width);
  for (Index i = 0; i < cells; ++i) {
    const Cell& cell = observations.cells[static_cast<std::size_t>(i)];
    const double sd = noise.channels[static_cast<std::size_t>(cell.channel)].sd(prediction[i]);
    columns.row(i).segment(cell.channel * width, width) = sd * functions.row(cell.row);
  }
  return whitening(columns);
}

namespace {

/// Waves of one to `most` periods over a covariate's range.
MatrixXd waves(const VectorXd& values, int most) {
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

/// Functions of the rows, family by family.
std::vector<MatrixXd> row_families(const Observations& observations) {
  const Index rows = static_cast<Index>(observations.rows.size());
  const int most = std::clamp(static_cast<int>(rows) / 4, 2, 14);
  std::vector<MatrixXd> families = {with_constant(smooth_basis(observations, most))};
  for (const Covariate& c : covariates(observations))
    if (c.name == "slip" || c.name == "load" || c.name == "position" || c.name == "run")
      families.push_back(waves(c.values, std::clamp(static_cast<int>(rows) / 10, 1, 5)));
  return families;
}

/// Each channel's prediction in the run before, standardised: what a lagging instrument or bed would carry over.
MatrixXd carried_over(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
                      const VectorXd& prediction) {
  const Index cells = prediction.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count);
  std::array<double, channel_count> before{};
  std::array<bool, channel_count> any{};
  for (Index i = 0; i < cells; ++i) {
    const std::size_t c = static_cast<std::size_t>(observations.cells[static_cast<std::size_t>(i)].channel);
    if (any[c]) columns(i, static_cast<Index>(c)) = before[c] - prediction[i];
    before[c] = prediction[i];
    any[c] = true;
  }
  for (int c = 0; c < channel_count; ++c) {
    const double size = columns.col(c).cwiseAbs().maxCoeff();
    if (size > 0)
      columns.col(c) *= noise.channels[static_cast<std::size_t>(c)].sd(prediction.cwiseAbs().mean()) * 2 / size;
  }
  return whitening(columns);
}

/// A gain of all forces that waves with a covariate: an amplifier warming from day to day, a frame that gives way.
MatrixXd common_gain(const Observations& observations, const Whitening& whitening, const VectorXd& prediction,
                     const VectorXd& values) {
  const MatrixXd functions = waves(values, std::clamp(static_cast<int>(observations.rows.size()) / 10, 1, 5));
  MatrixXd columns = MatrixXd::Zero(prediction.size(), functions.cols());
  for (Index i = 0; i < prediction.size(); ++i) {
    const Cell& cell = observations.cells[static_cast<std::size_t>(i)];
    if (cell.channel != sinkage) columns.row(i) = prediction[i] * functions.row(cell.row);
  }
  const MatrixXd white = whitening(columns);
  const double size = std::sqrt(white.squaredNorm() / static_cast<double>(white.size()));
  return size > 0 ? MatrixXd(white / size) : white;
}

/// Each channel bent over its own range: Legendre's polynomials of the prediction of order 2 to 4. An instrument that
/// is not linear, whatever the conditions.
MatrixXd bent(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
              const VectorXd& prediction) {
  constexpr int bends = 3;
  std::array<double, channel_count> low, high;
  low.fill(std::numeric_limits<double>::infinity()), high.fill(-std::numeric_limits<double>::infinity());
  const auto channel_of = [&](Index i) {
    return static_cast<std::size_t>(observations.cells[static_cast<std::size_t>(i)].channel);
  };
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
      columns(i, static_cast<Index>(c) * bends + k) =
          noise.channels[c].sd(prediction[i]) * std::sqrt(2.0 * k + 5) * std::legendre(static_cast<unsigned>(k) + 2, x);
  }
  return whitening(columns);
}

}  // namespace

std::vector<MatrixXd> unnamed_families(const Observations& observations, const NoiseFloor& noise,
                                       const Whitening& whitening, const VectorXd& prediction) {
  std::vector<MatrixXd> families;
  for (const MatrixXd& functions : row_families(observations))
    families.push_back(in_every_channel(observations, noise, whitening, prediction, functions));
  families.push_back(carried_over(observations, noise, whitening, prediction));
  families.push_back(bent(observations, noise, whitening, prediction));
  for (const Covariate& c : covariates(observations))
    if (c.name == "run" || c.name == "load")
      families.push_back(common_gain(observations, whitening, prediction, c.values));
  return families;
}

UnnamedTerm::UnnamedTerm(const LinearProblem& problem, const MatrixXd& columns) {
  const Projector off(problem.nuisance);
  MatrixXd full = MatrixXd::Zero(problem.residual.size(), columns.cols());
  full.topRows(columns.rows()) = columns;
  const MatrixXd kept = off(full);
  gram_ = kept.transpose() * kept;
  seen_ = kept.transpose() * problem.residual;
}

double UnnamedTerm::gain(double size) const {
  MatrixXd m = size * size * gram_;
  m.diagonal().array() += 1.0;
  const Eigen::LLT<MatrixXd> llt(m);
  return 0.5 * size * size * llt.matrixL().solve(seen_).squaredNorm() - llt.matrixLLT().diagonal().array().log().sum();
}

double unnamed_gain(const LinearProblem& problem, const std::vector<MatrixXd>& families) {
  std::vector<double> gains;
  for (const MatrixXd& columns : families) {
    const UnnamedTerm term(problem, columns);
    for (const double size : term_sizes) gains.push_back(term.gain(size));
  }
  const double top = *std::max_element(gains.begin(), gains.end());
  double sum = 0.0;
  for (const double g : gains) sum += std::exp(g - top);
  return top + std::log(sum / static_cast<double>(gains.size()));
}

}  // namespace soilbin::compare
