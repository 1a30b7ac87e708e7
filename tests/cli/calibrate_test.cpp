// soilbin calibrate, run as a person runs it.
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(CalibrateCommand, RefusesWhatMakesNoSenseWithAHint) {
  struct {
    const char* arguments;
    const char* says;
  } const wrong[] = {
      {"calibrate papr-sand", "did you mean 'paper-sand'"},
      {"calibrate dry-sand", "need its section 'granular'"},
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
      {"calibrate paper-sand --test direct-sheer", "did you mean 'direct-shear'"},
      {"calibrate paper-sand --contact tire --target board_angle=31deg --test triaxial", "--test has no effect"},
      {"calibrate paper-sand --strength top", "'top' is none of peak, residual"},
      {"calibrate paper-sand --rolling elastic_plastik", "did you mean 'elastic_plastic'"},
      {"calibrate paper-sand --decide ding2011-smoot", "did you mean 'ding2011-smooth'"},
      {"calibrate paper-sand --decide ding2011-smooth --decide-at slop=1%..2%", "did you mean 'slip'"},
      {"calibrate paper-sand --decide ding2011-smooth --decide-at slip=20%", "expected LOW..HIGH"},
      {"calibrate paper-sand --decide ding2011-smooth --decide-at slip=70%..80%", "it has load 80 N, slip 0 %"},
      {"calibrate paper-sand --decide ding2011-smooth --bed-length 0.6m", "leaves the wheel no way"},
      {"calibrate paper-sand --decide cmu-grousered --bed-width 0.1m", "cmu-grousered: its wheel: "},
      {"calibrate paper-sand --bed-length 3m", "--decide"},
      {"calibrate paper-sand --decide ding2011-smooth --beside sets.csv", "--beside"},
  };
  for (const auto& [arguments, says] : wrong) {
    const Scratch scratch;
    EXPECT_THAT(soilbin(std::string(arguments) + " --store '" + (scratch / "store.json").string() + "'"),
                Refuses(HasSubstr(says)))
        << arguments;
  }
}

TEST(CalibrateCommand, NamesAStoreThatIsNone) {
  const Scratch scratch;
  const auto store = scratch.write("store.json", "{}");
  EXPECT_THAT(soilbin("calibrate paper-sand --store '" + store.string() + "'"), Refuses(HasSubstr("store.json")));
}

/// Four grains across, two boards, the law that takes the longer step: seconds of work.
const char* const small_board =
    "calibrate '" SOILBIN_SOURCE_DIR
    "/tests/fixtures/pebbles.yaml' --contact tire --target board_angle=31.47deg --rolling elastic_plastic --across 4 "
    "--packings 2 --threads 1 ";

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

/// Twenty-odd grains along a bed, a wheel of ten of them: a second a run.
const char* const toy_soil =
    "format: soilbin-soil/1\nname: toy\ngranular:\n  radius_min: 8 mm\n  radius_max: 12 mm\n  grain_density: 2500 "
    "kg/m^3\n"
    "  youngs_modulus: 3 MPa\n  poisson_ratio: 0.2\n  rolling_resistance: elastic_plastic\n"
    "  grain_grain: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}\n"
    "  grain_tire: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.5}\n";
const char* const toy_campaign =
    "format: soilbin-campaign/1\nname: toy-bin\nwheel: {radius: 80 mm, width: 60 mm}\nsoil:\n"
    "  exponent: {value: 1, sd: 0}\n  k_c: {value: 0 kN/m^2, sd: 0 kN/m^2}\n  k_phi: {value: 1000 kN/m^3, sd: 0 "
    "kN/m^3}\n"
    "  cohesion: {value: 0 kPa, sd: 0 kPa}\n  friction_angle: {value: 28 deg, sd: 0 deg}\n"
    "  shear_modulus: {value: 10 mm, sd: 0 mm}\n  stress_angle_c1: {value: 0.2, sd: 0}\n"
    "  stress_angle_c2: {value: 0.3, sd: 0}\n  density: 1500 kg/m^3\nbin: {depth: 50 mm, width: 100 mm}\ndata: "
    "runs.csv\n";

TEST(SlowCalibrateCommand, LetsTheSoilBinDecideAndKeepsItsRuns) {
  const Scratch scratch;
  scratch.write("soil.yaml", toy_soil), scratch.write("campaign/campaign.yaml", toy_campaign);
  scratch.write("campaign/runs.csv",
                "setpoint,load_N,slip,speed_m_s,drawbar_pull_N,torque_Nm\nA,20,0.3,0.4,2,0.5\nA,20,0.3,0.4,3,0.6\n"
                "B,20,0.6,0.4,3,0.7\n");
  const auto at = [&](const char* name) { return "'" + (scratch / name).string() + "' "; };
  const std::string asked = "calibrate " + at("soil.yaml") + "--contact tire --target board_angle=25deg --near 20% " +
                            "--across 3 --packings 2 --runs 10 --threads 1 --store " + at("store.json") + "--decide " +
                            at("campaign") +
                            "--decide-at slip=25%..35% --bed-length 0.35m --behind 0.1m --ahead 0.1m " +
                            "--lowering 0.1s --resting 0.02s --starting 0.05s --output " + at("out.yaml");
  const std::string beds = "SOILBIN_BEDS=" + at("beds");
  const Outcome first = soilbin(asked + "--json", beds);
  ASSERT_TRUE(first.status == 0 || first.status == 1) << first.err;
  const nlohmann::json found = first.json(), decision = found.at("decision");
  const std::size_t candidates = found.at("candidates").size();
  ASSERT_GE(candidates, 1U);
  EXPECT_EQ(decision.at("campaign"), "toy-bin");
  EXPECT_EQ(decision.at("setpoints").size(), 1U);
  EXPECT_EQ(decision.at("setpoints").at(0).at("runs"), 2);
  EXPECT_EQ(decision.at("trials").size(), candidates);
  EXPECT_EQ(decision.at("runs"), candidates);
  EXPECT_EQ(found.at("best"), found.at("candidates").at(decision.at("chosen").get<std::size_t>()));
  EXPECT_THAT(text_of(scratch / "out.yaml"), AllOf(HasSubstr("soil bin"), HasSubstr("toy-bin")));
  // Again: from what was kept, and told in words.
  const Outcome again = soilbin(asked + "--json", beds);
  EXPECT_EQ(again.json().at("decision"), decision);
  const Outcome words = soilbin(asked, beds);
  EXPECT_THAT(words.out, HasSubstr("is nearest to toy-bin"));
  EXPECT_THAT(words.out, HasSubstr("torque off [% W r]"));
  EXPECT_THAT(words.out, HasSubstr("chosen"));
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
