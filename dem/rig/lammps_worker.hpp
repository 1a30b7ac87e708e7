// Starts soilbin-lammps, the program that makes a wheel's run with its grains in LAMMPS on many processes, and takes
// its answer. They talk by the files of a folder alone (wheel_job.hpp), so that nothing that ends that program ends
// this one.
//
//   const LammpsWorker worker{.ranks = 64, .program = folder_of_command / "soilbin-lammps"};
//   const WheelRun run = run_in_lammps(worker, on, at, how, checkpoints);
#pragma once

#include <filesystem>
#include <string>

#include "dem/archive/checkpoints.hpp"
#include "dem/rig/wheel_run.hpp"

namespace soilbin::dem {

struct LammpsWorker {
  int ranks = 1;                    ///< processes
  std::filesystem::path program;    ///< soilbin-lammps
  std::string launcher = "mpirun";  ///< with its own flags, blanks between; gets -n RANKS PROGRAM FOLDER
};

/// The bed of a recipe that LAMMPS settles, in the folder bed-KEY of `beds`: found there, gone on with, or begun. Its
/// grains stay in that folder (SettledBed::grains_in); the report is what LAMMPS measures (bed_job.hpp). Throws what
/// settle_bed throws, and std::runtime_error as run_in_lammps.
SettledBed bed_in_lammps(const LammpsWorker& worker, const BedRecipe& recipe, const std::filesystem::path& beds,
                         const WorkOptions& how);

/// As run_wheel, of the same arguments. The job lies in a folder lammps-KEY beside the file run-KEY.h5 that
/// `checkpoints` names, and stays there until forget_run; a run that has its answer there is not made again. Throws
/// what run_wheel throws; InputError also for an onlooker or a ledger, which this run has not, and for laws that LAMMPS
/// has not; std::runtime_error where the program can't be started or ends without a word, with the last lines that it
/// wrote.
WheelRun run_in_lammps(const LammpsWorker& worker, const WheelOnBed& on, const OperatingCondition& at,
                       const WorkOptions& how, const Checkpoints& checkpoints);

/// The folder of a run whose restart would be this file, and the file that is locked while someone is at a folder.
std::filesystem::path lammps_folder(const std::filesystem::path& restart);
std::filesystem::path lammps_lock(const std::filesystem::path& folder);

}  // namespace soilbin::dem
