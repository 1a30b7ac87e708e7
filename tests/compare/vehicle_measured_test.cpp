// A vehicle beside what was measured of the whole machine: its file, the model at the measured slips with errors, and
// NASA's points of a rover on slopes.
#include "compare/vehicle/vehicle_measured.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "bekker_wong/effect_vocabulary.hpp"
#include "bekker_wong/model.hpp"
#include "compare/report/report.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/csv.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string cases_shelf = SOILBIN_SOURCE_DIR "/cases";
const bekker_wong::BekkerWong rolling_wheel({.errors = false, .patch = false});

VehicleCase rover_on(double slope = 0.0) {
  VehicleCase rover = find_vehicle_case("rover", Library({cases_shelf}), bekker_wong::CatalogueVocabulary());
  rover.condition.slope = slope;
  return rover;
}

MeasuredVehicle measured_in(const std::string& csv) { return read_measured_vehicle({"climbs.csv", csv}); }

MeasuredAnswers beside(const VehicleCase& vehicle, const std::string& csv) {
  return beside_measured(vehicle, wheels_of(vehicle), rolling_wheel, measured_in(csv));
}

TEST(MeasuredVehicle, IsReadInItsUnits) {
  const MeasuredVehicle slopes = measured_in("slip_percent,slope_deg\n20,10\n40,15\n");
  EXPECT_EQ(slopes.channel, VehicleChannel::slope);
  EXPECT_DOUBLE_EQ(slopes.states[1].slip, 0.4);
  EXPECT_DOUBLE_EQ(slopes.states[1].value, 15 * degree);
  const MeasuredVehicle pulls = measured_in("slope [deg];drawbar_pull [kN];slip\n5;1,5;0,2\n");
  EXPECT_EQ(pulls.channel, VehicleChannel::drawbar_pull);
  EXPECT_DOUBLE_EQ(pulls.states[0].value, 1500.0);
  EXPECT_DOUBLE_EQ(pulls.states[0].slope.value(), 5 * degree);
  EXPECT_EQ(measured_in("slip,traction_angle_rad\n0.2,0.3\n").channel, VehicleChannel::traction_angle);
}

TEST(MeasuredVehicle, IsRefusedWithItsPlaceAndAHint) {
  const auto told = [](const std::string& csv) { return soilbin::test::refusal([&] { measured_in(csv); }); };
  EXPECT_THAT(told("slope_deg\n3\n"), AllOf(StartsWith("climbs.csv:1:1: no column 'slip'"), HasSubstr("hint:")));
  EXPECT_THAT(told("slip,slope_deg\n0.1,3\n43,15\n"),
              AllOf(StartsWith("climbs.csv:3:1: column 'slip': '43' is out of range"),
                    HasSubstr("a column in per cent is called 'slip_percent'")));
  EXPECT_THAT(told("slip,slope\n0.1,3\n"),
              AllOf(HasSubstr("column 'slope': expected an angle"), HasSubstr("'slope_deg'")));
  EXPECT_THAT(told("slip,slope_deg\n0.1,steep\n"),
              StartsWith("climbs.csv:2:5: column 'slope': expected a finite number"));
  EXPECT_THAT(told("slip,slope_deg\n0.1,\n"), StartsWith("climbs.csv:2:5: column 'slope': empty"));
  EXPECT_THAT(told("slip,slope_deg,test\n0.1,3,4\n"), HasSubstr("column 'test' is not read here"));
  EXPECT_THAT(told("slip,slip_percent,slope_deg\n0.1,10,3\n"), HasSubstr("a second column holds 'slip'"));
  EXPECT_THAT(told("slip\n0.1\n"), AllOf(HasSubstr("no column holds what was measured"), HasSubstr("drawbar_pull_N")));
  EXPECT_THAT(told("slip,drawbar_pull_N,traction_angle_deg\n0.1,1,1\n"), HasSubstr("two columns hold a pull"));
  EXPECT_THAT(told("slip,slope_deg\n"), HasSubstr("no row holds a measured state"));
}

// What the model says of itself is met: the slope at a slip is that on which it travels steadily with that slip.
TEST(SlowMeasuredVehicle, TheModelsOwnStateIsNotOff) {
  const VehicleCase rover = rover_on();
  const auto wheels = wheels_of(rover);
  const SteadyVehicles vehicles(rover, wheels, rolling_wheel);
  for (const double slope : {-12 * degree, 8 * degree}) {
    const double slip = vehicles.pulling({.slope = slope, .speed = rover.condition.speed}).slip;
    const MeasuredAnswers answers = beside(rover, fmt::format("slip,slope_rad\n{},{}\n", slip, slope));
    EXPECT_NEAR(answers.difference(0).value(), 0.0, 1e-10);
    EXPECT_NEAR(answers.rms, 0.0, 1e-10);
  }
}

