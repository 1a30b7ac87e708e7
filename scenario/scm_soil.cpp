#include "scenario/scm_soil.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenario/nearest_word.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin {
namespace {

using ScmJson = nlohmann::json;

/// Where a key stands in the text, for errors; the beginning where it doesn't.
std::size_t place_of(const SourceText& source, const std::string& key) {
  const std::size_t at = source.text.find("\"" + key + "\"");
  return at == std::string::npos ? 0 : at;
}

double number_of(const ScmJson& section, const std::string& key, const SourceText& source) {
  if (const ScmJson& value = section.at(key); value.is_number()) return value.get<double>();
  source.refuse(place_of(source, key), fmt::format("'{}': expected a number", clipped(key)));
}

const ScmJson& soil_parameters_of(const ScmJson& document, const SourceText& source) {
  const char* const section = "Soil parameters";
  const char* const hint =
      "a soil of soilbin is a YAML file; soilbin export scm SOIL --output scm.json writes this one";
  if (!document.is_object() || !document.contains(section))
    source.refuse(0, "no soil for Chrono's SCM terrain: it has no section 'Soil parameters'", hint);
  const ScmJson& values = document.at(section);
  if (!values.is_object()) source.refuse(place_of(source, section), "'Soil parameters': expected a section", hint);
  std::vector<std::string> missing;
  for (const ScmParameter& p : scm_parameters)
    if (!values.contains(p.key)) missing.emplace_back(p.key);
  if (!missing.empty())
    source.refuse(place_of(source, section), "'Soil parameters' lacks " + listed(missing),
                  "as SCMTerrain::SetSoilParameters takes them: Pa, m, deg, Kc in N/m^(n+1), Kphi in N/m^(n+2)");
  return values;
}

/// A standard deviation or a value that SCM has no place for; absent: nothing.
std::optional<double> told_beside(const ScmJson& beside, const char* group, const std::string& key,
                                  const SourceText& source) {
  if (!beside.contains(group) || !beside.at(group).is_object() || !beside.at(group).contains(key)) return std::nullopt;
  return number_of(beside.at(group), key, source);
}

void check_range(const SoilParameter& p, const Estimate& value, const std::string& key, double per,
                 const SourceText& source) {
  if (!std::isfinite(value.value) || !p.range.holds(value.value))
    source.refuse(place_of(source, key), fmt::format("'{}' is {:.6g}: outside what a soil can have ({})", key,
                                                     value.value * per, describe_range(p.measure(), 1.0)));
  if (!(value.std_error >= 0.0) || !std::isfinite(value.std_error))
    source.refuse(place_of(source, "soilbin"), fmt::format("the standard deviation of '{}' is below 0", key));
}

}  // namespace

bool names_json(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".json";
}

bool is_scm_soil(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const ScmJson document = ScmJson::parse(in, nullptr, false, true);
  return document.is_object() && document.contains("Soil parameters");
}

ScmChoices scm_choices(const SemiEmpiricalSoil& soil) {
  ScmChoices choices;
  choices.elastic_stiffness = std::max(choices.elastic_stiffness, 20.0 * soil.k_phi.value);
  return choices;
}

Soil parse_scm_soil(const SourceText& source) {
  ScmJson document;
  try {
    document = ScmJson::parse(source.text, nullptr, true, true);
  } catch (const ScmJson::parse_error& error) {
    source.refuse(std::min(error.byte > 0 ? error.byte - 1 : 0, source.text.size()), "this is no JSON",
                  "a soil of soilbin is a YAML file, NAME.yaml; JSON is read as Chrono's SCM terrain has it");
  } catch (const ScmJson::exception&) {
    source.refuse(0, "it holds a number that is too large");
  }
  const ScmJson& values = soil_parameters_of(document, source);
  const ScmJson beside = document.value("soilbin", ScmJson::object());
  if (!beside.is_object()) source.refuse(place_of(source, "soilbin"), "'soilbin': expected a section");
  Soil soil;
  soil.name = std::filesystem::path(source.file).stem().string();
  if (const auto name = beside.find("soil"); name != beside.end() && name->is_string()) soil.name = *name;
  SemiEmpiricalSoil& semi = soil.semi_empirical.emplace();
  for (const ScmParameter& one : scm_parameters) {
    const SoilParameter& p = soil_parameter(one.name);
    Estimate& value = semi.*p.value;
    value = {number_of(values, one.key, source) / one.per_si,
             told_beside(beside, "sd", one.key, source).value_or(0.0) / one.per_si};
    check_range(p, value, one.key, one.per_si, source);
  }
  semi.stress_angle_c1 = usual_stress_angle_c1, semi.stress_angle_c2 = usual_stress_angle_c2;
  for (const char* name : {"stress_angle_c1", "stress_angle_c2"}) {
    const SoilParameter& p = soil_parameter(name);
    if (const auto value = told_beside(beside, "beside SCM", name, source)) {
      semi.*p.value = {*value, told_beside(beside, "sd", name, source).value_or(0.0)};
      check_range(p, semi.*p.value, name, 1.0, source);
    } else {
      semi.sources[name] = usual_stress_angle_source;
    }
  }
  for (const ExactSoilValue& exact : exact_soil_values)
    if (const auto value = told_beside(beside, "beside SCM", exact.name, source)) {
      if (!(*value > 0.0)) source.refuse(place_of(source, exact.name), fmt::format("'{}': above 0", exact.name));
      semi.*exact.value = value;
    }
  if ((semi.assumed_sd = told_beside(beside, "sd", "assumed share", source)))
    for (const SoilParameter& p : soil_parameters) {  // an angle has lost a last digit on its way through degrees
      const double share = *semi.assumed_sd * std::abs((semi.*p.value).value);
      if (std::abs((semi.*p.value).std_error - share) <= 1e-12 * share) (semi.*p.value).std_error = share;
    }
  if (beside.contains("sources") && beside.at("sources").is_object())
    for (const auto& [key, text] : beside.at("sources").items())
      if (text.is_string()) semi.sources[key] = text.get<std::string>();
  soil.source = "values of Chrono's SCM terrain";
  if (const auto from = beside.find("source"); from != beside.end() && from->is_string()) soil.source = *from;
  return soil;
}

}  // namespace soilbin
