#include "scenario/number_check.hpp"

#include <fmt/core.h>

#include <array>
#include <utility>

namespace soilbin {

std::string si_unit_of(const std::string& unit) {
  static constexpr std::array<std::pair<const char*, const char*>, 10> other = {{{"mm", "m"},
                                                                                 {"kPa", "Pa"},
                                                                                 {"MPa", "Pa"},
                                                                                 {"kN", "N"},
                                                                                 {"deg", "rad"},
                                                                                 {"%", "-"},
                                                                                 {"rpm", "rad/s"},
                                                                                 {"kJ/m^3", "J/m^3"},
                                                                                 {"kN/m^(n+1)", "N/m^(n+1)"},
                                                                                 {"kN/m^(n+2)", "N/m^(n+2)"}}};
  for (const auto& [file, si] : other)
    if (unit == file) return si;
  return unit;
}

void check_number(const char* key, double value, const Measure& measure) {
  if (!std::isfinite(value)) throw InputError(fmt::format("{}: {} is no number to work with", key, value));
  if (measure.range.holds(value)) return;
  const bool share = si_unit_of(measure.unit) == "-" && measure.range.upper <= 1.0;
  const bool meant_percent = share && value >= 2.0 && measure.range.holds(value / 100);
  throw InputError(fmt::format("{}: {} is out of range, which is {}{}", key, value,
                               describe_range({si_unit_of(measure.unit), measure.range}),
                               meant_percent ? fmt::format(", did you mean {} ({} %)?", value / 100, value) : ""));
}

}  // namespace soilbin
