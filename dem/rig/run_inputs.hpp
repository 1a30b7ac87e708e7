// Everything that a run follows from, beside its condition and the packing, as names and values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dem/bed/settled_bed.hpp"
#include "dem/rig/wheel_run.hpp"

namespace soilbin::dem {

/// The bed's recipe without its packing ("bed.length"), the tire as far as grains meet it ("tire.radius"), its contact
/// with them ("soil.tire_sliding") and the rig ("rig.lowering"); the time step as it is taken. Values in full
/// precision, in a fixed order. Threads aren't among them: they change nothing.
std::vector<std::pair<std::string, std::string>> run_inputs(const BedRecipe& recipe, const Tire& tire, const Rig& rig);

}  // namespace soilbin::dem
