#include "compare/doubts/unused_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bekker_wong/effect.hpp"

namespace soilbin::compare {
namespace {

/// A thing that a case may declare, and what hears of it: which effects, their forms say themselves (hears_of).
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
  const auto typed = [](const Case& question, const std::string& key) {
    return question.on_command_line.contains(key);
  };
  // Files may say more than one model needs; whoever types a value wants it to matter. Grains hear of these.
  const auto of_typed = [&](const std::string& key, const std::string& words) {
    return Declared{key, words, "", "", [=](const Case& question) {
                      const auto source = question.scenario.tire.sources.find(key);
                      const bool of_tire = source != question.scenario.tire.sources.end();
                      return (of_tire ? source->second == command_line_source : typed(question, key)) &&
                             !asks(question.study, ModelKind::dem);
                    }};
  };
  // These are about the angle between wheel and travel.
  const auto of_yaw = [&](const std::string& key) {
    const std::string words = fmt::format("'{}' is ignored: no condition has a 'yaw'", key);
    return Declared{key, words, words, "", [=](const Case& question) {
                      return typed(question, key) && !any_condition(question, [](At at) { return at.yaw != 0.0; });
                    }};
  };
  static const std::vector<Declared> all = {
      {"lugs", "lugs are ignored: add {} (estimate, explain, limits and run do where they ask one model)", "", "",
       [](const Case& question) { return is_lugged(question.scenario.tire); }},
      {"inflation_pressure", "the inflation pressure is ignored: add {} (estimate, explain, limits and run do)",
       "the inflation pressure is ignored: grains meet a rigid tire", "",
       [](const Case& question) {
         return question.scenario.tire.inflation_pressure.has_value() ||
                any_condition(question, [](const OperatingCondition& at) { return at.inflation_pressure.has_value(); });
       }},
      {"carcass_pressure", "the carcass pressure is ignored: add {}",
       "the carcass pressure is ignored: grains meet a rigid tire", "",
       [](const Case& question) {
         const Tire& tire = question.scenario.tire;
         const auto source = tire.sources.find("carcass_pressure");
         const bool is_typed = source != tire.sources.end() && source->second == command_line_source;
         return tire.carcass_pressure && (is_typed || !tire.inflation_pressure);
       }},
      of_typed("lugs.count", "the number of lugs is ignored: add {}"),
      of_typed("lugs.thickness", "the lugs' thickness is ignored: only grains have it, {}"),
      of_typed("lugs.pattern", "the lugs' pattern is ignored: only grains have it, {}"),
      of_typed("lugs.angle", "the lugs' angle is ignored: only grains have it, {}"),
      of_typed("speed", "the speed is ignored: add {}"),
      of_typed("bin", "the bin is ignored: add {}, which reads its depth"),
      of_yaw("slip_by"),
      of_yaw("force_frame"),
      {"no_assumed_sd", "--no-assumed-sd is ignored: no standard deviation of the soil is only assumed",
       "grains ignore --no-assumed-sd", "", [=](const Case& question) { return typed(question, "no_assumed_sd"); }},
      of_condition("pass", "", "no condition has a 'pass' of 2 or more", [](At at) { return at.pass > 1; }),
      of_condition("moisture", "grains ignore 'moisture'", "no condition has a 'moisture'",
                   [](At at) { return at.moisture.has_value(); }),
      of_condition("position", "grains ignore 'position'", "no condition has a 'position'",
                   [](At at) { return at.position.has_value(); }),
      of_condition("run", "grains ignore 'run'", "no condition has a 'run'", [](At at) { return at.run.has_value(); }),
  };
  return all;
}

bool hears_of(const bekker_wong::EffectForm& form, const std::string& key) {
  if (key == "bin") return std::ranges::any_of(form.parameters, &bekker_wong::EffectParameter::is_the_bins);
  return depends_on(form, key);
}

/// The effects of the catalogue that hear of this, as a flag takes them: "--effect soil_gradient or bed_tilt:curved",
/// with their forms where some don't; where none does, how grains are asked.
std::string hearing_effects(const std::string& key) {
  std::vector<std::string> names;
  for (const std::string& id : bekker_wong::effect_ids()) {
    std::vector<std::string> forms;
    std::size_t all = 0;
    for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) {
      if (form.id != id) continue;
      ++all;
      if (hears_of(form, key)) forms.push_back(id + ":" + form.form);
    }
    if (forms.size() == all) forms = {id};
    names.insert(names.end(), forms.begin(), forms.end());
  }
  return names.empty() ? "--model dem" : fmt::format("--effect {}", fmt::join(names, " or "));
}

bool hears(const ModelChoice& choice, const Declared& declared) {
  return std::any_of(choice.effects.begin(), choice.effects.end(), [&](const EffectChoice& effect) {
    return hears_of(bekker_wong::find_form(effect), declared.key);
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
  const auto lugs_are_left_out = [&] {
    return !all.empty() && all.front().key == "lugs";
  };  // says it of all about them
  const std::vector<ModelChoice>& models = question.study.models;
  if (question.study.conditions.empty()) return all;
  for (const Declared& declared : declarable()) {
    if (declared.key.starts_with("lugs.") && lugs_are_left_out()) continue;
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
