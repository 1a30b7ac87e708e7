// What the contacts of this process's grains with each other remember, while LAMMPS moves grains from process to
// process and lists their neighbours anew.
//
//   memory.begin_step();                                     // then pair by pair, as LAMMPS lists them
//   if (!touch(i, j)) memory.pass(i, j);
//   else memory.keep({i, j, ids[i], ids[j], respond(memory.before(i, j, ids))});
//   memory.end_step();
//
// From step to step the pairs come in the same order, so each contact is found where the last one stood. When they are
// listed anew, contacts are found by the ids of their grains.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "dem/engine/laws/contact_law.hpp"

namespace soilbin::dem {

/// Contact of the first grain with the second; plain data, so that it can be sent and written.
struct PairContact {
  int row_first = 0, row_second = 0;  ///< of this process, in this listing
  int first = 0, second = 0;          ///< ids
  Memory<double> memory{};
};

class PairMemory {
 public:
  void begin_step() { cursor_ = 0, making_.clear(); }
  /// What the contact of these two grains remembered a step ago, seen from the first; none where they didn't touch. For
  /// each pair of the list that touches, in its order.
  std::optional<Memory<double>> before(int row_first, int row_second, const int* ids);
  /// In place of that, for a pair that does not touch now.
  void pass(int row_first, int row_second);
  void keep(const PairContact& contact) { making_.push_back(contact); }
  void end_step();

  /// Before a step whose pairs are listed anew: contacts are then found by ids.
  void forget_order();
  /// Another process's, or a file's, for the next step. What is there already stays.
  void take(const PairContact& contact);
  const std::vector<PairContact>& contacts() const { return made_; }

 private:
  struct Kept {
    int first;
    Memory<double> memory;
  };
  bool is_next(int row_first, int row_second) const;
  static std::uint64_t key(int a, int b);

  std::vector<PairContact> made_, making_;
  std::size_t cursor_ = 0;
  std::unordered_map<std::uint64_t, Kept> by_ids_;
  bool in_order_ = true;
};

}  // namespace soilbin::dem
