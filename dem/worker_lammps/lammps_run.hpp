// A run in stages whose grains are in LAMMPS: what StagedRun is for the engine.
//
//   WheelRunStages<LammpsRun> ride(job.wheel(), job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, how, folder); });
//   const WheelRun run = ride.run();
//
//   LammpsRun settles(MPI_COMM_WORLD, recipe, how, folder);
//   const BedReport report = settle_in_lammps(settles, recipe);          // lammps_bed.hpp
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
#include <vector>

#include "dem/bed/settled_bed.hpp"
#include "dem/rig/run_stages.hpp"
#include "dem/rig/wheel_job.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"

namespace soilbin::dem {

class LammpsRun final : public RunStages {
 public:
  /// `how`: progress is told by the first process, and a stop of any stops all. `seconds`: of wall time from one
  /// restart to the next. Job and options must outlive it. A bed that LAMMPS settled is taken from its folder. Throws
  /// InputError where what lies in the folder is damaged.
  LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, std::filesystem::path folder = {},
            double seconds = 60);
  /// Begins a bed that is to settle: its grains are poured.
  LammpsRun(MPI_Comm world, const BedRecipe& recipe, const WorkOptions& how, std::filesystem::path folder = {},
            double seconds = 60);

  /// As StagedRun's.
  void through(const std::function<void()>& stages);
  void step();
  /// Puts the run into its folder as it is now.
  void write_restart();
  LammpsSimulation& simulation() { return *simulation_; }
  const LammpsSimulation& simulation() const { return *simulation_; }

 private:
  /// What it begins with, and what its own restart lacks.
  struct Beginning {
    std::string inputs;
    Setup setup;
    std::vector<Body> bodies;
    std::function<std::unique_ptr<LammpsSimulation>(const std::string& log)> fresh;
  };
  LammpsRun(MPI_Comm world, Beginning beginning, const WorkOptions& how, std::filesystem::path folder, double seconds);
  static Beginning beginning_of(MPI_Comm world, const WheelJob& job);
  static Beginning beginning_of(MPI_Comm world, const BedRecipe& recipe);
  std::unique_ptr<LammpsSimulation> begin(MPI_Comm world, const Beginning& beginning);
  std::int64_t steps_between_looks() const override;
  void look(std::string_view stage, double share) override;
  /// Grains times steps in a second and memory a grain: what one asks before a huge run.
  void tell_cost() const;
  bool speaks() const { return rank_ == 0; }

  std::string inputs_;
  const WorkOptions& how_;
  std::filesystem::path folder_;
  double between_;  ///< restarts [s]
  int rank_ = 0;
  std::unique_ptr<LammpsSimulation> simulation_;
  std::int64_t begun_at_ = 0;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace soilbin::dem
