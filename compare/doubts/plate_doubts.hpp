// What is doubtful in fits to measured plates and shear tests: a part of the list of doubts (doubts.hpp).
#pragma once

#include <span>

#include "compare/bevameter/measured_plates.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/bevameter/plate_groups.hpp"
#include "compare/doubts/doubt.hpp"

namespace soilbin::compare {

/// Tests that disagree, a sensor that sticks, spikes without number, one size of plate, a modulus below 0, an unusual
/// n, no test that was repeated, a curve that bends, a form that misses the pressures.
Doubts doubts(const MeasuredPlatesFit& fit);

/// Of tests fitted apart: those of their readings, one size of plate, a density that no bed had.
Doubts doubts(const PlateGroups& groups);

/// One normal stress, a cohesion below 0, humps, no test that was repeated.
Doubts doubts(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests);

}  // namespace soilbin::compare
