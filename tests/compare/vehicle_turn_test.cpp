// A vehicle in a steady turn: Ackermann's radius where nothing slips aside, closed forms of a vehicle that turns by its
// sides, and on soil what must hold whatever the soil.
#include "compare/vehicle/vehicle_turn.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "bekker_wong/model.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/yawed_frames.hpp"
#include "tests/fixtures.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

/// Hard ground: pull 2 s W, torque of that at the rim; across the wheel so many times its yaw times its load.
struct GroundThatHolds final : Model {
  explicit GroundThatHolds(double times) : stiffness(times) {}
  std::string name() const override { return "ground that holds"; }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    const GroundForce force =
        turned({2.0 * at.slip * at.load, stiffness * at.yaw * at.load}, at.yaw, ForceFrame::wheel, ForceFrame::travel);
    TractionResult result;
    result.at = at;
    result.drawbar_pull.value = force.forward, result.lateral_force.value = force.left;
    result.torque.value = 2.0 * at.slip * at.load * scenario.tire.radius;
    result.contact_area = 0.01;
    return result;
  }
  double stiffness;
};

const bekker_wong::BekkerWong soft_soil({.errors = false, .patch = false});

VehicleAxle axle_that_turns(const std::string& name, double x, YesNo steered) {
  VehicleAxle made;
  made.name = name, made.x = x, made.track = 0.8, made.steered = steered;
  made.tire = soilbin::test::smooth_wheel(0.15, 0.12);
  return made;
}

/// 1.2 m between its axles, of which the front one is steered; the centre of gravity 0.5 m before the rear one.
VehicleCase steered_rover() {
  VehicleCase made;
  made.name = "rover", made.mass = 40.0, made.centre_of_gravity = {0.5, 0.0, 0.3};
  made.axles = {axle_that_turns("front", 1.2, YesNo::yes), axle_that_turns("rear", 0.0, YesNo::no)};
  made.hitch.at = {0.0, 0.0, 0.15};
  made.drive_line = DriveLine::motors;
  made.soil.name = "dry sand", made.soil.semi_empirical = soilbin::test::dry_sand();
  made.condition.speed = 0.1;
  return made;
}

VehicleCase rover_by_sides() {
  VehicleCase made = steered_rover();
  made.axles[0].steered = YesNo::no, made.drive_line = DriveLine::sides;
  return made;
}

SteadyVehicle turning(const VehicleCase& vehicle, double radius, const Model& model) {
  const auto wheels = wheels_of(vehicle);
  VehicleCondition at = vehicle.condition;
  at.curvature = 1.0 / radius;
  return SteadyVehicles(vehicle, wheels, model).pulling(at);
}

/// Where the turn of a radius of the centre of gravity has the rear axle's middle, and what steering that is.
double ackermann(double radius) { return std::atan(1.2 / std::sqrt(radius * radius - 0.5 * 0.5)); }

TEST(VehicleTurn, ItsCsvTellsAWheelOffTheGroundFromOneThatDoesNothing) {
  TurnAnswers answers{steered_rover(), wheels_of(steered_rover())};
  answers.turn = VehicleTurn{.radius = 5.0, .vehicle = turning(steered_rover(), 5.0, GroundThatHolds(1e2))};
  SteadyWheel& lifted = answers.turn->vehicle.wheels[0];
  lifted = {};
  lifted.lifted = true;
  const std::string csv = report_on(answers).csv();
  EXPECT_THAT(csv, testing::HasSubstr("sinkage_m,off_the_ground\nfront left,5,0,0,,,,,,,1\nfront right,5,"));
  EXPECT_THAT(csv, testing::EndsWith(",0\n"));
}

TEST(VehicleTurn, HasAckermannsRadiusWhereNothingSlipsAside) {
  // What is left is the yaw that holds the centrifugal force: the better the ground holds, the less.
  for (const double radius : {2.0, 5.0, 50.0}) {
    double before = HUGE_VAL;
    for (const double stiffness : {1e2, 1e4}) {
      const double off =
          std::abs(turning(steered_rover(), radius, GroundThatHolds(stiffness)).steering / ackermann(radius) - 1);
      EXPECT_LT(off, 0.05 * before) << radius;
      before = off;
    }
    EXPECT_LT(before, 1e-6) << radius;
  }
}

