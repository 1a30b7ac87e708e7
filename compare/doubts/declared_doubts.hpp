// What is doubtful in a soil and a wheel by themselves, before any condition: a part of the list of doubts
// (doubts.hpp).
#pragma once

#include "compare/doubts/doubt.hpp"
#include "scenario/soil.hpp"
#include "scenario/tire.hpp"

namespace soilbin::compare {

/// Of a soil by itself: values out of the usual, no strength, nothing carried, hardly known.
Doubts doubts(const Soil& soil);

/// Of a wheel by itself: its proportions.
Doubts doubts(const Tire& tire);

/// The same on a soil, which may carry nothing for this width.
Doubts doubts(const Tire& tire, const Soil& soil);

}  // namespace soilbin::compare
