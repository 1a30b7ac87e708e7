#include "scenario/effect_choices.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace soilbin {
namespace {

std::vector<std::string> names_of(const std::vector<EffectParameterWords>& parameters) {
  std::vector<std::string> names;
  for (const EffectParameterWords& parameter : parameters) names.push_back(parameter.name);
  return names;
}

Measure measure_of(const EffectParameterWords& parameter) {
  return {parameter.unit, {.lower = parameter.lower, .upper = parameter.upper}};
}

/// "lug_thrust:passive_blade", as flags have it, as a file has it: "{id: lug_thrust, form: passive_blade}"; "" for
/// other texts.
std::string as_mapping(const std::string& text) {
  const std::size_t colon = text.find(':'), comma = text.find(',');
  const std::string id = text.substr(0, std::min(colon, comma));
  constexpr std::size_t longest = 200;  // of a message
  if (id.size() == text.size() || id.empty() || text.size() > longest) return "";
  std::string words = "{id: " + id, parameters;
  if (colon < comma) words += ", form: " + text.substr(colon + 1, comma == text.npos ? text.npos : comma - colon - 1);
  for (std::size_t from = comma; from != text.npos; from = text.find(',', from + 1)) {
    std::string parameter = text.substr(from + 1, text.find(',', from + 1) - from - 1);
    if (const std::size_t equals = parameter.find('='); equals != parameter.npos) parameter.replace(equals, 1, ": ");
    parameters += (parameters.empty() ? "" : ", ") + parameter;
  }
  return words + (parameters.empty() ? "" : ", parameters: {" + parameters + "}") + "}";
}

const EffectFormWords& read_form(const YamlNode* node, const std::vector<EffectFormWords>& forms,
                                 const Reading& reading) {
  if (node == nullptr) return forms.front();
  std::vector<std::string> names;
  for (const EffectFormWords& form : forms) names.push_back(form.form);
  return forms[read_word(*node, names, reading)];
}

EffectChoice read_effect(const YamlNode& node, const EffectVocabulary& vocabulary, const Reading& reading) {
  const bool plain = !node.is_mapping();
  if (!plain) expect_keys(node, {"id", "form", "parameters"}, reading);
  const YamlNode& id_node = plain ? node : *value_of(node, "id", Need::required, "of the catalogue", reading);
  const std::vector<std::string> ids = vocabulary.ids();
  if (const std::string words = as_mapping(id_node.scalar); !words.empty())
    reading.refuse(id_node, fmt::format("'{}' is how a flag spells an effect", clipped(id_node.scalar)),
                   "in a file: " + words);
  EffectChoice choice;
  choice.id = ids[read_word(id_node, ids, reading)];
  const std::vector<EffectFormWords> forms = vocabulary.forms(choice.id);
  const YamlNode* form_node = plain ? nullptr : value_of(node, "form", Need::optional, "form of the effect", reading);
  const EffectFormWords& form = read_form(form_node, forms, reading);
  choice.form = form.form;
  const YamlNode* values =
      plain ? nullptr : value_of(node, "parameters", Need::optional, "parameters of the form", reading);
  if (values != nullptr) expect_keys(*values, names_of(form.parameters), reading);
  for (const EffectParameterWords& parameter : form.parameters) {
    const YamlNode* value =
        values == nullptr ? nullptr : value_of(*values, parameter.name, Need::optional, parameter.meaning, reading);
    choice.parameters[parameter.name] =
        value == nullptr ? parameter.fallback : read_scalar(*value, measure_of(parameter), reading).value;
  }
  return choice;
}

}  // namespace

EffectFormWords form_of(const EffectChoice& choice, const EffectVocabulary& vocabulary) {
  for (EffectFormWords& form : vocabulary.forms(choice.id))
    if (choice.form.empty() || form.form == choice.form) return std::move(form);
  throw InputError(fmt::format("effect '{}' has no variant '{}'", choice.id, choice.form));
}

std::vector<EffectChoice> read_effects(const YamlNode& list, const EffectVocabulary& vocabulary,
                                       const Reading& reading) {
  if (!list.is_sequence())
    reading.refuse(list, "expected a list of effects, such as '[slip_sinkage]', not " + list.kind_name());
  std::vector<EffectChoice> effects;
  for (const YamlNode& node : list.items) {
    EffectChoice choice = read_effect(node, vocabulary, reading);
    const bool again = std::any_of(effects.begin(), effects.end(), [&](const EffectChoice& e) {
      return e.id == choice.id && (e.form == choice.form || !vocabulary.forms_add_up(e.id));
    });
    if (again) reading.refuse(node, fmt::format("effect '{}' is listed twice", choice.id));
    effects.push_back(std::move(choice));
  }
  return effects;
}

void write_effects(const std::vector<EffectChoice>& effects, const EffectVocabulary& vocabulary,
                   std::optional<double> n, YamlLines& lines) {
  if (effects.empty()) return lines.value("effects", "[]");
  lines.open("effects");
  for (const EffectChoice& choice : effects) {
    const EffectFormWords form = form_of(choice, vocabulary);
    lines.open_item();
    lines.value("id", choice.id);
    lines.value("form", form.form);
    if (!form.parameters.empty()) lines.open("parameters");
    for (const EffectParameterWords& parameter : form.parameters) {
      const auto found = choice.parameters.find(parameter.name);
      const double value = found == choice.parameters.end() ? parameter.fallback : found->second;
      lines.value(parameter.name, write_quantity(value, parameter.unit, n));
    }
    if (!form.parameters.empty()) lines.close();
    lines.close();
  }
  lines.close();
}

}  // namespace soilbin
