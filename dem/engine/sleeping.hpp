// Which slabs of cells sleep (Sleep in state.hpp): what is left out while nothing moves there, and when it is taken up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/state.hpp"

namespace soilbin::dem {

/// How fast the grains of a slab are [m/s].
struct SlabSpeed {
  double fastest = 0;
  double root_mean_square = 0;
};

class Sleeping {
 public:
  /// After a search: all slabs are awake until the next choice.
  void begin(const State& state);
  /// A slab sleeps where it and both its neighbours have been calm for long enough. Gives whether others sleep now.
  bool choose(const State& state, const Numerics& numerics);
  /// At the end of a step, from the speeds in each slab: how calm each has been (State::calm). A slab near a body that
  /// moves or may move is not.
  void count_calm(State& state, const Numerics& numerics, std::span<const SlabSpeed> speeds) const;

  bool operator[](int slab) const { return asleep_[slab]; }
  /// The slabs on both sides; the row of slabs is closed to a ring.
  bool next_sleeps(int slab) const { return asleep_[(slab + 1) % asleep_.size()]; }
  bool previous_sleeps(int slab) const { return asleep_[(slab + asleep_.size() - 1) % asleep_.size()]; }
  /// Share of the grains.
  double share(const State& state) const;

 private:
  bool is_driven(const State& state, int slab) const;

  std::vector<std::uint8_t> asleep_;  ///< of each slab
  std::vector<std::uint8_t> near_;    ///< whether slab k has grains near body b, at k*bodies + b
};

/// Nobody has been calm: the next step works on all grains.
void wake_all(State& state);

/// Carries State::calm through a search, which sorts grains into other slabs: how calm each grain's slab was, by the
/// rows of the new order; and back. Nobody is calm after grains were added or removed.
std::vector<std::uint32_t> calm_by_row(const State& state, std::span<const std::uint32_t> order);
void take_calm(State& state, const Numerics& numerics, std::span<const std::uint32_t> by_row);

}  // namespace soilbin::dem
