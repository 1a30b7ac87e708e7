// A tire or a soil where a file asks for one: written out as a mapping, a name of the library such as `dry-sand`, or a
// path relative to the file. Cases and campaigns read theirs here.
#pragma once

#include "scenario/library.hpp"
#include "scenario/mapping_reader.hpp"

namespace soilbin {

/// Throws InputError with file, line, column and the nearest name.
Tire read_tire_part(const YamlNode& node, const Library& library, const Reading& reading);
Soil read_soil_part(const YamlNode& node, const Library& library, const Reading& reading);

}  // namespace soilbin
