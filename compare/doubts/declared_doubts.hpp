// What is doubtful in a soil and a wheel by themselves, before any condition: a part of the list of doubts
// (doubts.hpp).
#pragma once

#include <string>
#include <vector>

#include "scenario/soil.hpp"
#include "scenario/tire.hpp"

namespace soilbin::compare {

/// Of a soil by itself: values out of the usual, no strength, nothing carried, hardly known.
std::vector<std::string> doubts(const Soil& soil);

/// Of a wheel by itself: its proportions.
std::vector<std::string> doubts(const Tire& tire);

/// The same on a soil, which may carry nothing for this width.
std::vector<std::string> doubts(const Tire& tire, const Soil& soil);

}  // namespace soilbin::compare
