#include "cli/soil_flags.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "cli/described_flags.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

constexpr const char* density_key = "density";
constexpr Measure density_measure{"kg/m^3", above_zero};

/// "30+-2 deg" as {"30 deg", "2 deg"}; the second is empty where none is given.
std::pair<std::string, std::string> value_and_deviation(std::string text) {
  for (const char* sign : {"±", "+-"}) {
    const std::vector<std::string> parts = split(text, sign);
    if (parts.size() != 2) continue;
    const std::size_t digits = parts[1].find_first_not_of("0123456789.eE+- ");
    const std::string unit = digits == std::string::npos ? "" : parts[1].substr(digits);
    return {read_number(parts[0]) ? parts[0] + " " + unit : parts[0], parts[1]};
  }
  return {std::move(text), ""};
}

/// A value without a deviation keeps the one that it had; an assumed share stays a share.
void set_value(const SoilParameter& p, const std::string& text, SemiEmpiricalSoil& soil) {
  const auto [value, deviation] = value_and_deviation(text);
  const double n = soil.exponent.value;
  Estimate& into = soil.*p.value;
  const bool assumed = has_assumed_sd(soil, into);
  try {
    into.value = read_quantity(value, p.measure(), n);
    if (assumed) into.std_error = *soil.assumed_sd * std::abs(into.value);
    if (!deviation.empty()) into.std_error = read_quantity(deviation, {p.unit, zero_or_more}, n);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", flag_of("", p.name), error.what()));
  }
}

}  // namespace

void SoilFlags::add_to(CLI::App& app, const std::string& heading) {
  const auto add = [&](const char* key, const std::string& unit, const char* meaning) {
    app.add_option(flag_of("", key), texts_[key], meaning)->type_name(unit)->group(heading);
  };
  for (const SoilParameter& p : soil_parameters)
    add(p.name, std::string(p.unit) == "-" ? "NUMBER[+-SD]" : std::string(p.unit) + "[+-SD]", p.meaning);
  add(density_key, density_measure.unit, "bulk density");
}

bool SoilFlags::any_given() const {
  return std::any_of(texts_.begin(), texts_.end(), [](const auto& entry) { return !entry.second.empty(); });
}

void SoilFlags::apply(Soil& soil) const {
  if (!any_given()) return;
  if (!soil.semi_empirical)
    throw InputError(
        fmt::format("soil '{}' has values for grains alone: a flag such as --friction-angle has nothing to change\n"
                    "  hint: begin with another --soil",
                    clipped(soil.name)));
  SemiEmpiricalSoil& values = *soil.semi_empirical;
  for (const SoilParameter& p : soil_parameters)  // n first: the units of k_c and k_phi depend on it
    if (const std::string& text = texts_.at(p.name); !text.empty()) {
      set_value(p, text, values);
      values.sources[p.name] = "given on the command line";
    }
  if (const std::string& text = texts_.at(density_key); !text.empty()) {
    if (!value_and_deviation(text).second.empty())
      throw InputError("--density: a density has no standard deviation here\n  hint: such as --density 1600kg/m^3");
    values.density = read_flag(flag_of("", density_key), text, density_measure);
    values.sources[density_key] = "given on the command line";
  }
  soil.name += ", changed";
}

}  // namespace soilbin::cli
