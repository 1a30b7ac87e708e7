// The grains: one row a grain, split by what reads it. Rows, not one array a quantity: a contact needs all of a grain's
// motion at once, and a row is one or two cache lines (docs/lab/performance.md has the figures).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/kernels/grain_rows.hpp"

namespace soilbin::dem {

using GrainId = std::uint32_t;
/// What Grains::clump holds for a grain that is a sphere by itself.
inline constexpr std::uint32_t lone = ~0u;

/// A grain to be added, or a sphere of a clump.
struct NewGrain {
  GrainId id = 0;
  double radius = 0;  ///< [m]
  double mass = 1;    ///< [kg]; of a clump's sphere the clump's
  std::uint8_t material = 0;
  Vec3 position{}, velocity{}, spin{};
  std::uint32_t clump = lone;
  double inertia = 0;  ///< [kg m^2]; 0: that of a sphere of this mass
};

/// All grains, in the order in which they lie in the cells; a grain's id stays with it.
struct Grains {
  std::vector<Motion> motion;  ///< count() rows, then two that nobody touches: they fill up batches of contacts
  std::vector<Spin> spin;
  std::vector<Load> load;
  std::vector<GrainId> id;
  std::vector<std::uint8_t> material;
  std::vector<std::uint32_t> clump;  ///< that a sphere belongs to (clumps.hpp), or lone

  std::size_t count() const { return id.size(); }
  /// [m]; 0 where there are none.
  double largest_radius() const;
  /// Whether two rows belong to one clump.
  bool of_one_clump(std::uint32_t i, std::uint32_t j) const { return clump[i] == clump[j] && clump[i] != lone; }
  /// Adds a grain at the end; its row may move at the next sorting.
  void add(const NewGrain& grain);
  /// Takes away the rows marked.
  void remove(std::span<const std::uint8_t> gone);
  /// Row k becomes what row order[k] was; a permutation.
  void reorder(std::span<const std::uint32_t> order);

  /// The idle rows' indices.
  std::uint32_t idle_first() const { return static_cast<std::uint32_t>(count()); }
  std::uint32_t idle_second() const { return static_cast<std::uint32_t>(count() + 1); }

 private:
  void close();
  void move_row(std::uint32_t from, std::uint32_t to);
};

}  // namespace soilbin::dem
