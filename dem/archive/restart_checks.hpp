// What a restart must hold to before the engine goes on from it.
#pragma once

#include <string>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// Whether all that is an index leads somewhere, and places, sizes and steps are such as a run can have: a restart that
/// another program made must not crash ours. Throws InputError that names the file and the part.
void check_restart(const Setup& setup, const State& state, const std::string& file);

}  // namespace soilbin::dem
