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
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dem/archive/note_text.hpp"
#include "dem/bed/work_options.hpp"
#include "dem/rig/stage_counter.hpp"
#include "dem/rig/wheel_job.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"

namespace soilbin::dem {

class LammpsRun {
 public:
  /// `how`: progress is told by the first process, and a stop of any stops all. `seconds`: of wall time from one
  /// restart to the next. Job and options must outlive it. Throws InputError where what lies in the folder is damaged.
  LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, std::filesystem::path folder = {},
            double seconds = 60);
  LammpsRun(const LammpsRun&) = delete;
  LammpsRun& operator=(const LammpsRun&) = delete;

  /// These are as StagedRun's.
  template <class Part>
  void keep(const std::string& name, Part& part);
  void plan(double steps) { all_steps_ = steps; }
  void through(const std::function<void()>& stages);
  void once(const std::function<void()>& what);
  void steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each);
  void loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each);
  void step();
  double earlier() const { return earlier_; }
  LammpsSimulation& simulation() { return *simulation_; }
  const LammpsSimulation& simulation() const { return *simulation_; }

  /// Where it is.
  template <class Notes>
  void state(Notes& notes) {
    notes(at_.reached, at_.taken, steps_, earlier_);
  }

 private:
  struct Kept {
    std::string name;
    std::function<std::string()> text;
  };

  std::unique_ptr<LammpsSimulation> begin(MPI_Comm world);
  void tell(std::string_view stage);
  void write_restart();
  /// Grains times steps in a second and memory a grain: what one asks before a huge run.
  void tell_cost() const;
  double seconds() const;
  bool speaks() const { return rank_ == 0; }

  const WheelJob& job_;
  const WorkOptions& how_;
  std::filesystem::path folder_;
  double between_;  ///< restarts [s]
  int rank_ = 0;
  std::map<std::string, std::string> found_;  ///< notes that the run goes on from
  std::unique_ptr<LammpsSimulation> simulation_;
  std::vector<Kept> kept_;
  StageCounter at_;
  std::int64_t steps_ = 0, begun_at_ = 0;
  double all_steps_ = 1, earlier_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), written_ = began_;
};

template <class Part>
void LammpsRun::keep(const std::string& name, Part& part) {
  kept_.push_back({name, [&part] {
                     NoteWriter writer;
                     part.state(writer);
                     return writer.text();
                   }});
  if (found_.empty()) return;
  NoteReader reader((folder_ / "state").string() + ": " + name, found_[name]);
  part.state(reader);
  reader.end();
}

}  // namespace soilbin::dem
