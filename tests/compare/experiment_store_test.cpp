// Stores of experiments: every bit comes back, two writers lose nothing, and damage is told.
#include "compare/calibrate/experiment_store.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "compare/failure_map/incline_map.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "tests/compare/stand_in_board.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using dem::test::Folder;
using Eigen::VectorXd;
using testing::HasSubstr;
namespace fs = std::filesystem;

VirtualTest board_test() { return stand_in_board({{"sliding_friction", 0.3, 0.9, "-"}}, "stand-in board, step 1e-5"); }

VectorXd at(double friction) { return VectorXd::Constant(1, friction); }

Experiment made_experiment(double friction) { return {at(friction), 7, {{8.47 + friction, 0.3}}, "", 1.5}; }

TEST(ExperimentStores, ADamagedFileIsNamed) {
  const Folder folder;
  std::ofstream(folder / "bad.json") << "{\"format\": \"soilbin-experi";
  EXPECT_THAT(soilbin::test::refusal([&] { ExperimentStore store(folder / "bad.json"); }), HasSubstr("bad.json"));
  std::ofstream(folder / "other.json") << "{\"format\": \"soilbin-run/1\"}";
  EXPECT_THROW(ExperimentStore(folder / "other.json"), InputError);
}

TEST(ExperimentStores, KeepEveryBit) {
  const Folder folder;
  const VirtualTest test = board_test();
  const VectorXd values = (VectorXd(3) << 1.0 / 3, 0.1 + 0.2, 5e-324).finished();
  {
    ExperimentStore store(folder / "store.json");
    store.add(test, {values, 18446744073709551615U, {{std::numbers::pi, 1e-300}}, "", 1.5});
  }
  const ExperimentStore store(folder / "store.json");
  const std::optional<Experiment> found = store.find(test, {values, 18446744073709551615U});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->results[0].value, std::numbers::pi);
  EXPECT_EQ(found->results[0].std_error, 1e-300);
  EXPECT_FALSE(store.find(test, {values, 1}));
}

/// What a failure map keeps of grains: four channels at values of its four factors, or why a run has no answer.
struct MapRuns {
  VirtualTest test{.identity = "grains\nbed.version 5",
                   .factors = {{"load", 300, 900, "N"},
                               {"lug height", 0, 0.02, "mm"},
                               {"angle", 0, 0.2, "deg"},
                               {"slip", 0.05, 0.4, "%"}},
                   .targets = grain_channels(),
                   .run = {}};
  std::mt19937_64 random;
  explicit MapRuns(std::uint64_t seed) : random(seed) {}

  /// Any finite number, the smallest and the largest with it.
  double number() {
    const double sign = random() % 2 == 0 ? 1 : -1;
    return sign * std::ldexp(1 + std::generate_canonical<double, 53>(random), static_cast<int>(random() % 2045) - 1022);
  }
  Experiment run() {
    Experiment one{(VectorXd(4) << number(), number(), number(), number()).finished(), random()};
    if (random() % 4 == 0)
      one.error = "the wheel digs itself in: \"80 %\"\nof its radius, \xc2\xb1 1";
    else
      for (int k = 0; k < 4; ++k) one.results.push_back({number(), std::abs(number())});
    one.seconds = std::abs(number());
    return one;
  }
};

// The runs alone: what a map learns from them takes minutes, and is kept nowhere.
TEST(ExperimentStores, WhatAFailureMapWritesIsReadToTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Folder folder;
    MapRuns map(seed);
    std::vector<Experiment> made;
    {
      ExperimentStore store(folder / "map.json");
      for (int k = 0; k < 12; ++k) store.add(map.test, made.emplace_back(map.run()));
    }
    const ExperimentStore store(folder / "map.json");
    ASSERT_EQ(store.size(), made.size());
    EXPECT_EQ(store.unsealed(), 0U);
    for (const Experiment& one : made) {
      const std::optional<Experiment> found = store.find(map.test, {one.values, one.seed});
      ASSERT_TRUE(found);
      EXPECT_EQ(found->error, one.error);
      EXPECT_EQ(found->seconds, one.seconds);
      ASSERT_EQ(found->results.size(), one.results.size());
      for (std::size_t k = 0; k < one.results.size(); ++k) {
        EXPECT_EQ(found->results[k].value, one.results[k].value);
        EXPECT_EQ(found->results[k].std_error, one.results[k].std_error);
      }
    }
    ExperimentStore copy(folder / "copy.json");
    copy.merge(folder / "map.json");
    EXPECT_EQ(copy.text(), store.text());
  }
}

