// soilbin vehicle: a vehicle of the library as text and JSON, one that does not travel, and what checks its file.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <string>

#include "scenario/unit.hpp"
#include "tests/cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string rover = "rover";

TEST(VehicleCommand, TellsWhatTheRoverDoes) {
  const Outcome run = soilbin("vehicle " + rover);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("It travels: The drive line slips by"), HasSubstr("Steepest slopes: Up "),
                             HasSubstr("front left"), HasSubstr("ground pressure"), HasSubstr("Add multipass"),
                             HasSubstr("The pull acts on the ground, at x = 0 and y = 0")));
}

TEST(VehicleCommand, SaysWhyAndWhereItDoesNotTravel) {
  const Outcome steep = soilbin("vehicle " + rover + " --slope 40deg --json");
  EXPECT_EQ(steep.status, 1);
  EXPECT_THAT(steep.err, HasSubstr("does not travel"));
  const auto answer = steep.json();
  EXPECT_EQ(answer.at("format"), "soilbin-vehicle-answer/1");
  EXPECT_TRUE(answer.at("steady").is_null());
  EXPECT_EQ(answer.at("failure").at("why"), "pull");
  EXPECT_GT(answer.at("steepest").at("up").at("slope").at("value").get<double>(), 0.3);
}

// Where it does not travel on the level there is no steepest slope, or one that it travels on, and just beyond not.
TEST(SlowVehicleCommand, TheSteepestSlopeIsOneThatItTravels) {
  const nlohmann::json wet = soilbin("vehicle truck --soil sandy-loam-wet --json").json()["steepest"];
  for (const char* way : {"up", "down"}) EXPECT_TRUE(wet[way]["slope"].is_null()) << way;
  const double up = soilbin("vehicle truck --soil heavy-clay --json").json()["steepest"]["up"]["slope"]["value"];
  EXPECT_LT(up, 0);
  for (const double beside : {-0.005, 0.005}) {
    const std::string at =
        fmt::format("vehicle truck --soil heavy-clay --json --slope={:.6f}deg", (up + beside) / degree);
    EXPECT_EQ(!soilbin(at).json()["steady"].is_null(), beside < 0) << at;
  }
}

TEST(SlowVehicleCommand, TakesTheDensityOfASoilWithBeds) {
  const auto sinkage = [](const std::string& density) {
    const auto answer = soilbin("vehicle " + rover + " --soil cullinan-sand --density " + density + " --json").json();
    return answer.at("steady").at("wheels").at(0).at("sinkage").at("value").get<double>();
  };
  EXPECT_GT(sinkage("1390kg/m^3"), sinkage("1450kg/m^3"));
  EXPECT_THAT(soilbin("vehicle " + rover + " --density 1450kg/m^3"),
              Refuses(HasSubstr("has values at one density alone")));
}

TEST(VehicleCommand, GivesEveryWheelsNumbersInJson) {
  const auto answer = soilbin("vehicle " + rover + " --soil dry-sand --pull 20N --json").json();
  const auto& steady = answer.at("steady");
  EXPECT_NEAR(steady.at("pull").get<double>(), 20.0, 1e-6);
  double pull = 0.0, load = 0.0;
  for (const auto& wheel : steady.at("wheels")) {
    pull += wheel.at("drawbar_pull").at("value").get<double>(), load += wheel.at("load").get<double>();
    EXPECT_GT(wheel.at("ground_pressure").get<double>(), 0.0);
  }
  EXPECT_NEAR(pull, 20.0, 1e-6);
  EXPECT_NEAR(load, 73.4 * 9.80665, 1e-6);
}

