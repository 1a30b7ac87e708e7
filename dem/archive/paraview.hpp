// Grains and bodies for ParaView: .vtp files (VTK's XML PolyData, numbers in base64) and a .pvd that gives each its
// time. For the eye: lengths and speeds in single precision. Each file is written whole or not at all.
//
//   export_to_paraview("frames", "wheel", simulation.state());  // again after some steps; then open frames/wheel.pvd
#pragma once

#include <filesystem>
#include <string>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// All meshes of a body where it is now, with the velocity of their points, and what the grains do to it (force,
/// torque) as field data. Planes have no end and are left out.
std::string body_vtp(const Body& body);

/// Writes FOLDER/NAME-grains-STEP.vtp, FOLDER/NAME-body-K-STEP.vtp for each body with a mesh, and enters them into
/// FOLDER/NAME.pvd. Entries that are there stay; those of the same step are replaced.
void export_to_paraview(const std::filesystem::path& folder, const std::string& name, const State& state);

}  // namespace soilbin::dem
