#include "compare/loop/accepted_model.hpp"

#include <algorithm>

namespace soilbin::compare {

std::vector<AcceptedEffect> effects_of(const CandidateModel& candidate) {
  constexpr double two_sided = 1.96;
  const WheelPredictor& predictor = candidate.model.predictor();
  const Eigen::VectorXd errors = candidate.model.standard_errors();
  const std::vector<EffectChoice> choices = predictor.choices(candidate.fit().theta);
  std::vector<AcceptedEffect> effects;
  for (std::size_t term = 0; term < candidate.terms().size(); ++term) {
    const Term& t = candidate.terms()[term];
    AcceptedEffect effect;
    effect.choice = choices[choices.size() - candidate.terms().size() + term];
    for (std::size_t k = 0; k < t.free.size(); ++k) {
      const Eigen::Index i = predictor.amplitude_index(static_cast<int>(term)) + k;
      const FreeParameter& bounds = predictor.parameters()[i];
      const bool held = errors[i] == 0.0;
      const double value = candidate.fit().theta[i], error = held ? candidate.model.held_error(i) : errors[i];
      effect.at_bound.push_back(held);
      effect.fitted.push_back(t.form->parameters[t.free[k]].name);
      effect.ci95.emplace_back(std::max(bounds.lower, value - two_sided * error),
                               std::min(bounds.upper, value + two_sided * error));
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

std::vector<AcceptedEffect> accepted_effects(const Attribution& found, const AttributionOptions& options) {
  std::vector<AcceptedEffect> effects = effects_of(found.best());
  for (std::size_t t = 0; t < effects.size(); ++t) {
    effects[t].p_value = p_beside_others(found, found.best(), static_cast<int>(t), options);
    effects[t].cosines = cosines(found.signatures.all, effects[t].choice.id);
  }
  return effects;
}

std::vector<SoilShift> soil_shifts(const FittedModel& with, const FittedModel& without) {
  // the same soil parameters come first in both
  const Eigen::VectorXd error = with.standard_errors(), base_error = without.standard_errors();
  std::vector<SoilShift> shifts;
  for (int i = 0; i < without.predictor().soil_parameters(); ++i)
    shifts.push_back({with.predictor().parameters()[i].name,
                      {with.fit().theta[i], error[i]},
                      {without.fit().theta[i], base_error[i]}});
  return shifts;
}

}  // namespace soilbin::compare