TEST(VehicleTurn, AllWheelsSteeredTurnAboutTheMiddle) {
  VehicleCase vehicle = steered_rover();
  vehicle.axles[1].steered = YesNo::yes, vehicle.centre_of_gravity.x = 0.6;
  const SteadyVehicle v = turning(vehicle, 3.0, GroundThatHolds(1e4));
  EXPECT_NEAR(v.steering, std::atan(0.6 / 3.0), 1e-6);
  EXPECT_NEAR(v.crab, 0.0, 1e-6);
  // Each wheel stands square to the centre, 3 m to the left.
  EXPECT_NEAR(v.wheels[0].steer, std::atan2(0.6, 3.0 - 0.4), 1e-6);
  EXPECT_NEAR(v.wheels[3].steer, -std::atan2(0.6, 3.0 + 0.4), 1e-6);
}

TEST(VehicleTurn, OfAVastRadiusIsStraightTravel) {
  for (VehicleCase vehicle : {steered_rover(), rover_by_sides()}) {
    const auto wheels = wheels_of(vehicle);
    const SteadyVehicle straight = SteadyVehicles(vehicle, wheels, soft_soil).pulling(vehicle.condition);
    const SteadyVehicle vast = turning(vehicle, 1e7, soft_soil);
    EXPECT_NEAR(vast.slip, straight.slip, 1e-6);
    EXPECT_NEAR(vast.steering, 0.0, 1e-6);
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      EXPECT_NEAR(vast.wheels[i].normal_load, straight.wheels[i].normal_load, 1e-4);
      EXPECT_NEAR(vast.wheels[i].result.torque.value, straight.wheels[i].result.torque.value, 1e-4);
    }
  }
}

TEST(VehicleTurn, BySidesStraightOnIsTheLockedDriveLineToTheBit) {
  const VehicleCase sides = rover_by_sides();
  VehicleCase locked = sides;
  locked.drive_line = DriveLine::locked;
  const auto wheels = wheels_of(sides);
  EXPECT_EQ(SteadyVehicles(sides, wheels, soft_soil).at_slip({}, 0.2).pull,
            SteadyVehicles(locked, wheels, soft_soil).at_slip({}, 0.2).pull);
}

TEST(VehicleTurn, ToTheOtherSideIsItsMirrorImage) {
  for (VehicleCase vehicle : {steered_rover(), rover_by_sides()}) {
    const SteadyVehicle left = turning(vehicle, 4.0, soft_soil), right = turning(vehicle, -4.0, soft_soil);
    EXPECT_NEAR(left.slip, right.slip, 1e-8);
    EXPECT_NEAR(left.steering, -right.steering, 1e-7);
    EXPECT_NEAR(left.crab, -right.crab, 1e-7);
    for (const auto& [one, other] : {std::pair{0u, 1u}, {1u, 0u}, {2u, 3u}, {3u, 2u}}) {
      EXPECT_NEAR(left.wheels[one].normal_load, right.wheels[other].normal_load, 1e-5);
      EXPECT_NEAR(left.wheels[one].result.at.yaw, -right.wheels[other].result.at.yaw, 1e-7);
      EXPECT_NEAR(left.wheels[one].result.lateral_force.value, -right.wheels[other].result.lateral_force.value, 1e-5);
      EXPECT_NEAR(left.wheels[one].result.torque.value, right.wheels[other].result.torque.value, 1e-5);
    }
  }
}

