// How fast a vehicle goes and how steep it climbs by the torque curve of its motor: closed forms on ground that needs
// all but no slip.
#include "compare/vehicle/vehicle_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/model.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

constexpr double resists = 0.1;  // rolling resistance over the load
constexpr double radius = 0.3;   // [m]

/// Ground that grips up to 0.8 of the load at all but no slip, and resists by a tenth of the load.
struct FirmGround final : Model {
  std::string name() const override { return "firm ground"; }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    const double up = at.load * std::cos(at.longitudinal_incline), thrust = 0.8 * std::tanh(1e6 * at.slip) * up;
    TractionResult result;
    result.at = at;
    result.torque.value = thrust * scenario.tire.radius;
    result.drawbar_pull.value = thrust - resists * up - at.load * std::sin(at.longitudinal_incline);
    result.contact_area = 0.01;
    return result;
  }
};

const FirmGround firm;

VehicleAxle axle_with_wheels(const std::string& name, double x) {
  VehicleAxle made;
  made.name = name, made.x = x, made.track = 0.8, made.tire = soilbin::test::smooth_wheel(radius, 0.2);
  return made;
}

/// 200 N m at rest, falling to none at 300 rad/s, through a gear of 10 of which 80 % arrive.
GearedMotor falling_motor(double share = 1.0) { return {{{0.0, 200.0 * share}, {300.0, 0.0}}, 10.0, 0.8}; }

VehicleCase cart() {
  VehicleCase made;
  made.name = "cart", made.mass = 400.0, made.centre_of_gravity = {0.7, 0.0, 0.4};
  made.axles = {axle_with_wheels("front", 1.2), axle_with_wheels("rear", 0.0)};
  made.hitch.at = {-0.2, 0.0, 0.3};
  made.soil.name = "dry sand", made.soil.semi_empirical = soilbin::test::dry_sand();
  made.condition.speed = 1.0;
  return made;
}

double weight_of(const VehicleCase& vehicle) { return vehicle.mass * gravity_of(vehicle.soil); }

/// Where eta i T(i v/r) = r R: T falls from 200 N m at rest to none at 300 rad/s.
double crossing(double resistance) {
  return radius * 300.0 / 10.0 * (1.0 - radius * resistance / (0.8 * 10.0 * 200.0));
}

FastestTravel fastest(const VehicleCase& vehicle) {
  return fastest_travel(vehicle, wheels_of(vehicle), firm, vehicle.condition);
}

TEST(VehicleSpeed, IsWhereTorqueCurveAndResistanceCross) {
  VehicleCase vehicle = cart();
  vehicle.motor = falling_motor();
  const double G = weight_of(vehicle);
  for (const double slope : {0.0, 0.1, 0.3}) {
    vehicle.condition.slope = slope;
    const FastestTravel found = fastest(vehicle);
    EXPECT_NEAR(found.speed->value, crossing(G * (std::sin(slope) + resists * std::cos(slope))), 1e-5) << slope;
    EXPECT_EQ(found.limit, TravelLimit::torque);
  }
  vehicle.condition.slope = 0.0, vehicle.condition.pull = 500.0;
  EXPECT_NEAR(fastest(vehicle).speed->value, crossing(resists * G + 500.0), 1e-5);
}

TEST(VehicleSpeed, OfAMotorAWheelIsWhereTheirTorquesTogetherCrossIt) {
  // The loads differ, so that a motor comes to its limit before the others: these take what it leaves.
  VehicleCase vehicle = cart();
  vehicle.drive_line = DriveLine::motors;
  for (VehicleAxle& axle : vehicle.axles) axle.motor = falling_motor(0.25);
  for (const double slope : {0.0, 0.2}) {
    vehicle.condition.slope = slope;
    const double speed = crossing(weight_of(vehicle) * (std::sin(slope) + resists * std::cos(slope)));
    EXPECT_NEAR(fastest(vehicle).speed->value, speed, 1e-3 * speed) << slope;
    EXPECT_EQ(fastest(vehicle).limit, TravelLimit::torque);
  }
}

