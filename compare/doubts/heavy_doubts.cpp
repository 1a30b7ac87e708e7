// A heavy tire on sand, beside what grains show of one.
#include <algorithm>
#include <optional>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/model.hpp"
#include "compare/doubts/answer_doubts.hpp"
#include "compare/doubts/doubts.hpp"

namespace soilbin::compare {
namespace {

bool carries_soil_along(const std::vector<EffectChoice>& effects) {
  return std::ranges::any_of(effects, [](const EffectChoice& effect) {
    const bekker_wong::EffectForm& form = bekker_wong::find_form(effect);
    return form.id == "shear_hump" && form.form == "carried";
  });
}

constexpr double deepest_grains = 0.18;  // of the width: 110 mm of 600 mm, the deepest of heavy-lugged-cullinan

/// The sinkage as a share of the width, of a wheel that sinks deep for it: soil fails sideways under it too. None of
/// one that does not.
std::optional<double> sinks_beyond_grains(const TractionResult& result, const Tire& tire) {
  const double share = result.sinkage.value / tire.width;
  return share > 1.5 * deepest_grains ? std::optional(share) : std::nullopt;
}

Doubts carried_beyond_grains(const Scenario& scenario, const Answer& answer) {
  const std::optional<double> share = sinks_beyond_grains(*answer.result, scenario.tire);
  if (!share || !carries_soil_along(scenario.effects)) return {};
  return {Doubt{DoubtKind::carried_beyond_grains, {deepest_grains, *share}, answer.at}};
}

/// A wheel like those of the failure map heavy-lugged-incline (docs/lab/failure-maps.md): 10 to 40 kN on a tire of 0.7
/// m radius with lugs of 45 mm, on sand of 3.9 kPa and 31 deg; what is like it is chosen. With soil carried along the
/// pull is near that of grains, and is told beside the answer's.
Doubts heavy_on_sand(const Scenario& scenario, const Answer& answer) {
  if (carries_soil_along(scenario.effects)) return {};
  const bekker_wong::SoilValues soil = bekker_wong::values_of(*scenario.soil.semi_empirical);
  const bool frictional = soil.cohesion < 5e3 && soil.friction_angle > 0.35;
  if (answer.at.load < 10e3 || !frictional || !(answer.result->drawbar_pull.value > 0.0)) return {};
  const bekker_wong::BekkerWong model({.errors = false, .patch = false});
  OperatingCondition rigid = answer.at;
  rigid.inflation_pressure.reset();
  const Answer nearer = ask(model, as_in_grains(scenario), rigid);
  Doubt doubt{
      is_lugged(scenario.tire) ? DoubtKind::heavy_and_lugged : DoubtKind::heavy_and_smooth, {"", "", ""}, answer.at};
  if (nearer.result) {
    doubt.says[0] = nearer.result->drawbar_pull.value, doubt.says[1] = answer.result->drawbar_pull.value;
    if (const auto share = sinks_beyond_grains(*nearer.result, scenario.tire)) doubt.says[2] = *share;
  }
  return {doubt};
}

}  // namespace

Doubts heavy_tire_doubts(const Scenario& scenario, const Answer& answer) {
  Doubts all = heavy_on_sand(scenario, answer);
  append(all, carried_beyond_grains(scenario, answer));
  return all;
}

Scenario as_in_grains(Scenario scenario) {
  std::erase_if(scenario.effects, [](const EffectChoice& effect) {
    return effect.id == "tire_flexibility" || effect.id == "lug_thrust" || effect.id == "slip_sinkage" ||
           effect.id == "shear_hump";
  });
  scenario.tire.inflation_pressure.reset(), scenario.tire.deflection.reset();
  if (is_lugged(scenario.tire)) scenario.effects.push_back({"lug_thrust", "tips", {}});
  scenario.effects.push_back({"shear_hump", "carried", {}});
  scenario.effects.push_back({"slip_sinkage", "reece", {{"h", 0.1}}});
  return scenario;
}

Case as_in_grains(Case question) {
  ModelChoice& model = question.study.models.front();
  question.scenario = as_in_grains(seen_by(model, question.scenario));
  model = {ModelKind::bekker_wong, std::move(question.scenario.effects), ""};
  question.scenario.effects.clear();
  question.study.models.resize(1);
  for (OperatingCondition& at : question.study.conditions) at.inflation_pressure.reset();
  return question;
}

Doubts doubts_of_climb(const Doubts& told, const char* who, std::optional<double> steepest,
                       const std::function<std::optional<double>()>& as_in_grains) {
  if (!steepest || (!tell_of(told, DoubtKind::heavy_and_lugged) && !tell_of(told, DoubtKind::heavy_and_smooth)))
    return {};
  return {Doubt{DoubtKind::heavy_climb, {who, as_in_grains().value_or(0.0) / degree, *steepest / degree}}};
}

}  // namespace soilbin::compare
