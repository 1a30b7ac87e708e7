// A tire or a soil where a file asks for one: written out as a mapping, a name of the library such as `dry-sand`, or a
// path relative to the file; of a soil with several beds also {from: cullinan-sand, density: 1450 kg/m^3}. Cases and
// campaigns read theirs here.
#pragma once

#include "scenario/library.hpp"
#include "scenario/mapping_reader.hpp"

namespace soilbin {

/// Throws InputError with file, line, column and the nearest name.
Tire read_tire_part(const YamlNode& node, const Library& library, const Reading& reading);
Soil read_soil_part(const YamlNode& node, const Library& library, const Reading& reading);

/// Whether a soil is told as {from, density}.
bool names_a_bed(const YamlNode& node);

}  // namespace soilbin
