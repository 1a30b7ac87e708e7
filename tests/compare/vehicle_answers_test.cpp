// What a vehicle can do at best, with errors; its file.

#include "compare/vehicle/vehicle_answers.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effect_vocabulary.hpp"
#include "bekker_wong/model.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/report/report.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/telling/reports.hpp"
#include "compare/vehicle/vehicle_doubts.hpp"
#include "compare/vehicle/vehicle_errors.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

const std::string cases_folder = SOILBIN_SOURCE_DIR "/cases";
const bekker_wong::BekkerWong wheel_model({.errors = false, .patch = false});

VehicleCase vehicle_of(const std::string& text) {
  return parse_vehicle_case({cases_folder + "/vehicles/here.yaml", text}, Library({cases_folder}),
                            bekker_wong::CatalogueVocabulary());
}

VehicleCase library_vehicle(const std::string& name) {
  return find_vehicle_case(name, Library({cases_folder}), bekker_wong::CatalogueVocabulary());
}

const std::string one_wheel = R"(format: soilbin-vehicle-case/1
name: one wheel
mass: 6.6 kg
centre_of_gravity: {x: 0 m, z: 0.2 m}
axles:
  - {name: wheel, x: 0 m, tire: rover-wheel}
soil: dry-sand
)";

std::string message_of(const std::string& text) {
  return soilbin::test::error_of([&] { vehicle_of(text); });
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = one_wheel;
  return text.replace(text.find(from), from.size(), to);
}

TEST(VehicleFile, IsRefusedWithItsPlaceAndTheRightWord) {
  EXPECT_THAT(message_of(changed("mass: 6.6 kg", "mass: 6.6")),
              testing::AllOf(HasSubstr("here.yaml:3"), HasSubstr("mass")));
  EXPECT_THAT(message_of(changed("tire: rover-wheel", "tyre: rover-wheel")), HasSubstr("tire"));
  EXPECT_THAT(message_of(changed("tire: rover-wheel", "tire: rover-wheal")), HasSubstr("rover-wheel"));
  EXPECT_THAT(message_of(changed("tire: rover-wheel", "driven: no, tire: rover-wheel")),
              HasSubstr("no axle is driven"));
  EXPECT_THAT(message_of(changed("tire: rover-wheel", "largest_torque: 3 N m, tire: rover-wheel")),
              HasSubstr("motors"));
  EXPECT_THAT(message_of(changed("soil: dry-sand", "soil: nakanishi-sand")), HasSubstr("semi_empirical"));
  EXPECT_THAT(message_of(one_wheel + "drive_line: open\n"), HasSubstr("open_axles"));
}

TEST(VehicleFile, RefusesDifferentialsThatItsDriveLineDoesNotHave) {
  const auto two_axles = [](const std::string& vehicle, const std::string& rear) {
    return message_of(changed("  - {name: wheel, x: 0 m, tire: rover-wheel}\n",
                              "  - {name: front, x: 1 m, track: 0.8 m, tire: rover-wheel}\n"
                              "  - {name: rear, x: 0 m, track: 0.8 m, tire: rover-wheel" +
                                  rear + "}\n" + vehicle));
  };
  using testing::AllOf;
  EXPECT_EQ(two_axles("centre_differential: open\n", ", differential: open, torque_share: 2"), "");
  EXPECT_THAT(two_axles("drive_line: motors\n", ", differential: open"),
              AllOf(HasSubstr("here.yaml:7:5"), HasSubstr("'motors'"), HasSubstr("no differentials"),
                    HasSubstr("'differential' of axle 'rear'")));
  EXPECT_THAT(two_axles("drive_line: sides\ncentre_differential: locked\n", ""),
              AllOf(HasSubstr("here.yaml:9:22"), HasSubstr("'sides'"), HasSubstr("'centre_differential'")));
  EXPECT_THAT(two_axles("centre_differential: open\n", ", driven: no"),
              AllOf(HasSubstr("here.yaml:8:22"), HasSubstr("between two driven axles, and 1 is driven")));
  EXPECT_THAT(two_axles("centre_differential: opened\n", ""), AllOf(HasSubstr("here.yaml:8"), HasSubstr("'open'")));
  EXPECT_THAT(two_axles("", ", driven: no, differential: open"),
              HasSubstr("'rear' has a differential and is not driven"));
  EXPECT_THAT(two_axles("", ", torque_share: 2"), HasSubstr("'centre_differential: open' of the vehicle"));
  EXPECT_THAT(message_of(changed("tire: rover-wheel", "differential: open, tire: rover-wheel")),
              AllOf(HasSubstr("here.yaml:6:5"), HasSubstr("one wheel")));
}

