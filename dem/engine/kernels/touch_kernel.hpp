// The law for contacts whose geometry was found one by one, grains on surfaces: a pack at a time, like pairs.
#pragma once

#include <cstdint>
#include <string_view>

#include "dem/engine/laws/law_constants.hpp"

namespace soilbin::dem {

/// Eight contacts in columns. Unused columns hold anything finite.
struct alignas(64) TouchBatch {
  // In: Touch of each contact, but the inverses of m* and I*.
  double normal[3][8], overlap[8], radius[8], inverse_mass[8], velocity[3][8], rotation[3][8], inverse_inertia[8];
  // In and out: slide and roll.
  double memory[6][8];
  // Out: on the grain.
  double force[3][8], couple[3][8];
  // Out, only where counted.
  double dashpot[3][8], slide[3][8];  ///< parts of force: of the normal dashpot, and tangential
  double losses[5];                   ///< Losses in their order, summed over the contacts [W]
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

/// The kernel for an instruction set of instruction_sets(). Throws InputError for any other name.
TouchKernel touch_kernel(std::string_view instruction_set);

}  // namespace soilbin::dem
