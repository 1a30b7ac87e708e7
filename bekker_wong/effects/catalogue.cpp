#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/learned.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::bekker_wong {
namespace {

/// One line an effect, in the catalogue's order (docs/reference/effects.md).
constexpr std::vector<EffectForm> (*effects_of_the_catalogue[])() = {
    exit_angle_forms,      slip_sinkage_forms,
    lug_thrust_forms,      bulldozing_forms,
    multipass_forms,       tire_flexibility_forms,
    rate_dependence_forms, interface_limit_forms,
    shear_hump_forms,      pressure_dependent_shear_modulus_forms,
    hard_layer_forms,      moisture_forms,
    slope_weakening_forms, sidewall_bulldozing_forms,
    bed_tilt_forms,        rig_friction_forms,
    sensor_offset_forms,   cross_talk_forms,
    soil_gradient_forms,   drift_forms,
};

std::vector<EffectForm> collect() {
  std::vector<EffectForm> all;
  for (const auto forms : effects_of_the_catalogue) {
    std::vector<EffectForm> some = forms();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& right) {
  const std::string near = nearest_word(word, right);
  return near.empty() ? std::string() : fmt::format(", did you mean '{}'?", near);
}

std::vector<double> parameters_of(const EffectForm& form, const EffectChoice& choice) {
  std::vector<double> values;
  for (const EffectParameter& p : form.parameters) values.push_back(p.fallback);
  for (const auto& [name, value] : choice.parameters) {
    const EffectParameter& p = find_parameter(form, name);
    if (!(value >= p.lower && value <= p.upper))
      throw InputError(fmt::format("effect '{}' ({}): {} = {:.6g} lies outside {:.6g} .. {:.6g} (SI)", form.id,
                                   form.form, name, value, p.lower, p.upper));
    values[static_cast<std::size_t>(&p - form.parameters.data())] = value;
  }
  return values;
}

}  // namespace

const std::vector<EffectForm>& effect_catalogue() {
  static const std::vector<EffectForm> all = collect();
  return all;
}

std::vector<std::string> effect_ids() {
  std::vector<std::string> ids;
  for (const EffectForm& form : effect_catalogue())
    if (ids.empty() || ids.back() != form.id) ids.push_back(form.id);
  return ids;
}

bool depends_on(const EffectForm& form, std::string_view key) {
  const auto is = [&](const std::string& condition) { return condition == key; };
  const auto read = [&](const Presumption& p) { return p.key == key || p.key.starts_with(std::string(key) + "."); };
  return std::ranges::any_of(form.conditions, is) || std::ranges::any_of(form.tire_values, is) ||
         std::ranges::any_of(form.presumes, read) ||
         std::ranges::any_of(form.parameters, is, &EffectParameter::centred_on);
}

const EffectForm& find_form(const EffectChoice& choice) {
  std::vector<std::string> ids, forms;
  for (const EffectForm& f : choice.id == learned_id ? learned_forms() : effect_catalogue()) {
    if (f.id != choice.id) {
      if (ids.empty() || ids.back() != f.id) ids.push_back(f.id);
      continue;
    }
    if (choice.form.empty() || f.form == choice.form) return f;
    forms.push_back(f.form);
  }
  if (forms.empty()) throw InputError(fmt::format("unknown effect '{}'{}", choice.id, suggestion(choice.id, ids)));
  throw InputError(
      fmt::format("effect '{}' has no variant '{}'{}", choice.id, choice.form, suggestion(choice.form, forms)));
}

bool is_flexible(const std::vector<EffectChoice>& effects) {
  return std::ranges::any_of(
      effects, [](const EffectChoice& choice) { return depends_on(find_form(choice), "inflation_pressure"); });
}

const EffectParameter& find_parameter(const EffectForm& form, const std::string& name) {
  const auto found = std::ranges::find(form.parameters, name, &EffectParameter::name);
  if (found != form.parameters.end()) return *found;
  std::vector<std::string> names;
  for (const EffectParameter& p : form.parameters) names.push_back(p.name);
  throw InputError(
      fmt::format("effect '{}' ({}) has no parameter '{}'{}", form.id, form.form, name, suggestion(name, names)));
}

std::unique_ptr<const Effect> make_effect(const EffectChoice& choice) {
  const EffectForm& form = find_form(choice);
  return form.make(parameters_of(form, choice));
}

EffectList make_effects(const std::vector<EffectChoice>& choices) {
  EffectList list;
  for (const EffectChoice& choice : choices) list.push_back(make_effect(choice));
  return list;
}

}  // namespace soilbin::bekker_wong