TEST(VehicleFile, OfTheLibraryIsRead) {
  for (const char* name : {"truck", "tractor", "rover"}) {
    const VehicleCase vehicle = library_vehicle(name);
    EXPECT_EQ(vehicle.name, name);
    EXPECT_EQ(wheels_of(vehicle).size(), 4u);
  }
  // 40 % of the tractor's weight stands on its front axle: 1.06 m of 2.65 m.
  EXPECT_NEAR(library_vehicle("tractor").centre_of_gravity.x / 2.65, 0.40, 1e-12);
}

TEST(VehicleAnswers, OfOneWheelAreThoseOfLimits) {
  const VehicleCase vehicle = vehicle_of(one_wheel);
  const auto wheels = wheels_of(vehicle);
  const VehicleLimit up = steepest_slopes(vehicle, wheels, wheel_model)[0];
  const double load = SteadyVehicles(vehicle, wheels, wheel_model).weight();
  const auto alone = steepest_slope(wheels[0].scenario, {.load = load, .speed = 1.0});
  ASSERT_TRUE(up.angle && alone);
  EXPECT_NEAR(up.angle->value, alone->value, 2e-6);
  EXPECT_NEAR(up.angle->std_error, alone->std_error, 1e-2 * alone->std_error);
  EXPECT_EQ(up.beyond.why, GaveOut::pull);
}

TEST(VehicleAnswers, HaveTheErrorsOfTheWheelsThatPullTogether) {
  // The errors of four wheels on one soil are one error: the pull's is four times that of a wheel.
  VehicleCase vehicle = vehicle_of(one_wheel);
  const auto one = wheels_of(vehicle);
  const Estimate alone =
      bekker_wong::BekkerWong({.errors = true, .patch = false})
          .evaluate(one[0].scenario,
                    {.load = SteadyVehicles(vehicle, one, wheel_model).weight(), .slip = 0.3, .speed = 1.0})
          .drawbar_pull;
  const VehicleAnswers answers = answers_of(vehicle, one, wheel_model);
  for (const VehiclePullRow& row : answers.pulls)
    if (row.slip == 0.3) {
      EXPECT_NEAR(row.vehicle->pull, alone.value, 1e-9);
      EXPECT_NEAR(row.pull_error, alone.std_error, 1e-3 * alone.std_error);
    }
  ASSERT_TRUE(answers.steady);
  EXPECT_NEAR(answers.steady->pull, 0.0, 1e-9);
  EXPECT_GT(answers.errors.slip, 0.0);
}

TEST(SlowVehicleAnswers, AHighNarrowVehicleTipsOverAcross) {
  VehicleCase vehicle = library_vehicle("rover");
  vehicle.centre_of_gravity.z =
      3.0;  // over half a track of 0.65 m; crabbed, less of the weight pulls across, and sunk on one side it leans
  const auto wheels = wheels_of(vehicle);
  const VehicleLimit across = steepest_slopes(vehicle, wheels, wheel_model)[2];
  ASSERT_TRUE(across.angle);
  EXPECT_EQ(across.beyond.why, GaveOut::tips_over);
  const SteadyVehicle last = SteadyVehicles(vehicle, wheels, wheel_model)
                                 .at_slip({.cross_slope = across.angle->value, .speed = 0.1}, across.slip);
  EXPECT_NEAR(across.angle->value, std::atan(0.65 / (3.0 * std::cos(last.crab))) + last.left_down, 0.2 * degree);
}