// On the steepest slope the best slip's error is that of the steepest slope (the envelope theorem).
TEST(SlowMeasuredVehicle, HasTheErrorOfTheSlopeAndOfTheirMean) {
  const VehicleCase rover = rover_on();
  const VehicleLimit up = steepest_climb(rover, wheels_of(rover), rolling_wheel);
  const std::string row = fmt::format("{},0\n", up.slip);
  const MeasuredAnswers answers = beside(rover, "slip,slope_rad\n" + row + row);
  const Estimate& model = answers.modelled[0].value.value();
  EXPECT_NEAR(model.value, up.angle->value, 2e-6);
  EXPECT_NEAR(model.std_error, up.angle->std_error, 1e-3 * up.angle->std_error);
  EXPECT_NEAR(answers.mean.std_error, model.std_error, 1e-9) << "two states of one soil are off together";
}

TEST(MeasuredVehicle, APullIsThatOnItsSlopeAndItsAngleThatOverTheWeight) {
  const VehicleCase rover = rover_on(3 * degree);
  const auto wheels = wheels_of(rover);
  const SteadyVehicles vehicles(rover, wheels, rolling_wheel);
  const double speed = rover.condition.speed;
  const double here = vehicles.at_slip(rover.condition, 0.3).pull,
               steeper = vehicles.at_slip({.slope = 8 * degree, .speed = speed}, 0.3).pull;
  const MeasuredAnswers pulls = beside(rover, "slip,drawbar_pull_N\n0.3,10\n");
  EXPECT_DOUBLE_EQ(pulls.modelled[0].value->value, here);
  EXPECT_NEAR(pulls.difference(0).value(), here - 10.0, 1e-9);
  const MeasuredAnswers on_slopes = beside(rover, "slip,slope_deg,drawbar_pull_N\n0.3,8,10\n0.3,3,10\n");
  EXPECT_DOUBLE_EQ(on_slopes.modelled[0].value->value, steeper);
  EXPECT_TRUE(on_slopes.curve.empty());
  const MeasuredAnswers angles = beside(rover, "slip,traction_angle_deg\n0.3,10\n");
  EXPECT_DOUBLE_EQ(angles.modelled[0].value->value, std::atan(here / vehicles.weight()));
  const double share = here / vehicles.weight();
  EXPECT_NEAR(angles.modelled[0].value->std_error,
              pulls.modelled[0].value->std_error / vehicles.weight() / (1 + share * share), 1e-12);
}

TEST(SlowMeasuredVehicle, NasasRoverOnSlopesIsMetToFourDegrees) {
  // Base and height of the centre of gravity are chosen; the wheel is smooth where NASA's has grousers.
  const std::string file = cases_shelf + "/measured/nasa/nasa-mgru3-2021-grc1-slip-slope.csv";
  const VehicleCase rover = rover_on();
  const MeasuredAnswers answers = beside_measured(rover, wheels_of(rover), rolling_wheel,
                                                  read_measured_vehicle(read_source_text(file, largest_csv)));
  ASSERT_EQ(answers.answered, 6u);
  EXPECT_NEAR(answers.rms / degree, 3.82, 0.01);
  for (const std::size_t large_slip : {3u, 4u, 5u}) {
    EXPECT_GT(answers.measured.states[large_slip].slip, 0.4);
    EXPECT_LT(std::abs(answers.difference(large_slip).value()) / degree, 3.1);
  }
  for (const std::size_t small_slip : {1u, 2u}) EXPECT_NEAR(answers.difference(small_slip).value() / degree, -6, 0.6);
  EXPECT_THAT(text_of(report_on(answers)), HasSubstr("How far off: 3.8 deg (root mean square over 6 points)"));
}

TEST(MeasuredVehicle, NasasWheelIsReadAsItIs) {
  const std::string file = cases_shelf + "/measured/nasa/nasa-trec-grc3-slip-traction.csv";
  const MeasuredVehicle measured = read_measured_vehicle(read_source_text(file, largest_csv));
  EXPECT_EQ(measured.channel, VehicleChannel::traction_angle);
  EXPECT_EQ(measured.states.size(), 18u);
  EXPECT_NEAR(measured.states[0].slip, -0.002059, 1e-12);
}

}  // namespace
}  // namespace soilbin::compare