TEST(SlowVehicleCommand, SavesTheChanceToGo) {
  const Scratch scratch;
  const std::string file = (scratch / "map.csv").string();
  const Outcome run = soilbin("vehicle " + rover + " --samples 2 --map '" + file + "' --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto map = run.json().at("map");
  EXPECT_EQ(map.at("samples"), 2);
  EXPECT_GE(map.at("chance")[0][0].at("value").get<double>(), map.at("chance")[7][0].at("value").get<double>());
  EXPECT_THAT(text_of(file), testing::StartsWith("slope_deg,heading_deg,chance,chance_se\n0,0,"));
  EXPECT_EQ(soilbin("vehicle " + rover + " --samples 4").status, 2);
  const std::string picture = (scratch / "map.png").string();
  ASSERT_EQ(soilbin("vehicle " + rover + " --samples 1 --map '" + picture + "'").status, 0);
  EXPECT_THAT(text_of(picture), testing::StartsWith("\x89PNG"));
}

const std::string climbing_rover = R"(format: soilbin-vehicle-case/1
name: climber
mass: 73.4 kg
centre_of_gravity: {x: 0.6 m, z: 0.6 m}
axles:
  - {name: front, x: 1.2 m, track: 1.3 m, tire: {name: wheel, radius: 250 mm, width: 200 mm}}
  - {name: rear, x: 0 m, track: 1.3 m, tire: {name: wheel, radius: 250 mm, width: 200 mm}}
soil: grc-1
drive:
  duration: 60 s
  controller: {rim_speed: 0.2 m/s}
  profile:
    - {at: 1 m}
    - {at: 4 m, longitudinal_incline: 35 deg}
)";

// By the error of its soil, then by what grains show under heavy tires: the verdict itself says that it is open.
TEST(SlowVehicleCommand, SaysWhatIsNotDecidedInItsVerdict) {
  const Outcome by_error = soilbin("vehicle truck --soil clayey-soil");
  EXPECT_EQ(by_error.status, 1);
  EXPECT_THAT(by_error.out,
              AllOf(HasSubstr("\nNot decided: It climbs -0.1 ± 1.7 deg, and 0 deg are asked: --map gives"),
                    HasSubstr("\nAs computed it does not travel: ")));
  EXPECT_THAT(by_error.err, HasSubstr("soilbin: does not travel (not decided): "));
  const Outcome level = soilbin("vehicle truck --soil dry-sand");
  EXPECT_THAT(level.out, AllOf(HasSubstr("\nIt travels: "), testing::Not(HasSubstr("Not decided"))));
  const auto on_level = soilbin("vehicle truck --soil dry-sand --json").json();
  EXPECT_TRUE(on_level.at("not_decided").is_null());
  const double climbs = on_level.at("steepest").at("up").at("slope").at("value");
  const std::string steep = fmt::format("vehicle truck --soil dry-sand --slope {}deg", 0.9 * climbs / degree);
  EXPECT_THAT(soilbin(steep).out,
              AllOf(HasSubstr("Not decided: "), HasSubstr("With what grains show under heavy tires on sand it climbs "),
                    HasSubstr("\nAs computed it travels: ")));
  const auto open = soilbin(steep + " --json").json().at("not_decided");
  EXPECT_LT(open.at("steepest_as_in_grains"), 0.9 * climbs);
  EXPECT_EQ(open.at("steepest").at("value"), climbs) << "its error reaches that slope, too";
}

TEST(VehicleCommand, StopsAtCtrlC) {
  const Scratch scratch;  // a map of minutes
  const Outcome r = soilbin("vehicle tractor --map '" + (scratch / "map.csv").string() + "' --samples 500",
                            "timeout --preserve-status -s INT 2 ");
  EXPECT_EQ(r.status, 130);
  EXPECT_EQ(r.out, "");
  EXPECT_THAT(r.err, HasSubstr("soilbin: stopped"));
}

TEST(SlowVehicleCommand, DrivesItInTimeUntilItIsStuck) {
  const Scratch scratch;
  const std::string file = "'" + scratch.write("climber.yaml", climbing_rover).string() + "'";
  const Outcome run = soilbin("vehicle " + file + " --drive");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("It is stuck: After"), HasSubstr("What gave out: The wheels spin"),
                             HasSubstr("Steadily: It climbs up to 23."), HasSubstr("unaccounted for")));
  const auto answer = soilbin("vehicle " + file + " --drive --json").json();
  EXPECT_EQ(answer.at("format"), "soilbin-vehicle-drive/1");
  EXPECT_EQ(answer.at("end"), "stuck");
  EXPECT_EQ(answer.at("gave_out"), "front");
  EXPECT_EQ(answer.at("axles").at(1).at("sinkage_m").size(), answer.at("samples").at("time_s").size());
  EXPECT_THAT(soilbin("vehicle " + file + " --drive --slope 5deg"),
              Refuses(HasSubstr("--slope has no effect: the file's drive has a profile of its own")));
}

