// What was found in a drawing of a wheel and what was mended in it; soilbin-mesh/1: docs/guide/bring-a-tire.md.
#pragma once

#include <string>

#include "compare/report/report.hpp"
#include "dem/surface/drawn_wheel.hpp"

namespace soilbin::compare {

/// Triangles, bodies, unit, axle, size and volume, and each change; drawn from the side and from the front, with where
/// something was mended. `file`: its name. The wheel outlives the report.
Report report_on(const dem::DrawnWheel& wheel, const std::string& file);

}  // namespace soilbin::compare
