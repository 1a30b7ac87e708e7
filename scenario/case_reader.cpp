#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "scenario/case.hpp"
#include "scenario/condition_axes.hpp"
#include "scenario/effect_choices.hpp"
#include "scenario/fitted_errors.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/named_parts.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin {
namespace {

/// Whether some of the models show this effect in another form.
bool in_other_forms(const EffectChoice& effect, const std::vector<ModelChoice>& models) {
  return std::any_of(models.begin(), models.end(), [&](const ModelChoice& model) {
    return std::any_of(model.effects.begin(), model.effects.end(),
                       [&](const EffectChoice& other) { return other.id == effect.id && other.form != effect.form; });
  });
}

void check_soil_for(const ModelChoice& choice, const Soil& soil, const YamlNode& node, const Reading& reading) {
  if (choice.model == ModelKind::bekker_wong && !soil.semi_empirical)
    reading.refuse(node, fmt::format("model 'bekker_wong' needs the soil's 'semi_empirical' section; '{}' has none",
                                     clipped(soil.name)));
  if (choice.model == ModelKind::dem && !soil.granular)
    reading.refuse(node,
                   fmt::format("model 'dem' needs the soil's 'granular' section; '{}' has none", clipped(soil.name)));
  if (choice.model == ModelKind::dem && !choice.effects.empty())
    reading.refuse(node, "model 'dem' takes no effects: grains show them or they don't");
  if ((choice.model == ModelKind::rft || choice.model == ModelKind::cone_index) && !choice.effects.empty())
    reading.refuse(
        node, fmt::format("model '{}' takes no effects: they are of bekker_wong's stresses", word_of(choice.model)));
  if (choice.model == ModelKind::rft && !soil.resistive_force && !soil.semi_empirical)
    reading.refuse(node, fmt::format("model 'rft' needs the soil's 'resistive_force' section, or 'semi_empirical' to "
                                     "estimate it from; '{}' has neither",
                                     clipped(soil.name)));
  if (choice.model == ModelKind::cone_index && !soil.cone_index && !soil.cone_index_gradient)
    reading.refuse(node, fmt::format("model 'cone_index' needs the soil's 'cone_index' or, of sand, its "
                                     "'cone_index_gradient'; '{}' has neither",
                                     clipped(soil.name)));
}

/// The effects of a model or a drive, and how they and the soil err where a fit found both.
void read_effects_and_errors(const YamlNode& node, const EffectVocabulary& effects, const Reading& reading,
                             auto& into) {
  if (const YamlNode* list = value_of(node, "effects", Need::optional, "list of effects; [] for none", reading))
    into.effects = read_effects(*list, effects, reading);
  if (const YamlNode* list = value_of(node, "errors", Need::optional, "how fitted parameters err together", reading))
    into.errors = read_fitted_errors(*list, into.effects, effects, reading);
}

Misfit read_misfit(const YamlNode& node, const Reading& reading) {
  std::vector<std::string> keys;
  for (const TractionChannel& channel : traction_channels) keys.emplace_back(channel.name);
  expect_keys(node, keys, reading);
  Misfit misfit{};
  for (std::size_t i = 0; i < misfit.size(); ++i)
    if (const YamlNode* rms = value_of(node, keys[i], Need::optional, "root mean square misfit", reading))
      misfit[i] = read_scalar(*rms, {std::string(traction_channels[i].si_unit), zero_or_more}, reading).value;
  return misfit;
}

/// A model's name, or {model, effects, label, errors, misfit}.
ModelChoice read_model(const YamlNode& node, const Soil& soil, const EffectVocabulary& effects,
                       const Reading& reading) {
  ModelChoice choice;
  if (!node.is_mapping()) {
    choice.model = read_choice<ModelKind>(node, reading);
  } else {
    expect_keys(node, {"model", "effects", "label", "errors", "misfit"}, reading);
    choice.model = read_choice<ModelKind>(
        *value_of(node, "model", Need::required, "bekker_wong, dem, rft or cone_index", reading), reading);
    read_effects_and_errors(node, effects, reading, choice);
    if (const YamlNode* misfit = value_of(node, "misfit", Need::optional, "what a fit missed, by channel", reading))
      choice.misfit = read_misfit(*misfit, reading);
    if (const YamlNode* label = value_of(node, "label", Need::optional, "for tables and plots", reading))
      choice.label = read_name(*label, reading);
  }
  check_soil_for(choice, soil, node, reading);
  return choice;
}

std::vector<ModelChoice> read_models(const YamlNode* list, const YamlNode& study, const Soil& soil,
                                     const EffectVocabulary& effects, const Reading& reading) {
  if (list == nullptr) {
    ModelChoice base;
    check_soil_for(base, soil, study, reading);
    std::vector<ModelChoice> only_base = {base};
    label_models(only_base);
    return only_base;
  }
  if (!list->is_sequence()) reading.refuse(*list, "expected a list of models, not " + list->kind_name());
  if (list->items.empty()) reading.refuse(*list, "the list of models is empty");
  std::vector<ModelChoice> models;
  for (const YamlNode& node : list->items) models.push_back(read_model(node, soil, effects, reading));
  label_models(models);
  return models;
}

Study read_study(const YamlNode& node, const Case& about, const EffectVocabulary& effects, Reading reading) {
  expect_keys(node, {"name", "models", "conditions"}, reading);
  const Soil& soil = about.scenario.soil;
  if (soil.semi_empirical) reading.n = soil.semi_empirical->exponent.value;
  Study study;
  study.name = about.name;
  if (const YamlNode* name = value_of(node, "name", Need::optional, "what to call the study", reading))
    study.name = read_name(*name, reading);
  study.models =
      read_models(value_of(node, "models", Need::optional, "list of models", reading), node, soil, effects, reading);
  ConditionGrid grid = read_conditions(
      *value_of(node, "conditions", Need::required, "load, slip, ...: a value, a list or a range each", reading),
      about.scenario.tire, reading);
  study.conditions = std::move(grid.conditions);
  study.rotations = std::move(grid.rotations);
  return study;
}

Drive read_drive(const YamlNode& node, const Soil& soil, const Library& library, const EffectVocabulary& effects,
                 Reading reading) {
  if (!soil.semi_empirical)
    reading.refuse(node,
                   fmt::format("a drive needs the soil's 'semi_empirical' section; '{}' has none", clipped(soil.name)));
  reading.n = soil.semi_empirical->exponent.value;
  const SoilReader soils = [&](const YamlNode& part, const Reading& at) {
    Soil other = read_soil_part(part, library, at);
    if (!other.semi_empirical) at.refuse(part, "a drive needs a soil with a 'semi_empirical' section");
    if (gravity_of(other) != gravity_of(soil))
      at.refuse(part,
                fmt::format("soil '{}' lies under {:.6g} m/s^2, and the case's soil under {:.6g} m/s^2",
                            clipped(other.name), gravity_of(other), gravity_of(soil)),
                "a drive has one gravity: write it in every soil on the way");
    return other;
  };
  reading.soils = &soils;
  Drive drive = read_mapping<Drive>(node, reading, {"effects", "errors"});
  read_effects_and_errors(node, effects, reading, drive);
  return drive;
}

}  // namespace

