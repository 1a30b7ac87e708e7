#include "dem/engine/pair_list.hpp"

#include <algorithm>

#include "dem/engine/periodic.hpp"

namespace soilbin::dem {
namespace {

struct Pair {
  std::uint32_t first, second;
};

/// Pairs of one slab: those that touch, then those that are near.
std::vector<Pair> pairs_of_slab(const Cells& cells, int slab, const Grains& grains, const Periods& periods, double skin,
                                std::size_t& touching) {
  std::vector<Pair> near, touch;
  const auto consider = [&](std::uint32_t i, std::uint32_t j) {
    const Motion &a = grains.motion[i], &b = grains.motion[j];
    const double d2 = squared(periods.shortest(a.position - b.position));
    const double sum = a.radius + b.radius;
    if (d2 >= (sum + skin) * (sum + skin) || (a.held() && b.held())) return;
    (d2 < sum * sum ? touch : near).push_back({i, j});
  };
  const std::size_t begin = slab * cells.cells_of_slab();
  std::vector<std::array<std::uint32_t, 2>> runs;
  for (std::size_t cell = begin; cell < begin + cells.cells_of_slab(); ++cell) {
    const auto [own_first, own_last] = cells.rows(cell);
    if (own_first == own_last) continue;
    runs.clear();
    cells.for_each_partner_run(cell, [&](std::uint32_t first, std::uint32_t last) { runs.push_back({first, last}); });
    for (std::uint32_t i = own_first; i < own_last; ++i)
      for (const auto& [first, last] : runs)
        for (std::uint32_t j = first == own_first ? i + 1 : first; j < last; ++j) consider(i, j);
  }
  touching = touch.size();
  touch.insert(touch.end(), near.begin(), near.end());
  return touch;
}

std::uint32_t batches_for(std::size_t pairs) {
  return static_cast<std::uint32_t>((pairs + batch_size - 1) / batch_size);
}

void fill_slab(PairList& list, std::size_t begin, const std::vector<Pair>& pairs, const Grains& grains, int materials,
               const KeptContacts& kept) {
  std::array<double, memory_size> memory{};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t at = begin + k;
    const auto [i, j] = pairs[k];
    list.first[at] = i;
    list.second[at] = j;
    list.kind[at] = static_cast<std::uint8_t>(grains.material[i] * materials + grains.material[j]);
    if (!kept.find(grains.id[i], grains.id[j], memory)) continue;
    list.touching[at / batch_size] |= static_cast<std::uint8_t>(1u << (at % batch_size));
    for (int what = 0; what < memory_size; ++what) list.remembered(at, what) = memory[what];
  }
}

}  // namespace

KeptContacts::KeptContacts(const PairList& pairs, const Grains& grains) {
  GrainId largest = 0;
  for (const GrainId id : grains.id) largest = std::max(largest, id);
  begin_.assign(static_cast<std::size_t>(largest) + 2, 0);
  const auto for_each = [&](const auto& act) {
    for (std::size_t pair = 0; pair < pairs.first.size(); ++pair)
      if (pairs.touches(pair)) act(pair, grains.id[pairs.first[pair]], grains.id[pairs.second[pair]]);
  };
  for_each([&](std::size_t, GrainId a, GrainId b) { ++begin_[std::min(a, b) + 1]; });
  for (std::size_t k = 0; k + 1 < begin_.size(); ++k) begin_[k + 1] += begin_[k];
  contacts_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for_each([&](std::size_t pair, GrainId a, GrainId b) {
    Contact& contact = contacts_[next[std::min(a, b)]++];
    contact.larger = std::max(a, b);
    for (int what = 0; what < memory_size; ++what)
      contact.memory[what] = a < b ? pairs.remembered(pair, what) : -pairs.remembered(pair, what);
  });
}

bool KeptContacts::find(GrainId a, GrainId b, std::array<double, memory_size>& out) const {
  const GrainId low = std::min(a, b), high = std::max(a, b);
  if (low + std::size_t{1} >= begin_.size()) return false;
  for (std::uint32_t k = begin_[low]; k < begin_[low + 1]; ++k)
    if (contacts_[k].larger == high) {
      for (int what = 0; what < memory_size; ++what)
        out[what] = a < b ? contacts_[k].memory[what] : -contacts_[k].memory[what];
      return true;
    }
  return false;
}

PairList find_pairs(const Cells& cells, const Grains& grains, const Domain& domain, double skin, int materials,
                    const KeptContacts& kept, int threads) {
  const int slabs = cells.slab_count();
  const Periods periods(domain);
  std::vector<std::vector<Pair>> of_slab(slabs);
  std::vector<std::size_t> touching(slabs);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (int slab = 0; slab < slabs; ++slab)
    of_slab[slab] = pairs_of_slab(cells, slab, grains, periods, skin, touching[slab]);

  PairList list;
  list.slab_begin.assign(slabs + 1, 0);
  for (int slab = 0; slab < slabs; ++slab)
    list.slab_begin[slab + 1] = list.slab_begin[slab] + batches_for(of_slab[slab].size());
  const std::size_t batches = list.slab_begin.back();
  list.first.assign(batches * batch_size, grains.idle_first());
  list.second.assign(batches * batch_size, grains.idle_second());
  list.kind.assign(batches * batch_size, 0);
  list.memory.assign(batches * batch_size * memory_size, 0.0);
  list.touching.assign(batches, 0);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (int slab = 0; slab < slabs; ++slab)
    fill_slab(list, static_cast<std::size_t>(list.slab_begin[slab]) * batch_size, of_slab[slab], grains, materials,
              kept);
  return list;
}

}  // namespace soilbin::dem
