// Runs kept in files, by one process or several, stopped and gone on with; shards made one: the same bytes.
#include "compare/recorded/run_store.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <set>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/recorded/kept_file.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A run as grains might have answered it: every number follows from what is asked.
RecordedRun answered(const RunSpec& asked) {
  TractionResult result;
  result.at = asked.at;
  result.drawbar_pull = {asked.at.load * asked.at.slip / 3 + static_cast<double>(asked.packing), 0.5};
  result.torque = {asked.at.load / 7, 0.25}, result.sinkage = {1e-3, 1e-4};
  return {.answer = {asked.at, result, ""},
          .packing = asked.packing,
          .source = "abc",
          .seconds = 10,
          .steady = true,
          .power = {},
          .rut = {},
          .flow = {}};
}

std::vector<RunSpec> asked_runs() {
  std::vector<OperatingCondition> conditions;
  for (const double slip : {0.4, 0.1, 0.2})
    for (const double load : {70.0, 40.0}) {
      OperatingCondition at;
      at.load = load, at.slip = slip;
      conditions.push_back(at);
    }
  return specs(conditions, {1, 2}, TestStep::yes);
}

const Record begun{"0.1.0", "dem", "name: made\n", {{"bed.length", "2.5"}}, {}};

/// In memory.
Record recorded_in_turn(const std::vector<RunSpec>& list) {
  RunStore store(begun);
  for (const RunSpec& spec : list) obtain(spec, store, answered);
  return store.record();
}

std::vector<NamedRecord> in_shards(int of) {
  std::vector<NamedRecord> shards;
  for (int k = 1; k <= of; ++k)
    shards.push_back({"shard-" + std::to_string(k) + ".json", recorded_in_turn(shard_of(asked_runs(), {k, of}))});
  return shards;
}

TEST(Merge, GivesTheBytesOfOneProcessForAnyNumberOfShardsInAnyOrder) {
  const std::string one = record_text(recorded_in_turn(asked_runs()));
  for (const int of : {1, 2, 4, 13, 20}) {
    std::vector<NamedRecord> shards = in_shards(of);
    EXPECT_EQ(record_text(merged(shards)), one) << of;
    std::reverse(shards.begin(), shards.end());
    EXPECT_EQ(record_text(merged(shards)), one) << of << " turned round";
    std::rotate(shards.begin(), shards.begin() + of / 2, shards.end());
    EXPECT_EQ(record_text(merged(shards)), one) << of << " rotated";
  }
}

TEST(Merge, OfWhatWasMergedChangesNothing) {
  std::vector<NamedRecord> shards = in_shards(3);
  const Record whole = merged(shards);
  shards.push_back({"whole.json", whole});
  EXPECT_EQ(record_text(merged(shards)), record_text(whole));
  EXPECT_EQ(record_text(merged({{"whole.json", whole}})), record_text(whole));
}

// Made twice, on a slower machine by other sources: the same answer, kept once, the same one for either order.
TEST(Merge, TheSameAnswerTwiceIsKeptOnce) {
  NamedRecord one{"a.json", recorded_in_turn(asked_runs())}, other{"b.json", recorded_in_turn(asked_runs())};
  for (RecordedRun& run : other.record.runs) run.seconds = 40;
  for (RecordedRun& run : other.record.half_step) run.seconds = 5;
  const Record whole = merged({one, other});
  EXPECT_EQ(whole.runs.size(), 12U);
  EXPECT_EQ(whole.half_step.size(), 1U);
  EXPECT_EQ(whole.runs[0].seconds, 10);
  EXPECT_EQ(whole.half_step[0].seconds, 5);
  EXPECT_EQ(record_text(merged({other, one})), record_text(whole));
}

void expect_merge_refused(const std::vector<NamedRecord>& shards, const std::vector<std::string>& words) {
  const std::string why = soilbin::test::refusal([&] { merged(shards); });
  for (const std::string& word : words) EXPECT_THAT(why, HasSubstr(word));
}

