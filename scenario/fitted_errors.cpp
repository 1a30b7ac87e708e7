#include "scenario/fitted_errors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenario/effect_choices.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin {
namespace {

std::vector<std::string> parameters_of(const std::vector<EffectChoice>& effects) {
  std::vector<std::string> names;
  for (const SoilParameter& p : soil_parameters) names.emplace_back(p.name);
  names.emplace_back(carcass_pressure_key);
  for (std::size_t i = 0; i < effects.size(); ++i)
    for (const auto& [name, value] : effects[i].parameters) names.push_back(effect_parameter_name(effects, i, name));
  return names;
}

/// The unit of an effect's parameter and no bound: an sd may be larger than what it stands beside.
Measure measure_of(const EffectParameterPlace& place, const std::vector<EffectChoice>& effects,
                   const EffectVocabulary& vocabulary) {
  const EffectFormWords form = form_of(effects[place.effect], vocabulary);
  const auto parameter = std::ranges::find(form.parameters, place.parameter, &EffectParameterWords::name);
  return {parameter == form.parameters.end() ? "-" : parameter->unit, zero_or_more};
}

FittedError read_error(const YamlNode& node, const std::vector<FittedError>& above,
                       const std::vector<EffectChoice>& effects, const EffectVocabulary& vocabulary,
                       const Reading& reading) {
  expect_keys(node, {"parameter", "sd", "correlations"}, reading);
  const YamlNode& name =
      *value_of(node, "parameter", Need::required, "of the soil, of the tire or of an effect", reading);
  const std::vector<std::string> known = parameters_of(effects);
  FittedError error;
  error.parameter = known[read_word(name, known, reading)];
  const YamlNode* sd = value_of(node, "sd", Need::optional, "standard deviation", reading);
  const auto place = find_effect_parameter(error.parameter, effects);
  if (place && !sd) reading.refuse(node, fmt::format("'{}' has no sd", error.parameter));
  if (!place && sd)
    reading.refuse(*sd, fmt::format("the sd of '{}' stands with the {}", error.parameter,
                                    error.parameter == carcass_pressure_key ? "tire" : "soil"));
  if (place) error.std_error = read_scalar(*sd, measure_of(*place, effects, vocabulary), reading).value;
  if (const YamlNode* list = value_of(node, "correlations", Need::optional, "with the parameters above", reading)) {
    if (!list->is_sequence() || list->items.size() != above.size())
      reading.refuse(*list,
                     fmt::format("expected a list of {} correlations, one for each parameter above", above.size()));
    for (const YamlNode& item : list->items)
      error.correlations.push_back(read_scalar(item, {"-", {.lower = -1.0, .upper = 1.0}}, reading).value);
  }
  return error;
}

}  // namespace

std::optional<EffectParameterPlace> find_effect_parameter(const std::string& name,
                                                          const std::vector<EffectChoice>& effects) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string effect = name.substr(0, dot);
  for (std::size_t i = 0; i < effects.size(); ++i)
    if (effect == effects[i].id || effect == effects[i].id + ":" + effects[i].form)
      return EffectParameterPlace{i, name.substr(dot + 1)};
  return std::nullopt;
}

std::string effect_parameter_name(const std::vector<EffectChoice>& effects, std::size_t effect,
                                  const std::string& parameter) {
  const EffectChoice& choice = effects[effect];
  const bool several = std::ranges::count(effects, choice.id, &EffectChoice::id) > 1;
  return choice.id + (several ? ":" + choice.form : "") + "." + parameter;
}

double correlation(const std::vector<FittedError>& errors, std::size_t i, std::size_t k) {
  if (i == k) return 1.0;
  const std::vector<double>& row = errors[std::max(i, k)].correlations;
  return row.empty() ? 0.0 : row[std::min(i, k)];
}

double correlation(const std::vector<FittedError>& errors, const std::string& one, const std::string& other) {
  const auto a = std::ranges::find(errors, one, &FittedError::parameter),
             b = std::ranges::find(errors, other, &FittedError::parameter);
  return a == errors.end() || b == errors.end() ? 0.0 : correlation(errors, a - errors.begin(), b - errors.begin());
}

bool are_correlations(const std::vector<FittedError>& errors) {
  constexpr double rounding = 1e-9;                        // of digits left out in a file
  std::vector<std::vector<double>> factor(errors.size());  // Cholesky's, where a pivot may be 0
  for (std::size_t i = 0; i < errors.size(); ++i)
    for (std::size_t k = 0; k <= i; ++k) {
      double rest = correlation(errors, i, k);
      for (std::size_t m = 0; m < k; ++m) rest -= factor[i][m] * factor[k][m];
      if (k == i && rest < -rounding) return false;
      factor[i].push_back(k == i ? std::sqrt(std::max(0.0, rest)) : factor[k][k] > 0.0 ? rest / factor[k][k] : 0.0);
    }
  return true;
}

std::vector<FittedError> read_fitted_errors(const YamlNode& list, const std::vector<EffectChoice>& effects,
                                            const EffectVocabulary& vocabulary, const Reading& reading) {
  if (!list.is_sequence()) reading.refuse(list, "expected a list of parameters, not " + list.kind_name());
  std::vector<FittedError> errors;
  std::set<std::string> seen;
  for (const YamlNode& node : list.items) {
    errors.push_back(read_error(node, errors, effects, vocabulary, reading));
    if (!seen.insert(errors.back().parameter).second)
      reading.refuse(node, fmt::format("parameter '{}' is listed twice", errors.back().parameter));
    if (!are_correlations(errors))
      reading.refuse(node,
                     "these correlations contradict each other: some combination of the parameters would have a "
                     "negative variance");
  }
  return errors;
}

void write_fitted_errors(const std::vector<FittedError>& errors, const std::vector<EffectChoice>& effects,
                         const EffectVocabulary& vocabulary, std::optional<double> n, YamlLines& lines) {
  if (errors.empty()) return;
  lines.open("errors");
  for (const FittedError& error : errors) {
    lines.open_item();
    lines.value("parameter", yaml_scalar(error.parameter));
    if (const auto place = find_effect_parameter(error.parameter, effects); place && error.std_error)
      lines.value("sd", write_quantity(*error.std_error, measure_of(*place, effects, vocabulary).unit, n));
    std::string row;
    for (const double r : error.correlations) row += (row.empty() ? "" : ", ") + write_quantity(r, "-");
    if (!row.empty()) lines.value("correlations", "[" + row + "]");
    lines.close();
  }
  lines.close();
}

}  // namespace soilbin
