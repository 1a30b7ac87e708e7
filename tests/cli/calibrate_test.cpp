// soilbin calibrate, run as a person runs it.
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

TEST(CalibrateCommand, RefusesWhatMakesNoSenseWithAHint) {
  struct {
    const char* arguments;
    const char* says;
  } const wrong[] = {
      {"calibrate papr-sand", "did you mean 'paper-sand'"},
      {"calibrate dry-sand", "it needs a section 'granular'"},
      {"calibrate paper-sand --contact tyre", "did you mean 'tire'"},
      {"calibrate paper-sand --contact tire", "--target board_angle=31.47deg"},
      {"calibrate paper-sand --contact tire --target angle=31deg", "board_angle"},
      {"calibrate paper-sand --target friction_angle=31", "deg"},
      {"calibrate paper-sand --vary sliding_frction=0.2..0.8", "did you mean 'sliding_friction'"},
      {"calibrate paper-sand --vary sliding_friction=0.2", "expected LOW..HIGH"},
      {"calibrate paper-sand --vary sliding_friction=0.8..0.2", "the lower end must be below the upper one"},
      {"calibrate paper-sand --design L8", "there are L9, L16, L25"},
      {"calibrate paper-sand --runs 5", "less than the 9 of the design L9"},
      {"calibrate paper-sand --probability 100%", "--probability"},
      {"calibrate paper-sand --strength top", "'top' is none of peak, residual"},
  };
  for (const auto& [arguments, says] : wrong) {
    const Scratch scratch;
    const Outcome outcome = soilbin(std::string(arguments) + " --store '" + (scratch / "store.json").string() + "'");
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(says)) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
  }
}

TEST(CalibrateCommand, NamesAStoreThatIsNone) {
  const Scratch scratch;
  const auto store = scratch.write("store.json", "{}");
  const Outcome outcome = soilbin("calibrate paper-sand --store '" + store.string() + "'");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("store.json"));
}

/// Four grains across, two boards: seconds of work.
const char* const small_board =
    "calibrate paper-sand --contact tire --target board_angle=31.47deg --across 4 --packings 2 --threads 1 ";

TEST(SlowCalibrateCommand, FindsAContactKeepsItsRunsAndWritesASoil) {
  const Scratch scratch;
  const std::string files = "--store '" + (scratch / "store.json").string() + "' --output '" +
                            (scratch / "soil.yaml").string() + "' --runs 10 --json";
  const Outcome first = soilbin(small_board + files);
  ASSERT_TRUE(first.status == 0 || first.status == 1) << first.err;
  const nlohmann::json found = first.json();
  EXPECT_EQ(found.at("format"), "soilbin-calibration/1");
  EXPECT_GE(found.at("runs").size(), 9U);
  EXPECT_FALSE(found.at("runs").at(0).at("from_store").get<bool>());
  EXPECT_THAT(text_of(scratch / "soil.yaml"), HasSubstr("calibrated by soilbin calibrate"));
  // Again: nothing is simulated, and the answer is the same.
  const nlohmann::json again = soilbin(small_board + files).json();
  for (const nlohmann::json& run : again.at("runs")) EXPECT_TRUE(run.at("from_store").get<bool>());
  EXPECT_EQ(again.at("best"), found.at("best"));
  // The soil is one that other commands take, with the values found.
  const Outcome taken = soilbin("check '" + (scratch / "soil.yaml").string() + "'");
  EXPECT_EQ(taken.status, 0) << taken.err;
}

TEST(SlowCalibrateCommand, PutsPublishedSetsBesideOurs) {
  const Scratch scratch;
  const auto table = scratch.write(
      "sets.csv", "set,restitution,sliding_friction,rolling_friction,board_angle_deg\na,0.56,0.52,0.41,31.13\n");
  const Outcome outcome =
      soilbin(small_board + ("--store '" + (scratch / "store.json").string()) + "' --beside '" + table.string() + "'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("31.13"));
  EXPECT_THAT(outcome.out, HasSubstr("±"));
  const auto wrong = scratch.write("wrong.csv", "set,restitution,sliding_friction,board_angle_deg\na,0.5,0.5,31\n");
  EXPECT_THAT(soilbin(small_board + ("--beside '" + wrong.string()) + "'").err,
              HasSubstr("no column 'rolling_friction'"));
}

}  // namespace
}  // namespace soilbin::cli::test
