// Running on and on: restarts now and then, a clean stop on demand, and going on where it was.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "dem/archive/restart.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

struct Checkpoints {
  std::filesystem::path restart;
  double seconds = 600;    ///< of wall time between restarts [s]; 0: not by time
  std::int64_t steps = 0;  ///< between restarts; 0: not by steps
  /// Gets what a person wants to know: where a run goes on, that a stopped one can. Of runs that say so (StagedRun).
  std::function<void(const std::string&)> tell{};
};

/// Knows when the next restart is due, and writes it. The checkpoints must outlive it.
class Checkpointer {
 public:
  /// `step`: of the restart that the run goes on from, or at which it begins.
  Checkpointer(const Checkpoints& checkpoints, std::int64_t step) : checkpoints_(checkpoints), step_(step) {}

  bool is_due(std::int64_t step) const;
  /// Throws std::runtime_error where the disk refuses.
  void write(const Simulation& simulation, const Notes& notes) { write(checkpoints_.restart, simulation, notes); }
  void write(const std::filesystem::path& path, const Simulation& simulation, const Notes& notes);
  /// After one that couldn't be written: the next one is due when it would be.
  void put_off() { at_ = std::chrono::steady_clock::now(); }

 private:
  const Checkpoints& checkpoints_;
  std::int64_t step_;  ///< of the last restart
  std::chrono::steady_clock::time_point at_ = std::chrono::steady_clock::now();
};

/// What the program round a simulation does.
struct Driver {
  /// Called at each step from the first to the last, and first thing when a run goes on. Before it a restart may be
  /// written, so what it does to the simulation must follow from the simulation and the notes alone.
  std::function<void(Simulation&)> at_step;
  /// What it wants to find again in a restart.
  std::function<Notes()> notes;
};

enum class RunEnd { reached, interrupted };

/// Where a run begins.
struct Start {
  Simulation simulation;
  Notes notes;
  std::string told;  ///< from which file and step it goes on, and what was wrong with a later one; empty: fresh
};

/// Goes on from the last good restart; where there is none at all, from `fresh`. `threads`: as in Numerics; absent:
/// those of the restart. Throws InputError where there are restarts but none is good: a run never starts anew by
/// mistake.
Start resume_or_start(const std::filesystem::path& restart, const std::function<Simulation()>& fresh,
                      std::optional<int> threads = {});

/// Runs to step `until`, and writes a restart every so often and at the end. Where `stop` is set (at Ctrl-C, say) it
/// finishes the step, writes a restart and gives RunEnd::interrupted. Where the run can't go on, the state is written
/// to the restart's name + ".stopped" and RunStopped names it; the last good restart stays.
RunEnd run_resumably(Simulation& simulation, std::int64_t until, const Checkpoints& checkpoints,
                     const std::atomic<bool>& stop, const Driver& driver = {});

}  // namespace soilbin::dem