TEST(Merge, AnotherAnswerToTheSameRunNamesBothSources) {
  std::vector<NamedRecord> shards = {{"a.json", recorded_in_turn(asked_runs())}};
  shards.push_back({"b.json", recorded_in_turn(asked_runs())});
  RecordedRun& run = shards[1].record.runs[3];
  run.source = "def-dirty", run.answer.result->torque.value *= 1 + 1e-15;  // its last bit
  expect_merge_refused(shards,
                       {"load 70 N, slip 10 %, bed sample 1", "a.json (made by abc", "b.json (made by def-dirty"});
}

// A key that came to case files after a shard was made stands in the others' cases with its default: the same question.
TEST(Merge, TakesShardsOfBeforeACaseHadAKey) {
  const bekker_wong::CatalogueVocabulary effects;
  const std::filesystem::path cases = SOILBIN_SOURCE_DIR "/cases";
  const std::string now =
      write_case(read_case(cases / "studies/paper-longitudinal.yaml", Library({cases}), effects), effects);
  const auto with = [&](const std::string& text, const std::string& other) {
    std::string changed = now;
    const std::size_t at = changed.find(text);
    if (at == std::string::npos) throw std::logic_error(text);
    return changed.replace(at, text.size(), other);
  };
  std::vector<NamedRecord> shards = in_shards(2);
  shards[0].record.question = with("    shape: sphere\n", ""), shards[1].record.question = now;
  EXPECT_EQ(merged(shards).question, now);
  std::swap(shards[0], shards[1]);
  EXPECT_EQ(merged(shards).question, now);
  shards[1].record.question = with("value: 305 mm", "value: 306 mm");
  expect_merge_refused(shards, {"shard-1.json", "shard-2.json", "different cases"});
}

TEST(Merge, OtherInputsOtherCasesAndNothingAreRefusedByName) {
  std::vector<NamedRecord> shards = in_shards(2);
  shards[1].record.inputs[0].second = "4";
  expect_merge_refused(shards, {"shard-2.json", "bed.length: 4 in the file, 2.5 asked for"});
  shards = in_shards(2);
  shards[1].record.question += "soil: other\n";
  expect_merge_refused(shards, {"shard-1.json", "shard-2.json", "different cases"});
  expect_merge_refused({}, {"no record to merge"});
}

/// Files are flushed to the disk, which takes its time.
class SlowRunStore : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name = "r.json") const { return folder_ / name; }
  /// Obtains a run, and counts those that are really made.
  RecordedRun get(RunStore& store, const RunSpec& spec) {
    return obtain(spec, store, [this](const RunSpec& missing) { return ++made_, answered(missing); });
  }
  std::size_t runs_in(const char* name = "r.json") const { return read_record(folder_ / name).runs.size(); }

  dem::test::Folder folder_;
  const std::vector<RunSpec> list_ = asked_runs();
  int made_ = 0;
};

TEST_F(SlowRunStore, WhatIsThereIsNotMadeAgain) {
  {
    RunStore store(begun, file());
    for (int k = 0; k < 2; ++k)
      for (const RunSpec& spec : list_) get(store, spec);
    EXPECT_EQ(made_, 13) << "twelve and one at half the step";
  }
  RunStore again(begun, file());
  EXPECT_EQ(again.record().runs.size(), 12U);
  for (const RunSpec& spec : list_) EXPECT_EQ(run_text(get(again, spec)), run_text(answered(spec)));
  EXPECT_EQ(made_, 13);
}

TEST_F(SlowRunStore, WhatIsKnownElsewhereIsNeitherMadeNorCopied) {
  NamedRecord other{"other.json", recorded_in_turn(list_)};
  RunStore store(begun, file(), Writers::several, {other});
  get(store, list_[3]);
  EXPECT_EQ(made_, 0);
  EXPECT_FALSE(std::filesystem::exists(file()));
  other.record.inputs[0].second = "4";
  EXPECT_THROW(RunStore(begun, file(), Writers::several, {other}), InputError);
}

