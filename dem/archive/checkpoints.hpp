// When a run writes a restart, and where it begins: anew or from the last good restart (dem/rig/staged_run.hpp).
#pragma once

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
  /// Gets what a person wants to know: where a run goes on, that a stopped one can.
  std::function<void(const std::string&)> tell{};
};

/// Knows when the next restart is due, and writes it. The checkpoints must outlive it.
class Checkpointer {
 public:
  /// `step`: of the restart that the run goes on from, or at which it begins.
  Checkpointer(const Checkpoints& checkpoints, std::int64_t step) : checkpoints_(checkpoints), step_(step) {}

  bool is_due(std::int64_t step) const;
  /// Throws std::runtime_error where the disk refuses.
  void write(const Simulation& simulation, const Notes& notes);
  /// After one that couldn't be written: the next one is due when it would be.
  void put_off() { at_ = std::chrono::steady_clock::now(); }

 private:
  const Checkpoints& checkpoints_;
  std::int64_t step_;  ///< of the last restart
  std::chrono::steady_clock::time_point at_ = std::chrono::steady_clock::now();
};

/// Where a run begins.
struct Start {
  Simulation simulation;
  Notes notes;
  std::string message;  ///< from which file and step it goes on, and what was wrong with a later one; empty: fresh
};

/// Goes on from the last good restart; where there is none at all, from `fresh`. `threads`: as in Numerics; absent:
/// those of the restart. Throws InputError where there are restarts but none is good: a run never starts anew by
/// mistake.
Start resume_or_start(const std::filesystem::path& restart, const std::function<Simulation()>& fresh,
                      std::optional<int> threads = {});

}  // namespace soilbin::dem
