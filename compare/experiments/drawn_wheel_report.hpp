// What was found in a drawing of a wheel and what was mended in it, for people, programs and as a picture.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/report/plot.hpp"
#include "dem/surface/drawn_wheel.hpp"

namespace soilbin::compare {

/// Lines: triangles, bodies, unit, axle, radius, width, volume, and each change.
std::string in_words(const dem::DrawnWheel& wheel, const std::string& file);

/// soilbin-mesh/1, SI: docs/guide/bring-a-tire.md.
nlohmann::ordered_json to_json(const dem::DrawnWheel& wheel, const std::string& file);

/// Side and front view: sharp edges and outlines [mm], and where something was mended.
Sheet wheel_sheet(const dem::DrawnWheel& wheel, const std::string& file);

}  // namespace soilbin::compare