TEST(VehicleAnswers, ThePowerTellsTheSpeed) {
  VehicleCase vehicle = library_vehicle("rover");
  const auto wheels = wheels_of(vehicle);
  vehicle.power = 20.0;
  const VehicleAnswers answers = answers_of(vehicle, wheels, wheel_model);
  ASSERT_TRUE(answers.steady && answers.power_speed);
  vehicle.condition.speed = *answers.power_speed;
  EXPECT_NEAR(SteadyVehicles(vehicle, wheels, wheel_model).pulling(vehicle.condition).power.into_wheels, 20.0, 1e-6);
  EXPECT_TRUE(answers.holds_speed());
}

TEST(VehicleAnswers, WithTooLittlePowerItDoesNotHoldItsSpeed) {
  VehicleCase vehicle = library_vehicle("rover");
  vehicle.power = 1.0;
  const VehicleAnswers answers = answers_of(vehicle, wheels_of(vehicle), wheel_model);
  ASSERT_TRUE(answers.steady);
  EXPECT_LT(*answers.power_speed, vehicle.condition.speed);
  EXPECT_FALSE(answers.holds_speed());
  const Report report = report_on(answers);
  EXPECT_EQ(report.no_answer, "it does not hold 0.100 m/s: too little power");
  EXPECT_THAT(text_of(report),
              testing::AllOf(HasSubstr("It does not hold 0.100 m/s: That takes "),
                             HasSubstr("and 1.00 W reach them, enough for "), testing::Not(HasSubstr("It travels"))));
}

// Both sides of the rover roll alike: one curve an axle, of a colour that the pull has not.
TEST(SlowVehicleAnswers, WheelsThatSinkAlikeAreOneCurve) {
  VehicleCase vehicle = library_vehicle("rover");
  const auto labels = [&] {
    const VehicleAnswers answers = answers_of(vehicle, wheels_of(vehicle), wheel_model);
    const Sheet sheet = report_on(answers).sheet();
    std::vector<std::string> all;
    for (const Series& series : sheet.plots[1].series) {
      all.push_back(series.label);
      EXPECT_NE(series.color, sheet.plots[0].series[0].color);
    }
    return all;
  };
  EXPECT_THAT(labels(), testing::ElementsAre("front", "rear"));
  vehicle.centre_of_gravity.y = 0.1;
  EXPECT_THAT(labels(), testing::ElementsAre("front left", "front right", "rear left", "rear right"));
}

/// With soil values moved by a standard error.
bool ends_otherwise(const DrivenAnswers& answers) {
  return std::ranges::any_of(answers.moved, [&](const MovedVehicleDrive& one) {
    return one.lower.end != answers.record->end || one.higher.end != answers.record->end;
  });
}

// At 26 deg the rover is stuck after some millimetres; with more friction it travels. What lies between is no error.
TEST(SlowVehicleAnswers, ADriveThatOtherSoilsEndOtherwiseHasNoError) {
  VehicleCase vehicle = library_vehicle("rover");
  vehicle.condition.slope = 26 * degree;
  const DrivenAnswers stuck = driven_answers(vehicle, wheels_of(vehicle), wheel_model, 4);
  ASSERT_TRUE(ends_otherwise(stuck));
  EXPECT_FALSE(stuck.travelled_error || stuck.end_time_error);
}

TEST(VehicleAnswers, ADriveThatOtherSoilsEndAlikeHasAnError) {
  VehicleCase vehicle = library_vehicle("rover");
  vehicle.drive.duration = 4.0;
  const DrivenAnswers level = driven_answers(vehicle, wheels_of(vehicle), wheel_model, 4);
  ASSERT_FALSE(ends_otherwise(level));
  EXPECT_GT(level.travelled_error.value(), 0.0);
}

