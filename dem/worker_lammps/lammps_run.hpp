// A run in stages whose grains are in LAMMPS: what StagedRun is for the engine.
//
//   Ride<LammpsRun> ride(job.wheel(), job.at, [&] { return LammpsRun(MPI_COMM_WORLD, job, tell); });
//   const WheelRun run = ride.run();
//
// All processes take the same stages with the same numbers; the first one speaks.
#pragma once

#include <mpi.h>

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "dem/bed/work_options.hpp"
#include "dem/rig/wheel_job.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"

namespace soilbin::dem {

class LammpsRun {
 public:
  /// `how`: progress is told by the first process, and a stop of any stops all. Job and options must outlive it.
  LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, const std::string& log = "");
  LammpsRun(const LammpsRun&) = delete;
  LammpsRun& operator=(const LammpsRun&) = delete;

  /// As StagedRun's.
  template <class Part>
  void keep(const std::string&, Part&) {}
  void plan(double steps) { all_steps_ = steps; }
  /// Lets the bed rest first: what its contacts remembered stayed behind.
  void through(const std::function<void()>& stages);
  void once(const std::function<void()>& what) { what(); }
  void steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each);
  void loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each);
  void step();
  double earlier() const { return 0; }
  LammpsSimulation& simulation() { return simulation_; }
  const LammpsSimulation& simulation() const { return simulation_; }

 private:
  void rest();
  /// Grains times steps in a second and memory a grain: what one asks before a huge run.
  void tell_cost() const;
  double seconds() const;
  void tell(std::string_view stage, double share) const;

  const WheelJob& job_;
  const WorkOptions& how_;
  LammpsSimulation simulation_;
  std::int64_t steps_ = 0;
  double all_steps_ = 1;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace soilbin::dem
