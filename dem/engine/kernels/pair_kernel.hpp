// The hottest loop: contacts of grains, a pack at a time. pair_kernel.cpp is compiled once for each instruction set;
// pair_forces() picks the widest that the machine has.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dem/engine/laws/law_constants.hpp"

namespace soilbin::dem {

struct Motion;
struct Spin;
struct Load;
struct Taking;

/// What a sweep over the contacts of a step reads and writes; the same for all its slabs.
struct PairSweep {
  const Motion* motion;
  const Spin* spin;
  Load* load;
  Taking* taking;  ///< nullptr: losses aren't counted
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
  double losses[5] = {};  ///< Losses in their order, summed over contacts [W]
};

/// Adds the forces of batches [begin, end) to the grains' loads, in the order of the batches.
using PairKernel = void (*)(const PairSweep&, std::size_t begin, std::size_t end, PairFindings&);

/// The instruction sets that the kernel was compiled for and this machine has, widest first: "avx512", "avx2", "sse4".
std::span<const std::string_view> instruction_sets();

/// The kernel for an instruction set of instruction_sets(). Throws InputError for any other name.
PairKernel pair_kernel(std::string_view instruction_set);

}  // namespace soilbin::dem