TEST(VehicleTurn, ForcesAndMomentsOnTheBodyCloseAboutTheCentreOfTheTurn) {
  // Along travel nothing is left, across it the soil gives m v^2/R, and no moment: from the wheels' forces in their own
  // planes, and their steering, alone.
  for (VehicleCase vehicle : {steered_rover(), rover_by_sides()}) {
    vehicle.condition.speed = 1.0;
    const auto wheels = wheels_of(vehicle);
    const double radius = 4.0, G = vehicle.mass * gravity_of(vehicle.soil);
    const SteadyVehicle v = turning(vehicle, radius, soft_soil);
    double forward = 0.0, left = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      const TractionResult& r = v.wheels[i].result;
      const GroundForce own =
          turned({r.drawbar_pull.value, r.lateral_force.value}, r.at.yaw, ForceFrame::travel, ForceFrame::wheel);
      const GroundForce on_body = turned(own, v.wheels[i].steer, ForceFrame::wheel, ForceFrame::travel);
      forward += on_body.forward, left += on_body.left;
      moment += (wheels[i].place.x - 0.5) * on_body.left - wheels[i].place.y * on_body.forward;
    }
    const double across = 40.0 * 1.0 / radius;
    EXPECT_NEAR(forward * std::cos(v.crab) - left * std::sin(v.crab), 0.0, 1e-6 * G);
    EXPECT_NEAR(forward * std::sin(v.crab) + left * std::cos(v.crab), across, 1e-6 * G);
    EXPECT_NEAR(moment, 0.0, 1e-4 * G) << "but for what the tilt by sinkage adds";
    const VehiclePower& p = v.power;
    EXPECT_NEAR(p.into_wheels, p.slip_loss + p.soil_loss, 1e-4 * p.into_wheels) << "and to its work";
  }
}

TEST(VehicleTurn, BySidesTheOuterWheelsTurnAsMuchFasterAsTheAxlesResist) {
  // Yaw of the wheels -x/R, against them k x/R of the load; 2 (d - b/R) W b brings it round: d = (b + k x^2/2b)/R with
  // x half the wheelbase, b half the track, d of the rims over their mean. To first order in 1/R.
  VehicleCase vehicle = rover_by_sides();
  vehicle.centre_of_gravity = {0.6, 0.0, 0.0}, vehicle.condition.speed = 1e-3, vehicle.hitch.at = {0.6, 0.0, 0.0};
  const double radius = 500.0, b = 0.4, x = 0.6, k = 0.7;
  const SteadyVehicle v = turning(vehicle, radius, GroundThatHolds(k));
  const double left = v.wheels[0].rim_speed, right = v.wheels[1].rim_speed;
  const double unlike = (b + k * x * x / (2 * b)) / radius;
  EXPECT_NEAR((right - left) / (right + left), unlike, 0.02 * unlike);
}

/// By its sides, its weight in the middle: 0.6 m from its axles, 0.4 m from its wheels, low enough to load all alike.
VehicleCase rover_in_balance() {
  VehicleCase vehicle = rover_by_sides();
  vehicle.centre_of_gravity = {0.6, 0.0, 0.0}, vehicle.hitch.at = {0.6, 0.0, 0.0};
  return vehicle;
}

VehicleTurn on_the_spot(const VehicleCase& vehicle, const Model& model) {
  return turn_of(vehicle, wheels_of(vehicle), model, {.radius = 0.0, .steer = {}}).turn.value();
}

TEST(VehicleTurn, OnTheSpotTheWheelsTurnItAgainstWhatHoldsThemAcross) {
  // Each wheel travels at atan(0.6/0.4) to its plane: k times that of its load across it, at 0.6 m, against 2 s of it
  // along it, at 0.4 m.
  const double k = 0.05, yaw = std::atan(0.6 / 0.4), slip = k * yaw * 0.6 / (2.0 * 0.4);
  const VehicleTurn turn = on_the_spot(rover_in_balance(), GroundThatHolds(k));
  EXPECT_EQ(turn.radius, 0.0);
  EXPECT_NEAR(turn.widest, std::hypot(0.6, 0.4), 1e-9);
  EXPECT_NEAR(turn.rate, 0.1 / 0.4, 1e-9);
  EXPECT_NEAR(turn.vehicle.slip, slip, 1e-9);
  for (const SteadyWheel& wheel : turn.vehicle.wheels) {
    EXPECT_NEAR(std::abs(wheel.result.at.yaw), yaw, 1e-9);
    EXPECT_NEAR(wheel.steer, 0.0, 1e-9);
    EXPECT_NEAR(wheel.result.at.slip, slip, 1e-9);
  }
  EXPECT_TRUE(turn.vehicle.wheels[0].backward) << "to the left, the left side backward";
  EXPECT_FALSE(turn.vehicle.wheels[1].backward);
}

