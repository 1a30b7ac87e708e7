#include "compare/doubts/unused_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bekker_wong/effect.hpp"

namespace soilbin::compare {
namespace {

/// A thing that a case may declare, and what hears of it.
struct Declared {
  std::string key;
  std::string of_wheel;  ///< why declaring it may change nothing of the analytic wheel; {}: the effects that hear of it
  std::string of_grains;  ///< the same of grains; empty where they hear of it
  std::string needs;      ///< what an effect that hears of it needs; empty where it does without
  std::function<bool(const Case&)> given;
};

bool any_condition(const Case& question, const std::function<bool(const OperatingCondition&)>& has) {
  return std::any_of(question.study.conditions.begin(), question.study.conditions.end(), has);
}

const std::vector<Declared>& declarable() {
  using At = const OperatingCondition&;
  const auto some = [](auto has) { return [has](const Case& question) { return any_condition(question, has); }; };
  const auto of_condition = [&](const std::string& key, const std::string& of_grains, const std::string& needs,
                                auto has) {
    return Declared{key, "'" + key + "' is ignored: add {}", of_grains, needs, some(has)};
  };
  static const std::vector<Declared> all = {
      {"lugs", "lugs are ignored: add {}", "", "",
       [](const Case& question) { return is_lugged(question.scenario.tire); }},
      {"inflation_pressure", "the inflation pressure is ignored: add {} (estimate, explain, limits and run do)",
       "the inflation pressure is ignored: grains meet a rigid tire", "",
       [](const Case& question) {
         return question.scenario.tire.inflation_pressure.has_value() ||
                any_condition(question, [](const OperatingCondition& at) { return at.inflation_pressure.has_value(); });
       }},
      of_condition("pass", "", "no condition has a 'pass' of 2 or more", [](At at) { return at.pass > 1; }),
      of_condition("moisture", "grains ignore 'moisture'", "no condition has a 'moisture'",
                   [](At at) { return at.moisture.has_value(); }),
      of_condition("position", "grains ignore 'position'", "no condition has a 'position'",
                   [](At at) { return at.position.has_value(); }),
      of_condition("run", "grains ignore 'run'", "no condition has a 'run'", [](At at) { return at.run.has_value(); }),
  };
  return all;
}

/// The effects of the catalogue of which some form hears of this, as a flag takes them: "--effect soil_gradient or
/// bed_tilt".
std::string hearing_effects(const std::string& key) {
  std::vector<std::string> ids;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (depends_on(form, key) && (ids.empty() || ids.back() != form.id)) ids.push_back(form.id);
  return ids.empty() ? "" : fmt::format("--effect {}", fmt::join(ids, " or "));
}

bool hears(const ModelChoice& choice, const Declared& declared) {
  return std::any_of(choice.effects.begin(), choice.effects.end(), [&](const EffectChoice& effect) {
    return depends_on(bekker_wong::find_form(effect), declared.key);
  });
}

/// Why a thing that is given changes nothing, of the analytic models or, where these hear or aren't asked, of grains.
std::string why_unused(const std::vector<ModelChoice>& models, const Declared& declared) {
  const auto is_grains = [](const ModelChoice& m) { return m.model == ModelKind::dem; };
  const bool grains = std::any_of(models.begin(), models.end(), is_grains);
  const bool wheel = !std::all_of(models.begin(), models.end(), is_grains);
  if (wheel && std::none_of(models.begin(), models.end(), [&](const ModelChoice& m) { return hears(m, declared); }))
    return fmt::format(fmt::runtime(declared.of_wheel), hearing_effects(declared.key));
  return grains ? declared.of_grains : "";
}

/// The effects of the study's models that need this, each id once.
std::vector<std::string> in_need(const std::vector<ModelChoice>& models, const Declared& declared) {
  std::vector<std::string> ids;
  for (const ModelChoice& choice : models)
    for (const EffectChoice& effect : choice.effects)
      if (depends_on(bekker_wong::find_form(effect), declared.key) &&
          std::find(ids.begin(), ids.end(), effect.id) == ids.end())
        ids.push_back(effect.id);
  return ids;
}

/// Depths that an effect has and does not take, since the bin's is declared.
void add_depths_of_the_bin(const Case& question, std::vector<UnusedInput>& all) {
  if (!question.scenario.bin || question.scenario.bin->depth <= 0) return;
  const double bin = question.scenario.bin->depth;
  for (const ModelChoice& choice : question.study.models)
    for (const EffectChoice& effect : choice.effects)
      for (const bekker_wong::EffectParameter& parameter : bekker_wong::find_form(effect).parameters) {
        const auto own = effect.parameters.find(parameter.name);
        if (!parameter.is_the_bins || own == effect.parameters.end() || own->second == bin) continue;
        all.push_back({parameter.name, fmt::format("effect {} takes the bin's depth, {:g} mm: its own '{}' of {:g} mm "
                                                   "is ignored",
                                                   effect.id, 1000 * bin, parameter.name, 1000 * own->second)});
      }
}

}  // namespace

std::vector<UnusedInput> unused_inputs(const Case& question) {
  std::vector<UnusedInput> all;
  const std::vector<ModelChoice>& models = question.study.models;
  if (question.study.conditions.empty()) return all;
  for (const Declared& declared : declarable()) {
    if (declared.given(question)) {
      if (const std::string why = why_unused(models, declared); !why.empty()) all.push_back({declared.key, why});
    } else if (!declared.needs.empty()) {
      for (const std::string& id : in_need(models, declared))
        all.push_back({"effect", fmt::format("effect {} does not act: {}", id, declared.needs)});
    }
  }
  add_depths_of_the_bin(question, all);
  return all;
}

}  // namespace soilbin::compare
