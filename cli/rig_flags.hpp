// Flags for a rig: where it can go, what it measures and how well.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "compare/test_design/effect_shapes.hpp"
#include "compare/test_design/rig_limits.hpp"

namespace soilbin::cli {

void add_limits_of_the_rig(CLI::App& app, std::vector<std::string>& texts, const std::string& meaning);

/// "load=50N..0.2kN", values with units. Throws InputError that names the flag.
compare::Limits read_limits(const std::vector<std::string>& texts);

/// "drawbar_pull=1N", values with units. Throws InputError that names the flag.
compare::ExpectedNoise read_noise(const std::vector<std::string>& texts);

}  // namespace soilbin::cli
