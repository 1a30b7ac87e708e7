#include "compare/loop/bounded_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/loop/evidence.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<VectorXd> feasible_start(const WheelPredictor& predictor, VectorXd start) {
  VectorXd prediction;
  const auto& parameters = predictor.parameters();
  const auto k_phi =
      std::find_if(parameters.begin(), parameters.end(), [](const auto& p) { return p.name == "k_phi"; });
  for (int attempt = 0; attempt < 21; ++attempt) {
    if (predictor.predict(start, prediction)) return start;
    if (k_phi == parameters.end()) return std::nullopt;
    const Index i = k_phi - parameters.begin();
    start[i] = std::max(start[i] * 1.25, start[i] + 0.25 * k_phi->prior_sd);
  }
  return std::nullopt;
}

namespace {

/// Rows of the priors: (prior - theta)/sd.
VectorXd prior_residual(const std::vector<FreeParameter>& parameters, const VectorXd& theta) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (std::isfinite(parameters[i].prior_sd))
      rows.push_back((parameters[i].prior - theta[static_cast<Index>(i)]) / parameters[i].prior_sd);
  return Eigen::Map<VectorXd>(rows.data(), static_cast<Index>(rows.size()));
}

MatrixXd prior_columns(const std::vector<FreeParameter>& parameters) {
  const Index n = static_cast<Index>(parameters.size());
  MatrixXd rows = MatrixXd::Zero(n, n);
  Index row = 0;
  for (Index i = 0; i < n; ++i) {
    const FreeParameter& p = parameters[static_cast<std::size_t>(i)];
    if (std::isfinite(p.prior_sd)) rows(row++, i) = p.scale / p.prior_sd;
  }
  return rows.topRows(row);
}

struct Linearised {
  VectorXd residual;  // augmented
  MatrixXd columns;   // augmented, in units of scale
};

Linearised augment(const WheelPredictor& predictor, const VectorXd& theta, const VectorXd& values,
                   const Whitening& whitening, const VectorXd& prediction, const MatrixXd& jacobian,
                   const VectorXd& scale) {
  const VectorXd cells = whitening(VectorXd(values - prediction));
  const MatrixXd derivative = whitening(MatrixXd(jacobian * scale.asDiagonal()));
  const VectorXd prior = prior_residual(predictor.parameters(), theta);
  const MatrixXd prior_rows = prior_columns(predictor.parameters());
  Linearised l;
  l.residual.resize(cells.size() + prior.size());
  l.residual << cells, prior;
  l.columns.resize(l.residual.size(), derivative.cols());
  l.columns << derivative, prior_rows;
  return l;
}

/// Parameters that sit at a bound and are pushed outward by the gradient.
std::vector<bool> held(const std::vector<FreeParameter>& parameters, const VectorXd& theta, const VectorXd& downhill) {
  std::vector<bool> at_bound(parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Index k = static_cast<Index>(i);
    at_bound[i] =
        (theta[k] <= parameters[i].lower && downhill[k] < 0) || (theta[k] >= parameters[i].upper && downhill[k] > 0);
  }
  return at_bound;
}

MatrixXd without(const MatrixXd& columns, const std::vector<bool>& drop, std::vector<int>* kept = nullptr) {
  MatrixXd rest(columns.rows(), std::count(drop.begin(), drop.end(), false));
  Index to = 0;
  for (std::size_t i = 0; i < drop.size(); ++i) {
    if (drop[i]) continue;
    rest.col(to++) = columns.col(static_cast<Index>(i));
    if (kept) kept->push_back(static_cast<int>(i));
  }
  return rest;
}

VectorXd damped_step(const Linearised& l, const std::vector<bool>& hold, double damping) {
  std::vector<int> kept;
  const MatrixXd a = without(l.columns, hold, &kept);
  MatrixXd normal = a.transpose() * a;
  normal.diagonal().array() *= 1 + damping;
  normal.diagonal().array() += 1e-10;
  const VectorXd step = normal.ldlt().solve(a.transpose() * l.residual);
  VectorXd full = VectorXd::Zero(l.columns.cols());
  for (std::size_t i = 0; i < kept.size(); ++i) full[kept[i]] = step[static_cast<Index>(i)];
  return full;
}

/// What the linearised model expects of a step in chi2.
double promised_gain(const Linearised& l, const VectorXd& step) {
  return l.residual.squaredNorm() - (l.residual - l.columns * step).squaredNorm();
}

