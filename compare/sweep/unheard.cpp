#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "bekker_wong/effect.hpp"
#include "compare/sweep/plausibility.hpp"

namespace soilbin::compare {
namespace {

/// A thing that a case may declare, and what hears of it.
struct Declared {
  std::string key;
  std::string of_case;  ///< why declaring it may change nothing; {}: the effects that hear of it
  std::string needs;    ///< what an effect that hears of it needs; empty where it does without
  bool grains_hear = false;
  std::function<bool(const Case&)> given;
};

bool any_condition(const Case& question, const std::function<bool(const OperatingCondition&)>& has) {
  return std::any_of(question.study.conditions.begin(), question.study.conditions.end(), has);
}

const std::vector<Declared>& declarable() {
  using At = const OperatingCondition&;
  const auto some = [](auto has) { return [has](const Case& question) { return any_condition(question, has); }; };
  static const std::vector<Declared> all = {
      {"lugs", "the tire's lugs change nothing: the analytic wheel is smooth without {}", "", true,
       [](const Case& question) { return is_lugged(question.scenario.tire); }},
      {"pass", "'pass' changes nothing: the analytic model hears of it by {}", "no condition has a 'pass' of 2 or more",
       true, some([](At at) { return at.pass > 1; })},
      {"moisture", "'moisture' changes nothing: the analytic model hears of it by {}", "no condition has a 'moisture'",
       false, some([](At at) { return at.moisture.has_value(); })},
      {"position", "'position' changes nothing: the analytic model hears of it by {}", "no condition has a 'position'",
       false, some([](At at) { return at.position.has_value(); })},
      {"run", "'run' changes nothing: the analytic model hears of it by {}", "no condition has a 'run'", false,
       some([](At at) { return at.run.has_value(); })},
  };
  return all;
}

/// The effects of the catalogue of which some form hears of this, for a person: "effect soil_gradient or bed_tilt".
std::string hearing_effects(const std::string& key) {
  std::vector<std::string> ids;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (hears_of(form, key) && (ids.empty() || ids.back() != form.id)) ids.push_back(form.id);
  std::string words;
  for (const std::string& id : ids) words += (words.empty() ? "effect " : " or ") + id;
  return words;
}

bool hears(const ModelChoice& choice, const Declared& declared) {
  if (choice.model == ModelKind::dem) return declared.grains_hear;
  return std::any_of(choice.effects.begin(), choice.effects.end(), [&](const EffectChoice& effect) {
    return hears_of(bekker_wong::find_form(effect), declared.key);
  });
}

/// The effects of the study's models that need this, each id once.
std::vector<std::string> in_need(const std::vector<ModelChoice>& models, const Declared& declared) {
  std::vector<std::string> ids;
  for (const ModelChoice& choice : models)
    for (const EffectChoice& effect : choice.effects)
      if (hears_of(bekker_wong::find_form(effect), declared.key) &&
          std::find(ids.begin(), ids.end(), effect.id) == ids.end())
        ids.push_back(effect.id);
  return ids;
}

}  // namespace

bool hears_of(const bekker_wong::EffectForm& form, const std::string& key) {
  // A parameter about which a form is centred tells; passes have none, and of lugs the one that knows them hears.
  if (key == "pass") return form.id == "multipass";
  if (key == "lugs") return form.id == "lug_thrust";
  return std::any_of(form.parameters.begin(), form.parameters.end(),
                     [&](const bekker_wong::EffectParameter& parameter) { return parameter.centred_on == key; });
}

std::vector<Unheard> unheard(const Case& question) {
  std::vector<Unheard> all;
  const std::vector<ModelChoice>& models = question.study.models;
  if (question.study.conditions.empty()) return all;
  for (const Declared& declared : declarable()) {
    if (declared.given(question)) {
      if (std::none_of(models.begin(), models.end(), [&](const ModelChoice& m) { return hears(m, declared); }))
        all.push_back({declared.key, fmt::format(fmt::runtime(declared.of_case), hearing_effects(declared.key))});
    } else if (!declared.needs.empty()) {
      for (const std::string& id : in_need(models, declared))
        all.push_back({"effect", fmt::format("effect {} changes nothing: {}", id, declared.needs)});
    }
  }
  return all;
}

}  // namespace soilbin::compare
