// soilbin element-test, run as a person runs it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ElementTestCommand, RefusesWhatMakesNoSenseWithAHint) {
  struct {
    const char* arguments;
    const char* says;
  } const wrong[] = {
      {"element-test direct-sheer paper-sand", "did you mean 'direct-shear'"},
      {"element-test direct-shear papr-sand", "did you mean 'paper-sand'"},
      {"element-test direct-shear dry-sand",
       "has no grains: the model dem and virtual tests need its section 'granular'"},
      {"element-test direct-shear paper-sand --stress 20", "kPa"},
      {"element-test direct-shear paper-sand --size 0.1", "--size"},
      {"element-test direct-shear paper-sand --settling-friction lose", "did you mean 'loose'"},
      {"element-test direct-shear paper-sand --settling-friction 2", "--settling-friction"},
      {"element-test direct-shear paper-sand --rolling directionl", "did you mean 'directional'"},
      {"element-test plate paper-sand --plate 190mm", "--plate 190mm is narrower than 5 grains"},
      {"element-test plate paper-sand --plate 300", "no unit"},
      {"element-test plate paper-sand --plate-sinkage 0mm", "--plate-sinkage"},
      {"element-test repose paper-sand --curves a.csv",
       "the test repose takes no --curves\n  hint: triaxial, plate do"},
      {"element-test plate paper-sand --curves a.csv --tests TX1", "plates are chosen by --only COLUMN=VALUE"},
      {"element-test triaxial paper-sand --curves a.csv --only bed=1", "chosen by --tests NAME,NAME"},
      {"element-test plate paper-sand --curves a.csv --plate 300mm", "--plate has no effect beside --curves"},
      {"calibrate paper-sand --test plate", "which plates?\n  hint: --curves plates.csv"},
      {"calibrate paper-sand --test plate --curves a.csv --features volume", "--features has no effect on plates"},
      {"element-test repose paper-sand --plate 300mm", "the test repose takes no --plate\n  hint: plate does"},
      {"element-test plate paper-sand --stress 10kPa", "hint: direct-shear, triaxial, shear do"},
      {"element-test shear paper-sand --packings 0", "--packings"},
  };
  for (const auto& [arguments, says] : wrong) EXPECT_THAT(soilbin(arguments), Refuses(HasSubstr(says))) << arguments;
}

// The directional couple hangs on the step: said of a test that is asked for it, and of a soil's file.
TEST(SlowElementTestCommand, WarnsOfALawWhoseAnswersDependOnTheStep) {
  constexpr const char* said = "answers depend on the time step";
  const std::string test = "element-test tilting-board paper-sand --size 0.5 --packings 1 --threads 1";
  EXPECT_THAT(soilbin(test + " --rolling directional").err, HasSubstr(said));
  EXPECT_THAT(soilbin(test).err, Not(HasSubstr(said)));
  const Scratch scratch;
  const std::string soil = R"(format: soilbin-soil/1
name: turned
granular:
  radius_min: 5 mm
  radius_max: 7 mm
  grain_density: 2500 kg/m^3
  youngs_modulus: 5 MPa
  poisson_ratio: 0.25
  rolling_resistance: directional
  grain_grain: {restitution: 0.5, sliding_friction: 0.6, rolling_friction: 0.2}
  grain_tire: {restitution: 0.5, sliding_friction: 0.7, rolling_friction: 0.2}
)";
  EXPECT_THAT(soilbin("check '" + scratch.write("soil.yaml", soil).string() + "'").out, HasSubstr(said));
}

/// Grains of 40 mm without cohesion, as a soil file; the softer, the longer their time step.
std::string dry_grains(const char* youngs_modulus) {
  return fmt::format(R"(format: soilbin-soil/1
name: dry-grains
granular:
  radius_min: 15 mm
  radius_max: 25 mm
  grain_density: 2650 kg/m^3
  youngs_modulus: {}
  poisson_ratio: 0.25
  grain_grain: {{restitution: 0.5, sliding_friction: 0.6, rolling_friction: 0.3}}
  grain_tire: {{restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1}}
)",
                     youngs_modulus);
}

