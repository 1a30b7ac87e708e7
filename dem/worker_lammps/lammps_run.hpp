// A run in stages whose grains are in LAMMPS: what StagedRun is for the engine.
//
//   Ride<LammpsRun> ride(job.wheel(), job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, how, folder); });
//   const WheelRun run = ride.run();
//
// All processes take the same stages with the same numbers; the first one speaks and writes. Where a folder is given,
// the run is kept there now and then, and goes on from it: grains-STEP, as LAMMPS keeps them, and state, all else.
#pragma once

#include <mpi.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "dem/rig/run_stages.hpp"
#include "dem/rig/wheel_job.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"

namespace soilbin::dem {

class LammpsRun final : public RunStages {
 public:
  /// `how`: progress is told by the first process, and a stop of any stops all. `seconds`: of wall time from one
  /// restart to the next. Job and options must outlive it. Throws InputError where what lies in the folder is damaged.
  LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, std::filesystem::path folder = {},
            double seconds = 60);

  /// As StagedRun's.
  void through(const std::function<void()>& stages);
  void step();
  LammpsSimulation& simulation() { return *simulation_; }
  const LammpsSimulation& simulation() const { return *simulation_; }

 private:
  std::unique_ptr<LammpsSimulation> begin(MPI_Comm world);
  void look(std::string_view stage, double share) override;
  void write_restart();
  /// Grains times steps in a second and memory a grain: what one asks before a huge run.
  void tell_cost() const;
  bool speaks() const { return rank_ == 0; }

  const WheelJob& job_;
  const WorkOptions& how_;
  std::filesystem::path folder_;
  double between_;  ///< restarts [s]
  int rank_ = 0;
  std::unique_ptr<LammpsSimulation> simulation_;
  std::int64_t begun_at_ = 0;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace soilbin::dem
