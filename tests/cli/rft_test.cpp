// The model rft in the commands: run, compare, predict and plates; what it can't know of is said.
#include <gmock/gmock.h>

#include <string>

#include "tests/cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A study of a lugged wheel by both quick models, on a soil with or without values for rft.
std::string lugged_study(const std::string& resistive_force, const std::string& more = "") {
  return "format: soilbin-case/1\nname: two-quick-models\n"
         "tire: {name: lugged, radius: 300 mm, width: 200 mm, lugs: {height: 20 mm, count: 24, thickness: 10 mm}}\n"
         "soil:\n  name: sand\n  semi_empirical: {exponent: 1, k_c: 1 kN/m^(n+1), k_phi: 1500 kN/m^(n+2), cohesion: 0 "
         "kPa, "
         "friction_angle: 30 deg, shear_modulus: 15 mm, density: 1600 kg/m^3}\n" +
         resistive_force + "study:\n  models: [bekker_wong, rft]\n  conditions: {load: 1 kN, slip: [10 %, 30 %]" +
         more + "}\n";
}

const std::string declared = "  resistive_force: {xi_n: {value: 1100 kN/m^3, sd: 100 kN/m^3}, surface_friction: 0.5}\n";

TEST(ResistiveForceCommand, AnswersAStudyBesideTheAnalyticWheel) {
  const Scratch scratch;
  const Outcome run = soilbin("run '" + scratch.write("case.yaml", lugged_study(declared)).string() + "' --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto rows = run.json().at("rows");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2].at("model"), "rft");
  EXPECT_GT(rows[2].at("drawbar_pull").get<double>(), 0.0);
  EXPECT_GT(rows[2].at("std_error").at("drawbar_pull").get<double>(), 0.0);
  EXPECT_THAT(run.err, Not(HasSubstr("xi_n")));
}

TEST(ResistiveForceCommand, SaysWhatItTakesForASoilThatDeclaresNothing) {
  const Scratch scratch;
  const Outcome run = soilbin("run '" + scratch.write("case.yaml", lugged_study("")).string() + "' --model rft");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("are estimated from the soil's density and friction angle"));
}

TEST(ResistiveForceCommand, IsAskedByFlags) {
  const Scratch scratch;
  const std::string file = "'" + scratch.write("case.yaml", lugged_study(declared)).string() + "'";
  const auto study = soilbin("run " + file + " --model rft --json").json().at("rows");
  EXPECT_EQ(soilbin("estimate " + file + " --model rft --json").json().at("rows"), study);
  const auto flags =
      soilbin("estimate --tire 600-65R28 --soil dry-sand --load 25kN --slip 20% --model rft --json").json();
  EXPECT_EQ(flags.at("rows").at(0).at("model"), "rft");
  EXPECT_THAT(soilbin("estimate " + file + " --model rft --effect bulldozing").err,
              HasSubstr("--effect means nothing to --model rft"));
  EXPECT_THAT(soilbin("limits " + file + " --model rft").err, HasSubstr("soilbin estimate --model rft"));
}

TEST(ResistiveForceCommand, SaysThatItHasNoRut) {
  const Scratch scratch;
  const Outcome run =
      soilbin("run '" + scratch.write("case.yaml", lugged_study(declared, ", pass: 2")).string() + "' --model rft");
  EXPECT_THAT(run.err, HasSubstr("rft ignores the pass: it has no rut"));
}

TEST(ResistiveForceCommand, TakesNoEffects) {
  const Scratch scratch;
  std::string text = lugged_study(declared);
  text.replace(text.find(", rft]"), 6, ", {model: rft, effects: [slip_sinkage]}]");
  EXPECT_THAT(soilbin("run '" + scratch.write("case.yaml", text).string() + "'"),
              Refuses(HasSubstr("takes no effects")));
}

TEST(ResistiveForceCommand, HasNoEquationsOfBekker) {
  const Scratch scratch;
  EXPECT_THAT(soilbin("explain '" + scratch.write("case.yaml", lugged_study(declared)).string() + "'"),
              Refuses(HasSubstr("leave 'rft' out")));
}

TEST(ResistiveForceCommand, StandsInAComparison) {
  const Scratch scratch;
  const Outcome run = soilbin("compare '" + scratch.write("case.yaml", lugged_study(declared)).string() + "'");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("resistive force theory"));
  EXPECT_THAT(run.out, Not(HasSubstr("no significance test"))) << "their soil values are not the same";
}

TEST(ResistiveForceCommand, PredictsSinkageAndLateralForceOfAMeasuredWheelBetterThanItsBekkerValues) {
  const auto error = [](const std::string& more) {
    const Outcome run = soilbin("predict cmu-smooth --json" + more);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json().at("error");
  };
  const auto rft = error(" --model rft"), wheel = error("");
  const auto rmse = [](const nlohmann::json& of, const char* channel) {
    return of.at(channel).at("rmse").get<double>();
  };
  EXPECT_LT(rmse(rft, "sinkage"), 0.7 * rmse(wheel, "sinkage"));
  EXPECT_LT(rmse(rft, "lateral_force"), 0.7 * rmse(wheel, "lateral_force"));
  EXPECT_LT(rmse(rft, "drawbar_pull"), 1.1 * rmse(wheel, "drawbar_pull"));
  EXPECT_GE(rft.at("sinkage").at("runs"), wheel.at("sinkage").at("runs"));
}

TEST(ResistiveForceCommand, HasItsSoilFromPlates) {
  const Scratch scratch;
  std::string rows = "test,plate_diameter_mm,sinkage_mm,pressure_kPa\n";  // 1000 kN/m^3, whatever the plate
  for (int test = 1; test <= 4; ++test)
    for (int z = 2; z <= 16; z += 2)
      rows += std::to_string(test) + (test % 2 == 1 ? ",100," : ",150,") + std::to_string(z) + "," + std::to_string(z) +
              "\n";
  const Outcome run = soilbin("plates '" + scratch.write("plates.csv", rows).string() + "' --json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(run.json().at("xi_n").at("value").get<double>(), 1e6 / 0.87504, 1.0);
  EXPECT_NEAR(run.json().at("xi_n").at("std_error").get<double>(), 0.0, 1.0);
}

}  // namespace
}  // namespace soilbin::cli::test