// Each began with what was there before the other's first experiment; what is in the journal is there too.
TEST(ExperimentStores, TwoThatFillOneFileLoseNothing) {
  const Folder folder;
  {
    ExperimentStore one(folder / "store.json"), other(folder / "store.json");
    for (int k = 0; k < 5; ++k) {
      one.add(board_test(), made_experiment(0.3 + 0.1 * k));
      other.add(board_test(), made_experiment(1.3 + 0.1 * k));
      EXPECT_EQ(ExperimentStore(folder / "store.json").size(), 2U * (static_cast<std::size_t>(k) + 1));
    }
    EXPECT_EQ(other.size(), 10U) << "each knows the other's by now";
  }
  EXPECT_EQ(ExperimentStore(folder / "store.json").size(), 10U);
  EXPECT_FALSE(fs::exists(folder / "store.json.journal"));
}

TEST(ExperimentStores, AnExperimentIsSafeOnlyOnceItIsInTheFile) {
  const Folder folder;
  int safe = 0;
  VirtualTest test = board_test();
  test.run = [](const VectorXd&, std::uint64_t) -> std::vector<Estimate> { return {{1.0, 0.1}}; };
  test.on_saved = [&] {
    ++safe;
    EXPECT_EQ(ExperimentStore(folder / "new" / "store.json").size(), 1U);
  };
  std::ofstream(folder / "new") << "in the way";
  ExperimentStore store(folder / "new" / "store.json");
  EXPECT_THROW(obtain(test, {at(0.5), 1}, store), std::runtime_error);
  EXPECT_EQ(safe, 0);
  fs::remove(folder / "new");
  obtain(test, {at(0.6), 1}, store);
  EXPECT_EQ(safe, 1);
}

/// What a store says of the experiments that were put into it.
std::string said_by_store(const ExperimentStore& store) {
  std::string said;
  for (const double friction : {0.3, 0.4})
    if (const auto found = store.find(board_test(), {at(friction), 7}))
      said += fmt::format("{} {} {} {}\n", friction, found->results.at(0).value, found->results.at(0).std_error,
                          found->error);
  return said;
}

// Damage of one bit: refused with the file's name, or an experiment isn't known; never another answer.
TEST(SlowExperimentStores, NoFlippedBitChangesAnAnswer) {
  const Folder folder;
  ExperimentStore store(folder / "store.json");
  store.add(board_test(), made_experiment(0.3)), store.add(board_test(), made_experiment(0.4));
  const std::string text = read_bytes(folder / "store.json", 1 << 20), said = said_by_store(store);
  std::mt19937 random(26);
  int refused = 0;
  constexpr int flips = 600;
  for (int k = 0; k < flips; ++k) {
    std::string damaged = text;
    const std::size_t place = random() % text.size();
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << random() % 8));
    std::ofstream(folder / "damaged.json", std::ios::binary) << damaged;
    try {
      EXPECT_EQ(said_by_store(ExperimentStore(folder / "damaged.json")), said) << "byte " << place;
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("damaged.json")) << "byte " << place;
    }
  }
  EXPECT_GT(refused, flips / 2) << "half of the text are blanks";
}

TEST(ExperimentStores, WithoutSealsTheyAreReadAndCounted) {
  const Folder folder;
  std::ofstream(folder / "old.json") << R"({"format": "soilbin-experiments/1", "tests": [{"test":
    "stand-in board, step 1e-5\nfactors sliding_friction\ntargets board_angle",
    "experiments": [{"values": [0.3], "seed": 7, "results": [[8.77, 0.3]], "seconds": 1.5}]}]})";
  ExperimentStore store(folder / "old.json");
  EXPECT_EQ(store.unsealed(), 1U);
  EXPECT_EQ(store.find(board_test(), {at(0.3), 7})->results[0].value, 8.77);
  store.add(board_test(), made_experiment(0.4));
  EXPECT_EQ(ExperimentStore(folder / "old.json").unsealed(), 1U) << "writing it again vouches for nothing";
}

/// A store's file with one experiment that no seal vouches for.
std::string unsealed_store(double friction, double angle) {
  return fmt::format(R"({{"format": "soilbin-experiments/1", "tests": [{{"test":
    "stand-in board, step 1e-5\nfactors sliding_friction\ntargets board_angle",
    "experiments": [{{"values": [{}], "seed": 7, "results": [[{}, 0.3]], "seconds": 1.5}}]}}]}})",
                     friction, angle);
}

