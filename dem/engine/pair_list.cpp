#include "dem/engine/pair_list.hpp"

#include <algorithm>
#include <bit>

#include "dem/engine/domain.hpp"

namespace soilbin::dem {
namespace {

struct Pair {
  std::uint32_t first, second;
};

/// Pairs of one slab: those that touch, then those that are near.
struct PairsOfSlab {
  std::vector<Pair> all;
  std::size_t touching = 0;
};

/// Runs of rows where partners of the grains of a cell may lie; those that follow each other are one run.
void partner_runs(const Cells& cells, std::size_t cell, std::vector<RowRun>& runs) {
  runs.clear();
  cells.for_each_partner_run(cell, [&](std::uint32_t first, std::uint32_t last) {
    if (!runs.empty() && runs.back().last == first)
      runs.back().last = last;
    else
      runs.push_back({first, last});
  });
}

PairsOfSlab pairs_of_slab(const Cells& cells, int slab, const Grains& grains, NearKernel kernel,
                          const NearSweep& sweep) {
  std::vector<Pair> near;
  PairsOfSlab out;
  std::vector<RowRun> runs;
  std::vector<std::uint32_t> touching_rows, near_rows;
  const std::size_t begin = slab * cells.cells_of_slab();
  for (std::size_t cell = begin; cell < begin + cells.cells_of_slab(); ++cell) {
    const auto [own_first, own_last] = cells.rows(cell);
    if (own_first == own_last) continue;
    partner_runs(cells, cell, runs);
    std::size_t room = 0;
    for (const RowRun& run : runs) room += run.last - run.first;
    touching_rows.resize(std::max(room, touching_rows.size()));
    near_rows.resize(touching_rows.size());
    for (std::uint32_t i = own_first; i < own_last; ++i) {
      runs.front().first = i + 1;  // the cell's own rows come first
      NearRows found{touching_rows.data(), near_rows.data()};
      kernel(sweep, i, runs.data(), static_cast<int>(runs.size()), found);
      const auto add = [&, i = i](const std::uint32_t* rows, int count, std::vector<Pair>& to) {
        for (const std::uint32_t* j = rows; j != rows + count; ++j)
          if ((!grains.motion[i].held() || !grains.motion[*j].held()) && !grains.of_one_clump(i, *j))
            to.push_back({i, *j});
      };
      add(found.touching, found.touching_count, out.all);
      add(found.near, found.near_count, near);
    }
  }
  out.touching = out.all.size();
  out.all.insert(out.all.end(), near.begin(), near.end());
  return out;
}

std::uint32_t batches_for(std::size_t pairs) {
  return static_cast<std::uint32_t>((pairs + batch_size - 1) / batch_size);
}

void fill_slab(PairList& list, std::size_t begin, const PairsOfSlab& pairs, const Grains& grains,
               const KeptContacts& kept, const PairSearch& search) {
  std::array<double, memory_size> memory{};
  const std::size_t may_be_kept = search.holds_apart ? pairs.all.size() : pairs.touching;
  for (std::size_t k = 0; k < pairs.all.size(); ++k) {
    const std::size_t at = begin + k;
    const auto [i, j] = pairs.all[k];
    list.first[at] = i;
    list.second[at] = j;
    list.kind[at] = static_cast<std::uint8_t>(grains.material[i] * search.materials + grains.material[j]);
    if (k >= may_be_kept || !kept.find(i, j, memory)) continue;
    list.touching[at / batch_size] |= static_cast<std::uint8_t>(1u << (at % batch_size));
    for (int what = 0; what < memory_size; ++what) list.remembered(at, what) = memory[what];
  }
}

}  // namespace

void KeptContacts::take(const PairList& pairs, std::span<const std::uint32_t> new_row, std::size_t new_rows) {
  begin_.assign(new_rows + 2, 0);
  const auto for_each = [&](const auto& act) {
    for (std::size_t batch = 0; batch < pairs.batches(); ++batch)
      for (unsigned made = pairs.touching[batch]; made != 0; made &= made - 1) {
        const std::size_t pair = batch * batch_size + static_cast<std::size_t>(std::countr_zero(made));
        const std::uint32_t a = new_row[pairs.first[pair]], b = new_row[pairs.second[pair]];
        if (a != gone && b != gone) act(pair, a, b);
      }
  };
  // Counted two places on, then filled one place on: in the end each row's own place says where it begins.
  for_each([&](std::size_t, std::uint32_t a, std::uint32_t b) { ++begin_[std::min(a, b) + 2]; });
  for (std::size_t k = 2; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  contacts_.resize(begin_.back());
  for_each([&](std::size_t pair, std::uint32_t a, std::uint32_t b) {
    Contact& contact = contacts_[begin_[std::min(a, b) + 1]++];
    contact.larger = std::max(a, b);
    for (int what = 0; what < memory_size; ++what)
      contact.memory[what] = a < b ? pairs.remembered(pair, what) : -pairs.remembered(pair, what);
  });
}

bool KeptContacts::find(std::uint32_t a, std::uint32_t b, std::array<double, memory_size>& out) const {
  const std::uint32_t low = std::min(a, b), high = std::max(a, b);
  for (std::uint32_t k = begin_[low]; k < begin_[low + 1]; ++k)
    if (contacts_[k].larger == high) {
      for (int what = 0; what < memory_size; ++what)
        out[what] = a < b ? contacts_[k].memory[what] : -contacts_[k].memory[what];
      return true;
    }
  return false;
}

void find_pairs(const Cells& cells, const Grains& grains, const Domain& domain, const KeptContacts& kept,
                const PairSearch& search, PairList& list) {
  const int slabs = cells.slab_count();
  const Vec3 period = Periods(domain).length;
  const NearSweep sweep{grains.motion.data(), {period.x, period.y, period.z}, search.skin};
  std::vector<PairsOfSlab> of_slab(slabs);
#pragma omp parallel for schedule(dynamic) num_threads(search.threads)
  for (int slab = 0; slab < slabs; ++slab) of_slab[slab] = pairs_of_slab(cells, slab, grains, search.kernel, sweep);

  list.slab_begin.assign(slabs + 1, 0);
  for (int slab = 0; slab < slabs; ++slab)
    list.slab_begin[slab + 1] = list.slab_begin[slab] + batches_for(of_slab[slab].all.size());
  const std::size_t batches = list.slab_begin.back();
  list.first.assign(batches * batch_size, grains.idle_first());
  list.second.assign(batches * batch_size, grains.idle_second());
  list.kind.assign(batches * batch_size, 0);
  list.memory.assign(batches * batch_size * memory_size, 0.0);
  list.touching.assign(batches, 0);
#pragma omp parallel for schedule(dynamic) num_threads(search.threads)
  for (int slab = 0; slab < slabs; ++slab)
    fill_slab(list, static_cast<std::size_t>(list.slab_begin[slab]) * batch_size, of_slab[slab], grains, kept, search);
}

}  // namespace soilbin::dem
