// Pairs of grains that touch or may touch before the next search, with what each contact remembers. Pairs of a slab
// follow each other, first those that touch at the search, in batches of eight: a pack or several.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "dem/engine/cells.hpp"
#include "dem/engine/grains.hpp"
#include "dem/engine/kernels/kernels.hpp"

namespace soilbin::dem {

/// Gives memory on cache lines, so that packs load without straddling two.
template <class T>
struct CacheLines {
  using value_type = T;
  CacheLines() = default;
  template <class U>
  CacheLines(const CacheLines<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64))); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, std::align_val_t(64)); }
  bool operator==(const CacheLines&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLines<T>>;

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

/// Contacts that outlive a sorting.
class KeptContacts {
 public:
  static constexpr std::uint32_t gone = ~0u;
  /// Takes over those of a list. new_row: of each grain, by its row in the list; or that it is gone.
  void take(const PairList& pairs, std::span<const std::uint32_t> new_row, std::size_t new_rows);
  /// What the contact of grain a with b, new rows, remembers, seen from a; false where they didn't touch.
  bool find(std::uint32_t a, std::uint32_t b, std::array<double, memory_size>& out) const;

 private:
  struct Contact {
    std::uint32_t larger;
    std::array<double, memory_size> memory;  ///< of the smaller row against the larger
  };
  std::vector<std::uint32_t> begin_;
  std::vector<Contact> contacts_;
};

struct PairSearch {
  NearKernel kernel;
  double skin;       ///< pairs are sought up to that far apart [m]
  bool holds_apart;  ///< whether contacts may last where grains don't overlap
  int materials;     ///< how many there are
  int threads;
};

/// Searches all pairs nearer than the sum of their radii plus the skin among sorted grains, and gives them the memory
/// of the contacts kept. What `list` held is gone; its room is used again.
void find_pairs(const Cells& cells, const Grains& grains, const Domain& domain, const KeptContacts& kept,
                const PairSearch& search, PairList& list);

}  // namespace soilbin::dem
