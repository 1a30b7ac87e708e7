// Records of shards made one: whatever the order, the bytes of the record that one process would have written.
#include "compare/recorded/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <ctime>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/recorded/run_list.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A run as grains might have answered it: every number follows from what is asked.
RecordedRun answered(const AskedRun& asked) {
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

std::vector<AskedRun> asked_runs() {
  std::vector<OperatingCondition> conditions;
  for (const double slip : {0.4, 0.1, 0.2})
    for (const double load : {70.0, 40.0}) {
      OperatingCondition at;
      at.load = load, at.slip = slip;
      conditions.push_back(at);
    }
  return run_list(conditions, {1, 2}, TestStep::yes);
}

const Record begun{"0.1.0", "dem", "name: made\n", {{"bed.length", "2.5"}}, {}};

/// As SoilBin's runs come into a file, without a file.
Record recorded_in_turn(const std::vector<AskedRun>& list) {
  Record record = begun;
  for (const AskedRun& run : list) {
    (run.half_step ? record.half_step : record.runs).push_back(answered(run));
    put_in_order(record);
  }
  return record;
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
  try {
    merged(shards);
    FAIL() << "took it";
  } catch (const InputError& error) {
    for (const std::string& word : words) EXPECT_THAT(error.what(), HasSubstr(word));
  }
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
class SlowShardFiles : public testing::Test {
 protected:
  SlowShardFiles() {
    std::string pattern = (std::filesystem::temp_directory_path() / "soilbin-shard-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~SlowShardFiles() override { std::filesystem::remove_all(folder_); }

  RunOnce kept(const std::string& name, Writers writers) {
    return kept_in(
        folder_ / name, begun,
        [this](const Scenario&, const OperatingCondition& at, std::uint64_t packing) {
          ++made_;
          return answered({at, packing, false});
        },
        &Record::runs, writers);
  }

  std::filesystem::path folder_;
  int made_ = 0;
};

TEST_F(SlowShardFiles, ARecordIsInOrderWhoeverMadeItsRunsAndWhen) {
  const auto list = asked_runs();
  const RunOnce forward = kept("a.json", Writers::several), backward = kept("b.json", Writers::one);
  for (std::size_t k = 2; k < list.size(); ++k) {
    forward({}, list[k].at, list[k].packing);
    const AskedRun& other = list[list.size() + 1 - k];
    backward({}, other.at, other.packing);
  }
  EXPECT_EQ(record_text(read_record(folder_ / "a.json")), record_text(read_record(folder_ / "b.json")));
}

// Two processes at one shard, without a lock: the file is written over between one's reading and its writing, so a run
// is lost; the one that ends last puts all there is in again.
TEST_F(SlowShardFiles, TwoAtOneShardLoseNothing) {
  const auto list = asked_runs();
  const RunOnce one = kept("s.json", Writers::one), other = kept("s.json", Writers::one);
  one({}, list[2].at, list[2].packing);
  const Record before = read_record(folder_ / "s.json");
  one({}, list[3].at, list[3].packing);
  std::filesystem::remove(folder_ / "s.json");
  add_run(folder_ / "s.json", before, answered(list[4]), &Record::runs, Writers::one);  // knew nothing of list[3]
  EXPECT_EQ(read_record(folder_ / "s.json").runs.size(), 2U);
  one({}, list[5].at, list[5].packing);
  EXPECT_EQ(read_record(folder_ / "s.json").runs.size(), 4U);
  made_ = 0;
  for (const std::size_t k : {2U, 3U, 4U, 5U}) other({}, list[k].at, list[k].packing);
  EXPECT_EQ(made_, 0);
}

// Six thousand runs with what a run holds: a copy of one for each that it is compared with took a minute and a half.
TEST(SlowMerge, OfManyRunsCopiesNone) {
  std::vector<NamedRecord> shards = {{"a.json", begun}, {"b.json", begun}};
  for (int k = 0; k < 6000; ++k) {
    OperatingCondition at;
    at.load = 100.0 + k, at.slip = 0.1;
    RecordedRun run = answered({at, 1, false});
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
