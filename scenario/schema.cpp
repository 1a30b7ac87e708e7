#include "scenario/schema.hpp"

#include <cmath>

#include "scenario/schema_visitor.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin {

using nlohmann::ordered_json;

namespace {

constexpr const char* number_pattern = R"(^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";

std::string sentence(const Measure& measure, const std::string& meaning) {
  const Range& range = measure.range;
  const bool bounded = std::isfinite(range.lower) || std::isfinite(range.upper);
  const std::string unit = measure.unit == "-" ? "" : " [" + measure.unit + "]";
  return meaning + unit + (bounded ? "; " + describe_range(measure) : "");
}

void add_bounds(ordered_json& schema, const Range& range) {
  if (std::isfinite(range.lower)) schema[range.lower_open ? "exclusiveMinimum" : "minimum"] = range.lower;
  if (std::isfinite(range.upper)) schema[range.upper_open ? "exclusiveMaximum" : "maximum"] = range.upper;
}

/// A property as an axis: the value, a list of values or, for a number, a range.
ordered_json axis_schema(const ordered_json& value, bool numeric) {
  ordered_json any = ordered_json::array({value, {{"type", "array"}, {"minItems", 1}, {"items", value}}});
  if (numeric) {
    ordered_json range = empty_object_schema();
    range["properties"] = {{"from", value}, {"to", value}, {"step", true}, {"count", integer_schema(2, "values")}};
    range["required"] = {"from", "to"};
    range["oneOf"] = {{{"required", {"step"}}}, {{"required", {"count"}}}};
    any.push_back(range);
  }
  ordered_json axis = {{"anyOf", any}};
  if (value.contains("description")) axis["description"] = value["description"];
  return axis;
}

/// OperatingCondition's description with each key as an axis.
class AxisSchema {
 public:
  ordered_json schema = empty_object_schema();

  template <class N>
  void number(const char* key, N OperatingCondition::*, const Measure& measure, Need need, const char* meaning) {
    add(key, need, axis_schema(quantity_schema(measure, meaning), true));
  }
  template <class N>
  void integer(const char* key, N OperatingCondition::*, int lowest, Need need, const char* meaning) {
    add(key, need, axis_schema(integer_schema(lowest, meaning), false));
  }
  template <class E>
  void choice(const char* key, E OperatingCondition::*, Need need, const char* meaning) {
    add(key, need, axis_schema(words_schema(all_words<E>(), meaning), false));
  }

 private:
  void add(const char* key, Need need, ordered_json property) {
    schema["properties"][key] = std::move(property);
    if (need == Need::required) schema["required"].push_back(key);
  }
};

ordered_json conditions_schema() {
  AxisSchema visitor;
  describe(visitor, std::type_identity<OperatingCondition>{});
  ordered_json grid = visitor.schema;
  grid["properties"]["rotation"] =
      axis_schema(quantity_schema({"rpm", above_zero}, "speed of rotation; instead of 'speed'"), true);
  grid["not"] = {{"required", {"speed", "rotation"}}};
  return {{"anyOf", ordered_json::array({grid, {{"type", "array"}, {"minItems", 1}, {"items", grid}}})}};
}

ordered_json fitted_errors_schema() {
  ordered_json error = empty_object_schema();
  const ordered_json correlation = {{"type", "number"}, {"minimum", -1}, {"maximum", 1}};
  error["properties"] = {
      {"parameter", text_schema("of the soil, of the tire (carcass_pressure), or of an effect: slip_sinkage.a")},
      {"sd", text_schema("standard deviation, of an effect's parameter")},
      {"correlations", {{"type", "array"}, {"items", correlation}}}};
  error["required"] = {"parameter"};
  return {{"type", "array"}, {"items", error}, {"description", "of a fit"}};
}

ordered_json misfit_schema() {
  ordered_json misfit = empty_object_schema();
  for (const TractionChannel& channel : traction_channels)
    misfit["properties"][std::string(channel.name)] =
        quantity_schema({std::string(channel.si_unit), zero_or_more}, "root mean square, beyond the runs' noise");
  misfit["description"] = "how far a fit missed runs that it had not seen: a part of every standard error";
  return misfit;
}

ordered_json models_schema(const EffectVocabulary& effects) {
  const ordered_json name = words_schema(all_words<ModelKind>(), "which model");
  ordered_json object = empty_object_schema();
  object["properties"] = {{"model", name},
                          {"effects", effects_schema(effects)},
                          {"label", text_schema("for tables and plots")},
                          {"errors", fitted_errors_schema()},
                          {"misfit", misfit_schema()}};
  object["required"] = {"model"};
  return {{"type", "array"}, {"minItems", 1}, {"items", {{"anyOf", ordered_json::array({name, object})}}}};
}

ordered_json study_schema(const EffectVocabulary& effects) {
  ordered_json study = empty_object_schema();
  study["properties"] = {{"name", text_schema("what to call the study")},
                         {"models", models_schema(effects)},
                         {"conditions", conditions_schema()}};
  study["required"] = {"conditions"};
  return study;
}

ordered_json effect_schema(const std::string& id, const std::vector<EffectFormWords>& forms, std::size_t chosen) {
  const EffectFormWords& form = forms[chosen];
  ordered_json parameters = empty_object_schema();
  for (const EffectParameterWords& p : form.parameters)
    parameters["properties"][p.name] = quantity_schema({p.unit, {.lower = p.lower, .upper = p.upper}}, p.meaning);
  ordered_json effect = empty_object_schema();
  effect["properties"] = {{"id", {{"const", id}}}, {"form", {{"const", form.form}}}, {"parameters", parameters}};
  effect["required"] = chosen == 0 ? ordered_json{"id"} : ordered_json{"id", "form"};
  return effect;
}

}  // namespace