TEST(VehicleCommand, SaysInTimeThatTheSoilDoesNotHoldIt) {
  const Outcome run = soilbin("vehicle " + rover + " --drive --slope 45deg --json");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("does not stand at its start"));
  EXPECT_TRUE(run.json().at("end").is_null());
}

TEST(SlowVehicleCommand, SaysThatThePowerDoesNotHoldTheSpeed) {
  const Outcome fast = soilbin("vehicle truck --speed 100km/h --json");
  EXPECT_EQ(fast.status, 1);
  EXPECT_THAT(fast.err, HasSubstr("it does not hold 27.8 m/s: too little power"));
  EXPECT_FALSE(fast.json().at("holds_speed").get<bool>());
  EXPECT_TRUE(soilbin("vehicle truck --json").json().at("holds_speed").get<bool>());
}

const std::string cart_with_motor = R"(format: soilbin-vehicle-case/1
name: cart
mass: 73.4 kg
centre_of_gravity: {x: 0.6 m, z: 0.6 m}
motor:
  torque_curve: [{speed: 0 rpm, torque: 20 N m}, {speed: 60 rpm, torque: 5 N m}]
  gear_ratio: 3
  efficiency: 90 %
axles:
  - {name: front, x: 1.2 m, track: 1.3 m, tire: {name: wheel, radius: 250 mm, width: 200 mm}}
  - {name: rear, x: 0 m, track: 1.3 m, tire: {name: wheel, radius: 250 mm, width: 200 mm}}
soil: grc-1
condition: {speed: 0.1 m/s}
)";

TEST(SlowVehicleCommand, SaysHowFastAndHowSteepItsMotorLetsItGo) {
  const Scratch scratch;
  const std::string file = "'" + scratch.write("cart.yaml", cart_with_motor).string() + "'";
  const Outcome run = soilbin("vehicle " + file);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("Fastest: "), HasSubstr("m/s: the motors give no more torque."),
                             HasSubstr("Climbs at its speed: "), HasSubstr("Speed on slopes")));
  const auto answer = soilbin("vehicle " + file + " --json").json();
  EXPECT_EQ(answer.at("fastest").at("limit"), "torque");
  EXPECT_EQ(answer.at("gradeability").at("limit"), "torque");
  const auto& climbs = answer.at("climbs");
  ASSERT_GE(climbs.size(), 3u);
  EXPECT_GT(climbs[0].at("speed").at("value").get<double>(), climbs[1].at("speed").at("value").get<double>());
  const Outcome fast = soilbin("vehicle " + file + " --speed 0.47m/s");
  EXPECT_EQ(fast.status, 1);
  EXPECT_THAT(fast.err, HasSubstr("it does not hold 0.470 m/s: the motors give no more torque"));
}

TEST(SlowVehicleCommand, TellsTheTightestTurnAndWhatEndsIt) {
  const Outcome run = soilbin("vehicle truck --turn");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("It turns: Radius "), HasSubstr("A tighter one: the steered wheels turn no further."),
                    HasSubstr("slip angle"), HasSubstr("Add sidewall_bulldozing")));
  const auto answer = soilbin("vehicle truck --turn --radius -20m --json").json();
  EXPECT_EQ(answer.at("format"), "soilbin-vehicle-turn/1");
  EXPECT_LT(answer.at("turn").at("steering").get<double>(), 0.0);
  EXPECT_EQ(answer.at("turn").at("wheels").size(), 4u);
  EXPECT_EQ(answer.at("end").at("limit"), "steering");
  const Outcome tight = soilbin("vehicle truck --turn --radius 3m");
  EXPECT_EQ(tight.status, 1);
  EXPECT_THAT(tight.err, HasSubstr("does not turn so: "));
}

