#include "compare/doubts/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/learned.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/deflection_table.hpp"
#include "scenario/nearest_word.hpp"

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

/// Grahn's power of the penetration speed under a tire that is flat, where nothing penetrates.
Doubts no_pressure_at_rest(const Case& question) {
  const auto jumps = [](const std::vector<EffectChoice>& effects) {
    return bekker_wong::is_flexible(effects) && std::ranges::any_of(effects, [](const EffectChoice& effect) {
             const bekker_wong::EffectForm& form = bekker_wong::find_form(effect);
             return form.id == "rate_dependence" && form.form == "grahn";
           });
  };
  const bool asked = std::ranges::any_of(question.study.models, jumps, [&](const ModelChoice& model) {
    return seen_by(model, question.scenario).effects;
  });
  if (!asked && !(question.drive && jumps(question.drive->effects))) return {};
  return {Doubt{DoubtKind::no_pressure_at_rest}};
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

/// A soil none of whose values has a standard deviation: then ± is that of c1 and c2 alone.
Doubts without_deviations(const Case& question) {
  const std::optional<SemiEmpiricalSoil>& soil = question.scenario.soil.semi_empirical;
  if (!soil || soil->assumed_sd || question.on_command_line.contains("no_assumed_sd")) return {};
  for (const Estimate& value :
       {soil->exponent, soil->k_c, soil->k_phi, soil->cohesion, soil->friction_angle, soil->shear_modulus})
    if (value.std_error > 0.0) return {};
  return {Doubt{DoubtKind::without_deviations}};
}

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
  append(all, heavy_on_sand(scenario, answer));
  append(all, carried_beyond_grains(scenario, answer));
  append(all, sinkage_in_rut(scenario, at));
}

/// Doubts of all answers, equal ones once.
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

/// A drive asks the analytic wheel, with effects of its own.
Case as_study(Case question) {
  question.study.models = {{ModelKind::bekker_wong, question.drive->effects, ""}};
  OperatingCondition& at = question.study.conditions.emplace_back();
  at.load = question.drive->load, at.pass = question.drive->pass;
  return question;
}

/// The analytic models' answers without errors and stresses, which no doubt asks for.
std::vector<ModelAnswers> quick_answers(const Case& question) {
  Case analytic = question;
  std::erase_if(analytic.study.models, [](const ModelChoice& c) { return c.model != ModelKind::bekker_wong; });
  if (!question.scenario.soil.semi_empirical) return {};
  return run_study(analytic, {}, [](ModelKind) {
    return std::make_unique<const bekker_wong::BekkerWong>(bekker_wong::Detail{.errors = false, .patch = false});
  });
}

/// Whether an answer of the analytic models, at the first condition or the last, hangs on the soil's density.
bool weighs_soil(const Case& question) {
  Case asked = question;
  std::vector<OperatingCondition>& at = asked.study.conditions;
  if (at.size() > 2) at = {at.front(), at.back()};
  const std::vector<ModelAnswers> as_it_is = quick_answers(asked);
  asked.scenario.soil.semi_empirical->density = 1.01 * bulk_density(*question.scenario.soil.semi_empirical);
  const std::vector<ModelAnswers> heavier = quick_answers(asked);
  for (std::size_t m = 0; m < heavier.size(); ++m)
    for (std::size_t i = 0; i < heavier[m].answers.size(); ++i) {
      const auto &one = as_it_is[m].answers[i].result, &other = heavier[m].answers[i].result;
      if (one.has_value() != other.has_value()) return true;
      for (const TractionChannel& channel : traction_channels)
        if (one && (one.value().*channel.predicted).value != (other.value().*channel.predicted).value) return true;
    }
  return false;
}

