#include "compare/fit/evidence.hpp"

#include <algorithm>
#include <cmath>

#include "compare/fit/condition_functions.hpp"

namespace soilbin::compare {

Eigen::MatrixXd gram_matrix(const Eigen::MatrixXd& columns, double ridge) {
  Eigen::MatrixXd gram = columns.transpose() * columns;
  gram.diagonal().array() += ridge;
  return gram;
}

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd LinearProblem::padded(const VectorXd& signature) const {
  VectorXd full = VectorXd::Zero(residual.size());
  full.head(signature.size()) = signature;
  return full;
}

namespace {

/// Whitened columns by which a form may be wrong (Tolerance); contribution: of its effect to each cell, unwhitened.
MatrixXd form_columns(const Dataset& data, const VectorXd& contribution, double tolerance) {
  const MatrixXd basis = with_constant(smooth_basis(data.observations, thresholds::tolerance_functions));
  const Index cells = contribution.size();
  MatrixXd columns = MatrixXd::Zero(cells, channel_count * basis.cols());
  Index used = 0;
  for (int channel = 0; channel < channel_count; ++channel)
    for (Index b = 0; b < basis.cols(); ++b) {
      for (Index i = 0; i < cells; ++i) {
        const Cell& cell = data.observations.cells[i];
        if (cell.channel == channel) columns(i, used) = contribution[i] * basis(cell.row, b);
      }
      if (columns.col(used).squaredNorm() > 0) ++used;
    }
  const double each = tolerance / std::sqrt(static_cast<double>(basis.cols()));
  return each * data.whitening(MatrixXd(columns.leftCols(used)));
}

LinearProblem linear_problem(const FittedModel& model, const MatrixXd& tolerance) {
  const Fit& fit = model.fit();
  const Index rows = fit.residual.size(), extra = tolerance.cols();
  LinearProblem p;
  p.cells = model.data().cells();
  for (Index c = 0; c < fit.columns.cols(); ++c)
    for (int t = 0; t < std::ssize(model.terms()); ++t)
      if (fit.column_parameter[c] == model.predictor().amplitude_index(t)) p.amplitudes.push_back(c);
  p.residual = VectorXd::Zero(rows + extra);
  p.residual.head(rows) = fit.residual;
  p.nuisance = MatrixXd::Zero(rows + extra, fit.columns.cols() + extra);
  p.nuisance.topLeftCorner(rows, fit.columns.cols()) = fit.columns;
  if (extra > 0) {
    p.nuisance.topRightCorner(p.cells, extra) = tolerance;
    p.nuisance.bottomRightCorner(extra, extra).setIdentity();
  }
  return p;
}

/// Share of a contribution that the soil's values, as far as their priors let them, could not have made.
double share_kept(const FittedModel& model, const VectorXd& contribution) {
  const Fit& fit = model.fit();
  std::vector<Index> soil;
  for (Index c = 0; c < fit.columns.cols(); ++c)
    if (fit.column_parameter[c] < model.predictor().soil_parameters()) soil.push_back(c);
  VectorXd whole = VectorXd::Zero(fit.columns.rows());
  whole.head(contribution.size()) = model.data().whitening(contribution);
  const double size = whole.norm();
  return size > 0 ? Projector(fit.columns(Eigen::all, soil)).vector(whole).norm() / size : 0.0;
}

/// Form tolerance of every term, shrunk by the root of the share that the soil's values could not have made: a form
/// that is almost a change of soil would else be free to be anything.
std::vector<Tolerance> tolerances_of(const FittedModel& model) {
  const std::span<const double> all(thresholds::tolerance_scales), narrow(thresholds::narrow_tolerance_scales);
  const bool far = far_from_noise(model);
  std::vector<Tolerance> each;
  for (int t = 0; t < std::ssize(model.terms()); ++t) {
    const bekker_wong::EffectForm& form = *model.terms()[t].form;
    const VectorXd contribution = model.contribution(t);
    const double tolerance = form.form_tolerance * std::sqrt(share_kept(model, contribution));
    each.push_back({form_columns(model.data(), contribution, tolerance), far || form.measurement ? narrow : all});
  }
  return each;
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

/// Columns but those of amplitudes: with an amplitude's column scaled to unit length off the others, the determinant
/// of all is that of the others.
MatrixXd without_amplitudes(const LinearProblem& problem) {
  MatrixXd others(problem.nuisance.rows(), problem.nuisance.cols());
  Index used = 0;
  for (Index c = 0; c < problem.nuisance.cols(); ++c)
    if (std::ranges::find(problem.amplitudes, c) == problem.amplitudes.end())
      others.col(used++) = problem.nuisance.col(c);
  return others.leftCols(used);
}

/// ln det of the Gram matrix.
double log_determinant(const MatrixXd& columns) {
  return 2 * Cholesky(gram_matrix(columns, 1e-9)).half_log_determinant();
}

/// 1 + S G S.
Cholesky widening(const MatrixXd& gram, const VectorXd& sd) {
  MatrixXd m = sd.asDiagonal() * gram * sd.asDiagonal();
  m.diagonal().array() += 1.0;
  return Cholesky(m);
}

/// Whitened columns over the cells, padded with zeros to the problem's rows.
MatrixXd padded_columns(const LinearProblem& problem, const MatrixXd& columns) {
  MatrixXd full = MatrixXd::Zero(problem.residual.size(), columns.cols());
  full.topRows(columns.rows()) = columns;
  return full;
}

}  // namespace

double log_mean_exp(const std::vector<double>& logs) {
  const double top = *std::ranges::max_element(logs);
  double sum = 0.0;
  for (const double x : logs) sum += std::exp(x - top);
  return top + std::log(sum / static_cast<double>(logs.size()));
}

double log_narrowing(const MatrixXd& gram, const VectorXd& sd) { return widening(gram, sd).half_log_determinant(); }

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
         static_cast<double>(tolerances.size()) * std::log(thresholds::amplitude_range);
}

LinearProblem problem_of(const FittedModel& model) {
  return linear_problem(model, side_by_side(model.data().cells(), tolerances_of(model)));
}

bool far_from_noise(const FittedModel& model) {
  const WithinPools& within = model.data().within_pools;
  return model.fit().chi2_cells + within.chi2 >
         thresholds::far_from_noise * (static_cast<double>(model.data().cells()) + within.cells);
}

double log_evidence(const FittedModel& model, bool none_near_noise) {
  if (!none_near_noise)
    return log_evidence(linear_problem(model, MatrixXd(model.data().cells(), 0)), tolerances_of(model));
  const WithinPools& within = model.data().within_pools;
  const double n = static_cast<double>(model.data().cells()) + within.cells, chi2 = model.fit().chi2 + within.chi2;
  const double k = static_cast<double>(model.fit().columns.cols());
  return -0.5 * n * std::log(chi2) - 0.5 * k * std::log(n);
}

JoinedColumns::JoinedColumns(const LinearProblem& problem, const MatrixXd& columns) {
  const Projector off(problem.nuisance);
  const MatrixXd kept = off(padded_columns(problem, columns));
  gram_ = kept.transpose() * kept;
  seen_ = kept.transpose() * problem.residual;
  chi2_ = off.vector(problem.residual).squaredNorm();
}

double JoinedColumns::taken(const VectorXd& sd) const {
  return 0.5 * widening(gram_, sd).half_solve(VectorXd(sd.cwiseProduct(seen_))).squaredNorm();
}

double JoinedColumns::gain(double size) const {
  const VectorXd sd = VectorXd::Constant(seen_.size(), size);
  return taken(sd) - log_narrowing(gram_, sd);
}

}  // namespace soilbin::compare
