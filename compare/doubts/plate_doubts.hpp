// What is doubtful in fits to measured plates and shear tests: a part of the list of doubts (doubts.hpp).
#pragma once

#include <span>

#include "compare/bevameter/measured_plates.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/doubts/doubt.hpp"

namespace soilbin::compare {

/// Tests that disagree, a sensor that sticks, spikes without number, one size of plate, a modulus below 0, an unusual
/// n, no test that was repeated, a form that misses the pressures.
Doubts doubts(const MeasuredPlatesFit& fit);

/// One normal stress, a cohesion below 0, humps, no test that was repeated.
Doubts doubts(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests);

}  // namespace soilbin::compare