double chi2_of(const WheelPredictor& predictor, const VectorXd& theta, const VectorXd& values,
               const Whitening& whitening, const VectorXd& prediction) {
  return whitening(VectorXd(values - prediction)).squaredNorm() +
         prior_residual(predictor.parameters(), theta).squaredNorm();
}

}  // namespace

std::optional<Fit> fit(const WheelPredictor& predictor, const VectorXd& values, const Whitening& whitening,
                       VectorXd start) {
  const auto feasible = feasible_start(predictor, std::move(start));
  if (!feasible) return std::nullopt;
  const std::vector<FreeParameter>& parameters = predictor.parameters();
  const Index n = feasible->size();
  VectorXd scale(n);
  for (Index i = 0; i < n; ++i) scale[i] = parameters[static_cast<std::size_t>(i)].scale;

  Fit best;
  best.theta = *feasible;
  if (!predictor.linearise(best.theta, best.prediction, best.jacobian)) return std::nullopt;
  best.chi2 = chi2_of(predictor, best.theta, values, whitening, best.prediction);
  double damping = 1e-3, growth = 2.0;
  BalanceMemory memory;
  constexpr int max_iterations = 40;
  constexpr double small_gain = 2e-3, small_share = 1e-4;  // of chi2, far below what any decision turns on
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Linearised l = augment(predictor, best.theta, values, whitening, best.prediction, best.jacobian, scale);
    const std::vector<bool> hold = held(parameters, best.theta, l.columns.transpose() * l.residual);
    const double enough = std::max(small_gain, small_share * best.chi2);
    bool better = false;
    double gain = 0.0;
    for (int attempt = 0; attempt < 10 && !better; ++attempt) {
      const VectorXd step = damped_step(l, hold, damping);
      const double promised = promised_gain(l, step);
      if (promised < enough) break;
      VectorXd trial = best.theta + step.cwiseProduct(scale);
      for (Index i = 0; i < n; ++i) {
        const FreeParameter& p = parameters[static_cast<std::size_t>(i)];
        trial[i] = std::clamp(trial[i], p.lower, p.upper);
      }
      VectorXd prediction;
      if (predictor.predict(trial, prediction, memory)) {
        const double chi2 = chi2_of(predictor, trial, values, whitening, prediction);
        if (chi2 < best.chi2) {
          gain = best.chi2 - chi2;
          best.theta = trial, best.prediction = prediction, best.chi2 = chi2;
          better = true;
          const double kept = 2 * gain / promised - 1;  // Nielsen's rule: the damping follows how well the line held
          damping = std::max(damping * std::max(0.1, 1 - kept * kept * kept), 1e-9);
          growth = 2.0;
        }
      }
      if (!better) damping *= growth, growth *= 2;
    }
    if (!better) break;
    if (!predictor.linearise(best.theta, best.prediction, best.jacobian, memory.angles)) return std::nullopt;
    if (gain < enough) break;
  }
  const Linearised l = augment(predictor, best.theta, values, whitening, best.prediction, best.jacobian, scale);
  best.residual = l.residual;
  best.columns =
      without(l.columns, held(parameters, best.theta, l.columns.transpose() * l.residual), &best.column_parameter);
  best.chi2 = best.residual.squaredNorm();
  best.chi2_cells = best.residual.head(values.size()).squaredNorm();
  return best;
}

VectorXd standard_errors(const Fit& fit, const WheelPredictor& predictor) {
  VectorXd errors = VectorXd::Zero(fit.theta.size());
  MatrixXd gram = fit.columns.transpose() * fit.columns;
  gram.diagonal().array() += 1e-12;
  const MatrixXd covariance = gram.ldlt().solve(MatrixXd::Identity(gram.rows(), gram.cols()));
  for (std::size_t i = 0; i < fit.column_parameter.size(); ++i) {
    const int p = fit.column_parameter[i];
    errors[p] = std::sqrt(std::max(0.0, covariance(static_cast<Index>(i), static_cast<Index>(i)))) *
                predictor.parameters()[static_cast<std::size_t>(p)].scale;
  }
  return errors;
}

double held_error(const Fit& fit, const WheelPredictor& predictor, const Whitening& whitening, Index parameter) {
  const FreeParameter& p = predictor.parameters()[static_cast<std::size_t>(parameter)];
  VectorXd column = VectorXd::Zero(fit.columns.rows());
  column.head(fit.jacobian.rows()) = whitening(VectorXd(fit.jacobian.col(parameter)));
  const double told = Projector(fit.columns).vector(column).squaredNorm() + 1 / (p.prior_sd * p.prior_sd);
  return told > 0 ? 1 / std::sqrt(told) : std::numeric_limits<double>::infinity();
}

}  // namespace soilbin::compare
