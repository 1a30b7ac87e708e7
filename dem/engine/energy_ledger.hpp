// Counts step by step where the energy goes (EnergyLosses), where Numerics::ledger is set.
//
// Contacts tell what they take from the motion by velocities of half a step ago. The work of a load on the way from
// that half step to the next is exactly that at the mean of both velocities; count_kick adds the difference.
#pragma once

#include <functional>

#include "dem/engine/evaluation.hpp"
#include "dem/engine/state.hpp"

namespace soilbin::dem {

class EnergyLedger {
 public:
  /// After a search.
  void begin(const Setup& setup, const State& state);
  /// Before the contacts of a step: which of them hold.
  void begin_step(const Setup& setup, const State& state);
  /// A row each of grains, where contacts add what they take; nullptr where nothing is counted.
  LedgerLoad* rows() { return loads_.empty() ? nullptr : loads_.data(); }
  /// As the grain in this row is kicked; `half` is what its load changes in half a step. Clears its row.
  void count_kick(std::size_t row, const Load& load, const Kick& half, LostPower& lost);
  /// Rows [first, last) of grains that are not moved.
  void clear(std::size_t first, std::size_t last);
  /// Adds up what the slabs found, and what bonds of jkr that broke in this step had stored.
  void end_step(World& world) const;

 private:
  std::vector<LedgerLoad> loads_;
  std::vector<std::uint8_t> bonds_before_;  ///< PairList::touching before the step, with jkr
};

/// Makes a change between steps, and counts the energy that it brings in.
void with_energy_counted(World& world, const std::function<void()>& change);

}  // namespace soilbin::dem
