// A wheel's run as files, for a program of its own that makes it (soilbin-lammps): the job, with everything resolved,
// and the answer.
//
//   write_job(folder / "job.h5", on, at, inputs);          // the command
//   const WheelJob job = read_job(folder / "job.h5");      // the worker
//   write_answer(folder / "answer.txt", run);              // the worker
//   WheelRun run = read_answer(folder / "answer.txt");     // the command
#pragma once

#include <filesystem>
#include <string>

#include "dem/rig/wheel_run.hpp"

namespace soilbin::dem {

struct WheelJob {
  Setup setup;  ///< of the run: the bed's, with the tire's material and the rig's numerics
  /// The state is the bed's. Of recipe and report only what a run reads: sizes, the grains' radii, gravity, the test of
  /// rest, density.
  SettledBed bed;
  Tire tire;  ///< its measures alone
  ContactPair contact;
  Rig rig;
  OperatingCondition at;
  std::string inputs;  ///< what the run follows from (inputs_text)

  WheelOnBed wheel() const { return {bed, tire, contact, rig}; }
};

/// The bed's grains go to a file of their own, bed.h5 beside it, unless LAMMPS has them in a folder. Throws
/// std::runtime_error where the disk refuses.
void write_job(const std::filesystem::path& file, const WheelOnBed& on, const OperatingCondition& at,
               const std::string& inputs);
/// Whether the bed's grains are read too, where they lie beside the job, or the state holds all but them.
enum class WithGrains { yes, no };
/// Throws InputError for a file that can't be read, is damaged or holds something else.
WheelJob read_job(const std::filesystem::path& file, WithGrains grains = WithGrains::yes);

/// Keeps what a run measured: samples, flow, rut, surface, density of the bed; the rest follows (summarise).
void write_answer(const std::filesystem::path& file, const WheelRun& run);
/// The whole run, summarised. Throws InputError as read_job.
WheelRun read_answer(const std::filesystem::path& file, const Tire& tire, const OperatingCondition& at, const Rig& rig);

}  // namespace soilbin::dem
