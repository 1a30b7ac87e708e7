#include "compare/loop/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/loop/condition_functions.hpp"

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

/// Columns but those of amplitudes: with an amplitude's column scaled to unit length off the others, the determinant
/// of all is that of the others.
MatrixXd without_amplitudes(const LinearProblem& problem) {
  MatrixXd others(problem.nuisance.rows(), problem.nuisance.cols());
  Index used = 0;
  for (Index c = 0; c < problem.nuisance.cols(); ++c)
    if (std::find(problem.amplitudes.begin(), problem.amplitudes.end(), c) == problem.amplitudes.end())
      others.col(used++) = problem.nuisance.col(c);
  return others.leftCols(used);
}

/// ln det of the Gram matrix.
double log_determinant(const MatrixXd& columns) {
  MatrixXd gram = columns.transpose() * columns;
  gram.diagonal().array() += 1e-9;
  return 2 * gram.llt().matrixLLT().diagonal().array().log().sum();
}

/// 1 + S G S.
Eigen::LLT<MatrixXd> widening(const MatrixXd& gram, const VectorXd& sd) {
  MatrixXd m = sd.asDiagonal() * gram * sd.asDiagonal();
  m.diagonal().array() += 1.0;
  return Eigen::LLT<MatrixXd>(m);
}

/// Whitened columns over the cells, padded with zeros to the problem's rows.
MatrixXd padded_columns(const LinearProblem& problem, const MatrixXd& columns) {
  MatrixXd full = MatrixXd::Zero(problem.residual.size(), columns.cols());
  full.topRows(columns.rows()) = columns;
  return full;
}

double log_mean_exp(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double x : logs) sum += std::exp(x - top);
  return top + std::log(sum / static_cast<double>(logs.size()));
}

}  // namespace

double log_narrowing(const MatrixXd& gram, const VectorXd& sd) {
  return widening(gram, sd).matrixLLT().diagonal().array().log().sum();
}

MatrixXd side_by_side(Index cells, const std::vector<Tolerance>& tolerances) {
  Index width = 0;
  for (const Tolerance& t : tolerances) width += t.columns.cols();
  MatrixXd all(cells, width);
  Index first = 0;
  for (const Tolerance& t : tolerances) {
    all.middleCols(first, t.columns.cols()) = t.columns;
    first += t.columns.cols();
  }
  return all;
}

double log_evidence(const LinearProblem& exact, const std::vector<Tolerance>& tolerances) {
  const MatrixXd others = without_amplitudes(exact), columns = side_by_side(exact.cells, tolerances);
  const JoinedColumns joined(exact, columns);
  const MatrixXd apart = Projector(others)(padded_columns(exact, columns)), gram = apart.transpose() * apart;
  std::size_t choices = 1;
  for (const Tolerance& t : tolerances) choices *= t.scales.size();
  std::vector<double> densities;
  for (std::size_t choice = 0; choice < choices; ++choice) {
    VectorXd sd(columns.cols());
    std::size_t left = choice;  // a digit a term
    Index first = 0;
    for (const Tolerance& t : tolerances) {
      sd.segment(first, t.columns.cols()).setConstant(t.scales[left % t.scales.size()]);
      first += t.columns.cols(), left /= t.scales.size();
    }
    densities.push_back(joined.taken(sd) - log_narrowing(gram, sd));
  }
  return log_mean_exp(densities) - 0.5 * joined.chi2() - 0.5 * log_determinant(others) -
         static_cast<double>(tolerances.size()) * std::log(amplitude_range);
}

double schwarz_log_evidence(const Fit& fit, Index cells) {
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
MatrixXd carried_over(const Observations& observations, const NoiseFloor& noise, const Whitening& whitening,
                      const VectorXd& prediction) {
  const Index cells = prediction.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count);
  std::array<double, channel_count> before{}, sizes{}, counts{};
  for (Index i = 0; i < cells; ++i) {
    const std::size_t c = static_cast<std::size_t>(observations.cells[static_cast<std::size_t>(i)].channel);
    if (counts[c] > 0) columns(i, static_cast<Index>(c)) = before[c] - prediction[i];
    before[c] = prediction[i];
    sizes[c] += std::abs(prediction[i]);
    ++counts[c];
  }
  for (std::size_t c = 0; c < channel_count; ++c) {
    auto column = columns.col(static_cast<Index>(c));
    const double largest = column.cwiseAbs().maxCoeff();
    if (largest > 0) column *= 2 * noise.channels[c].sd(sizes[c] / counts[c]) / largest;
  }
  return whitening(columns);
}

/// A gain of all forces that waves with a covariate: an amplifier warming from day to day, a frame that gives way.
MatrixXd common_gain(const Observations& observations, const Whitening& whitening, const VectorXd& prediction,
                     const VectorXd& values) {
  const MatrixXd functions = waves(values);
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

JoinedColumns::JoinedColumns(const LinearProblem& problem, const MatrixXd& columns) {
  const Projector off(problem.nuisance);
  const MatrixXd kept = off(padded_columns(problem, columns));
  gram_ = kept.transpose() * kept;
  seen_ = kept.transpose() * problem.residual;
  chi2_ = off.vector(problem.residual).squaredNorm();
}

double JoinedColumns::taken(const VectorXd& sd) const {
  return 0.5 * widening(gram_, sd).matrixL().solve(sd.cwiseProduct(seen_)).squaredNorm();
}

double JoinedColumns::gain(double size) const {
  const VectorXd sd = VectorXd::Constant(seen_.size(), size);
  return taken(sd) - log_narrowing(gram_, sd);
}

double unnamed_gain(const LinearProblem& problem, const std::vector<MatrixXd>& families) {
  std::vector<double> gains;
  for (const MatrixXd& columns : families) {
    const JoinedColumns joined(problem, columns);
    for (const double size : term_sizes) gains.push_back(joined.gain(size));
  }
  return log_mean_exp(gains);
}

}  // namespace soilbin::compare