TEST(SlowVehicleCommand, TurnsOnTheSpotByItsSides) {
  const Scratch scratch;
  const std::string file = "'" + scratch.write("skid.yaml", "drive_line: sides\n" + climbing_rover).string() + "'";
  const Outcome run = soilbin("vehicle " + file + " --turn --radius 0m");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("It turns: On the spot, "), HasSubstr(" J a full turn."), HasSubstr("backward")));
  const auto turn = soilbin("vehicle " + file + " --turn --radius 0m --json").json().at("turn");
  EXPECT_EQ(turn.at("radius").get<double>(), 0.0);
  EXPECT_TRUE(turn.at("wheels").at(0).at("backward").get<bool>());
}

TEST(VehicleCommand, RefusesATurnThatIsNone) {
  const auto told = [](const std::string& flags) {
    const Outcome run = soilbin("vehicle truck " + flags);
    EXPECT_EQ(run.status, 2) << flags;
    return run.err;
  };
  EXPECT_THAT(told("--turn --slope 5deg"), HasSubstr("on a slope no turn is steady"));
  EXPECT_THAT(told("--radius 5m"), HasSubstr("--turn"));
  EXPECT_THAT(told("--turn --radius 5deg"), HasSubstr("--radius"));
  EXPECT_THAT(told("--turn --radius 0m"), HasSubstr("a steered axle does not turn it on the spot"));
  EXPECT_THAT(told("--turn --drive"), HasSubstr("--turn"));
}

TEST(VehicleCommand, StandsBesideWhatWasMeasured) {
  const Scratch scratch;
  const std::string file = scratch.write("climbs.csv", "slip_percent,slope_deg\n20,5\n60,20\n").string();
  const Outcome run = soilbin("vehicle " + rover + " --measured '" + file + "'");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("beside 2 points of"), HasSubstr("root mean square over 2 points"),
                             HasSubstr("over its standard error")));
  const auto answer = soilbin("vehicle " + rover + " --measured '" + file + "' --json").json();
  EXPECT_EQ(answer.at("format"), "soilbin-vehicle-measured/1");
  EXPECT_EQ(answer.at("channel"), "slope");
  const auto& point = answer.at("points").at(0);
  EXPECT_DOUBLE_EQ(point.at("difference").get<double>(),
                   point.at("model").at("value").get<double>() - point.at("measured").get<double>());
  EXPECT_THAT(soilbin("vehicle " + rover + " --measured '" + file + "' --slope 5deg"),
              Refuses(HasSubstr("--slope has no effect: the measured file has the slopes")));
  const std::string bad = scratch.write("bad.csv", "slip,slope\n0.2,5\n").string();
  EXPECT_THAT(soilbin("vehicle " + rover + " --measured '" + bad + "'"),
              Refuses(AllOf(HasSubstr("bad.csv:1:6"), HasSubstr("hint: such as 'slope_deg'"))));
}

TEST(VehicleCommand, RefusesAMotorThatItCannotRead) {
  const Scratch scratch;
  const auto told = [&](const std::string& from, const std::string& to) {
    std::string text = cart_with_motor;
    text.replace(text.find(from), from.size(), to);
    const Outcome run = soilbin("vehicle '" + scratch.write("bad.yaml", text).string() + "'");
    EXPECT_EQ(run.status, 2);
    return run.err;
  };
  EXPECT_THAT(told("speed: 60 rpm", "speed: 0 rpm"),
              AllOf(HasSubstr("bad.yaml:6"), HasSubstr("the speeds of the torque_curve don't rise")));
  EXPECT_THAT(told("speed: 60 rpm", "speed: 60"), AllOf(HasSubstr("bad.yaml:6"), HasSubstr("rpm")));
  EXPECT_THAT(told("torque_curve", "torque"), AllOf(HasSubstr("bad.yaml:6"), HasSubstr("torque_curve")));
  EXPECT_THAT(told("motor:", "drive_line: motors\nmotor:"), HasSubstr("give 'motor' to the axles"));
}