/// The rover in balance, on soft soil: turned once for all tests.
const VehicleTurn& turned_on_soft_soil() {
  static const VehicleTurn turn = on_the_spot(rover_in_balance(), soft_soil);
  return turn;
}

TEST(VehicleTurn, OnTheSpotEachWheelIsTheWheelAloneAcrossItsTravel) {
  // Of four wheels alike one says it all: its force along its plane at 0.4 m is that across it at 0.6 m.
  const VehicleCase vehicle = rover_in_balance();
  const VehicleTurn& turn = turned_on_soft_soil();
  const auto wheels = wheels_of(vehicle);
  const double load = vehicle.mass * gravity_of(vehicle.soil) / 4;
  OperatingCondition at{.load = load, .slip = turn.vehicle.slip, .speed = 0.1 * std::hypot(0.6, 0.4) / 0.4};
  at.yaw = -std::atan(0.6 / 0.4);
  const TractionResult alone = soft_soil.evaluate(wheels[1].scenario, at);
  const GroundForce own =
      turned({alone.drawbar_pull.value, alone.lateral_force.value}, at.yaw, ForceFrame::travel, ForceFrame::wheel);
  EXPECT_NEAR(own.forward * 0.4, own.left * -0.6, 2e-3 * load) << "but for what torques and tilt shift of the loads";
  EXPECT_NEAR(turn.vehicle.wheels[1].result.torque.value, alone.torque.value, 0.02 * alone.torque.value);
}

TEST(VehicleTurn, OnTheSpotItsHalvesAreOneAnotherTurnedRound) {
  const VehicleTurn& turn = turned_on_soft_soil();
  const auto& wheels = turn.vehicle.wheels;
  for (const auto& [one, other] : {std::pair{0u, 3u}, {1u, 2u}}) {
    EXPECT_NEAR(wheels[one].normal_load, wheels[other].normal_load, 1e-5);
    EXPECT_NEAR(wheels[one].result.torque.value, wheels[other].result.torque.value, 1e-5);
    EXPECT_NEAR(wheels[one].result.lateral_force.value, wheels[other].result.lateral_force.value, 1e-5);
  }
  const VehiclePower& power = turn.vehicle.power;
  EXPECT_GT(power.into_wheels, 0.0);
  EXPECT_NEAR(power.into_wheels, power.slip_loss + power.soil_loss, 1e-4 * power.into_wheels);
}

TEST(SlowVehicleTurn, OnTheSpotForcesAndMomentsCloseWithItsWeightBehindTheMiddle) {
  const VehicleCase vehicle = rover_by_sides();
  const auto wheels = wheels_of(vehicle);
  const VehicleTurn turn = on_the_spot(vehicle, soft_soil);
  const double G = vehicle.mass * gravity_of(vehicle.soil);
  double forward = 0.0, left = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const TractionResult& r = turn.vehicle.wheels[i].result;
    const GroundForce own =
        turned({r.drawbar_pull.value, r.lateral_force.value}, r.at.yaw, ForceFrame::travel, ForceFrame::wheel);
    const double way = turn.vehicle.wheels[i].backward ? -1.0 : 1.0;
    forward += way * own.forward, left += way * own.left;
    moment += way * (wheels[i].place.x * own.left - wheels[i].place.y * own.forward);
  }
  EXPECT_NEAR(forward, 0.0, 1e-6 * G);
  EXPECT_NEAR(left, 0.0, 1e-6 * G);
  EXPECT_NEAR(moment, 0.0, 1e-3 * G) << "but for what the tilt by sinkage adds";
}

TEST(SlowVehicleTurn, OnTheSpotItStaysWhereTheSoilHoldsItsWheelsAcrossMoreThanTheyDrive) {
  VehicleCase vehicle = rover_in_balance();  // k at atan(0.6/0.4) and 0.6 m beats 2 at 0.4 m
  const TurnAnswers held = turn_of(vehicle, wheels_of(vehicle), GroundThatHolds(2.0), {.radius = 0.0, .steer = {}});
  ASSERT_FALSE(held.turn);
  EXPECT_EQ(held.why_not->limit, TurnLimit::balance);
  EXPECT_EQ(held.why_not->failure.why, GaveOut::pull);
  vehicle.power = 0.5 * on_the_spot(vehicle, soft_soil).vehicle.power.into_wheels;
  const TurnAnswers weak = turn_of(vehicle, wheels_of(vehicle), soft_soil, {.radius = 0.0, .steer = {}});
  EXPECT_EQ(weak.why_not->motors, TravelLimit::power);
}

