#include "compare/doubts/answer_doubts.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/doubts/doubts.hpp"
#include "scenario/deflection_table.hpp"

namespace soilbin::compare {
namespace {

/// Sinkage over the radius up to which the base model's stresses are tested; beyond 0.9 it has no balance.
constexpr double unreliable_sinkage_share = 0.5;

/// A wheel so deep that the stresses under it are a stretch, or none at all.
Doubts too_deep(const Scenario& scenario, const Answer& answer) {
  const double share = answer.result->sinkage.value / scenario.tire.radius;
  if (share > bekker_wong::max_sinkage_share)
    return {Doubt{DoubtKind::settles_too_deep, {100 * share, 100 * bekker_wong::max_sinkage_share}, answer.at}};
  if (!(share > unreliable_sinkage_share)) return {};
  return {Doubt{DoubtKind::deep_sinkage, {100 * share, 100 * unreliable_sinkage_share}, answer.at}};
}

/// A cross slope down which the load slides; none where the soil can hold it beside the thrust. Along the way a pull
/// below 0 says the same.
Doubts too_steep_across(const Scenario& scenario, const Answer& answer, double contact_length) {
  const OperatingCondition& at = answer.at;
  const bekker_wong::SoilValues soil = bekker_wong::values_of(*scenario.soil.semi_empirical);
  const double uphill = std::cos(at.longitudinal_incline),
               share = std::abs(at.load * uphill * std::sin(at.transverse_incline)),
               pressing = at.load * uphill * std::cos(at.transverse_incline),
               held = pressing * std::tan(soil.friction_angle) + soil.cohesion * scenario.tire.width * contact_length;
  const auto budget = std::ranges::find(answer.result->budget, "shear_thrust", &Contribution::name);
  const double thrust = budget == answer.result->budget.end() ? 0.0 : std::abs(budget->force);
  constexpr double hardly = 0.05;  // of what the soil holds: no slope to speak of
  if (!(share > hardly * held && std::hypot(share, thrust) > held)) return {};
  return {Doubt{DoubtKind::slides_across, {share, share > held ? Said("") : Said(thrust), held}, at}};
}

/// A tire that flattens until its rim is near the ground.
Doubts too_flat(const Scenario& scenario, const Answer& answer) {
  constexpr double most = 0.2;  // of the radius, chosen: half of a high section height
  const double radius = scenario.tire.radius;
  const double flattened = radius * (1 - std::cos(answer.result->entry_angle)) - answer.result->sinkage.value;
  if (!bekker_wong::is_flexible(scenario.effects) || !(flattened > most * radius))
    return {};  // nor of a drive, which has no angles
  return {Doubt{DoubtKind::large_deflection, {1000 * flattened, 100 * flattened / radius, 100 * most}, answer.at}};
}

/// A load or a pressure that the tire's maker did not measure.
Doubts beyond_deflections(const Scenario& scenario, const Answer& answer) {
  const Tire tire = tire_at(scenario.tire, answer.at);
  const auto reads = [](const EffectChoice& effect) {
    return depends_on(bekker_wong::find_form(effect), deflection_key);
  };
  if (!tire.deflection || !tire.inflation_pressure || std::ranges::none_of(scenario.effects, reads)) return {};
  const double load =
      answer.at.load * std::cos(answer.at.longitudinal_incline) * std::cos(answer.at.transverse_incline);
  if (covers(*tire.deflection, load, *tire.inflation_pressure)) return {};
  return {Doubt{
      DoubtKind::beyond_deflections, {load, *tire.inflation_pressure / 1000, in_words(*tire.deflection)}, answer.at}};
}

/// A tire that is asked as a rigid wheel and would flatten: what the default form of tire_flexibility makes of it.
Doubts taken_as_rigid(const Scenario& scenario, const Answer& answer) {
  constexpr double hardly = 0.01;  // of the load
  const Tire tire = tire_at(scenario.tire, answer.at);
  if (!tire.inflation_pressure || bekker_wong::is_flexible(scenario.effects)) return {};
  Scenario flexible = scenario;
  flexible.effects.push_back({"tire_flexibility", "", {}});
  const bekker_wong::BekkerWong model({.errors = false, .patch = false});
  const Answer asked = std::isfinite(answer.result->entry_angle) ? answer : ask(model, scenario, answer.at);
  if (!asked.result) return {};  // of a drive, where it is at no steady state
  const double rigid = asked.result->drawbar_pull.value,
               carcass = *declared_ground_pressure(tire) - *tire.inflation_pressure;
  Doubt doubt{DoubtKind::flattens, {*tire.inflation_pressure / 1000, carcass / 1000, "", ""}, answer.at};
  const Answer flattened = ask(model, flexible, answer.at);
  doubt.error = flattened.error;
  if (!flattened.result) return {doubt};
  const double pull = flattened.result->drawbar_pull.value;
  if (std::abs(pull - rigid) < hardly * answer.at.load) return {};
  doubt.says[2] = rigid, doubt.says[3] = pull;
  return {doubt};
}

/// A wheel that pulls more than 15 % of its load at a slip of up to 1 %, level or on a slope. Even
/// without slip the model shears the soil by up to r (theta_1 - sin theta_1) under the wheel, and a large or deep one
/// by many times K. Wheels that pull slip.
Doubts pull_without_slip(const Scenario& scenario, const Answer& answer) {
  constexpr double no_slip = 0.01, much = 0.15;  // chosen; the share is of the load
  const OperatingCondition& at = answer.at;
  const double beside_slope = answer.result->drawbar_pull.value + at.load * std::sin(at.longitudinal_incline);
  const double share = beside_slope / at.load, entry = answer.result->entry_angle;
  if (std::abs(at.slip) > no_slip || !(share > much) || !(entry > 0.0)) return {};
  return {Doubt{DoubtKind::pull_without_slip,
                {share, 1000 * scenario.tire.radius * (entry - std::sin(entry)), 1000 * scenario.tire.radius,
                 1000 * scenario.soil.semi_empirical->shear_modulus.value},
                at}};
}

/// A slope on which no soil like this would lie.
Doubts slope_slides(const Scenario& scenario, const OperatingCondition& at) {
  const double slope = std::acos(std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline));
  const std::optional<double> slides = bekker_wong::sliding_slope(scenario.soil, scenario.tire);
  if (!slides || slope <= *slides) return {};
  return {Doubt{DoubtKind::slope_slides, {*slides / degree}, at}};
}

bool has_effect(const Scenario& scenario, std::string_view id) {
  return std::ranges::find(scenario.effects, id, &EffectChoice::id) != scenario.effects.end();
}

/// A sinkage that is not the depth of the rut.
Doubts sinkage_in_rut(const Scenario& scenario, const OperatingCondition& at) {
  if (at.pass < 2) return {};
  for (const EffectChoice& effect : scenario.effects)
    if (bekker_wong::find_form(effect).sinkage_from_rut_floor)
      return {Doubt{DoubtKind::sinkage_in_rut, {effect.id + (effect.form.empty() ? "" : ":" + effect.form)}}};
  return {};
}

/// A driven wheel that needs no slip to carry itself, or to pull: the rim is slower than the travel.
Doubts drives_without_slip(const Answer& answer) {
  constexpr double no_slip = -0.01, carries_itself = -0.01;  // chosen; the second one is a share of the load
  const OperatingCondition& at = answer.at;
  const double beside_slope = answer.result->drawbar_pull.value + at.load * std::sin(at.longitudinal_incline);
  if (at.slip > no_slip || !(answer.result->torque.value > 0.0) || beside_slope < carries_itself * at.load) return {};
  return {Doubt{DoubtKind::drives_without_slip, {}, at}};
}

/// What the analytic wheel answers at one condition.
void add_answer_doubts(const Scenario& scenario, const Answer& answer, Doubts& all) {
  const OperatingCondition& at = answer.at;
  const Tire& tire = scenario.tire;
  const TractionResult& r = *answer.result;
  const double length = tire.radius * (r.entry_angle - r.exit_angle);
  const double pressure = answer.at.load / (tire.width * tire.radius * std::sin(r.entry_angle));
  if (pressure < 500.0 || pressure > 2e6) all.push_back({DoubtKind::unusual_ground_pressure, {pressure / 1000}, at});
  const double arc = bekker_wong::contact_length(r.sinkage.value, tire.radius);
  if (at.inflation_pressure) append(all, unusual_inflation(*at.inflation_pressure, at));
  append(all, too_steep_across(scenario, answer, std::fmax(length, arc)));
  append(all, too_deep(scenario, answer));
  if (scenario.bin && r.sinkage.value > 0.5 * scenario.bin->depth && !has_effect(scenario, "hard_layer"))
    all.push_back({DoubtKind::bin_floor, {100 * r.sinkage.value / scenario.bin->depth}, at});
  const double modulus = scenario.soil.semi_empirical->shear_modulus.value;
  if (modulus > length) all.push_back({DoubtKind::short_contact, {1000 * modulus, 1000 * length}, at});
  append(all, too_flat(scenario, answer));
  append(all, beyond_deflections(scenario, answer));
  append(all, taken_as_rigid(scenario, answer));
  append(all, pull_without_slip(scenario, answer));
  append(all, drives_without_slip(answer));
  append(all, slope_slides(scenario, at));
  append(all, heavy_tire_doubts(scenario, answer));
  append(all, sinkage_in_rut(scenario, at));
}

}  // namespace

Doubts doubts_of_answers(const Scenario& scenario, const std::vector<ModelAnswers>& study, bool unsolved) {
  Doubts all;
  for (const ModelAnswers& model : study) {
    const Scenario asked = seen_by(model.choice, scenario);
    for (const Answer& answer : model.answers) {
      if (!answer.result) {
        if (unsolved) all.push_back({.kind = DoubtKind::no_solution, .at = answer.at, .error = answer.error});
        continue;
      }
      // A steady wheel gives out no more than is put in; what instruments show may.
      if (answer.result->tractive_efficiency > 1.0) all.push_back({DoubtKind::power_from_nothing, {}, answer.at});
      if (model.choice.model == ModelKind::bekker_wong && asked.soil.semi_empirical)
        add_answer_doubts(asked, answer, all);
    }
  }
  return once_each(all);
}

}  // namespace soilbin::compare