ordered_json named_or(ordered_json inline_part) {
  const ordered_json name = {{"type", "string"}, {"description", "a name of the library, or a relative path"}};
  return {{"anyOf", ordered_json::array({name, std::move(inline_part)})}};
}

ordered_json soil_part_schema(ordered_json inline_part) {
  ordered_json bed = empty_object_schema(), any = named_or(std::move(inline_part));
  bed["properties"] = {{"from", text_schema("a soil with 'beds': a name of the library, or a relative path")},
                       {"density", quantity_schema({"kg/m^3", above_zero}, "of the bed that is asked about")}};
  bed["required"] = {"from", "density"};
  any["anyOf"].push_back(std::move(bed));
  return any;
}

ordered_json empty_object_schema() {
  return {{"type", "object"},
          {"additionalProperties", false},
          {"properties", ordered_json::object()},
          {"required", ordered_json::array()}};
}

ordered_json text_schema(const std::string& meaning) {
  return {{"type", ordered_json::array({"string", "number", "boolean"})}, {"description", meaning}};
}

ordered_json integer_schema(int lowest, const std::string& meaning) {
  return {{"type", "integer"}, {"minimum", lowest}, {"description", meaning}};
}

ordered_json document_schema(const char* format, const char* title, ordered_json object) {
  ordered_json schema;
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = title;
  schema.update(object);
  ordered_json properties = {{"format", {{"const", format}}}};
  properties.update(object["properties"]);
  schema["properties"] = properties;
  ordered_json required = {"format"};
  for (const ordered_json& key : object["required"]) required.push_back(key);
  schema["required"] = required;
  return schema;
}

ordered_json words_schema(const std::vector<std::string>& words, const std::string& meaning) {
  return {{"enum", words}, {"description", meaning}};
}

ordered_json quantity_schema(const Measure& measure, const std::string& meaning) {
  if (measure.unit != "-") {
    const bool ratio = same_dimension(parse_unit(measure.unit, 1.0).dimension, {});
    const std::string pattern = std::string(number_pattern) + (ratio ? R"(\s*(%|-)?\s*$)" : R"(\s*[^\s0-9.].*$)");
    ordered_json text = {{"type", "string"}, {"pattern", pattern}, {"description", sentence(measure, meaning)}};
    if (!ratio) return text;
    ordered_json number = {{"type", "number"}};
    add_bounds(number, measure.range);
    return {{"anyOf", ordered_json::array({number, text})}, {"description", sentence(measure, meaning)}};
  }
  ordered_json number = {{"type", "number"}};
  add_bounds(number, measure.range);
  const ordered_json percent = {{"type", "string"}, {"pattern", std::string(number_pattern) + R"(\s*(%|-)?\s*$)"}};
  return {{"anyOf", ordered_json::array({number, percent})}, {"description", sentence(measure, meaning)}};
}

ordered_json number_schema(const Measure& measure, const std::string& meaning, bool with_deviation) {
  const ordered_json scalar = quantity_schema(measure, meaning);
  ordered_json object = empty_object_schema();
  object["properties"]["value"] = scalar;
  if (with_deviation) object["properties"]["sd"] = quantity_schema({measure.unit, zero_or_more}, "standard deviation");
  object["properties"]["source"] = text_schema("where the number comes from");
  object["required"] = {"value"};
  return {{"anyOf", ordered_json::array({scalar, object})}, {"description", sentence(measure, meaning)}};
}

ordered_json effects_schema(const EffectVocabulary& effects) {
  ordered_json any = ordered_json::array({words_schema(effects.ids(), "an effect in its default form")});
  for (const std::string& id : effects.ids()) {
    const std::vector<EffectFormWords> forms = effects.forms(id);
    for (std::size_t i = 0; i < forms.size(); ++i) any.push_back(effect_schema(id, forms, i));
  }
  return {{"type", "array"}, {"items", {{"anyOf", any}}}};
}

ordered_json case_schema(const EffectVocabulary& effects) {
  ordered_json object = object_schema<Case>();
  object["properties"]["tire"] = named_or(object_schema<Tire>());
  object["properties"]["soil"] = soil_part_schema(object_schema<Soil>());
  object["properties"]["bin"] = object_schema<Bin>();
  object["properties"]["study"] = study_schema(effects);
  object["properties"]["drive"] = object_schema<Drive>();
  object["properties"]["drive"]["properties"]["effects"] = effects_schema(effects);
  object["properties"]["drive"]["properties"]["errors"] = fitted_errors_schema();
  for (const char* key : {"tire", "soil"}) object["required"].push_back(key);
  ordered_json schema = document_schema(case_format, "A soilbin case", object);
  schema["anyOf"] = {{{"required", {"study"}}}, {{"required", {"drive"}}}};
  return schema;
}

ordered_json tire_schema() { return document_schema(tire_format, "A soilbin tire", object_schema<Tire>()); }
ordered_json soil_schema() { return document_schema(soil_format, "A soilbin soil", object_schema<Soil>()); }

}  // namespace soilbin
