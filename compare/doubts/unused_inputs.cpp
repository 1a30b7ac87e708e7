#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bekker_wong/effect.hpp"
#include "compare/doubts/doubts.hpp"

namespace soilbin::compare {
namespace {

/// A thing that a case may declare, and what hears of it: which effects, their forms say themselves (hears_of).
struct Declared {
  std::string key;
  std::optional<DoubtKind> of_wheel;  ///< that it changes nothing of the analytic wheel, which says the effects that do
  std::optional<DoubtKind> of_grains;  ///< the same of grains; none where they hear of it
  std::optional<DoubtKind> needs;      ///< that an effect lacks it; none where effects do without
  std::function<bool(const Case&)> given;
  std::string of_rft{};   ///< what resistive force theory does not know of it, in words; "" where it reads it
  std::string of_cone{};  ///< what the model cone_index does not know of it
};

bool any_condition(const Case& question, const std::function<bool(const OperatingCondition&)>& has) {
  return std::any_of(question.study.conditions.begin(), question.study.conditions.end(), has);
}

/// Whether the question tells a speed of a condition: one that is not the default, nor follows from a rotation.
bool tells_speed(const Case& question) {
  const Study& study = question.study;
  for (std::size_t i = 0; i < study.conditions.size(); ++i)
    if (study.conditions[i].speed != OperatingCondition{}.speed &&
        !(i < study.rotations.size() && study.rotations[i].has_value()))
      return !question.drive;
  return false;
}

const std::vector<Declared>& declarable() {
  using At = const OperatingCondition&;
  const auto some = [](auto has) { return [has](const Case& question) { return any_condition(question, has); }; };
  const auto of_condition = [&](const std::string& key, std::optional<DoubtKind> of_grains, DoubtKind needs, auto has,
                                const std::string& unread = "") {
    const std::string words = unread.empty() ? "'" + key + "'" : unread;
    return Declared{key, DoubtKind::condition_ignored, of_grains, needs, some(has), words, words};
  };
  const auto typed = [](const Case& question, const std::string& key) {
    return question.on_command_line.contains(key);
  };
  // Files may say more than one model needs; whoever types a value wants it to matter. Grains hear of these.
  const auto of_typed = [&](const std::string& key, DoubtKind kind, const std::string& of_rft,
                            const std::string& of_cone) {
    return Declared{key,
                    kind,
                    {},
                    {},
                    [=](const Case& question) {
                      const auto source = question.scenario.tire.sources.find(key);
                      const bool of_tire = source != question.scenario.tire.sources.end();
                      return (of_tire ? source->second == command_line_source : typed(question, key)) &&
                             !asks(question.study, ModelKind::dem);
                    },
                    of_rft,
                    of_cone};
  };
  // These are about the angle between wheel and travel.
  const auto of_yaw = [&](const std::string& key) {
    return Declared{key, DoubtKind::no_yaw, DoubtKind::no_yaw, {}, [=](const Case& question) {
                      return typed(question, key) && !any_condition(question, [](At at) { return at.yaw != 0.0; });
                    }};
  };
  static const std::vector<Declared> all = {
      {"lugs",
       DoubtKind::lugs_ignored,
       {},
       {},
       [](const Case& question) { return is_lugged(question.scenario.tire); },
       "",
       "the lugs, but for the outer diameter"},
      {"inflation_pressure",
       DoubtKind::inflation_ignored,
       DoubtKind::inflation_ignored_by_grains,
       {},
       [](const Case& question) {
         return question.scenario.tire.inflation_pressure.has_value() ||
                any_condition(question, [](const OperatingCondition& at) { return at.inflation_pressure.has_value(); });
       },
       "the inflation pressure: its wheel is rigid"},
      {"carcass_pressure",
       DoubtKind::carcass_ignored,
       DoubtKind::carcass_ignored_by_grains,
       {},
       [](const Case& question) {
         const Tire& tire = question.scenario.tire;
         const auto source = tire.sources.find("carcass_pressure");
         const bool is_typed = source != tire.sources.end() && source->second == command_line_source;
         return tire.carcass_pressure && (is_typed || !tire.inflation_pressure);
       },
       "the carcass pressure: its wheel is rigid",
       ""},
      {deflection_key,
       DoubtKind::deflection_ignored,
       DoubtKind::deflection_ignored_by_grains,
       {},
       [](const Case& question) { return question.scenario.tire.deflection.has_value(); },
       "the load-deflection table: its wheel is rigid"},
      of_typed("lugs.count", DoubtKind::lug_count_ignored, "", "the number of lugs"),
      of_typed("lugs.thickness", DoubtKind::lug_thickness_ignored, "", "the lugs' thickness"),
      of_typed("lugs.pattern", DoubtKind::lug_pattern_ignored, "", "the lugs' pattern"),
      of_typed("lugs.angle", DoubtKind::lug_angle_ignored, "", "the lugs' angle"),
      of_typed(section_height_key, DoubtKind::section_height_ignored, "the section height", ""),
      of_typed(construction_key, DoubtKind::construction_ignored, "the construction", ""),
      {"speed",
       DoubtKind::speed_ignored,
       {},
       {},
       [=](const Case& question) {
         return (typed(question, "speed") || tells_speed(question)) && !asks(question.study, ModelKind::dem);
       },
       "'speed'",
       "'speed'"},
      of_typed("bin", DoubtKind::bin_ignored, "'bin'", "'bin'"),
      of_yaw("slip_by"),
      of_yaw("force_frame"),
      {"no_assumed_sd",
       DoubtKind::assumed_errors_none,
       DoubtKind::assumed_errors_ignored_by_grains,
       {},
       [=](const Case& question) { return typed(question, "no_assumed_sd"); }},
      of_condition(
          "pass", {}, DoubtKind::effect_without_pass, [](At at) { return at.pass > 1; }, "the pass: it has no rut"),
      of_condition("moisture", DoubtKind::condition_ignored_by_grains, DoubtKind::effect_without_condition,
                   [](At at) { return at.moisture.has_value(); }),
      of_condition("position", DoubtKind::condition_ignored_by_grains, DoubtKind::effect_without_condition,
                   [](At at) { return at.position.has_value(); }),
      of_condition("run", DoubtKind::condition_ignored_by_grains, DoubtKind::effect_without_condition,
                   [](At at) { return at.run.has_value(); }),
  };
  return all;
}

bool hears_of(const bekker_wong::EffectForm& form, const std::string& key) {
  if (key == "bin") return std::ranges::any_of(form.parameters, &bekker_wong::EffectParameter::is_the_bins);
  return depends_on(form, key);
}

/// Whether the study is a drive's: its wheel has no label.
bool asked_by_drive(const Case& question) {
  return question.drive && std::ranges::any_of(question.study.models, [](const ModelChoice& m) {
           return m.model == ModelKind::bekker_wong && m.label.empty();
         });
}

/// The effects of the catalogue that hear of this, as a flag takes them: "--effect soil_gradient or bed_tilt:curved",
/// with their forms where some don't, or where they go in a drive; where none does, how grains are asked.
std::string hearing_effects(const std::string& key, EffectsAre named) {
  const bool of_drive = named == EffectsAre::of_a_drive;
  std::vector<std::string> names;
  for (const std::string& id : bekker_wong::effect_ids()) {
    std::vector<std::string> forms;
    std::size_t all = 0;
    for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) {
      const bool is_default = all == 0, holds = !of_drive || form.steady_only.empty();
      if (form.id != id || !(holds || is_default)) continue;
      ++all;
      if (hears_of(form, key) && holds) forms.push_back(id + ":" + form.form);
    }
    if (forms.size() == all) forms = {id};
    names.insert(names.end(), forms.begin(), forms.end());
  }
  if (names.empty()) return "--model dem";
  const std::string all = fmt::format("{}", fmt::join(names, " or "));
  if (named == EffectsAre::of_a_campaign) return all + " to 'model: {effects: [...]}' in campaign.yaml";
  return of_drive ? all + " to the drive's effects" : "--effect " + all;
}

bool hears(const ModelChoice& choice, const Declared& declared) {
  return std::any_of(choice.effects.begin(), choice.effects.end(), [&](const EffectChoice& effect) {
    return hears_of(bekker_wong::find_form(effect), declared.key);
  });
}

/// That a thing which is given changes nothing of the analytic models or, where these hear or aren't asked, of grains,
/// of resistive force theory or of cone_index.
Doubts doubts_of_unused(const std::vector<ModelChoice>& models, const Declared& declared, EffectsAre named) {
  const auto asked = [&](ModelKind kind) {
    return std::ranges::any_of(models, [&](auto& m) { return m.model == kind; });
  };
  const bool grains = asked(ModelKind::dem), wheel = asked(ModelKind::bekker_wong);
  Doubts by_others;
  if (asked(ModelKind::rft) && !declared.of_rft.empty())
    by_others.push_back({DoubtKind::ignored_by_rft, {declared.of_rft}});
  if (asked(ModelKind::cone_index) && !declared.of_cone.empty())
    by_others.push_back({DoubtKind::ignored_by_cone_index, {declared.of_cone}});
  if (!by_others.empty() && !wheel) return by_others;
  if (wheel && std::none_of(models.begin(), models.end(), [&](const ModelChoice& m) { return hears(m, declared); }))
    return {Doubt{*declared.of_wheel, {declared.key, hearing_effects(declared.key, named)}}};
  if (!grains || !declared.of_grains) return {};
  return {Doubt{*declared.of_grains, {declared.key}}};
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
void add_depths_of_the_bin(const Case& question, Doubts& all) {
  if (!question.scenario.bin || question.scenario.bin->depth <= 0) return;
  const double bin = question.scenario.bin->depth;
  for (const ModelChoice& choice : question.study.models)
    for (const EffectChoice& effect : choice.effects)
      for (const bekker_wong::EffectParameter& parameter : bekker_wong::find_form(effect).parameters) {
        const auto own = effect.parameters.find(parameter.name);
        if (!parameter.is_the_bins || own == effect.parameters.end() || own->second == bin) continue;
        all.push_back({DoubtKind::bin_depth_taken, {effect.id, 1000 * bin, parameter.name, 1000 * own->second}});
      }
}

}  // namespace

Doubts unused_inputs(const Case& question, EffectsAre named) {
  if (asked_by_drive(question)) named = EffectsAre::of_a_drive;
  Doubts all;
  const std::vector<ModelChoice>& models = question.study.models;
  if (question.study.conditions.empty()) return all;
  for (const Declared& declared : declarable()) {
    if (declared.key.starts_with("lugs.") && tell_of(all, DoubtKind::lugs_ignored)) continue;  // says it of all of them
    if (declared.given(question)) {
      append(all, doubts_of_unused(models, declared, named));
    } else if (declared.needs) {
      for (const std::string& id : in_need(models, declared)) all.push_back({*declared.needs, {declared.key, id}});
    }
  }
  add_depths_of_the_bin(question, all);
  return all;
}

}  // namespace soilbin::compare