TEST(VehicleTurn, TheTightestEndsAtTheSteeringsStop) {
  VehicleCase vehicle = steered_rover();
  vehicle.axles[0].largest_steer = 0.5;
  const TurnAnswers stop = turn_of(vehicle, wheels_of(vehicle), GroundThatHolds(1e4));
  EXPECT_EQ(stop.end.limit, TurnLimit::steering);
  EXPECT_NEAR(stop.tightest->radius, std::hypot(1.2 / std::tan(0.5), 0.5), 1e-4);
  // Its outermost wheel is the right front one: 1.2 m before the centre's line, 0.4 m to the right.
  EXPECT_NEAR(stop.tightest->widest, std::hypot(1.2, 1.2 / std::tan(0.5) + 0.4), 1e-4);
  const TurnAnswers asked = turn_of(vehicle, wheels_of(vehicle), GroundThatHolds(1e4), {.radius = {}, .steer = -0.3});
  EXPECT_NEAR(asked.turn->vehicle.steering, -0.3, 1e-5);
  EXPECT_NEAR(asked.turn->radius, -std::hypot(1.2 / std::tan(0.3), 0.5), 1e-3);
  const TurnAnswers beyond = turn_of(vehicle, wheels_of(vehicle), GroundThatHolds(1e4), {.radius = 1.0, .steer = {}});
  EXPECT_FALSE(beyond.turn);
  EXPECT_EQ(beyond.why_not->limit, TurnLimit::steering);
}

TEST(SlowVehicleTurn, OnSandSidesResistAndTheMotorMayGiveOutFirst) {
  VehicleCase vehicle = rover_by_sides();
  const auto wheels = wheels_of(vehicle);
  const TurnAnswers strong = turn_of(vehicle, wheels, soft_soil);
  ASSERT_TRUE(strong.tightest);
  EXPECT_EQ(strong.end.limit, TurnLimit::balance);
  EXPECT_GT(strong.tightest->vehicle.power.into_wheels, strong.ever_tighter.front().vehicle.power.into_wheels);
  vehicle.power =
      0.5 * (strong.tightest->vehicle.power.into_wheels + strong.ever_tighter.front().vehicle.power.into_wheels);
  const TurnAnswers weak = turn_of(vehicle, wheels, soft_soil);
  EXPECT_EQ(weak.end.limit, TurnLimit::motors);
  EXPECT_EQ(weak.end.motors, TravelLimit::power);
  EXPECT_GT(weak.tightest->radius, strong.tightest->radius);
  EXPECT_NEAR(weak.tightest->vehicle.power.into_wheels, *vehicle.power, 1e-3 * *vehicle.power);
}

TEST(VehicleTurn, SaysWhatItNeedsToTurn) {
  const auto told = [](const VehicleCase& vehicle) -> std::string {
    return soilbin::test::error_of([&] { turn_of(vehicle, wheels_of(vehicle), soft_soil); });
  };
  VehicleCase locked = rover_by_sides();
  locked.drive_line = DriveLine::locked;
  EXPECT_THAT(told(locked), HasSubstr("no axle is steered"));
  VehicleCase uphill = steered_rover();
  uphill.condition.slope = 0.1;
  EXPECT_THAT(told(uphill), HasSubstr("level ground"));
  EXPECT_THAT(soilbin::test::error_of([&] {
                const VehicleCase steered = steered_rover();
                turn_of(steered, wheels_of(steered), soft_soil, {.radius = 0.0, .steer = {}});
              }),
              HasSubstr("a steered axle does not turn it on the spot"));
  VehicleCase one = steered_rover();
  one.axles.pop_back();
  EXPECT_THAT(told(one), HasSubstr("one axle alone"));
}

}  // namespace
}  // namespace soilbin::compare
