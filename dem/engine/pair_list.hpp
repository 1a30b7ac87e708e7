// Pairs of grains that touch or may touch before the next search, with what each contact remembers. Pairs of a slab
// follow each other, first those that touch at the search, in batches of eight: a pack or several.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/engine/aligned.hpp"
#include "dem/engine/cells.hpp"
#include "dem/engine/grains.hpp"

namespace soilbin::dem {

inline constexpr int batch_size = 8;
/// Numbers that a contact remembers: slide x, y, z [m], roll x, y, z [rad], of the first grain against the second.
inline constexpr int memory_size = 6;

struct PairList {
  std::vector<std::uint32_t> first, second;  ///< rows of grains; batches are filled up with the idle rows
  std::vector<std::uint8_t> kind;            ///< pair of materials, a*materials + b
  AlignedVector<double> memory;              ///< a batch: memory_size columns of batch_size
  std::vector<std::uint8_t> touching;        ///< a batch: bit k, contact k has been made
  std::vector<std::uint32_t> slab_begin;     ///< first batch of each slab, and the end

  std::size_t batches() const { return touching.size(); }
  bool touches(std::size_t pair) const { return touching[pair / batch_size] >> (pair % batch_size) & 1; }
  double& remembered(std::size_t pair, int what) {
    return memory[(pair / batch_size * memory_size + what) * batch_size + pair % batch_size];
  }
  double remembered(std::size_t pair, int what) const {
    return memory[(pair / batch_size * memory_size + what) * batch_size + pair % batch_size];
  }
};

/// Contacts by the ids of their grains, so that they outlive a sorting.
class KeptContacts {
 public:
  KeptContacts(const PairList& pairs, const Grains& grains);
  /// What the contact of a with b remembers, seen from a; nullptr-like false where they didn't touch.
  bool find(GrainId a, GrainId b, std::array<double, memory_size>& out) const;

 private:
  struct Contact {
    GrainId larger;
    std::array<double, memory_size> memory;  ///< of the smaller id against the larger
  };
  std::vector<std::uint32_t> begin_;
  std::vector<Contact> contacts_;
};

/// Searches all pairs nearer than the sum of their radii plus `skin` among sorted grains, on `threads` threads, and
/// gives them the memory of the contacts kept.
PairList find_pairs(const Cells& cells, const Grains& grains, const Domain& domain, double skin, int materials,
                    const KeptContacts& kept, int threads);

}  // namespace soilbin::dem
