// The search for pairs: which of the grains in neighbouring cells are near one, a pack at a time.
#pragma once

#include <cstdint>
#include <string_view>

namespace soilbin::dem {

struct Motion;

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

/// The kernel for an instruction set of instruction_sets(). Throws InputError for any other name.
NearKernel near_kernel(std::string_view instruction_set);

}  // namespace soilbin::dem