TEST(ExperimentStores, AMergeOrAJournalVouchesForNothingThatHadNoSeal) {
  const Folder folder;
  std::ofstream(folder / "old.json") << unsealed_store(0.3, made_experiment(0.3).results[0].value)
                                     << std::string(4000, '\n');
  ExperimentStore merged(folder / "merged.json");
  merged.merge(folder / "old.json");
  EXPECT_EQ(ExperimentStore(folder / "merged.json").unsealed(), 1U);

  std::string line = unsealed_store(0.4, 8.87);
  std::ranges::replace(line, '\n', ' ');
  std::ofstream(folder / "old.json.journal") << line << '\n';
  { ExperimentStore writes_again(folder / "old.json"); }
  EXPECT_FALSE(fs::exists(folder / "old.json.journal"));
  EXPECT_EQ(ExperimentStore(folder / "old.json").unsealed(), 2U);

  ExperimentStore made(folder / "made.json");
  made.add(board_test(), made_experiment(0.3));
  merged.merge(folder / "made.json");
  EXPECT_EQ(ExperimentStore(folder / "merged.json").unsealed(), 0U) << "the one that was made anew confirms it";
}

TEST(ExperimentStores, ARefusedMergeTakesNothing) {
  const Folder folder;
  std::ofstream(folder / "mine.json") << unsealed_store(0.3, 8.77);
  std::ofstream(folder / "theirs.json") << unsealed_store(0.3, 99.0);
  {
    ExperimentStore large(folder / "mine.json");
    for (int k = 0; k < 8; ++k) large.add(board_test(), made_experiment(0.4 + 0.1 * k));
  }
  {
    ExperimentStore mine(folder / "mine.json");
    mine.add(board_test(), made_experiment(1.5));
    ASSERT_TRUE(fs::exists(folder / "mine.json.journal")) << "what is known is written once more at the end";
    EXPECT_THAT(soilbin::test::refusal([&] { mine.merge(folder / "theirs.json"); }), HasSubstr("another answer"));
    EXPECT_EQ(mine.find(board_test(), {at(0.3), 7})->results[0].value, 8.77);
  }
  const ExperimentStore mine(folder / "mine.json");
  EXPECT_EQ(mine.find(board_test(), {at(0.3), 7})->results[0].value, 8.77);
  EXPECT_EQ(mine.size(), 10U);
  EXPECT_EQ(mine.unsealed(), 1U);
  EXPECT_EQ(read_bytes(folder / "mine.json", 1 << 20).find("99.0"), std::string::npos);
}

TEST(ExperimentStores, TellTheFlagsOfTheCommandsThatMadeThem) {
  const Folder folder;
  {
    ExperimentStore store(folder / "asked.json");
    store.tell_asked({{"--load", "2kN..8kN"}});
    EXPECT_FALSE(fs::exists(folder / "asked.json")) << "nothing is kept yet";
    store.add(board_test(), made_experiment(0.4));
  }
  ExperimentStore again(folder / "asked.json");
  again.tell_asked({{"--load", "1kN..2kN"}, {"--check", "5"}});
  EXPECT_EQ(again.asked().at("--load"), "2kN..8kN") << "what it tells stays";
  EXPECT_EQ(again.size(), 1U);
  EXPECT_EQ(ExperimentStore(folder / "asked.json").asked().at("--check"), "5") << "what came later is added";
}

// As soilbins of before wrote them.
TEST(ExperimentStores, ThoseOfTheLibraryAreWrittenBackAsTheyAre) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(SOILBIN_SOURCE_DIR "/cases/failure_maps")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_TRUE(ExperimentStore(entry).text() == read_bytes(entry, 1 << 26)) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 4);
}

TEST(ExperimentStores, SayWhereTheyAreNotAsExpected) {
  const Folder folder;
  const auto expect_refused = [&](const std::string& text, const std::string& words) {
    std::ofstream(folder / "s.json") << text;
    EXPECT_THAT(soilbin::test::refusal([&] { ExperimentStore store(folder / "s.json"); }),
                testing::AllOf(HasSubstr("s.json"), HasSubstr(words), testing::Not(HasSubstr("json.exception"))));
  };
  const std::string head = "{\"format\": \"soilbin-experiments/1\", \"tests\": ";
  expect_refused(head + "[{\"test\": \"a\", \"experiments\": [{}]}]}", "tests[0].experiments[0]: ");
  expect_refused(head + "[{\"experiments\": []}]}", "tests[0]: ");
  expect_refused(head + "7}", "tests");
  expect_refused(head + "\n[1e309]}", "s.json:2:2: this number is too large");
  expect_refused(std::string(100000, '['), "nested deeper than 32 levels");
}

}  // namespace
}  // namespace soilbin::compare
