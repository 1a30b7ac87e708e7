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

#include <functional>
#include <memory>
#include <string>

#include "dem/archive/checkpoints.hpp"
#include "dem/engine/simulation.hpp"
#include "dem/rig/run_stages.hpp"
#include "scenario/file_lock.hpp"

namespace soilbin::dem {

/// The simulation and where its work is. The same calls of once, steps and loop come in the same order each time, and
/// what they do follows from the simulation and from what is kept.
class StagedRun final : public RunStages {
 public:
  /// Goes on from the last good restart where there is one, else begins with `fresh`. Without a path in `checkpoints`
  /// nothing is kept, nor while another process is at the same run, nor where the folder can't be written to (told).
  /// `inputs`: all that the run's bits follow from, as a text. Options must outlive it. Throws InputError where the
  /// restart is of a run of other inputs, or where there are restarts but none is good.
  StagedRun(const Checkpoints& checkpoints, std::string inputs, const WorkOptions& how,
            const std::function<Simulation()>& fresh);
  ~StagedRun();

  /// Does the stages; throws what they throw, and Stopped. Stopped from outside, by whatever progress throws too, the
  /// run leaves its restart; through, its last one; without an answer (NoSolution, RunStopped) the one before, and with
  /// InputError none. A restart that can't be written is told by Checkpoints::tell, and the run goes on.
  void through(const std::function<void()>& stages);

  /// One step of the engine.
  void step();

  Simulation& simulation() { return start_.simulation; }
  const Simulation& simulation() const { return start_.simulation; }

 private:
  bool is_kept() const { return !checkpoints_.restart.empty(); }
  bool write_restart();
  void look(std::string_view stage, double share) override;
  void tell(std::string_view stage, double share);
  void tell_of_threads();

  Checkpoints checkpoints_;
  std::unique_ptr<const FileLock> lock_;
  std::string inputs_;
  const WorkOptions& how_;
  Start start_;
  Checkpointer checkpointer_;
  bool told_of_threads_ = false;
};

/// Removes what is kept of a run whose answer is safe, unless another process is at it; its folder of LAMMPS too.
void forget_run(const std::filesystem::path& restart);

}  // namespace soilbin::dem
