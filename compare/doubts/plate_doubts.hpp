// What is doubtful in a fit to measured plates: a part of the list of doubts (doubts.hpp).
#pragma once

#include "compare/bevameter/measured_plates.hpp"
#include "compare/doubts/doubt.hpp"

namespace soilbin::compare {

/// Tests that disagree, a sensor that sticks, spikes without number, one size of plate, a modulus below 0, an unusual
/// n, no test that was repeated, a form that misses the pressures.
Doubts doubts(const MeasuredPlatesFit& fit);

}  // namespace soilbin::compare
