#include "compare/loop/accepted_model.hpp"

#include <algorithm>

#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {

namespace {

AcceptedEffect accepted(const WheelPredictor& predictor, const Whitening& whitening, const CandidateModel& candidate,
                        int term) {
  constexpr double two_sided = 1.96;
  Eigen::VectorXd errors = standard_errors(candidate.fit, predictor);
  const Term& t = candidate.terms[static_cast<std::size_t>(term)];
  AcceptedEffect effect;
  const auto all = predictor.choices(candidate.fit.theta);
  effect.choice = all[all.size() - candidate.terms.size() + static_cast<std::size_t>(term)];
  for (std::size_t k = 0; k < t.free.size(); ++k) {
    const Eigen::Index i = predictor.amplitude_index(term) + static_cast<Eigen::Index>(k);
    const FreeParameter& bounds = predictor.parameters()[static_cast<std::size_t>(i)];
    const bool held = errors[i] == 0.0;
    if (held) errors[i] = held_error(candidate.fit, predictor, whitening, i);
    effect.at_bound.push_back(held);
    effect.fitted.push_back(t.form->parameters[static_cast<std::size_t>(t.free[k])].name);
    effect.ci95.emplace_back(std::max(bounds.lower, candidate.fit.theta[i] - two_sided * errors[i]),
                             std::min(bounds.upper, candidate.fit.theta[i] + two_sided * errors[i]));
  }
  return effect;
}

std::vector<SoilShift> soil_shifts(const Identification& id, const WheelPredictor& predictor) {
  const Fit& with = id.candidates[*id.best].fit;
  const Eigen::VectorXd error = standard_errors(with, predictor);
  const Eigen::VectorXd base_error = standard_errors(id.base, predictor);  // the same soil parameters come first
  std::vector<SoilShift> shifts;
  for (int i = 0; i < predictor.soil_parameters(); ++i)
    shifts.push_back({predictor.parameters()[static_cast<std::size_t>(i)].name,
                      {with.theta[i], error[i]},
                      {id.base.theta[i], base_error[i]}});
  return shifts;
}

}  // namespace

SemiEmpiricalSoil fitted_soil(const Campaign& campaign, const WheelPredictor& predictor, const Fit& fit) {
  SemiEmpiricalSoil soil = campaign.soil;
  const Eigen::VectorXd errors = standard_errors(fit, predictor);
  for (int i = 0; i < predictor.soil_parameters(); ++i)
    soil.*soil_parameter(predictor.parameters()[static_cast<std::size_t>(i)].name).value = {fit.theta[i], errors[i]};
  return soil;
}

std::vector<AcceptedEffect> take_best(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  const CandidateModel& best = id.candidates[*id.best];
  const WheelPredictor predictor(campaign, id.observations, best.terms);
  std::vector<AcceptedEffect> effects;
  for (int t = 0; t < static_cast<int>(best.terms.size()); ++t)
    effects.push_back(accepted(predictor, *id.whitening, best, t));
  answer.soil = fitted_soil(campaign, predictor, best.fit);
  answer.soil_shifts = soil_shifts(id, predictor);
  answer.dependences_after = dependences(
      id.observations, best.fit.residual.head(static_cast<Eigen::Index>(id.observations.cells.size())), 999, 11);
  return effects;
}

void describe_effects(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options) {
  const Identification& id = answer.details;
  for (std::size_t t = 0; t < answer.effects.size(); ++t) {
    answer.effects[t].p_value = p_beside_others(campaign, id, id.candidates[*id.best], t, options);
    answer.effects[t].cosines = cosines(id, answer.effects[t].choice.id);
  }
}

}  // namespace soilbin::compare