TEST(VehicleSpeed, EndsWhereTheMotorTurnsNoFaster) {
  VehicleCase vehicle = cart();
  vehicle.motor = GearedMotor{{{0.0, 200.0}, {100.0, 200.0}}, 10.0, 1.0};
  EXPECT_NEAR(fastest(vehicle).speed->value, 100.0 / 10.0 * radius, 1e-5);
  EXPECT_EQ(fastest(vehicle).limit, TravelLimit::speed);
}

TEST(VehicleSpeed, OfAPowerAloneIsTheSameBitsWhateverTheTorque) {
  VehicleCase vehicle = cart();
  vehicle.power = 2000.0;
  const double by_power = fastest(vehicle).speed->value;
  EXPECT_NEAR(by_power, 2000.0 / (resists * weight_of(vehicle)), 1e-4);
  EXPECT_EQ(fastest(vehicle).limit, TravelLimit::power);
  vehicle.motor = GearedMotor{{{0.0, 1e6}, {1e6, 1e6}}, 10.0, 1.0};
  EXPECT_EQ(fastest(vehicle).speed->value, by_power);
  EXPECT_EQ(fastest(vehicle).limit, TravelLimit::power);
}

TEST(VehicleSpeed, ThereIsNoneWhereTheMotorStalls) {
  VehicleCase vehicle = cart();
  vehicle.motor = falling_motor(0.4);
  vehicle.condition.pull = 0.4 * 0.8 * 10.0 * 200.0 / radius;
  EXPECT_EQ(fastest(vehicle).speed->value, 0.0);
  EXPECT_EQ(fastest(vehicle).limit, TravelLimit::torque);
}

TEST(SlowVehicleSpeed, TheSteepestSlopeAtASpeedIsTheTorqueCurvesThere) {
  // eta i T(i v/r) = r G (sin(a) + f cos(a)).
  VehicleCase vehicle = cart();
  vehicle.condition.speed = 6.0;
  const double torque = 0.8 * 10.0 * 200.0 * (1.0 - 6.0 / radius * 10.0 / 300.0);
  const double share = torque / (radius * weight_of(vehicle));
  const double slope = std::asin(share / std::hypot(1.0, resists)) - std::atan(resists);
  for (const DriveLine line : {DriveLine::locked, DriveLine::motors}) {
    vehicle.drive_line = line, vehicle.motor.reset();
    if (line == DriveLine::locked) vehicle.motor = falling_motor();
    if (line == DriveLine::motors)
      for (VehicleAxle& axle : vehicle.axles) axle.motor = falling_motor(0.25);
    const VehicleAnswers answers = answers_of(vehicle, wheels_of(vehicle), firm);
    ASSERT_TRUE(answers.gradeability->angle);
    EXPECT_NEAR(answers.gradeability->angle->value, slope, 1e-4);
    EXPECT_EQ(answers.gradeability->limit, TravelLimit::torque);
    EXPECT_TRUE(answers.holds_speed());
  }
}

// Motors of a largest torque and more power than it takes: at a speed too the slope ends by the torque, where
// sin(slope) + 0.1 cos(slope) of the weight is all that they push with.
TEST(VehicleSpeed, TheSteepestSlopeAtASpeedEndsByALargestTorqueAsTheSteepestDoes) {
  VehicleCase vehicle = cart();
  vehicle.drive_line = DriveLine::motors, vehicle.power = 1e6;
  for (VehicleAxle& axle : vehicle.axles) axle.largest_torque = 80.0;
  const VehicleAnswers answers = answers_of(vehicle, wheels_of(vehicle), firm);
  const double slope =
      std::asin(4 * 80.0 / radius / weight_of(vehicle) / std::hypot(1.0, resists)) - std::atan(resists);
  ASSERT_TRUE(answers.gradeability && answers.gradeability->angle);
  EXPECT_NEAR(answers.gradeability->angle->value, slope, 1e-4);
  EXPECT_EQ(answers.up.beyond.why, GaveOut::torque);
  EXPECT_EQ(answers.gradeability->limit, TravelLimit::torque);
}

