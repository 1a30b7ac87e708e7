// A study's runs as a list: one order, whole in its shards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "compare/recorded/run_store.hpp"
#include "scenario/errors.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

OperatingCondition listed_condition(double load, double slip) {
  OperatingCondition at;
  at.load = load, at.slip = slip;
  return at;
}

/// Of 2 loads and 3 slips, out of order.
std::vector<OperatingCondition> six_conditions() {
  std::vector<OperatingCondition> conditions;
  for (const double slip : {0.4, 0.1, 0.2})
    for (const double load : {70.0, 40.0}) conditions.push_back(listed_condition(load, slip));
  return conditions;
}

std::vector<std::string> in_words_all(const std::vector<RunSpec>& list) {
  std::vector<std::string> words;
  for (const RunSpec& run : list) words.push_back(in_words(run));
  return words;
}

TEST(RunSpecs, GoesPackingByPackingAndInEachByLoadAndSlip) {
  const auto list = specs(six_conditions(), {3, 1}, TestStep::no);
  ASSERT_EQ(list.size(), 12U);
  EXPECT_EQ(in_words(list[0]), "load 40 N, slip 10 %, bed sample 3");
  EXPECT_EQ(in_words(list[5]), "load 70 N, slip 40 %, bed sample 3");
  EXPECT_EQ(in_words(list[6]), "load 40 N, slip 10 %, bed sample 1");
}

TEST(RunSpecs, IsTheSameForConditionsInAnyOrderAndCountsThoseThatAreAlikeOnce) {
  std::vector<OperatingCondition> turned = six_conditions();
  std::reverse(turned.begin(), turned.end());
  turned.push_back(listed_condition(70, 0.1 * (1 + 1e-12)));
  EXPECT_EQ(in_words_all(specs(turned, {1, 2}, TestStep::yes)),
            in_words_all(specs(six_conditions(), {1, 2}, TestStep::yes)));
}

TEST(RunSpecs, BeginsWithTheHardestConditionAtBothSteps) {
  const auto list = specs(six_conditions(), {5, 6}, TestStep::yes);
  ASSERT_EQ(list.size(), 13U);
  EXPECT_EQ(in_words(list[0]), "load 70 N, slip 40 %, bed sample 5");
  EXPECT_EQ(in_words(list[1]), "load 70 N, slip 40 %, bed sample 5, half the time step");
  const std::set<std::string> once = [&] {
    const auto words = in_words_all(list);
    return std::set<std::string>(words.begin(), words.end());
  }();
  EXPECT_EQ(once.size(), 13U) << "nothing twice";
}

TEST(RunSpecs, CoarserTwinsComeLastEachOnce) {
  const auto plain = specs(six_conditions(), {1, 2}, TestStep::yes);
  const auto list = specs(six_conditions(), {1, 2}, TestStep::yes, Twins::yes);
  ASSERT_EQ(list.size(), plain.size() + 12);
  for (std::size_t k = 0; k < list.size(); ++k) {
    EXPECT_EQ(list[k].kind == RunKind::coarser, k >= plain.size()) << k;
    if (k < plain.size()) {
      EXPECT_EQ(in_words(list[k]), in_words(plain[k]));
    }
  }
  EXPECT_THAT(in_words(list.back()), testing::EndsWith(", bed sample 2, coarser grains"));
}

TEST(RunSpecs, NothingAskedIsNoRun) {
  EXPECT_TRUE(specs({}, {1}, TestStep::yes).empty());
  EXPECT_TRUE(shard_of(std::vector<RunSpec>{}, {1, 4}).empty());
}

// For every number of shards: put together they are the list, none has a pair's half alone, no two differ by more than
// a run and the pair (which counts as three).
TEST(Shards, AreTheListInStretches) {
  for (const TestStep test : {TestStep::no, TestStep::yes}) {
    const auto list = specs(six_conditions(), {1, 2, 3}, test);
    for (int of = 1; of <= 25; ++of) {
      std::vector<RunSpec> together;
      std::size_t least = list.size(), most = 0;
      for (int number = 1; number <= of; ++number) {
        const auto mine = shard_of(list, {number, of});
        if (!mine.empty()) {
          EXPECT_NE(mine.front().kind, RunKind::half_step) << number << " of " << of;
        }
        together.insert(together.end(), mine.begin(), mine.end());
        least = std::min(least, mine.size()), most = std::max(most, mine.size());
      }
      EXPECT_EQ(in_words_all(together), in_words_all(list)) << of << " shards";
      EXPECT_LE(most - least, test == TestStep::yes ? 3U : 1U) << of << " shards";
    }
  }
}

TEST(Shards, TheFirstMakesThePairOfTheTimeStep) {
  const auto list = specs(six_conditions(), {1}, TestStep::yes);
  for (const int of : {1, 2, 4, 6}) {
    const auto first = shard_of(list, {1, of});
    ASSERT_GE(first.size(), 2U);
    EXPECT_EQ(first[1].kind, RunKind::half_step) << of << " shards";
  }
}

TEST(Shards, AreReadAsKOfN) {
  EXPECT_EQ(parse_shard("2/4").number, 2);
  EXPECT_EQ(parse_shard("2/4").of, 4);
  for (const char* wrong : {"", "2", "0/4", "5/4", "2/0", "a/4", "2/4/6", "2/ 4", "-1/4", "1.5/2", "99999999999/2"})
    EXPECT_THAT(soilbin::test::refusal([&] { parse_shard(wrong); }), AllOf(HasSubstr("--shard"), HasSubstr("hint")))
        << wrong;
}

TEST(MissingRuns, AreThoseThatNoRecordHolds) {
  const auto list = specs({listed_condition(40, 0.1), listed_condition(40, 0.2)}, {1}, TestStep::yes);
  const auto made = [](const RunSpec& run) {
    return RecordedRun{.answer = {run.at, std::nullopt, "dug in"},
                       .packing = run.packing,
                       .source = "abc",
                       .power = {},
                       .rut = {},
                       .flow = {}};
  };
  Record one{"0.1.0", "dem", "", {}, {made(list[0])}}, other{"0.1.0", "dem", "", {}, {}, {made(list[1])}};
  EXPECT_EQ(missing_runs(list, {}).size(), 3U);
  EXPECT_EQ(in_words_all(missing_runs(list, {one})), in_words_all({list[1], list[2]}))
      << "the run at half the step is not the one at the step";
  EXPECT_EQ(in_words_all(missing_runs(list, {one, other})), in_words_all({list[2]}));
}

}  // namespace
}  // namespace soilbin::compare