// Thirteen runs: each is on the disk at once, in a file that is written whole a few times.
TEST_F(SlowRunStore, ARunIsALineOfTheJournalUntilThatIsAsLongAsTheFile) {
  std::set<std::filesystem::file_time_type> written;
  {
    RunStore store(begun, file());
    for (const RunSpec& spec : list_) {
      get(store, spec), written.insert(std::filesystem::last_write_time(file()));
      EXPECT_NE(find_run(read_record(file()), spec), nullptr);
    }
    EXPECT_LE(written.size(), 7U);
    EXPECT_TRUE(std::filesystem::exists(file("r.json.journal")));
  }
  EXPECT_FALSE(std::filesystem::exists(file("r.json.journal")));
  EXPECT_EQ(read_bytes(file(), 1 << 26), record_text(recorded_in_turn(list_)));
}

// As a shard is written, on file systems without locks.
TEST_F(SlowRunStore, OneWriterKeepsAJournalTooAndTheSameBytes) {
  std::set<std::filesystem::file_time_type> written;
  {
    RunStore store(begun, file(), Writers::one);
    for (const RunSpec& spec : list_) {
      get(store, spec), written.insert(std::filesystem::last_write_time(file()));
      EXPECT_NE(find_run(read_record(file()), spec), nullptr);
    }
    EXPECT_LE(written.size(), 7U) << "not once a run";
  }
  EXPECT_FALSE(std::filesystem::exists(file("r.json.journal")));
  EXPECT_EQ(read_bytes(file(), 1 << 26), record_text(recorded_in_turn(list_)));
}

TEST_F(SlowRunStore, WhatCouldNotBeReadAgainIsNotWritten) {
  { RunStore(begun, file()).add(list_[0], answered(list_[0])); }
  const std::string before = read_bytes(file(), 1 << 26);
  KeptFile kept(
      file(), Writers::several, [] {}, [] { return std::string(largest_json + 1, ' '); });
  EXPECT_THAT(soilbin::test::error_of<CannotWrite>([&] { kept.add([] {}, ""); }),
              HasSubstr("no more than 256 MiB are read again"));
  EXPECT_EQ(read_bytes(file(), 1 << 26), before);
}

// What a process that is killed leaves: the file, the journal, half a line of it.
TEST_F(SlowRunStore, WhoIsKilledLosesNothing) {
  {
    RunStore store(begun, file());
    for (const RunSpec& spec : list_)
      if (made_ < 9) get(store, spec);
    std::filesystem::copy(file(), file("k.json"));
    std::filesystem::copy(file("r.json.journal"), file("k.json.journal"));
  }
  const std::string journal = read_bytes(file("k.json.journal"), 1 << 26);
  std::ofstream(file("k.json.journal"), std::ios::app) << journal.substr(0, journal.size() / 3);
  EXPECT_EQ(runs_in("k.json"), 8U) << "and one at half the step";
  {
    RunStore store(begun, file("k.json"));
    for (const RunSpec& spec : list_) get(store, spec);
  }
  EXPECT_EQ(made_, 13);
  EXPECT_EQ(read_bytes(file("k.json"), 1 << 26), record_text(recorded_in_turn(list_)));
  std::string damaged = journal;
  damaged.replace(damaged.find("\"torque\":"), 10, "\"torque\":1");
  std::ofstream(file("k.json.journal")) << damaged;
  EXPECT_THAT(soilbin::test::refusal([&] { read_record(file("k.json")); }),
              HasSubstr("k.json.journal: runs[0]: its seal doesn't fit"));
}

// What a run could be had again from is let go only with the run in the file: never before, however the writing fails.
TEST_F(SlowRunStore, ARunIsSafeOnlyOnceItIsInTheFile) {
  int safe = 0;
  RecordedRun run = answered(list_[2]);
  run.on_saved = [&] {
    ++safe;
    EXPECT_EQ(runs_in(), 1U);
  };
  RunStore store(begun, file());
  std::filesystem::create_directories(file() / "in the way");
  EXPECT_ANY_THROW(store.add(list_[2], run));
  EXPECT_EQ(safe, 0);
  std::filesystem::remove_all(file());
  store.add(list_[2], run);
  EXPECT_EQ(safe, 1);
}

