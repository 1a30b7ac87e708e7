// The conditions that a campaign can vary: their names in files and for people, their units, and where they stand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scenario/description.hpp"
#include "scenario/estimate.hpp"
#include "scenario/operating_condition.hpp"
#include "scenario/quantity.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// One condition of a run.
struct ConditionView {
  std::string_view name;                     ///< in answers, limits and `columns:`: "longitudinal_incline"
  std::string_view title;                    ///< for people: "uphill"
  std::string_view unit;                     ///< in which people read it: "deg"; empty: a plain number
  double per_si;                             ///< units per SI unit
  std::string_view column;                   ///< of a campaign's runs: "longitudinal_incline_deg"
  std::string_view column_unit;              ///< "deg"; "-": a plain number
  Range range;                               ///< [SI]
  bool whole;                                ///< a whole number
  double (*get)(const OperatingCondition&);  ///< [SI]; not a number where it isn't told
  void (*set)(OperatingCondition&, double);  ///< [SI]
};

namespace condition_members {

template <double OperatingCondition::*member>
constexpr auto get = [](const OperatingCondition& at) { return at.*member; };
template <double OperatingCondition::*member>
constexpr auto set = [](OperatingCondition& at, double value) { at.*member = value; };
template <std::optional<double> OperatingCondition::*member>
constexpr auto get_optional = [](const OperatingCondition& at) { return (at.*member).value_or(not_a_number); };
template <std::optional<double> OperatingCondition::*member>
constexpr auto set_optional = [](OperatingCondition& at, double value) { at.*member = value; };

}  // namespace condition_members

/// The conditions that a rig sets, then the order of the runs.
inline constexpr std::array<ConditionView, 11> condition_views = [] {
  using C = OperatingCondition;
  namespace m = condition_members;
  constexpr Range slips{.lower = -1.0, .upper = 1.0}, passes{.lower = 1.0};
  return std::array<ConditionView, 11>{{
      {"slip", "slip", "%", 100.0, "slip", "-", slips, false, m::get<&C::slip>, m::set<&C::slip>},
      {"load", "load", "N", 1.0, "load_N", "N", above_zero, false, m::get<&C::load>, m::set<&C::load>},
      {"pass", "pass", "", 1.0, "pass", "-", passes, true, [](const C& at) { return static_cast<double>(at.pass); },
       [](C& at, double value) { at.pass = static_cast<int>(std::lround(value)); }},
      {"yaw", "yaw", "deg", 1 / degree, "yaw_deg", "deg", yaws, false, m::get<&C::yaw>, m::set<&C::yaw>},
      {"longitudinal_incline", "uphill", "deg", 1 / degree, "longitudinal_incline_deg", "deg", inclines, false,
       m::get<&C::longitudinal_incline>, m::set<&C::longitudinal_incline>},
      {"transverse_incline", "cross slope", "deg", 1 / degree, "transverse_incline_deg", "deg", inclines, false,
       m::get<&C::transverse_incline>, m::set<&C::transverse_incline>},
      {"speed", "speed", "m/s", 1.0, "speed_m_s", "m/s", zero_or_more, false, m::get<&C::speed>, m::set<&C::speed>},
      {"inflation_pressure", "inflation pressure", "kPa", 1e-3, "inflation_pressure_kPa", "kPa", zero_or_more, false,
       m::get_optional<&C::inflation_pressure>, m::set_optional<&C::inflation_pressure>},
      {"position", "position", "m", 1.0, "position_m", "m", any_value, false, m::get_optional<&C::position>,
       m::set_optional<&C::position>},
      {"moisture", "moisture", "%", 100.0, "moisture_percent", "%", fractions, false, m::get_optional<&C::moisture>,
       m::set_optional<&C::moisture>},
      {"run", "run", "", 1.0, "run", "-", zero_or_more, true,
       [](const C& at) { return at.run ? static_cast<double>(*at.run) : not_a_number; },
       [](C& at, double value) { at.run = static_cast<int>(std::lround(value)); }},
  }};
}();

/// Throws std::out_of_range for a name that is none of them.
inline const ConditionView& condition_view(std::string_view name) {
  const auto found = std::ranges::find(condition_views, name, &ConditionView::name);
  if (found == condition_views.end()) throw std::out_of_range("a condition of no such name: " + std::string(name));
  return *found;
}

/// "uphill [deg]"; the title alone of a plain number.
inline std::string heading(const ConditionView& view) {
  return std::string(view.title) + (view.unit.empty() ? "" : " [" + std::string(view.unit) + "]");
}

}  // namespace soilbin::compare
