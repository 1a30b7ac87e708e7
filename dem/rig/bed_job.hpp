// A bed as files, for a program of its own that settles it (soilbin-lammps): what is asked for, and what came of it.
//
//   write_bed_job(folder, recipe);                            // the command
//   const BedRecipe recipe = read_bed_job(folder);            // the worker
//   write_bed_report(folder, report);                         // the worker, when the grains lie there too
//   const BedReport report = read_bed_report(folder);         // the command
#pragma once

#include <filesystem>

#include "dem/bed/settled_bed.hpp"

namespace soilbin::dem {

/// Whether a folder holds the job of a bed, and not that of a run.
bool is_bed_job(const std::filesystem::path& folder);
/// Throws std::runtime_error where the disk refuses.
void write_bed_job(const std::filesystem::path& folder, const BedRecipe& recipe);
/// Throws InputError for a file that can't be read or holds something else.
BedRecipe read_bed_job(const std::filesystem::path& folder);

/// What LAMMPS measures of a bed: grains, height, void ratio, bulk density, coordination, rattlers, overlap (of grains
/// with each other), unrest and settling time. To the file report.txt of the folder, which is there when the bed is.
void write_bed_report(const std::filesystem::path& folder, const BedReport& report);
BedReport read_bed_report(const std::filesystem::path& folder);

template <class Notes>
void archive(Notes& notes, ContactPair& pair) {
  auto& [restitution, sliding_friction, rolling_friction, rolling_damping, cohesion, rolling_stiffness,
         work_of_adhesion] = pair;  // LAMMPS takes no jkr
  notes(restitution, sliding_friction, rolling_friction, rolling_damping, cohesion, rolling_stiffness);
}

}  // namespace soilbin::dem
