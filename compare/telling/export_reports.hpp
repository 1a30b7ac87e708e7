// What is said of a wheel for another program beyond its numbers: several soils as one map for Gazebo, a driven wheel
// as a unit of FMI.
#pragma once

#include <string>

#include "compare/report/report.hpp"

namespace soilbin::compare {

struct CompiledC;
struct SlipMap;
struct WheelFmu;
struct WheelSlipFit;

/// A wheel for Gazebo, and its map of soils: each one's colour, what the plugins have there, what the map can't say;
/// soilbin-wheel-slip/1 with the key `map`. `file`: of the map, for the SDF.
Report report_on(const WheelSlipFit& fit, const SlipMap& map, const std::string& file);

/// A driven wheel as a unit of FMI 2.0: its table and that one's errors, its variables, whether it was compiled;
/// soilbin-fmu/1.
Report report_on(const WheelFmu& fmu, const CompiledC& compiled);

}  // namespace soilbin::compare
