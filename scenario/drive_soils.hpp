// The soils of a drive's way: the question's own, then those that begin on it. A value of a soil that returns errs
// wherever that soil lies, so who moves it moves it in all of them.
//
//   for (Soil* soil : soils_of_way(question.soil, question.drive.profile))
//     if (is_same_soil(*soil, declared)) move_value(*soil->semi_empirical, p, value, n);
#pragma once

#include <algorithm>
#include <vector>

#include "scenario/drive.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin {

inline std::vector<Soil*> soils_of_way(Soil& own, std::vector<Waypoint>& profile) {
  std::vector<Soil*> soils = {&own};
  for (Waypoint& point : profile)
    if (point.soil) soils.push_back(&*point.soil);
  return soils;
}

/// Whether this is the same soil again: a value that errs, errs in both.
inline bool is_same_soil(const Soil& one, const Soil& other) {
  if (one.name != other.name || !one.semi_empirical || !other.semi_empirical) return false;
  return std::ranges::all_of(soil_parameters, [&](const SoilParameter& p) {
    const Estimate &a = (*one.semi_empirical).*p.value, &b = (*other.semi_empirical).*p.value;
    return a.value == b.value && a.std_error == b.std_error;
  });
}

/// soils_of_way without those that return.
inline std::vector<Soil*> soils_once(Soil& own, std::vector<Waypoint>& profile) {
  std::vector<Soil*> once;
  for (Soil* soil : soils_of_way(own, profile))
    if (std::ranges::none_of(once, [&](const Soil* before) { return is_same_soil(*before, *soil); }))
      once.push_back(soil);
  return once;
}

}  // namespace soilbin