TEST(SlowVehicleCommand, FlagsOfTheMachineAreAFileThatSaysTheSame) {
  const Scratch scratch;
  const std::string file = scratch
                               .write("heavy.yaml", R"(format: soilbin-vehicle-case/1
name: heavy
mass: 90 kg
centre_of_gravity: {x: 0.5 m, z: 0.8 m}
drive_line: sides
power: 50 W
axles:
  - {name: front, x: 1.2 m, track: 1.3 m, steered: yes, tire: {name: rover 0.5 m, radius: 250 mm, width: 200 mm, inflation_pressure: 20 kPa}}
  - {name: rear, x: 0 m, track: 1.3 m, tire: {name: rover 0.5 m, radius: 250 mm, width: 200 mm, inflation_pressure: 20 kPa}}
soil: grc-1
effects: [{id: slip_sinkage, form: lyasko, parameters: {a: 0.5}}]
condition: {speed: 0.1 m/s, slope: 2 deg}
)")
                               .string();
  const auto as_file = soilbin("vehicle '" + file + "' --json").json();
  const auto as_flags = soilbin(
                            "vehicle rover --mass 90kg --centre-of-gravity-x 0.5m --centre-of-gravity-z 0.8m "
                            "--drive-line sides --power 50W --slope 2deg --inflation-pressure 20kPa "
                            "--effect slip_sinkage:lyasko,a=0.5 --json")
                            .json();
  for (const char* key : {"condition", "steady", "steepest", "pulls", "speed_at_largest_power"})
    EXPECT_EQ(as_flags.at(key), as_file.at(key)) << key;
  EXPECT_EQ(as_flags.at("vehicle"), "rover, changed");
}

TEST(SlowVehicleCommand, TakesASoilsValuesByFlags) {
  const auto weaker = soilbin("vehicle " + rover + " --friction-angle 25+-0deg --json").json();
  const auto declared = soilbin("vehicle " + rover + " --json").json();
  const auto up = [](const auto& answer) { return answer.at("steepest").at("up").at("slope"); };
  EXPECT_LT(up(weaker).at("value").template get<double>(), up(declared).at("value").template get<double>());
  EXPECT_EQ(weaker.at("soil").get<std::string>(), declared.at("soil").get<std::string>() + ", changed");
}

TEST(VehicleCommand, RefusesFlagsThatContradictItsFile) {
  const auto told = [](const std::string& flags) {
    const Outcome run = soilbin("vehicle rover " + flags);
    EXPECT_EQ(run.status, 2) << flags;
    return run.err;
  };
  EXPECT_THAT(told("--driven frnt"),
              HasSubstr("no axle is called 'frnt', did you mean 'front'?\n  hint: there are front, rear"));
  EXPECT_THAT(told("--drive-line lockd"), HasSubstr("did you mean 'locked'?"));
  EXPECT_THAT(told("--mass 0kg"), HasSubstr("--mass"));
  EXPECT_THAT(told("--inflation-pressure 20kPa --rigid"),
              HasSubstr("--rigid: a rigid wheel has no inflation pressure"));
  EXPECT_THAT(told("--effect none --effect multipass"), HasSubstr("--effect none excludes all others"));
}

// As estimate has them: "none" leaves out what the tires declare, "declared" only what the file says.
TEST(VehicleCommand, EffectsGoOffByName) {
  const auto slip = [](const std::string& flags) {
    return soilbin("vehicle truck --soil sandy-loam --json " + flags)
        .json()
        .at("steady")
        .at("slip")
        .at("value")
        .get<double>();
  };
  const double declared = slip("--effect declared"), none = slip("--effect none");
  EXPECT_NE(declared, slip("")) << "the truck's file has multipass";
  EXPECT_NE(declared, none);
  EXPECT_EQ(none, slip("--effect none --rigid --no-lugs")) << "of tires it keeps size and place";
}

TEST(VehicleCommand, ItsFileIsChecked) {
  EXPECT_THAT(soilbin("check " + rover).out, HasSubstr("valid: vehicle 'rover': 2 axles on"));
  const Scratch scratch;
  const std::string file = scratch.write("bad.yaml", "format: soilbin-vehicle-case/1\nname: x\nmas: 3 kg\n").string();
  EXPECT_THAT(soilbin("vehicle '" + file + "'"), Refuses(AllOf(HasSubstr("bad.yaml:3"), HasSubstr("mass"))));
}

}  // namespace
}  // namespace soilbin::cli::test