/// Conditions beyond those that a learned effect was learned from.
Doubts doubts_of_learned(const Case& question) {
  Doubts all;
  for (const ModelChoice& model : question.study.models)
    for (const EffectChoice& effect : model.effects)
      for (const OperatingCondition& at : question.study.conditions)
        for (const std::string& name : bekker_wong::outside_learned(effect, at))
          all.push_back({DoubtKind::beyond_learned, {effect.form, name}, at});
  return once_each(all);
}

/// The tire at the condition that tells the least of its pressure.
Tire least_told(const Case& question) {
  const std::vector<OperatingCondition>& all = question.study.conditions;
  const auto silent = std::ranges::find_if(all, [](const auto& at) { return !at.inflation_pressure; });
  if (silent != all.end() || all.empty()) return question.scenario.tire;
  return tire_at(question.scenario.tire, all.front());
}

/// What is declared and has no influence, and what has influence and is not declared.
Doubts doubts_of_declarations(const Case& question) {
  Doubts all = unused_inputs(question);
  append(all, doubts_of_learned(question));
  std::vector<EffectChoice> effects;
  for (const ModelChoice& model : question.study.models)
    effects.insert(effects.end(), model.effects.begin(), model.effects.end());
  for (const std::string& presumed : bekker_wong::presumptions(effects, least_told(question)))
    all.push_back({DoubtKind::presumed, {presumed}});
  const std::optional<SemiEmpiricalSoil>& soil = question.scenario.soil.semi_empirical;
  const bool asks_wheel = asks(question.study, ModelKind::bekker_wong);
  const auto is_typed = [&](const char* value) { return soil && is_from_command_line(*soil, value); };
  if ((is_typed("gravity") || is_typed("density")) && asks_wheel && !question.drive && !weighs_soil(question))
    for (const char* value : {"gravity", "density"})
      if (is_typed(value) && !(value == std::string_view("density") && !question.scenario.soil.beds.empty()))
        all.push_back({DoubtKind::soil_weight_ignored, {value}});
  if (soil && !soil->density && !effects.empty() && weighs_soil(question))
    all.push_back({DoubtKind::density_assumed, {presumed_bulk_density}});
  return all;
}

/// Conditions that no motion has; a drive begins at rest.
Doubts doubts_of_speeds(const Case& question) {
  Doubts all;
  if (question.drive) return all;
  for (const OperatingCondition& at : question.study.conditions)
    if (at.speed == 0.0 && std::abs(at.slip) < 1.0) all.push_back({DoubtKind::standing_wheel, {}, at});
  return once_each(all);
}

/// Whether answers stand beside the doubts: then what has none is told there, and grains that weren't asked are left
/// aside.
enum class Answered { no, yes };

/// doubts(question, study) without what changes nothing.
Doubts doubts_but_unused_inputs(const Case& question, const std::vector<ModelAnswers>& study, Answered answered) {
  const Scenario& scenario = question.scenario;
  const bool open = answered == Answered::no;
  Doubts all;
  if (open || asks(question.study, ModelKind::bekker_wong) || !scenario.soil.semi_empirical)
    append(all, doubts(scenario.soil));
  append(all, doubts(scenario.tire, scenario.soil));
  if (asks(question.study, ModelKind::rft)) append(all, resistive_force_doubts(scenario.soil));
  if (asks(question.study, ModelKind::cone_index)) {
    append(all, cone_index_doubts(scenario, question.study.conditions));
    if (asks(question.study, ModelKind::bekker_wong)) all.push_back({DoubtKind::cone_index_beside_bekker});
  }
  append(all, doubts_of_speeds(question));
  if (asks(question.study, ModelKind::bekker_wong)) append(all, without_deviations(question));
  append(all, no_pressure_at_rest(question));
  append(all, doubts_of_answers(scenario, study, open));
  if (open || asks(question.study, ModelKind::dem))
    append(all, grain_doubts(scenario, question.study.conditions, study));
  return all;
}

