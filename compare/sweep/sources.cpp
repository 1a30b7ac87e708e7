#include "compare/sweep/sources.hpp"

#include <fmt/core.h>

#include <map>
#include <optional>
#include <type_traits>

#include "compare/report/number_text.hpp"
#include "scenario/description.hpp"

namespace soilbin::compare {
namespace {

/// A source of a value's own, else that of the whole.
std::string source_of(const std::string& key, const std::map<std::string, std::string>& own, const std::string& whole) {
  if (const auto found = own.find(key); found != own.end() && !found->second.empty()) return found->second;
  return whole.empty() ? "not stated" : whole;
}

Estimate estimate_of(double exact) { return {exact, 0.0}; }
Estimate estimate_of(const Estimate& estimate) { return estimate; }

/// The numbers of a wheel, or of its lugs, that are declared.
template <class Part>
void add_numbers(const Part& part, const std::string& prefix, const Tire& tire, std::vector<SourcedValue>& all) {
  each_member<Part>([&](const std::string& key, auto member, const auto& limits, const char*) {
    const std::optional number(part.*member);
    using Number = typename decltype(number)::value_type;
    if constexpr (std::is_arithmetic_v<Number> || std::is_same_v<Number, Estimate>) {
      std::string unit = "-";
      if constexpr (std::is_same_v<std::decay_t<decltype(limits)>, Measure>) unit = limits.unit;
      if (number)
        all.push_back({.of = "tire",
                       .key = prefix + key,
                       .name = (prefix.empty() ? "" : "lug ") + spaced(key),
                       .unit = unit,
                       .per_si = per_unit(unit),
                       .value = estimate_of(*number),
                       .source = source_of(prefix + key, tire.sources, tire.source)});
    }
  });
}

}  // namespace

std::vector<SourcedValue> sourced_values(const Scenario& scenario) {
  std::vector<SourcedValue> all;
  add_numbers(scenario.tire, "", scenario.tire, all);
  if (const std::optional<DeflectionTable>& table = scenario.tire.deflection)
    all.push_back(
        {.of = "tire",
         .key = deflection_key,
         .name = "load-deflection table",
         .unit = "rows",
         .per_si = 1.0,
         .value = {static_cast<double>(table->rows.size()), 0.0},
         .source = table->source.empty() ? source_of(deflection_key, {}, scenario.tire.source) : table->source});
  if (is_lugged(scenario.tire)) add_numbers(scenario.tire.lugs, "lugs.", scenario.tire, all);
  if (!scenario.soil.semi_empirical) return all;
  const SemiEmpiricalSoil& soil = *scenario.soil.semi_empirical;
  for (const SoilParameter& p : soil_parameters)
    all.push_back({"soil", p.name, p.title, p.unit, p.per_si, soil.*p.value, has_assumed_sd(soil, soil.*p.value),
                   source_of(p.name, soil.sources, scenario.soil.source)});
  for (const ExactSoilValue& exact : exact_soil_values)
    if (const std::optional<double>& value = soil.*exact.value)
      all.push_back({"soil",
                     exact.name,
                     exact.name,
                     exact.unit,
                     1.0,
                     {*value, 0.0},
                     false,
                     source_of(exact.name, soil.sources, scenario.soil.source)});
  return all;
}

std::string in_words(const SourcedValue& value) {
  const bool exact = value.value.std_error == 0.0;
  return (exact ? fmt::format("{:.6g}", value.value.value * value.per_si) : number(value.value, value.per_si)) +
         unit_behind(value.unit) + (value.assumed_sd ? " (± assumed)" : "");
}

Json sources_json(const Scenario& scenario) {
  Json all = Json::array();
  for (const SourcedValue& value : sourced_values(scenario))
    all.push_back({{"of", value.of},
                   {"name", value.key},
                   {"value", value.value.value},
                   {"std_error", value.value.std_error},
                   {"assumed_sd", value.assumed_sd},
                   {"source", value.source}});
  return all;
}

Table sources_table(const Scenario& scenario) {
  Table table{"", {"", "value", "source"}, {true, true, true}};
  for (const SourcedValue& value : sourced_values(scenario))
    table.add({fmt::format("  {}: {}", value.of, value.name), in_words(value), value.source});
  return table;
}

}  // namespace soilbin::compare