// Where the disk takes neither record nor restart, what the run found is said: it may have taken hours.
TEST_F(SlowRunStore, ARunThatFindsNoPlaceIsTold) {
  RunStore store(begun, file("lost") / "record.json");
  std::ofstream(file("lost")) << "in the way";
  std::string said;
  try {
    get(store, list_[2]);
  } catch (const CannotWrite& error) {
    said = error.what();
  }
  const double pull = answered(list_[2]).answer.result->drawbar_pull.value;
  EXPECT_THAT(said, HasSubstr("can't make the folder"));
  EXPECT_THAT(said, HasSubstr("the run that is not in it: load 40 N, slip 10 %"));
  EXPECT_THAT(said, HasSubstr(fmt::format("drawbar pull {:.6g} ± ", pull)));
}

TEST_F(SlowRunStore, AnotherQuestionIsRefusedBeforeItRuns) {
  RunStore store(begun, file());
  get(store, list_[2]);
  Record longer = begun;
  longer.inputs[0].second = "4";
  EXPECT_THROW(RunStore(longer, file()), InputError);
  EXPECT_EQ(runs_in(), 1U);
}

TEST_F(SlowRunStore, TwoThatFillOneFileLoseNothing) {
  RunStore one(begun, file()), other(begun, file());
  get(one, list_[2]), get(other, list_[3]), get(one, list_[4]), get(other, list_[4]);
  EXPECT_EQ(made_, 3);
  EXPECT_EQ(runs_in(), 3U);
}

TEST_F(SlowRunStore, ARecordIsInOrderWhoeverMadeItsRunsAndWhen) {
  RunStore forward(begun, file("a.json")), backward(begun, file("b.json"), Writers::one);
  for (std::size_t k = 0; k < list_.size(); ++k) get(forward, list_[k]), get(backward, list_[list_.size() - 1 - k]);
  EXPECT_EQ(record_text(read_record(file("a.json"))), record_text(read_record(file("b.json"))));
  EXPECT_EQ(record_text(read_record(file("a.json"))), record_text(recorded_in_turn(list_)));
}

// Two processes at one shard, without a lock: the file is written over between one's reading and its writing, so a run
// is lost; the one that ends last puts all there is in again.
TEST_F(SlowRunStore, TwoAtOneShardLoseNothing) {
  RunStore one(begun, file(), Writers::one), other(begun, file(), Writers::one);
  get(one, list_[2]), get(one, list_[3]);
  std::filesystem::remove(file());
  get(other, list_[4]);  // knew nothing of the first two
  EXPECT_EQ(runs_in(), 1U);
  get(one, list_[5]);
  EXPECT_EQ(runs_in(), 4U);
  made_ = 0;
  for (const std::size_t k : {2U, 3U, 4U, 5U}) get(other, list_[k]);
  EXPECT_EQ(made_, 0);
}

// Six thousand runs with what a run holds: a copy of one for each that it is compared with took a minute and a half.
TEST(SlowMerge, OfManyRunsCopiesNone) {
  std::vector<NamedRecord> shards = {{"a.json", begun}, {"b.json", begun}};
  for (int k = 0; k < 6000; ++k) {
    OperatingCondition at;
    at.load = 100.0 + k, at.slip = 0.1;
    RecordedRun run = answered({at, 1});
    run.answer.result->patch.resize(180);
    shards[static_cast<std::size_t>(k % 2)].record.runs.push_back(std::move(run));
  }
  const std::clock_t began = std::clock();
  const Record whole = merged(shards);
  EXPECT_LT(static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC, 10.0);
  EXPECT_EQ(whole.runs.size(), 6000U);
}

}  // namespace
}  // namespace soilbin::compare
