// A bed that settles in LAMMPS: the engine's stages (dem/bed/settling.hpp) over grains that no process holds all of.
//
//   LammpsRun run(MPI_COMM_WORLD, recipe, how, folder);
//   const BedReport report = settle_in_lammps(run, recipe);   // the grains lie in the folder: LammpsRun begins there
//
// Each process sees its own part of the bin: the grains there, and copies of those that reach into it. What is counted
// over parts is summed up.
#pragma once

#include "dem/bed/settling.hpp"
#include "dem/worker_lammps/lammps_run.hpp"

namespace soilbin::dem {

// What Settling asks for. LAMMPS keeps what is watched.
struct WatchedInLammps {};
WatchedInLammps watched(LammpsSimulation& simulation);
Unrest unrest_since(LammpsSimulation& simulation, const WatchedInLammps& before, int steps);
double mean_height(const LammpsSimulation& simulation, const Footprint& over, double spacing, double cut);
void remove_above(LammpsSimulation& simulation, double cut);

/// Void ratio, density, coordination and rattlers of the core; height; mean overlap. As report_on(Simulation) has them,
/// which has more.
BedReport report_on(const LammpsSimulation& simulation, const BedRecipe& recipe);

/// Settles the bed and keeps it in the run's folder, where it has one. Throws RunStopped, Stopped.
BedReport settle_in_lammps(LammpsRun& run, const BedRecipe& recipe);

}  // namespace soilbin::dem
