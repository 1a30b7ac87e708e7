#include "dem/worker_lammps/pair_memory.hpp"

#include <algorithm>

namespace soilbin::dem {

std::uint64_t PairMemory::key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
}

bool PairMemory::is_next(int row_first, int row_second) const {
  return cursor_ < made_.size() && made_[cursor_].row_first == row_first && made_[cursor_].row_second == row_second;
}

void PairMemory::pass(int row_first, int row_second) {
  if (in_order_ && is_next(row_first, row_second)) ++cursor_;
}

std::optional<Memory<double>> PairMemory::before(int row_first, int row_second, const int* ids) {
  if (in_order_) {
    if (!is_next(row_first, row_second)) return std::nullopt;
    return made_[cursor_++].memory;
  }
  const auto found = by_ids_.find(key(ids[row_first], ids[row_second]));
  if (found == by_ids_.end()) return std::nullopt;
  const Memory<double>& memory = found->second.memory;
  if (found->second.first == ids[row_first]) return memory;
  return Memory<double>{-memory.slide, -memory.roll};
}

void PairMemory::end_step() {
  made_.swap(making_);
  by_ids_.clear();
  in_order_ = true;
}

void PairMemory::forget_order() {
  in_order_ = false;
  for (const PairContact& contact : made_) take(contact);
}

void PairMemory::take(const PairContact& contact) {
  by_ids_.try_emplace(key(contact.first, contact.second), Kept{contact.first, contact.memory});
}

}  // namespace soilbin::dem
