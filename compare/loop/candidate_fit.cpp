#include "compare/loop/candidate_fit.hpp"

#include <algorithm>
#include <cmath>

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// What the term adds to the cells at the fit.
VectorXd contribution_of(const WheelPredictor& predictor, const Fit& fit, int term) {
  VectorXd theta = fit.theta, without;
  theta[predictor.amplitude_index(term)] = 0.0;
  BalanceMemory memory = giving_way();
  if (!predictor.predict(theta, without, memory)) return VectorXd::Zero(fit.prediction.size());
  return fit.prediction - without;
}

/// Share of a contribution that the soil's values, as far as their priors let them, could not have made.
double share_kept(const Identification& id, const WheelPredictor& predictor, const Fit& fit,
                  const VectorXd& contribution) {
  std::vector<Index> soil;
  for (std::size_t c = 0; c < fit.column_parameter.size(); ++c)
    if (fit.column_parameter[c] < predictor.soil_parameters()) soil.push_back(static_cast<Index>(c));
  MatrixXd columns(fit.columns.rows(), static_cast<Index>(soil.size()));
  for (std::size_t c = 0; c < soil.size(); ++c) columns.col(static_cast<Index>(c)) = fit.columns.col(soil[c]);
  VectorXd whole = VectorXd::Zero(fit.columns.rows());
  whole.head(contribution.size()) = (*id.whitening)(contribution);
  const double size = whole.norm();
  return size > 0 ? Projector(columns).vector(whole).norm() / size : 0.0;
}

/// Form tolerance of every term, shrunk by the root of the share that the soil's values could not have made: a form
/// that is almost a change of soil would else be free to be anything. (Root: found best on the tuning sets among 0,
/// 1/2, 1.)
std::vector<Tolerance> tolerances_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit) {
  const std::span<const double> all(tolerance_scales), narrow(narrow_tolerance_scales);
  const bool far = far_from_noise(id, fit);
  std::vector<Tolerance> each;
  for (int t = 0; t < static_cast<int>(predictor.terms().size()); ++t) {
    const bekker_wong::EffectForm& form = *predictor.terms()[static_cast<std::size_t>(t)].form;
    const VectorXd contribution = contribution_of(predictor, fit, t);
    const double tolerance = form.form_tolerance * std::sqrt(share_kept(id, predictor, fit, contribution));
    each.push_back({form_columns(id.observations, *id.whitening, contribution, tolerance),
                    far || form.measurement ? narrow : all});
  }
  return each;
}

Index cells_of(const Identification& id) { return static_cast<Index>(id.observations.cells.size()); }

/// Soil values and earlier terms to start from, then the terms that join them at their defaults.
VectorXd start_from(const WheelPredictor& predictor, const VectorXd& known) {
  VectorXd start = predictor.start();
  start.head(known.size()) = known;
  return start;
}

/// Starts a term at these values of its form's parameters, with a share of the amplitude.
void put(VectorXd& start, const WheelPredictor& predictor, int term, const std::vector<double>& values, double share) {
  const Term& t = predictor.terms()[static_cast<std::size_t>(term)];
  const Index first = predictor.amplitude_index(term);
  for (std::size_t k = 0; k < t.free.size(); ++k) {
    const auto i = static_cast<std::size_t>(t.free[k]);
    const bekker_wong::EffectParameter& p = t.form->parameters[i];
    const double least = k == 0 ? p.lower + 1e-3 * (p.upper - p.lower) : p.lower;
    start[first + static_cast<Index>(k)] = std::clamp(k == 0 ? share * values[i] : values[i], least, p.upper);
  }
}

}  // namespace

bool far_from_noise(const Identification& id, const Fit& fit) {
  constexpr double far = 3.0;  // chi2 a value
  return fit.chi2_cells > far * static_cast<double>(id.observations.cells.size());
}

LinearProblem problem_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit) {
  return linear_problem(predictor, fit, cells_of(id), side_by_side(cells_of(id), tolerances_of(id, predictor, fit)));
}

double evidence_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit) {
  if (id.none_near_noise) return schwarz_log_evidence(fit, cells_of(id));
  const LinearProblem exact = linear_problem(predictor, fit, cells_of(id), MatrixXd(cells_of(id), 0));
  return log_evidence(exact, tolerances_of(id, predictor, fit));
}

std::optional<CandidateModel> refit(const Campaign& campaign, const Identification& id, const std::vector<Term>& terms,
                                    const CandidateStart& from) {
  const WheelPredictor predictor(campaign, id.observations, terms);
  std::optional<CandidateModel> best;
  for (const double share : {1.0, 0.3, 0.0}) {
    if (best && best->fit.chi2 < from.chi2 - (share > 0.0 ? 0.5 * from.promised : 0.0)) break;
    VectorXd start = start_from(predictor, from.known);
    for (const auto& [term, values] : from.traced) put(start, predictor, term, values, share);
    VectorXd prediction;
    BalanceMemory memory = giving_way();
    for (int halving = 0; halving < 6 && !predictor.predict(start, prediction, memory); ++halving)
      for (const auto& [term, values] : from.traced) start[predictor.amplitude_index(term)] *= 0.5;
    auto found = fit(predictor, id.observations.values(), *id.whitening, start);
    if (!found || (best && found->chi2 >= best->fit.chi2)) continue;
    best = CandidateModel{.ids = {}, .terms = terms, .fit = std::move(*found), .log_evidence = 0.0};
    for (const Term& term : terms) best->ids.insert(term.form->id);
  }
  if (best) best->log_evidence = evidence_of(id, predictor, best->fit);
  return best;
}

}  // namespace soilbin::compare