TEST(VehicleAnswers, ADriveErrsWithTheSoilThatItIsDrivenOn) {
  VehicleCase on_sand = library_vehicle("rover");
  on_sand.soil = find_soil("dry-sand", Library({cases_folder}));
  on_sand.condition.slope = 14 * degree, on_sand.drive.duration = 1.5;
  VehicleCase led_there = on_sand;
  led_there.soil = find_soil("grc-1", Library({cases_folder}));
  led_there.drive.profile.resize(1);
  led_there.drive.profile[0].soil = on_sand.soil, led_there.drive.profile[0].longitudinal_incline = 14 * degree;
  const double expected = driven_answers(on_sand, wheels_of(on_sand), wheel_model, 2).travelled_error.value();
  const DrivenAnswers there = driven_answers(led_there, wheels_of(led_there), wheel_model, 2);
  ASSERT_GT(expected, 0.0);
  EXPECT_NEAR(there.travelled_error.value(), expected, 1e-3 * expected);
  EXPECT_TRUE(std::ranges::any_of(
      there.moved, [](const MovedVehicleDrive& one) { return one.title == "friction angle of dry-sand"; }));
  EXPECT_THAT(report_on(there).heading, HasSubstr("on dry-sand"));
  EXPECT_THAT(report_on(there).heading, testing::Not(HasSubstr("grc-1")));
}

/// Carcasses of 50 and 250 kPa, each to 10 kPa, under tires of these names.
VehicleCase with_two_carcasses(const std::string& front, const std::string& rear) {
  const auto axle = [](const std::string& name, double x, const std::string& tire, int carcass) {
    return fmt::format(
        "  - {{name: {}, x: {} m, track: 2.05 m, tire: {{{}radius: 0.6 m, width: 0.4 m, inflation_pressure: 200 kPa, "
        "carcass_pressure: {{value: {} kPa, sd: 10 kPa, source: chosen}}}}}}\n",
        name, x, tire.empty() ? "" : "name: " + tire + ", ", carcass);
  };
  return vehicle_of(
      "format: soilbin-vehicle-case/1\nname: two\nmass: 11 t\ncentre_of_gravity: {x: 2.4 m, z: 1.4 m}\naxles:\n" +
      axle("front", 4.5, front, 50) + axle("rear", 0.0, rear, 250) + "soil: sandy-loam\n");
}

TEST(VehicleAnswers, TiresOfOneNameAreOneOnlyWhereTheyAreAlike) {
  const auto error_of_power = [](const VehicleCase& vehicle) {
    std::vector<VehicleWheel> wheels = wheels_of(vehicle);
    declare_tires(wheels);
    EXPECT_EQ(doubtful_carcasses(wheels).size(), 2U);
    return errors_of_steady(vehicle, wheels, wheel_model, vehicle.condition).into_wheels;
  };
  const double expected = error_of_power(with_two_carcasses("a", "b"));
  EXPECT_EQ(error_of_power(with_two_carcasses("same", "same")), expected);
  EXPECT_EQ(error_of_power(with_two_carcasses("", "")), expected);
  std::vector<VehicleWheel> wheels = wheels_of(with_two_carcasses("same", "same"));
  EXPECT_EQ(declare_tires(wheels).size(), 2U) << "both are taken as flexible, each at its pressure";
  EXPECT_EQ(doubtful_carcasses(wheels)[1].title, "carcass pressure of the tire rear left");
}

// The rover's weight is in the middle of 1.2 m by 1.3 m and 0.6 m high: it would tip over across at atan(0.65/0.6).
TEST(VehicleDoubts, AWeightThatIsNotOverItsWheelsIsTold) {
  VehicleCase vehicle = library_vehicle("rover");
  EXPECT_THAT(doubts(vehicle), testing::IsEmpty());
  vehicle.centre_of_gravity.x = 1.5;
  EXPECT_THAT(doubts(vehicle), testing::ElementsAre(test::tells(DoubtKind::beyond_wheels, {0.3, "ahead"})));
  vehicle.centre_of_gravity = {0.6, -0.75, 0.6};
  EXPECT_THAT(doubts(vehicle), testing::ElementsAre(test::tells(DoubtKind::beyond_wheels, {0.1, "to the right"})));
  vehicle.centre_of_gravity = {0.6, 0.15, 6.0};
  EXPECT_THAT(doubts(vehicle),
              testing::ElementsAre(test::tells(DoubtKind::tips_easily, {6.0, 0.5, std::atan(0.5 / 6.0) / degree, 15})));
}

