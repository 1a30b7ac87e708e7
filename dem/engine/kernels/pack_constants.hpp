// What a pack of contacts takes from tables and adds to sums: the law's constants, from a table with a row of 16
// doubles for each kind of pair, and the powers lost.
#pragma once

#include <cstdint>

#include "dem/engine/kernels/grain_rows.hpp"
#include "dem/engine/kernels/pack.hpp"
#include "dem/engine/laws/contact_law.hpp"

namespace soilbin::dem::HWY_NAMESPACE {

static_assert(sizeof(LawConstants<double>) == 13 * sizeof(double),
              "a new constant: broadcast and gather list each one");

HWY_INLINE LawConstants<Pack> broadcast(const double* c) {
  return {Pack(c[0]), Pack(c[1]), Pack(c[2]), Pack(c[3]),  Pack(c[4]),  Pack(c[5]), Pack(c[6]),
          Pack(c[7]), Pack(c[8]), Pack(c[9]), Pack(c[10]), Pack(c[11]), Pack(c[12])};
}

/// Constants of a pack whose contacts are of several kinds.
HWY_INLINE LawConstants<Pack> gather(const double* table, const std::uint8_t* kind) {
  const FourPacks a = columns([&](int k) { return table + 16 * kind[k]; });
  const FourPacks b = columns([&](int k) { return table + 16 * kind[k] + 4; });
  const FourPacks c = columns([&](int k) { return table + 16 * kind[k] + 8; });
  const FourPacks d = columns([&](int k) { return table + 16 * kind[k] + 12; });
  return {a.a, a.b, a.c, a.d, b.a, b.b, b.c, b.d, c.a, c.b, c.c, c.d, d.a};
}

/// Constants of a pack, from the kinds of its contacts.
HWY_INLINE LawConstants<Pack> constants_of(const double* table, const std::uint8_t* kind) {
  for (int k = 1; k < lanes; ++k)
    if (kind[k] != kind[0]) return gather(table, kind);
  return broadcast(table + 16 * kind[0]);
}

/// Adds the losses of the contacts `counted`.
HWY_INLINE void add_up(const Losses<Pack>& of, PackMask counted, LostPower& sum) {
  sum.damping = add_up(sum.damping, where(counted, of.damping));
  sum.shear_damping = add_up(sum.shear_damping, where(counted, of.shear_damping));
  sum.sliding = add_up(sum.sliding, where(counted, of.sliding));
  sum.into_slide = add_up(sum.into_slide, where(counted, of.into_slide));
  sum.into_roll = add_up(sum.into_roll, where(counted, of.into_roll));
}

}  // namespace soilbin::dem::HWY_NAMESPACE
