// A run in stages, kept now and then: it goes on where it was, in the middle of a stage or between two, with the same
// bits.
//
//   StagedRun run(checkpoints, inputs, how, [&] { return Simulation(setup, state); });
//   run.keep("rig", rig);                                            // rig.state(notes) is found again here
//   run.through([&] {
//     run.once([&] { put_wheel(); });                                // what was done before isn't done again
//     run.steps("lowering", 500, [&](std::int64_t k) { press(k); run.step(); });
//     run.loop("driving", [&] { return !over; }, [&] { drive(); run.step(); });
//   });
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dem/archive/checkpoints.hpp"
#include "dem/archive/note_text.hpp"
#include "dem/bed/work_options.hpp"
#include "dem/engine/simulation.hpp"
#include "dem/rig/stage_counter.hpp"
#include "scenario/file_lock.hpp"

namespace soilbin::dem {

/// The simulation and where its work is. The same calls of once, steps and loop come in the same order each time, and
/// what they do follows from the simulation and from what is kept.
class StagedRun {
 public:
  /// Goes on from the last good restart where there is one, else begins with `fresh`. Without a path in `checkpoints`
  /// nothing is kept, nor while another process is at the same run, nor where the folder can't be written to (told).
  /// `inputs`: all that the run's bits follow from, as a text. Options must outlive it. Throws InputError where the
  /// restart is of a run of other inputs, or where there are restarts but none is good.
  StagedRun(const Checkpoints& checkpoints, std::string inputs, const WorkOptions& how,
            const std::function<Simulation()>& fresh);
  StagedRun(const StagedRun&) = delete;
  StagedRun& operator=(const StagedRun&) = delete;
  ~StagedRun();

  /// What a restart keeps beside the simulation, by part.state(notes) for writing and reading alike. Where the run goes
  /// on, `part` is what it was when this returns.
  template <class Part>
  void keep(const std::string& name, Part& part);

  /// Number of all steps that are to come, for the word about how far it is.
  void plan(double steps) { all_steps_ = steps; }
  /// Does the stages; throws what they throw, and Stopped. Stopped from outside, by whatever progress throws too, the
  /// run leaves its restart; through, its last one; without an answer (NoSolution, RunStopped) the one before, and with
  /// InputError none. A restart that can't be written is told by Checkpoints::tell, and the run goes on.
  void through(const std::function<void()>& stages);

  /// Between two stages.
  void once(const std::function<void()>& what);
  /// `each` so many times; it gets which one, from 0, and takes a step.
  void steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each);
  /// `each` as long as `goes_on` holds. `share`: of the whole work that is done, where steps don't tell it.
  void loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each,
            const std::function<double()>& share = {});
  /// One step of the engine.
  void step();

  /// Share of the planned steps that are taken.
  double done() const;
  /// On the clock on the wall before this run was gone on with [s].
  double earlier() const { return earlier_; }
  Simulation& simulation() { return start_.simulation; }
  const Simulation& simulation() const { return start_.simulation; }

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

  bool is_kept() const { return !checkpoints_.restart.empty(); }
  bool write_restart();
  void tell(std::string_view stage, double share);
  Notes notes();
  double seconds() const;

  Checkpoints checkpoints_;
  std::unique_ptr<const FileLock> lock_;
  std::string inputs_;
  const WorkOptions& how_;
  std::vector<Kept> kept_;
  Start start_;
  Checkpointer checkpointer_;
  StageCounter at_;
  std::int64_t steps_ = 0;
  double all_steps_ = 1, earlier_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// Removes what is kept of a run whose answer is safe, unless another process is at it; its folder of LAMMPS too.
void forget_run(const std::filesystem::path& restart);

template <class Part>
void StagedRun::keep(const std::string& name, Part& part) {
  kept_.push_back({name, [&part] {
                     NoteWriter writer;
                     part.state(writer);
                     return writer.text();
                   }});
  if (start_.told.empty()) return;
  NoteReader reader(checkpoints_.restart.string() + ": " + name, start_.notes[name]);
  part.state(reader);
  reader.end();
}

}  // namespace soilbin::dem