TEST(VehicleSpeed, OneTooSlowForItsTorqueCurveIsNotHeldThoughAFasterOneIs) {
  // T rises from 25 N m at 10 rad/s to 100 at 100: at 0.3 m/s the motor gives 25, at 3 m/s 100.
  VehicleCase vehicle = cart();
  vehicle.motor = GearedMotor{{{10.0, 25.0}, {100.0, 100.0}}, 10.0, 1.0};
  vehicle.condition.pull = 50.0 * 10.0 / radius - resists * weight_of(vehicle);  // takes 50 N m
  vehicle.condition.speed = 0.3;
  const VehicleAnswers slow = answers_of(vehicle, wheels_of(vehicle), firm);
  EXPECT_EQ(slow.not_held, TravelLimit::torque);
  EXPECT_NEAR(slow.fastest->speed->value, 3.0, 1e-4);
  vehicle.condition.speed = 1.3;  // 50 N m from 40 rad/s on: 1.2 m/s
  EXPECT_TRUE(answers_of(vehicle, wheels_of(vehicle), firm).holds_speed());
}

TEST(SlowVehicleSpeed, IsLimitedByTheSoilWhereTheMotorsHaveMoreThanItTakes) {
  VehicleCase vehicle = cart();
  vehicle.motor = GearedMotor{{{0.0, 1e4}, {1e3, 1e4}}, 10.0, 1.0};
  const VehicleAnswers firmly = answers_of(vehicle, wheels_of(vehicle), firm);
  EXPECT_EQ(firmly.gradeability->limit, TravelLimit::soil);
  EXPECT_EQ(firmly.gradeability->angle->value, firmly.up.angle->value);
  EXPECT_NEAR(firmly.up.angle->value, std::atan(0.8 - resists), 1e-5);
  // On sand the pull grows up to 100 % of slip, at which no rim turns fast enough.
  vehicle.mass = 40.0, vehicle.condition.speed = 0.1;
  const bekker_wong::BekkerWong soft({.errors = false, .patch = false});
  const VehicleAnswers softly = answers_of(vehicle, wheels_of(vehicle), soft);
  EXPECT_EQ(softly.gradeability->limit, TravelLimit::speed);
  EXPECT_NEAR(softly.gradeability->angle->value, softly.up.angle->value, 1e-3);
  EXPECT_EQ(softly.fastest->limit, TravelLimit::speed);
  EXPECT_GT(softly.fastest->speed->std_error, 0.0) << "by the slip";
}

TEST(GearedMotor, GivesItsCurveThroughItsGear) {
  const GearedMotor motor{{{100.0, 500.0}, {200.0, 700.0}, {300.0, 400.0}}, 20.0, 0.9};
  EXPECT_DOUBLE_EQ(torque_at_wheels(motor, 7.5), 0.9 * 20.0 * 600.0);
  EXPECT_DOUBLE_EQ(torque_at_wheels(motor, 0.0), 0.9 * 20.0 * 500.0) << "below the curve as at its start";
  EXPECT_DOUBLE_EQ(top_spin(motor), 15.0);
  EXPECT_DOUBLE_EQ(*fastest_spin(motor, 0.9 * 20.0 * 550.0, HUGE_VAL), 12.5);
  EXPECT_DOUBLE_EQ(*fastest_spin(motor, 0.9 * 20.0 * 550.0, 9.0), 9.0);
  EXPECT_FALSE(fastest_spin(motor, 0.9 * 20.0 * 650.0, 6.0)) << "it gives so much from 8.75 rad/s on";
}

}  // namespace
}  // namespace soilbin::compare