// A quarter of the rover's weight is 180 N: 3.6 kPa over a radius of 0.25 m and a width of 0.2 m.
TEST(VehicleDoubts, ALoadThatNoSuchWheelCarriesIsTold) {
  VehicleCase vehicle = library_vehicle("rover");
  vehicle.mass = 0.734;
  EXPECT_THAT(doubts(vehicle),
              testing::ElementsAre(test::tells(DoubtKind::unusual_wheel_load, {"front", 1.8, 0.036, 0.5, 500})));
  VehicleCase truck = library_vehicle("truck");
  EXPECT_THAT(doubts(truck), testing::IsEmpty());
  truck.mass *= 10;
  EXPECT_THAT(doubts(truck), testing::ElementsAre(test::tells(DoubtKind::unusual_wheel_load, {"front"})))
      << "at 450 kPa";
}

TEST(VehicleDoubts, NoVehicleOfTheLibraryHasOne) {
  for (const std::string& name : Library({cases_folder}).names(Shelf::vehicles))
    EXPECT_THAT(doubts(library_vehicle(name)), testing::IsEmpty()) << name;
}

TEST(GoMap, HasSlopeAndCrossSlopeOfEachHeading) {
  const double S = 0.3;
  EXPECT_NEAR(heading_on({}, S, 0.0).slope, S, 1e-12);
  EXPECT_EQ(heading_on({}, S, 0.0).cross_slope, 0.0);
  const VehicleCondition across = heading_on({}, S, 90 * degree);  // to the right of straight up: the left side is up
  EXPECT_NEAR(across.slope, 0.0, 1e-12);
  EXPECT_NEAR(across.cross_slope, S, 1e-12);
  EXPECT_NEAR(heading_on({}, S, 180 * degree).slope, -S, 1e-12);
  // Whatever the heading, the share of the weight on the ground is cos(S).
  const VehicleCondition at = heading_on({}, S, 0.7);
  EXPECT_NEAR(std::cos(at.slope) * std::cos(at.cross_slope), std::cos(S), 1e-12);
}

TEST(GoMap, OfAnExactSoilIsYesOrNo) {
  VehicleCase vehicle = vehicle_of(one_wheel);
  for (const SoilParameter& p : soil_parameters) ((*vehicle.soil.semi_empirical).*p.value).std_error = 0.0;
  const auto wheels = wheels_of(vehicle);
  const double steepest = steepest_slopes(vehicle, wheels, wheel_model)[0].angle->value;
  const GoMap map =
      go_map(vehicle, wheels, wheel_model, {.slopes = {0.0, steepest - 1e-4, steepest + 1e-4}, .headings = {0.0}});
  EXPECT_EQ(map.samples, 1);
  EXPECT_EQ(map.cells[0][0].chance, 1.0);
  EXPECT_EQ(map.cells[1][0].chance, 1.0);
  EXPECT_EQ(map.cells[2][0].chance, 0.0);
}

TEST(GoMap, IsEvenAtTheSteepestSlopeAndFirstOrderNearBy) {
  // One value with a small standard deviation: normal about the steepest slope, by its standard error.
  VehicleCase vehicle = vehicle_of(one_wheel);
  for (const SoilParameter& p : soil_parameters) ((*vehicle.soil.semi_empirical).*p.value).std_error = 0.0;
  vehicle.soil.semi_empirical->friction_angle.std_error = 0.5 * degree;
  const auto wheels = wheels_of(vehicle);
  const Estimate steepest = *steepest_slopes(vehicle, wheels, wheel_model)[0].angle;
  const GoMap map =
      go_map(vehicle, wheels, wheel_model,
             {.slopes = {steepest.value - steepest.std_error, steepest.value, steepest.value + steepest.std_error},
              .headings = {0.0}});
  EXPECT_NEAR(map.cells[0][0].chance, 0.84, 0.03);  // a Latin hypercube of one value has one in each fiftieth
  EXPECT_NEAR(map.cells[1][0].chance, 0.50, 0.03);
  EXPECT_NEAR(map.cells[2][0].chance, 0.16, 0.03);
}

}  // namespace
}  // namespace soilbin::compare
