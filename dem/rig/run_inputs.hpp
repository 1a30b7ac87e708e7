// Everything that a run follows from, beside its condition and the packing, as names and values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dem/bed/settled_bed.hpp"
#include "dem/rig/wheel_run.hpp"
#include "scenario/drive.hpp"

namespace soilbin::dem {

/// The bed's recipe without its packing ("bed.length"), the tire as far as grains meet it ("tire.radius"), its contact
/// with them ("soil.tire_sliding") and the rig ("rig.lowering"); the time step as it is taken. Values in full
/// precision, in a fixed order. Threads aren't among them: they change nothing.
std::vector<std::pair<std::string, std::string>> run_inputs(const BedRecipe& recipe, const Tire& tire, const Rig& rig);

/// All that a run's bits follow from, a line each: run_inputs, packing, ledger, onlooker, program and condition. A
/// restart is good for the run of the same text.
std::string inputs_text(const BedRecipe& recipe, const Tire& tire, const ContactPair& tire_contact, const Rig& rig,
                        const OperatingCondition& at);
/// The inputs of a drive that is told in so many samples.
std::string inputs_text(const BedRecipe& recipe, const Tire& tire, const ContactPair& tire_contact, const Rig& rig,
                        const Drive& drive, int samples);

/// Sixteen hexadecimal digits of such a text, for the name of a file: FNV-1a, 64 bits.
std::string key_of(const std::string& text);

}  // namespace soilbin::dem
