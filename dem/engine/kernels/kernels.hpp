// The three hot loops, a pack of contacts at a time: forces of pairs of grains, the law for grains on surfaces, and the
// search for neighbours. Each is compiled once for each instruction set (dem/CMakeLists.txt); kernels_for() picks.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dem/engine/kernels/grain_rows.hpp"
#include "dem/engine/laws/law_constants.hpp"

namespace soilbin::dem {

/// What a sweep over the pairs of a step reads and writes; the same for all its slabs.
struct PairSweep {
  const Motion* motion;
  const Spin* spin;
  Load* load;
  LedgerLoad* ledger_loads;  ///< nullptr: losses aren't counted
  const std::uint32_t *first, *second;
  const std::uint8_t* kind;
  double* memory;
  std::uint8_t* touching;
  const double* constants;  ///< a kind of pair: 16 doubles, LawConstants<double> first; aligned to 64 bytes
  int kinds;
  LawFlags laws;
  double dt;         ///< [s]
  double period[3];  ///< [m]; 0: not periodic
  double deepest;    ///< largest overlap allowed, as a share of the smaller radius
};

/// What a sweep over some batches found.
struct PairFindings {
  bool too_deep = false;
  LostPower lost;
};

/// Adds the forces of batches [begin, end) to the grains' loads, in the order of the batches.
using PairKernel = void (*)(const PairSweep&, std::size_t begin, std::size_t end, PairFindings&);

/// Contacts whose geometry was found one by one, grains on surfaces: eight in columns. Unused columns hold anything
/// finite.
struct alignas(64) TouchBatch {
  // In: Touch of each contact, but the inverses of m* and I*.
  double normal[3][8], overlap[8], radius[8], inverse_mass[8], velocity[3][8], rotation[3][8], inverse_inertia[8];
  double turning[8], before[3][8];
  // In and out: slide and roll.
  double memory[6][8];
  // Out: on the grain.
  double force[3][8], couple[3][8];
  // Out, only where counted.
  double dashpot[3][8], slide[3][8];  ///< parts of force: of the normal dashpot, and tangential
  LostPower lost;
  std::uint8_t kind[8];
};

struct TouchSweep {
  const double* constants;  ///< as of PairSweep
  LawFlags laws;
  double dt;
  bool ledger;
};

/// Fills in memory, force and couple of the first `count` contacts of a batch.
using TouchKernel = void (*)(const TouchSweep&, TouchBatch&, int count);

/// What a search reads; the same for all grains.
struct NearSweep {
  const Motion* motion;
  double period[3];  ///< [m]; 0: not periodic
  double skin;       ///< [m]
};

/// Rows [first, last).
struct RowRun {
  std::uint32_t first, last;
};

/// Rows found, in the order of the runs, in room for all of them.
struct NearRows {
  std::uint32_t *touching, *near;  ///< overlapping, and those up to the skin apart
  int touching_count = 0, near_count = 0;
};

/// Finds the rows in so many runs whose grains overlap the one in `row`, or are nearer to it than the skin.
using NearKernel = void (*)(const NearSweep&, std::uint32_t row, const RowRun* run, int runs, NearRows&);

struct Kernels {
  PairKernel pairs;
  TouchKernel touches;
  NearKernel near;
};

/// The instruction sets that the kernels were compiled for and this machine has, widest first: "avx512", "avx2",
/// "sse4". The first two give the same bits.
std::span<const std::string_view> instruction_sets();

/// The kernels for one of them. Throws InputError for any other name.
Kernels kernels_for(std::string_view instruction_set);

}  // namespace soilbin::dem
