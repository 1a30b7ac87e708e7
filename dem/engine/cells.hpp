// Where grains lie: cells at least as wide as two grains can reach, sorted so that grains of a slab (all cells at one
// place along the longest axis) follow each other. A contact joins grains of one slab or of two that are next to each
// other; so blocks of slabs can be worked on at once, then the seams between them (step.cpp), and nobody adds to a
// grain at the same time. The order of all sums is that of the slabs: the same bits for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/domain.hpp"
#include "dem/engine/grains.hpp"

namespace soilbin::dem {

class Cells {
 public:
  /// Lays cells over the box, or over the grains where a side of the box is farther out. reach: the largest distance
  /// of two centres that any contact may have until the next sorting [m]. Throws InputError where a periodic side is
  /// too short for a grain to meet another only once.
  Cells(const Domain& domain, std::span<const Motion> grains, double reach);

  /// The order that sorts grains by cell, and by id in a cell.
  std::vector<std::uint32_t> order(const Grains& grains) const;
  /// Reads where each cell begins, once grains are in that order.
  void index(const Grains& sorted);

  int slab_count() const { return count_[axis_]; }
  /// Rows of a slab, [first, last).
  std::array<std::uint32_t, 2> slab(int k) const {
    return {begin_[static_cast<std::size_t>(k) * cells_of_slab()],
            begin_[(static_cast<std::size_t>(k) + 1) * cells_of_slab()]};
  }

  /// Calls with the rows [first, last) of each run of cells where a partner of a grain of `cell` may lie, each pair of
  /// cells once; the cell itself comes first, with rows after the grain's own left to the caller.
  template <class Visit>
  void for_each_partner_run(std::size_t cell, const Visit& visit) const;

  std::size_t cells_of_slab() const { return static_cast<std::size_t>(count_[inner_[0]]) * count_[inner_[1]]; }
  std::array<std::uint32_t, 2> rows(std::size_t cell) const { return {begin_[cell], begin_[cell + 1]}; }

 private:
  std::size_t cell_of(const Vec3& position) const;

  std::array<double, 3> lower_{}, inverse_size_{};
  std::array<int, 3> count_{1, 1, 1};
  std::array<bool, 3> periodic_{};
  int axis_ = 0;  ///< of the slabs: the one with most cells
  std::array<int, 2> inner_{1, 2};
  std::vector<std::uint32_t> begin_;
};

template <class Visit>
void Cells::for_each_partner_run(std::size_t cell, const Visit& visit) const {
  const int n0 = count_[inner_[0]], n1 = count_[inner_[1]];
  const int k1 = static_cast<int>(cell % n1), k0 = static_cast<int>(cell / n1 % n0);
  const int slab = static_cast<int>(cell / (static_cast<std::size_t>(n0) * n1));
  const auto at = [&](int s, int a, int b) { return (static_cast<std::size_t>(s) * n0 + a) * n1 + b; };
  // Wraps an index, or says that there is nothing there (or that it is there already, the other way round).
  const auto wrapped = [](int& index, int n, bool periodic) {
    if (index >= 0 && index < n) return true;
    if (!periodic) return false;
    index = (index + n) % n;
    return true;
  };
  for (int ds = 0; ds <= 1; ++ds)
    for (int d0 = -1; d0 <= 1; ++d0)
      for (int d1 = -1; d1 <= 1; ++d1) {
        if (ds == 0 && (d0 < 0 || (d0 == 0 && d1 < 0))) continue;
        int s = slab + ds, a = k0 + d0, b = k1 + d1;
        if (!wrapped(s, count_[axis_], periodic_[axis_]) || !wrapped(a, n0, periodic_[inner_[0]]) ||
            !wrapped(b, n1, periodic_[inner_[1]]))
          continue;
        const auto [first, last] = rows(at(s, a, b));
        if (first != last) visit(first, last);
      }
}

}  // namespace soilbin::dem