bool asks(const Study& study, ModelKind kind) {
  return std::any_of(study.models.begin(), study.models.end(),
                     [&](const ModelChoice& choice) { return choice.model == kind; });
}

Scenario seen_by(const ModelChoice& choice, Scenario scenario) {
  scenario.effects = choice.effects;
  scenario.errors = choice.errors;
  scenario.misfit = choice.misfit;
  return scenario;
}

void label_models(std::vector<ModelChoice>& models) {
  for (ModelChoice& choice : models) {
    if (!choice.label.empty()) continue;
    choice.label = word_of(choice.model);
    for (const EffectChoice& effect : choice.effects)
      choice.label += " + " + effect.id + (in_other_forms(effect, models) ? ":" + effect.form : "");
  }
}

Case question_of(Scenario scenario) {
  Case question;
  question.study.models = {{ModelKind::bekker_wong, std::move(scenario.effects), "", std::move(scenario.errors),
                            std::exchange(scenario.misfit, {})}};
  scenario.effects.clear(), scenario.errors.clear();
  question.scenario = std::move(scenario);
  label_models(question.study.models);
  return question;
}

Case parse_case(const SourceText& source, const Library& library, const EffectVocabulary& effects) {
  const YamlNode document = parse_yaml(source);
  const Reading reading{&source, std::nullopt, nullptr, ""};
  expect_format(document, case_format, reading);
  Case value = read_mapping<Case>(document, reading, {"format", "tire", "soil", "bin", "study", "drive"});
  const Library near = library.beside(source.file);
  const auto part = [&](const char* key, const char* meaning) -> const YamlNode& {
    return *value_of(document, key, Need::required, meaning, reading);
  };
  value.scenario.tire = read_tire_part(part("tire", "a mapping, a name of the library, or a path"), near, reading);
  value.scenario.soil = read_soil_part(part("soil", "a mapping, a name of the library, or a path"), near, reading);
  if (const YamlNode* bin = value_of(document, "bin", Need::optional, "inner measures of the soil bin", reading))
    value.scenario.bin = read_mapping<Bin>(*bin, reading);
  const YamlNode* drive = value_of(document, "drive", Need::optional, "a wheel driven in time", reading);
  if (drive != nullptr) value.drive = read_drive(*drive, value.scenario.soil, near, effects, reading);
  const Need study = drive != nullptr ? Need::optional : Need::required;
  if (const YamlNode* node = value_of(document, "study", study, "models and conditions", reading))
    value.study = read_study(*node, value, effects, reading);
  return value;
}

Case read_case(const std::filesystem::path& path, const Library& library, const EffectVocabulary& effects) {
  return parse_case(read_source_text(path, largest_yaml), library, effects);
}

}  // namespace soilbin
