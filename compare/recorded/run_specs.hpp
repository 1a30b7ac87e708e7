// What a study asks of grains, run by run, in one order: answered by one process, or in shards by several.
//
//   for (const RunSpec& spec : shard_of(specs(conditions, packings, TestStep::yes), {.number = 2, .of = 4})) ...
//
// The specs follow from conditions and packings alone: whoever computes them, on whichever machine, gets the same.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "compare/recorded/record.hpp"

namespace soilbin::compare {

/// Whether the hardest condition is also to be run at half the time step (step_pair.hpp).
enum class TestStep { no, yes };
/// Whether each run is also to be made with coarser grains (coarser_twin.hpp).
enum class Twins { no, yes };

/// Every condition on every packing, packing by packing, so that a shard needs few beds; in each as conditions compare.
/// Conditions that are alike count once. With a test of the time step its pair comes first: the hardest condition on
/// the first packing, then the same at half the step; so whoever has the first shard makes both, before anything else.
/// Coarser twins come last, in the same order.
std::vector<RunSpec> specs(const std::vector<OperatingCondition>& conditions,
                           const std::vector<std::uint64_t>& packings, TestStep test, Twins twins = Twins::no);

/// The specs that none of the records answers.
std::vector<RunSpec> missing_runs(const std::vector<RunSpec>& specs, const std::vector<Record>& records);

/// Shard `number` of 1 .. `of`.
struct Shard {
  int number = 1, of = 1;
};

/// "2/4". Throws InputError that names the flag --shard for anything else.
Shard parse_shard(std::string_view text);

/// The number, 1 .. `of`, of the shard that each piece of work belongs to. `half_step`: whether a piece is a run at
/// half the step, which counts as two and stays with the piece before it.
std::vector<int> shard_numbers(const std::vector<bool>& half_step, int of);

/// A shard's part of pieces of work: a stretch of them. All shards together are the whole; a pair of the time step
/// stays together. With more shards than pieces some are empty.
template <class Piece>
std::vector<Piece> shard_of(const std::vector<Piece>& all, const Shard& shard) {
  std::vector<bool> half_step(all.size());
  if constexpr (requires(const Piece& piece) { piece.kind; })
    for (std::size_t i = 0; i < all.size(); ++i) half_step[i] = all[i].kind == RunKind::half_step;
  const std::vector<int> numbers = shard_numbers(half_step, shard.of);
  std::vector<Piece> mine;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (numbers[i] == shard.number) mine.push_back(all[i]);
  return mine;
}

}  // namespace soilbin::compare