/// A campaign's runs as questions to a model.
Case question_of(const Campaign& campaign, const Scenario& asked) {
  Case question;
  question.scenario = asked;
  question.study.models = {{ModelKind::bekker_wong, asked.effects, ""}};
  question.scenario.effects.clear();
  for (const Run& run : campaign.runs) question.study.conditions.push_back(run.at);
  return question;
}

/// Each row has a run, a place and a speed: so a campaign is told, whether or not its model asks for them.
bool only_tells_the_row(const Doubt& one) {
  return one.kind == DoubtKind::speed_ignored ||
         (one.kind == DoubtKind::condition_ignored && (one.says[0] == Said("run") || one.says[0] == Said("position")));
}

/// The campaign's model at other conditions.
AskAgain asked_again(const Case& question) {
  return [question](const std::vector<OperatingCondition>& conditions) {
    Case again = question;
    again.study.conditions = conditions;
    return quick_answers(again).front().answers;
  };
}

enum class NextIs { nothing, a_fit_for_effects };

Doubts doubts_of(const Campaign& campaign, const Case& question, const std::vector<ModelAnswers>& study,
                 Answered answered, NextIs next) {
  Doubts all = doubts_but_unused_inputs(question, study, answered);
  if (next == NextIs::nothing) {
    Doubts unused = unused_inputs(question, EffectsAre::of_a_campaign);
    std::erase_if(unused, only_tells_the_row);
    append(all, std::move(unused));
  }
  Doubts of_data = row_doubts(campaign);
  append(of_data, column_doubts(campaign, study.front().answers, asked_again(question)));
  append(all, once_each(of_data));
  return all;
}

/// A carcass pressure that a declared effect reads and no fit may move: nobody measures one.
void add_doubt_of_exact_carcass(const Campaign& campaign, Doubts& all) {
  const auto reads = std::ranges::find_if(campaign.effects, [](const EffectChoice& effect) {
    return depends_on(bekker_wong::find_form(effect), carcass_pressure_key);
  });
  if (reads == campaign.effects.end() || bekker_wong::errs_by_carcass(campaign.wheel, campaign.effects)) return;
  const double value = campaign.wheel.carcass_pressure.value_or(Estimate{}).value;
  all.push_back({DoubtKind::exact_carcass, {reads->id, value / 1000}});
}

Doubts doubts_as_declared(const Campaign& campaign, NextIs next) {
  const Case question = question_of(campaign, scenario_of(campaign));
  Doubts all = doubts_of(campaign, question, quick_answers(question), Answered::no, next);
  add_doubt_of_exact_carcass(campaign, all);
  if (!campaign.runs.empty() && std::ranges::none_of(campaign.runs, [](const Run& run) { return bool(run.sinkage); }))
    all.push_back({DoubtKind::no_sinkage});
  return all;
}

}  // namespace

std::string remark_on(const Scenario& scenario, const ModelChoice& model, const Answer& answer) {
  Doubts all = doubts_of_answers(scenario, {{model, {answer}}}, false);
  if (answer.result && !answer.result->without_error_of.empty())
    all.push_back({DoubtKind::errors_left_out, {listed(answer.result->without_error_of)}});
  return as_remark(all);
}

Remark remarks_about(const Scenario& scenario) {
  return [&scenario](const ModelChoice& model, const Answer& answer) { return remark_on(scenario, model, answer); };
}

