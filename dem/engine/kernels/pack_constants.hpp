// The law's constants for a pack of contacts, from a table with a row of 16 doubles for each kind of pair.
#pragma once

#include <cstdint>

#include "dem/engine/kernels/pack.hpp"
#include "dem/engine/laws/law_constants.hpp"

namespace soilbin::dem::HWY_NAMESPACE {

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

}  // namespace soilbin::dem::HWY_NAMESPACE
