// What a study asks of grains, run by run, in one order: answered by one process, or in shards by several.
//
//   for (const AskedRun& run : shard_of(run_list(conditions, packings, TestStep::yes), {.number = 2, .of = 4})) ...
//
// The list follows from conditions and packings alone: whoever computes it, on whichever machine, gets the same one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compare/recorded/record.hpp"

namespace soilbin::compare {

/// A run that a record is to hold.
struct AskedRun {
  OperatingCondition at;
  std::uint64_t packing = 1;  ///< seed of the bed
  bool half_step = false;     ///< at half the time step: belongs to Record::half_step
};

/// Whether the hardest condition is also to be run at half the time step (step_pair.hpp).
enum class TestStep { no, yes };

/// Every condition on every packing, packing by packing, so that a shard needs few beds; in each as conditions compare.
/// Conditions that are alike count once. With a test of the time step the list begins with its pair: the hardest
/// condition on the first packing, then the same at half the step; so whoever has the first shard makes both, before
/// anything else.
std::vector<AskedRun> run_list(const std::vector<OperatingCondition>& conditions,
                               const std::vector<std::uint64_t>& packings, TestStep test);

/// Shard `number` of 1 .. `of`.
struct Shard {
  int number = 1, of = 1;
};

/// "2/4". Throws InputError that names the flag --shard for anything else.
Shard parse_shard(std::string_view text);

/// The shard's runs: a stretch of the list. All shards together are the list; a pair of the time step stays together. A
/// run at half the step counts as two. With more shards than runs some are empty.
std::vector<AskedRun> shard_of(const std::vector<AskedRun>& list, const Shard& shard);
/// The number, 1 .. `of`, of the shard that each run of the list belongs to.
std::vector<int> shard_numbers(const std::vector<AskedRun>& list, int of);

/// The run of the record that answers what is asked; nullptr where there is none.
const RecordedRun* find_run(const Record& record, const AskedRun& asked);

/// Those of the list that none of the records holds.
std::vector<AskedRun> missing_runs(const std::vector<AskedRun>& list, const std::vector<Record>& records);

/// "load 4 kN, slip 20 %, bed sample 2"; with ", half the time step" where it is that.
std::string in_words(const AskedRun& run);

}  // namespace soilbin::compare