std::vector<std::string> remarks_on(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  std::vector<std::string> remarks;
  std::map<int, std::size_t> of_line;
  const ModelChoice model{prediction.model, asked.effects, ""};
  for (const PredictedRun& run : prediction.runs) {
    of_line[campaign.runs[remarks.size()].csv_line] = remarks.size();
    remarks.push_back(remark_on(asked, model, run.predicted));
  }
  for (const Doubt& one : row_doubts(campaign))
    if (one.line) {
      std::string& remark = remarks[of_line.at(*one.line)];
      remark += (remark.empty() ? "" : "; ") + as_remark({one});
    }
  return remarks;
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

Doubts doubts(const Case& question, const std::vector<ModelAnswers>& study, const Doubts& of_models) {
  Doubts all = doubts_but_unused_inputs(question, study, Answered::yes);
  append(all, of_models);
  append(all, doubts_of_declarations(question));
  return all;
}

std::string tire_in_words(const Case& question) {
  const bool ignored = tell_of(unused_inputs(question), DoubtKind::lugs_ignored);
  return in_words(question.scenario.tire, !ignored                               ? ""
                                          : asks(question.study, ModelKind::dem) ? "; the analytic wheel ignores them"
                                          : question.study.models.size() == 1    ? "; this model ignores the lugs"
                                                                                 : "; these models ignore the lugs");
}

Doubts doubts(const Case& question) {
  Doubts all = doubts_but_unused_inputs(question, quick_answers(question), Answered::no);
  append(all,
         doubts_of_declarations(question.drive && question.study.conditions.empty() ? as_study(question) : question));
  return all;
}

Doubts doubts(const Campaign& campaign) { return doubts_as_declared(campaign, NextIs::nothing); }

Doubts doubts_before_fit(const Campaign& campaign) { return doubts_as_declared(campaign, NextIs::a_fit_for_effects); }

Doubts of_mistaken_columns(Doubts doubts) {
  std::erase_if(doubts, [](const Doubt& one) {
    const bool of_samples = one.kind == DoubtKind::rows_are_samples || one.kind == DoubtKind::several_wheels;
    return !of_samples && (one.kind < DoubtKind::flipped_sign || one.kind > DoubtKind::load_swapped);
  });
  return doubts;
}

Doubts doubts(const Campaign& campaign, const Scenario& asked, const Prediction& prediction) {
  const Case question = question_of(campaign, asked);
  ModelAnswers answers{question.study.models.front(), {}};
  for (const PredictedRun& run : prediction.runs) answers.answers.push_back(run.predicted);
  return doubts_of(campaign, question, {answers}, Answered::yes, NextIs::nothing);
}

namespace {

/// Whether grains are as coarse for the one wheel as for the other.
bool same_wheel_on_grains(const Scenario& a, const Scenario& b) {
  return a.tire.name == b.tire.name && a.soil.name == b.soil.name && a.tire.radius == b.tire.radius &&
         a.tire.width == b.tire.width && a.tire.lugs.height == b.tire.lugs.height &&
         mean_diameter(*a.soil.granular) == mean_diameter(*b.soil.granular);
}

}  // namespace

void NamedDoubts::add(const std::string& name, const Case& question, const std::vector<ModelAnswers>& study) {
  for (const Doubt& doubt : doubts(question, study)) {
    if (doubt.kind != DoubtKind::coarse_grains) {
      add(name, Doubts{doubt});
      continue;
    }
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) {
      return one.grains && same_wheel_on_grains(one.grains->scenario, question.scenario);
    });
    if (known == entries_.end()) {
      entries_.push_back({doubt, OnGrains{question.scenario, study}});
      entries_.back().doubt.of = name;
    } else {
      known->doubt.of += ", " + name;
      known->grains->study.insert(known->grains->study.end(), study.begin(), study.end());
    }
  }
}

void NamedDoubts::add(const std::string& name, const Doubts& doubts) {
  for (Doubt doubt : doubts) {
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) {
      doubt.of = one.doubt.of;
      return one.doubt == doubt;
    });
    if (known != entries_.end()) {
      known->doubt.of += ", " + name;
      continue;
    }
    doubt.of = name;
    entries_.push_back({doubt, {}});
  }
}

Doubts NamedDoubts::all() const {
  Doubts all;
  for (const Entry& one : entries_) {
    all.push_back(one.grains ? coarse_grain_doubts(one.grains->scenario, one.grains->study).front() : one.doubt);
    all.back().of = one.doubt.of;
  }
  return all;
}

}  // namespace soilbin::compare