// The board's angle is the mean of its packings, with their scatter over the root of their number.
TEST(SlowElementTestCommand, GivesTheMeanOverPackingsWithTheirScatter) {
  const Scratch scratch;
  const std::string soil = scratch.write("soil.yaml", dry_grains("10 MPa")).string();
  const std::string board = "element-test tilting-board '" + soil + "' --size 0.5 --threads 1 --json";
  const auto three = soilbin(board + " --packings 3").json();
  ASSERT_EQ(three.at("runs").size(), 3U);
  std::vector<double> onsets;
  for (int packing = 1; packing <= 3; ++packing) {
    const auto one = soilbin(fmt::format("{} --packings 1 --packing {}", board, packing)).json();
    onsets.push_back(one.at("onset"));
    EXPECT_EQ(one.at("onset_error"), 0.0);
    EXPECT_EQ(three.at("runs").at(static_cast<std::size_t>(packing - 1)).at("onset"), onsets.back());
  }
  const double mean = (onsets[0] + onsets[1] + onsets[2]) / 3;
  double squares = 0;
  for (const double onset : onsets) squares += (onset - mean) * (onset - mean);
  EXPECT_NEAR(three.at("onset").get<double>(), mean, 1e-12);
  EXPECT_NEAR(three.at("onset_error").get<double>(), std::sqrt(squares / 2 / 3), 1e-12);
  EXPECT_EQ(soilbin(board).json(), three) << "three where none are asked for";
}

TEST(SlowElementTestCommand, EveryTestTakesPackings) {
  const Scratch scratch;
  const std::string soil = scratch.write("soil.yaml", dry_grains("10 MPa")).string();
  for (const std::string& test : {std::string("plate paper-sand --size 0.8 --plate 200mm --plate-sinkage 40mm"),
                                  "shear '" + soil + "' --size 0.76 --stress 10kPa"}) {
    const auto two = soilbin(fmt::format("element-test {} --threads 1 --json --packings 2", test));
    ASSERT_EQ(two.status, 0) << two.err;
    const auto first = two.json().at("at_end").at(0);
    EXPECT_EQ(first.at("packings"), 2);
    const char* what = first.contains("pressure") ? "pressure" : "shear_stress";
    EXPECT_GT(first.at(what).at("std_error").get<double>(), 0.0);
  }
}

// These grains are steep, and still a heap of half the default size is told to be too low to be believed.
TEST(SlowElementTestCommand, TellsOfAHeapThatIsTooLow) {
  const Scratch scratch;
  const std::string soil = scratch.write("dry-grains.yaml", dry_grains("50 MPa")).string();
  const Outcome low = soilbin("element-test repose '" + soil + "' --size 0.5 --packings 1 --threads 1");
  EXPECT_THAT(low.out, HasSubstr("The heap is lower than 6 grains: its slope comes out too small"));
  EXPECT_THAT(low.out, HasSubstr("packings differ by more (--packings 3)"));
}

// Paper sand stands as it was poured: 3.63 kPa bear a wall of more than half a metre.
TEST(SlowElementTestCommand, SaysThatCohesiveGrainsHaveNoSlopeOfRepose) {
  const Outcome stands = soilbin("element-test repose paper-sand --size 0.5 --packings 1 --threads 1");
  EXPECT_EQ(stands.status, 1);
  EXPECT_THAT(stands.err, HasSubstr("its grains' cohesion holds up its wall"));
}

TEST(SlowElementTestCommand, ShowsInDegreesWhatItsJsonHoldsAsARatio) {
  const std::string box = "element-test direct-shear paper-sand --size 0.4 --stress 20kPa --threads 1";
  const Outcome table = soilbin(box), json = soilbin(box + " --json");
  ASSERT_EQ(table.status, 0) << table.err;
  ASSERT_EQ(json.status, 0) << json.err;
  const double peak = json.json().at("runs").at(0).at("peak_ratio").at("value");
  std::istringstream lines(table.out);
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("stress")) continue;
  std::getline(lines, line);  // the row below the names
  std::istringstream row(line);
  double stress = 0, packing = 0, void_ratio = 0, shown = 0;
  row >> stress >> packing >> void_ratio >> shown;
  EXPECT_EQ(stress, 20);
  EXPECT_NEAR(shown, std::atan(peak) * 180 / std::numbers::pi, 0.1) << line;
}

TEST(SlowElementTestCommand, SaysWhereTheStressWasNotHeld) {
  const std::string cell = "element-test triaxial paper-sand --size 0.5 --stress 20kPa --threads 1";
  EXPECT_THAT(soilbin(cell).out, Not(HasSubstr("not to 1 %")));
  EXPECT_THAT(soilbin(cell + " --inertial 0.05").out,
              HasSubstr("The confining stress of 20.00 kPa (specimen 1) was held to "));
}

TEST(SlowElementTestCommand, PressesPlatesOfTheSizeThatIsGiven) {
  const std::string plates = "element-test plate paper-sand --size 0.5 --threads 1 --json";
  const Outcome in_grains = soilbin(plates);  // 5, 7 and 9 of 40 mm, to a sinkage of 2
  const Outcome in_metres = soilbin(plates + " --plate 200mm,280mm --plate 360mm --plate-sinkage 80mm");
  ASSERT_EQ(in_grains.status, 0) << in_grains.err;
  EXPECT_EQ(in_metres.out, in_grains.out);
}

}  // namespace
}  // namespace soilbin::cli::test
