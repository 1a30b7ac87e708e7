// The one keeper of runs: a record in a file that several processes add to, or in memory; and records put together.
//
//   RunStore store(begin, "record.json");                     // what is there is known; other inputs are refused
//   const RecordedRun run = obtain({at, 1}, store, make);     // from the store, or made now and kept
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/recorded/kept_file.hpp"
#include "compare/recorded/record.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

// What a study asks of grains, run by run, in one order: answered by one process, or in shards by several.
//
//   for (const RunSpec& spec : shard_of(specs(conditions, packings, TestStep::yes), {.number = 2, .of = 4})) ...
//
// The specs follow from conditions and packings alone: whoever computes them, on whichever machine, gets the same.

/// Whether the hardest condition is also to be run at half the time step (step_pair.hpp).
enum class TestStep { no, yes };
/// Whether each run is also to be made with coarser grains.
enum class Twins { no, yes };

/// Every condition on every packing, packing by packing, so that a shard needs few beds; in each as conditions compare.
/// Conditions that are alike count once. With a test of the time step its pair comes first: the hardest condition on
/// the first packing, then the same at half the step; so whoever has the first shard makes both, before anything else.
/// Coarser twins come last, in the same order.
std::vector<RunSpec> specs(const std::vector<OperatingCondition>& conditions,
                           const std::vector<std::uint64_t>& packings, TestStep test, Twins twins = Twins::no);

/// The specs that none of the records answers.
std::vector<RunSpec> missing_runs(const std::vector<RunSpec>& specs, const std::vector<Record>& records);

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

// Records, and their keeper.

/// A record and the file that it was read from, for messages.
struct NamedRecord {
  std::filesystem::path file;
  Record record;
};

/// All their runs in one record, in_order; any order of the shards gives the same one, whose bytes are those of the
/// record that one process would have written, but for the seconds that each run took. A run that several hold with the
/// same answer is kept once (of seconds and sources those that compare first), so merging twice changes nothing. Throws
/// InputError for none, for records of other inputs, model or case (as each is written today), and where two hold the
/// same run with different answers; it names both files, the run, and what made each.
Record merged(const std::vector<NamedRecord>& shards);

class RunStore {
 public:
  /// `begin`: what the file is begun with where there is none. Without a file runs are kept in memory alone. `known`:
  /// records whose runs are known too, and not copied. Throws InputError where the inputs of a file differ.
  explicit RunStore(Record begin, std::filesystem::path file = {}, Writers writers = Writers::several,
                    const std::vector<NamedRecord>& known = {});

  /// The run of a spec, in the file, as it is by now, or in a record that is known; nullptr where there is none. Stays
  /// until the next call.
  const RecordedRun* find(const RunSpec& spec);
  /// Whether a record that is known has it.
  bool knows(const RunSpec& spec) const;

  /// Adds a run that find doesn't have. With the run on the disk, it is safe (on_saved). Throws CannotWrite with what
  /// the run found, for nothing else may be left of it.
  void add(const RunSpec& spec, const RecordedRun& run);

  /// The record as it was read or written last.
  const Record& record() const { return record_; }

 private:
  void read();

  std::filesystem::path file_;
  Record record_;
  std::vector<Record> known_{};
  KeptFile kept_;  ///< last: goes first, and writes the record
};

/// The run of a spec: the store's, or made now and added to it.
RecordedRun obtain(const RunSpec& spec, RunStore& store, const std::function<RecordedRun(const RunSpec&)>& make);

// A record told to a person: how many runs it holds of which packing, who made them, and whether they hang on the time
// step. `soilbin record show` prints it.

/// A row a packing: runs, those with a result, those that became steady, seconds of work.
Table packings_table(const Record& record);

/// Model, makers, hash of the inputs; packings_table; a line for each pair of the time step (step_pair.hpp).
std::string in_words(const NamedRecord& record);

}  // namespace soilbin::compare
