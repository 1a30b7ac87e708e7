// A vehicle on soil: its statics by closed forms on ground that is hard, and on soil what must hold whatever the soil.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <utility>

#include "bekker_wong/effect_vocabulary.hpp"
#include "bekker_wong/model.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/vehicle/steady_vehicle.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

/// Ground on which nothing sinks: pull 2 s W, torque of that at the rim; across the wheel twice the yaw.
struct HardGround final : Model {
  std::string name() const override { return "hard ground"; }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    const double up = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
    const double forward = 2.0 * at.slip * up, left = 2.0 * at.yaw * up;
    const double c = std::cos(at.yaw), s = std::sin(at.yaw);
    TractionResult result;
    result.at = at;
    result.drawbar_pull.value = forward * c - left * s - at.load * std::sin(at.longitudinal_incline);
    result.lateral_force.value =
        forward * s + left * c - at.load * std::cos(at.longitudinal_incline) * std::sin(at.transverse_incline);
    result.torque.value = forward * scenario.tire.radius;
    result.contact_area = 0.01;
    return result;
  }
};

Tire wheel_of_a_rover() { return soilbin::test::smooth_wheel(0.15, 0.12); }

VehicleAxle axle(const std::string& name, double x) {
  VehicleAxle made;
  made.name = name, made.x = x, made.track = 0.8, made.tire = wheel_of_a_rover();
  return made;
}

/// 1.2 m between its axles, the centre of gravity 0.5 m before the rear one and 0.4 m high.
VehicleCase rover() {
  VehicleCase made;
  made.name = "rover", made.mass = 40.0, made.centre_of_gravity = {0.5, 0.0, 0.4};
  made.axles = {axle("front", 1.2), axle("rear", 0.0)};
  made.hitch.at = {-0.2, 0.0, 0.3};
  made.soil.name = "dry sand", made.soil.semi_empirical = soilbin::test::dry_sand();
  return made;
}

const HardGround hard;
const bekker_wong::BekkerWong soft({.errors = false, .patch = false});

double load_of(const SteadyVehicle& vehicle, std::initializer_list<std::size_t> wheels) {
  double sum = 0.0;
  for (const std::size_t i : wheels) sum += vehicle.wheels[i].normal_load;
  return sum;
}

TEST(VehicleStatics, AreTheTextbooksOfTwoAxles) {
  // Moments about the rear wheels' ground: N_f L = G cos(a) l_r - G sin(a) h - D h_d.
  const VehicleCase question = rover();
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, hard);
  const double G = vehicles.weight();
  for (const double slope : {0.0, 0.2, -0.15})
    for (const double pull : {0.0, 30.0}) {
      const SteadyVehicle v = vehicles.pulling({.slope = slope, .speed = 1.0, .pull = pull});
      const double front = (G * std::cos(slope) * 0.5 - G * std::sin(slope) * 0.4 - pull * 0.3) / 1.2;
      EXPECT_NEAR(load_of(v, {0, 1}) / G, front / G, 1e-12) << slope << " " << pull;
      EXPECT_NEAR(load_of(v, {2, 3}) / G, std::cos(slope) - front / G, 1e-12);
      EXPECT_NEAR(v.pull, pull, 1e-9 * G);
      EXPECT_NEAR(v.slip, (G * std::sin(slope) + pull) / (2 * G * std::cos(slope)), 1e-9);
    }
}

TEST(VehicleStatics, APullThatPointsDownPressesTheVehicleDown) {
  VehicleCase question = rover();
  question.hitch.angle = 0.3;
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, hard);
  const double G = vehicles.weight(), pull = 40.0;
  const SteadyVehicle v = vehicles.pulling({.pull = pull});
  const double down = pull * std::sin(0.3), front = (G * 0.5 - pull * std::cos(0.3) * 0.3 - down * 0.2) / 1.2;
  EXPECT_NEAR(load_of(v, {0, 1}) / G, front / G, 1e-9);
  EXPECT_NEAR(load_of(v, {0, 1, 2, 3}), G + down, 1e-9 * G);
}

TEST(VehicleStatics, OnACrossSlopeTheLowerWheelsCarryMore) {
  // N_right - N_left = 2 G sin(b) h/t, where nothing else turns it over; the crab holds it: 2 psi N = G sin(b).
  VehicleCase question = rover();
  question.axles[0].steered = YesNo::yes;
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, hard);
  const double G = vehicles.weight(), slope = 0.1;
  const SteadyVehicle v = vehicles.pulling({.cross_slope = slope});
  EXPECT_NEAR(load_of(v, {1, 3}) - load_of(v, {0, 2}), 2 * G * std::sin(slope) * 0.4 / 0.8, 0.02 * G * slope);
  EXPECT_NEAR(v.crab, std::tan(slope) / 2, 0.02 * slope);
  EXPECT_NEAR(v.yaw_moment, 0.0, 1e-7 * G);
}

TEST(VehicleStatics, ThreeAxlesStandAsARigidFrameOnSprings) {
  // L_i = k_i (a + b x_i): of springs alike at 0, 1 and 2 with the weight at 1.25: 1/3 + (x - 1)/8.
  VehicleCase question = rover();
  question.axles = {axle("a", 2.0), axle("b", 1.0), axle("c", 0.0)};
  question.centre_of_gravity = {1.25, 0.0, 0.0};
  auto wheels = wheels_of(question);
  const SteadyVehicles alike(question, wheels, hard);
  const double G = alike.weight();
  const SteadyVehicle v = alike.at_slip({}, 0.0);
  EXPECT_NEAR(load_of(v, {0, 1}) / G, 1.0 / 3 + 1.0 / 8, 1e-12);
  EXPECT_NEAR(load_of(v, {2, 3}) / G, 1.0 / 3, 1e-12);
  EXPECT_NEAR(load_of(v, {4, 5}) / G, 1.0 / 3 - 1.0 / 8, 1e-12);
  // A middle axle that is all but loose leaves two: 1.25/2 on the first.
  question.axles[0].stiffness = question.axles[2].stiffness = 1.0, question.axles[1].stiffness = 1e-7;
  EXPECT_NEAR(load_of(SteadyVehicles(question, wheels, hard).at_slip({}, 0.0), {0, 1}) / G, 1.25 / 2, 1e-6);
}

// By the matrix of Jazar, Vehicle Dynamics, Eqs. 2.241 to 2.268 (its printed solution has another factor): 9 t on axles
// at 1.6, -1.2 and -2.4 m of its centre of gravity, which is 1.1 m high, on springs alike, level and on 10 deg.
TEST(VehicleStatics, MeetThreeAxlesOnSpringsByJazar) {
  VehicleCase question = rover();
  question.mass = 9000.0, question.centre_of_gravity = {0.0, 0.0, 1.1};
  question.axles = {axle("a", 1.6), axle("b", -1.2), axle("c", -2.4)};
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, hard);
  constexpr double his_weight = 9000.0 * 9.81, degree = 0.017453292519943295;
  const std::array<double, 3> level = {22631.2975, 12852.3418, 8661.3608},
                              uphill = {20019.3037, 13190.7737, 10264.2609};
  for (const auto& [slope, each] : {std::pair(0.0, level), std::pair(10 * degree, uphill)}) {
    const SteadyVehicle v = vehicles.pulling({.slope = slope});
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(load_of(v, {2 * i}) / vehicles.weight(), each[i] / his_weight, 2e-9) << slope << " " << i;
  }
}

TEST(VehicleStatics, AWheelOffTheGroundLeavesTheOthersItsLoad) {
  VehicleCase question = rover();
  question.axles = {axle("a", 2.0), axle("b", 1.0), axle("c", 0.0)};
  question.centre_of_gravity = {1.9, 0.0, 0.0};
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, hard);
  const SteadyVehicle v = vehicles.at_slip({}, 0.0);
  EXPECT_TRUE(v.wheels[4].lifted);
  EXPECT_NEAR(load_of(v, {0, 1}) / vehicles.weight(), 0.9, 1e-9);
}

TEST(VehicleStatics, TipsOverWhereTheWeightStandsOutside) {
  VehicleCase question = rover();
  const auto wheels = wheels_of(question);
  question.centre_of_gravity = {1.3, 0.0, 0.4};
  try {
    SteadyVehicles(question, wheels, hard).at_slip({}, 0.1);
    FAIL() << "it stands";
  } catch (const VehicleGaveOut& error) {
    EXPECT_EQ(error.why(), GaveOut::tips_over);
  }
}

TEST(Vehicle, OfOneWheelIsTodaysEstimateToTheBit) {
  VehicleCase question = rover();
  question.axles = {axle("wheel", 0.0)};
  question.axles[0].track.reset();
  question.mass = 12.0;
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, soft);
  for (const double slope : {0.0, 0.15})
    for (const double slip : {-0.2, 0.1, 0.4, 1.0}) {
      const SteadyVehicle v = vehicles.at_slip({.slope = slope, .speed = 0.1}, slip);
      const TractionResult alone =
          soft.evaluate(wheels[0].scenario, {.load = vehicles.weight(), .slip = slip, .longitudinal_incline = slope});
      EXPECT_EQ(v.pull, alone.drawbar_pull.value);
      EXPECT_EQ(v.wheels[0].result.torque.value, alone.torque.value);
      EXPECT_EQ(v.wheels[0].result.sinkage.value, alone.sinkage.value);
    }
  const OperatingCondition at{.load = vehicles.weight()};
  EXPECT_NEAR(vehicles.at_most({}).pull, largest_pull(wheels[0].scenario, at).drawbar_pull.value, 1e-6);
  EXPECT_NEAR(vehicles.pulling({.pull = 5.0}).slip, slip_for_pull(wheels[0].scenario, at, 5.0)->value, 1e-9);
}

TEST(Vehicle, OfFourWheelsAlikeIsFourTimesOne) {
  // Its weight in the middle and on the ground, and no ruts: four wheels alike, but for the couple -M of each.
  VehicleCase question = rover();
  question.axles = {axle("front", 0.5), axle("rear", -0.5)};
  question.centre_of_gravity = {0.0, 0.0, 0.0}, question.hitch.at = {0.0, 0.0, 0.0};
  const auto wheels = wheels_of(question);
  const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({}, 0.3);
  EXPECT_EQ(v.wheels[0].result.drawbar_pull.value, v.wheels[1].result.drawbar_pull.value);
  EXPECT_EQ(v.wheels[2].result.torque.value, v.wheels[3].result.torque.value);
  // A hitch as high as the wheels' forces and couples ask for leaves no transfer: then all four are alike.
  const TractionResult one = soft.evaluate(
      wheels[0].scenario, {.load = SteadyVehicles(question, wheels, soft).weight() / 4, .slip = 0.3, .speed = 1.0});
  const double height = wheels[0].place.z - one.torque.value / one.drawbar_pull.value;
  question.hitch.at.z = height;
  const SteadyVehicle alike = SteadyVehicles(question, wheels, soft).at_slip({}, 0.3);
  for (const SteadyWheel& wheel : alike.wheels) EXPECT_NEAR(wheel.result.at.load, one.at.load, 1e-9 * one.at.load);
}

/// Gives the vehicle on one of two slopes, steered in front; on the other it is its mirror image.
SteadyVehicle expect_mirrored(VehicleCase question) {
  question.axles[0].steered = YesNo::yes;
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, soft);
  const SteadyVehicle left = vehicles.at_slip({.slope = 0.05, .cross_slope = 0.12}, 0.25);
  const SteadyVehicle right = vehicles.at_slip({.slope = 0.05, .cross_slope = -0.12}, 0.25);
  EXPECT_NEAR(left.pull, right.pull, 1e-7 * vehicles.weight());
  EXPECT_NEAR(left.crab, -right.crab, 1e-8);
  EXPECT_NEAR(left.steering, -right.steering, 1e-8);
  for (const auto& [one, other] : {std::pair{0, 1}, {1, 0}, {2, 3}, {3, 2}}) {
    const SteadyWheel &a = left.wheels[static_cast<std::size_t>(one)],
                      &b = right.wheels[static_cast<std::size_t>(other)];
    EXPECT_NEAR(a.normal_load, b.normal_load, 1e-7 * vehicles.weight());
    EXPECT_NEAR(a.result.torque.value, b.result.torque.value, 1e-7 * vehicles.weight());
    EXPECT_NEAR(a.result.at.slip, b.result.at.slip, 1e-7);
  }
  return left;
}

void expect_sum(const VehiclePower& p) {
  EXPECT_NEAR(p.into_wheels, p.drawbar + p.climbing + p.slip_loss + p.soil_loss, 1e-9 * p.into_wheels);
}

TEST(Vehicle, OnTheOtherSlopeIsItsMirrorImage) {
  for (const DriveLine line : {DriveLine::locked, DriveLine::open_axles}) {
    VehicleCase question = rover();
    question.drive_line = line;
    expect_mirrored(question);
  }
}

VehicleCase described_farther_left(VehicleCase vehicle, double by) {
  vehicle.centre_of_gravity.y += by, vehicle.hitch.at.y += by;
  for (VehicleAxle& one : vehicle.axles) one.y += by;
  return vehicle;
}

TEST(Vehicle, DoesNotHangOnWhereItsFileCountsFrom) {
  VehicleCase here = rover();
  here.axles[0].steered = YesNo::yes, here.hitch.at.y = -0.25, here.condition.pull = 20.0;
  const VehicleCase there = described_farther_left(here, 0.25);  // its hitch is at y = 0, and beside the wheels' middle
  const SteadyVehicle one = SteadyVehicles(here, wheels_of(here), soft).pulling(here.condition),
                      other = SteadyVehicles(there, wheels_of(there), soft).pulling(there.condition);
  ASSERT_GT(std::abs(one.crab), 1e-3);
  EXPECT_NEAR(other.crab, one.crab, 1e-9);
  EXPECT_NEAR(other.steering, one.steering, 1e-9);
  for (std::size_t i = 0; i < one.wheels.size(); ++i)
    EXPECT_NEAR(other.wheels[i].normal_load, one.wheels[i].normal_load, 1e-6);
}

// Where its middle is a mean of numbers that no double holds, as 0.1 m is.
TEST(Vehicle, AlikeOnBothSidesItGoesStraightWhereverItsFileCountsFrom) {
  for (const double by : {0.1, -0.3, 1.0 / 3.0}) {
    VehicleCase vehicle = described_farther_left(rover(), by);
    for (VehicleAxle& one : vehicle.axles) one.track = 1.3;
    vehicle.axles[0].steered = YesNo::yes;
    const SteadyVehicle steady = SteadyVehicles(vehicle, wheels_of(vehicle), soft).pulling(vehicle.condition);
    EXPECT_EQ(steady.crab, 0.0) << by;
    EXPECT_EQ(steady.steering, 0.0) << by;
  }
}

TEST(Vehicle, PowersAddUp) {
  VehicleCase question = rover();
  question.axles[0].driven = YesNo::no;
  const auto wheels = wheels_of(question);
  const SteadyVehicles vehicles(question, wheels, soft);
  const SteadyVehicle v = vehicles.at_slip({.slope = 0.05, .speed = 0.4}, 0.35);
  const VehiclePower& p = v.power;
  expect_sum(p);
  double into_wheels = 0.0;  // by torque and rotation, wheel by wheel
  for (std::size_t i = 0; i < wheels.size(); ++i)
    into_wheels += v.wheels[i].result.torque.value * v.wheels[i].rim_speed / wheels[i].scenario.tire.radius;
  EXPECT_NEAR(p.into_wheels, into_wheels, 1e-12 * into_wheels);
  EXPECT_GT(p.slip_loss, 0.0);
  EXPECT_GT(p.soil_loss, 0.0);
}

TEST(Vehicle, ATowedWheelHasNoTorqueAndSkids) {
  VehicleCase question = rover();
  question.axles[0].driven = YesNo::no;
  const auto wheels = wheels_of(question);
  const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({}, 0.3);
  EXPECT_EQ(v.wheels[0].result.torque.value, 0.0);  // by definition, without what the search leaves
  EXPECT_LT(v.wheels[0].result.at.slip, 0.0);
  EXPECT_LT(v.wheels[0].result.drawbar_pull.value, 0.0);
}

TEST(Vehicle, AnOpenAxleHasEqualTorques) {
  VehicleCase question = rover();
  question.drive_line = DriveLine::open_axles;
  question.centre_of_gravity.y = 0.1;
  const auto wheels = wheels_of(question);
  const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({}, 0.3);
  for (const std::size_t left : {0u, 2u}) {
    const SteadyWheel &l = v.wheels[left], &r = v.wheels[left + 1];
    EXPECT_NEAR(l.result.torque.value, r.result.torque.value, 1e-10);
    EXPECT_GT(l.normal_load, r.normal_load);
    EXPECT_LT(l.result.at.slip, r.result.at.slip);
    // The mean of the rim speeds is the drive line's: v/(1 - 0.3).
    EXPECT_NEAR((l.rim_speed + r.rim_speed) / 2, 1.0 / 0.7, 1e-2);
  }
}

// Differentials: which of them is open or locked.

/// Its rear axle locked beside an open one in front.
VehicleCase open_in_front() {
  VehicleCase made = rover();
  made.axles[0].differential = Differential::open, made.axles[1].differential = Differential::locked;
  return made;
}

/// Torque of an axle at its shaft, at the rim [N].
double shaft_thrust(const SteadyVehicle& vehicle, const VehicleAxle& axle, std::size_t left) {
  const double torque = vehicle.wheels[left].result.torque.value + vehicle.wheels[left + 1].result.torque.value;
  return torque * (1.0 + axle.lead) / axle.tire.radius;
}

TEST(VehicleDifferential, ThatSaysWhatItsDriveLineSaysChangesNoBit) {
  const VehicleCondition at{.slope = 0.05, .cross_slope = 0.1};
  const std::pair<DriveLine, Differential> alike[] = {{DriveLine::locked, Differential::locked},
                                                      {DriveLine::open_axles, Differential::open}};
  for (const auto& [line, differential] : alike) {
    VehicleCase question = rover();
    question.drive_line = line;
    const auto wheels = wheels_of(question);
    const SteadyVehicle before = SteadyVehicles(question, wheels, soft).at_slip(at, 0.2);
    for (VehicleAxle& axle : question.axles) axle.differential = differential;
    question.centre_differential = Differential::locked;
    const SteadyVehicle after = SteadyVehicles(question, wheels, soft).at_slip(at, 0.2);
    EXPECT_EQ(after.pull, before.pull);
    EXPECT_EQ(after.crab, before.crab);
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      EXPECT_EQ(after.wheels[i].result.torque.value, before.wheels[i].result.torque.value);
      EXPECT_EQ(after.wheels[i].rim_speed, before.wheels[i].rim_speed);
    }
  }
}

TEST(VehicleDifferential, OnLevelGroundAnOpenAxleIsALockedOneToTheBit) {
  VehicleCase question = rover();
  const auto wheels = wheels_of(question);
  const SteadyVehicle locked = SteadyVehicles(question, wheels, soft).pulling({.pull = 20.0});
  question.axles[1].differential = Differential::open;
  const SteadyVehicle open = SteadyVehicles(question, wheels, soft).pulling({.pull = 20.0});
  EXPECT_EQ(open.slip, locked.slip);
  for (std::size_t i = 0; i < wheels.size(); ++i)
    EXPECT_EQ(open.wheels[i].result.torque.value, locked.wheels[i].result.torque.value);
}

TEST(VehicleDifferential, OnACrossSlopeAnOpenAxleHasOneTorqueAndALockedOneOneSpeed) {
  const VehicleCase question = open_in_front();
  const auto wheels = wheels_of(question);
  const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({.cross_slope = 0.15}, 0.3);
  const SteadyWheel &front_left = v.wheels[0], &front_right = v.wheels[1], &rear_left = v.wheels[2],
                    &rear_right = v.wheels[3];
  EXPECT_NEAR(front_left.result.torque.value, front_right.result.torque.value, 1e-10);
  EXPECT_GT(front_left.rim_speed, 1.01 * front_right.rim_speed);  // the upper wheel is the lighter one
  EXPECT_NEAR(rear_left.rim_speed, rear_right.rim_speed, 1e-12);
  EXPECT_LT(rear_left.result.torque.value, 0.9 * rear_right.result.torque.value);
  EXPECT_NEAR((front_left.rim_speed + front_right.rim_speed) / 2, rear_left.rim_speed, 1e-12);
}

TEST(VehicleDifferential, AnOpenCentreSharesTheTorqueInHalves) {
  VehicleCase question = rover();
  question.centre_differential = Differential::open;
  question.axles[0].lead = 0.03, question.axles[0].tire.radius = 0.12;  // its shaft turns as the rear one's does
  const auto wheels = wheels_of(question);
  for (const double slip : {-0.1, 0.2, 0.6}) {
    const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({.slope = 0.1}, slip);
    EXPECT_NEAR(shaft_thrust(v, question.axles[0], 0), shaft_thrust(v, question.axles[1], 2), 1e-9);
    const double faster = v.wheels[0].rim_speed / 1.03 - v.wheels[2].rim_speed;
    EXPECT_GT(faster * slip, 0.0);  // uphill the front axle is the lighter one: it slips more
    EXPECT_NEAR((v.wheels[0].rim_speed / 1.03 + v.wheels[2].rim_speed) / 2, 1.0 / speed_ratio(slip), 1e-9);
  }
}

// Torque 2 s N r of each wheel: s_f N_f/s_1 = s_r N_r/s_2 with s_1/(1 - s_f) + s_2/(1 - s_r) = 1/(1 - s).
TEST(VehicleDifferential, AnOpenCentreOnHardGroundIsItsClosedForm) {
  VehicleCase question = rover();
  question.centre_differential = Differential::open;
  question.axles[0].torque_share = 1.0, question.axles[1].torque_share = 2.0;
  const auto wheels = wheels_of(question);
  const SteadyVehicle v = SteadyVehicles(question, wheels, hard).at_slip({}, 0.2);
  const double front = v.wheels[0].result.at.slip, rear = v.wheels[2].result.at.slip;
  EXPECT_NEAR(2 * front * load_of(v, {0, 1}), rear * load_of(v, {2, 3}), 1e-9);
  EXPECT_NEAR((1 / (1 - front) + 2 / (1 - rear)) / 3, 1 / (1 - 0.2), 1e-12);
}

TEST(VehicleDifferential, AnAxleInTheAirLeavesTheOtherNoTorqueThroughAnOpenCentre) {
  VehicleCase question = rover();
  question.axles = {axle("front", 2.0), axle("middle", 1.0), axle("rear", 0.0)};
  question.axles[1].driven = YesNo::no;
  question.centre_of_gravity = {1.9, 0.0, 0.0};
  const auto wheels = wheels_of(question);
  question.centre_differential = Differential::locked;
  EXPECT_GT(SteadyVehicles(question, wheels, hard).at_slip({}, 0.1).pull, 10.0);
  question.centre_differential = Differential::open;
  const SteadyVehicle v = SteadyVehicles(question, wheels, hard).at_slip({}, 0.1);
  EXPECT_TRUE(v.wheels[4].lifted);
  EXPECT_NEAR(v.wheels[0].result.torque.value, 0.0, 1e-9);
  EXPECT_NEAR(v.pull, 0.0, 1e-9);
}

TEST(VehicleDifferential, OnTheOtherSlopeIsItsMirrorImageAndPowersAddUp) {
  for (const bool open_centre : {false, true}) {
    VehicleCase question = open_in_front();
    if (open_centre) question.centre_differential = Differential::open;
    expect_sum(expect_mirrored(question).power);
  }
}

// Whose rear wheels may turn unlike goes round with less power, and with less torque on its outer rear wheel's rim.
TEST(VehicleDifferential, InATurnAnOpenAxleScuffsLess) {
  VehicleCase question = rover();
  question.axles[0].steered = YesNo::yes, question.axles[0].driven = YesNo::no;
  const auto wheels = wheels_of(question);
  const auto turning = [&](Differential rear) {
    question.axles[1].differential = rear;
    return SteadyVehicles(question, wheels, soft).pulling({.speed = 0.2, .curvature = 0.3});
  };
  const SteadyVehicle locked = turning(Differential::locked), open = turning(Differential::open);
  const auto unlike = [](const SteadyVehicle& v) {
    return std::abs(v.wheels[3].result.torque.value - v.wheels[2].result.torque.value);
  };
  EXPECT_LT(open.power.into_wheels, locked.power.into_wheels);
  EXPECT_LT(open.wheels[2].result.torque.value + open.wheels[3].result.torque.value,
            locked.wheels[2].result.torque.value + locked.wheels[3].result.torque.value);
  EXPECT_LT(unlike(open), 1e-9);
  EXPECT_GT(unlike(locked), 0.1);
  EXPECT_LT(open.wheels[2].rim_speed, open.wheels[3].rim_speed);  // the inner one is on the left
}

TEST(Vehicle, AMotorGivesNoMoreThanItsLargestTorque) {
  VehicleCase question = rover();
  question.drive_line = DriveLine::motors;
  const auto wheels = wheels_of(question);
  const SteadyVehicle free = SteadyVehicles(question, wheels, soft).at_slip({}, 0.4);
  const double most = 0.8 * free.wheels[2].result.torque.value;
  question.axles[1].largest_torque = most;
  const SteadyVehicle held = SteadyVehicles(question, wheels, soft).at_slip({}, 0.4);
  EXPECT_TRUE(held.wheels[2].at_largest_torque);
  EXPECT_FALSE(held.wheels[0].at_largest_torque);
  EXPECT_NEAR(held.wheels[2].result.torque.value, most, 1e-10);
  EXPECT_LT(held.pull, free.pull);
}

TEST(Vehicle, RearWheelsRollInTheRutsOfThoseBefore) {
  VehicleCase question = rover();
  question.effects = {{"multipass", "stiffer", {}}};
  EXPECT_THAT(
      wheels_of(question),
      testing::ElementsAre(testing::Property(&VehicleWheel::pass, 1), testing::Property(&VehicleWheel::pass, 1),
                           testing::Property(&VehicleWheel::pass, 2), testing::Property(&VehicleWheel::pass, 2)));
  const auto wheels = wheels_of(question);
  question.centre_of_gravity.x = 0.6;
  const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({}, 0.0);
  EXPECT_GT(v.wheels[0].result.sinkage.value, v.wheels[2].result.sinkage.value);
  question.axles[1].track = 1.1;  // beside the ruts
  EXPECT_EQ(wheels_of(question)[2].pass(), 1);
}

// The rear wheels are single wheels on their second pass, told what rolled before them.
TEST(Vehicle, ARutIsWhatTheWheelBeforeHasMadeOfIt) {
  VehicleCase question = rover();
  question.axles[0].driven = YesNo::no;
  question.centre_of_gravity.x = 0.6;
  for (const char* form : {"reload", "slip_hardening"}) {
    SCOPED_TRACE(form);
    question.effects = {{"multipass", form, {}}};
    const auto wheels = wheels_of(question);
    const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({}, 0.3);
    const TractionResult &front = v.wheels[0].result, &rear = v.wheels[2].result;
    EXPECT_NE(front.at.load, rear.at.load);
    EXPECT_LT(front.at.slip, 0.0);
    OperatingCondition alone = rear.at;
    EXPECT_EQ(alone.rut_load, front.at.load);
    EXPECT_EQ(alone.rut_slip, front.at.slip);
    EXPECT_EQ(soft.evaluate(wheels[2].scenario, alone).drawbar_pull.value, rear.drawbar_pull.value);
    alone.rut_load.reset(), alone.rut_slip.reset();
    EXPECT_NE(soft.evaluate(wheels[2].scenario, alone).drawbar_pull.value, rear.drawbar_pull.value);

    std::swap(question.axles[0], question.axles[1]);  // the order of a file is not that of the road
    const auto swapped = wheels_of(question);
    const SteadyVehicle same = SteadyVehicles(question, swapped, soft).at_slip({}, 0.3);
    EXPECT_NEAR(same.pull, v.pull, 1e-9);
    std::swap(question.axles[0], question.axles[1]);
  }
}

// A third wheel rolls in what the heaviest has pressed and the last one has sheared.
TEST(Vehicle, TheHeaviestWheelMakesTheRut) {
  VehicleCase question = rover();
  question.effects = {{"multipass", "reload", {}}};
  VehicleAxle tag = question.axles[1];
  tag.x -= 0.8;
  question.axles.push_back(tag);
  question.axles[0].stiffness = 3.0, question.axles[1].stiffness = 1.0, question.axles[2].stiffness = 1.0;
  question.axles[1].driven = YesNo::no;
  const auto wheels = wheels_of(question);
  const SteadyVehicle v = SteadyVehicles(question, wheels, soft).at_slip({}, 0.2);
  ASSERT_GT(v.wheels[0].result.at.load, v.wheels[2].result.at.load);
  EXPECT_EQ(v.wheels[4].result.at.rut_load, v.wheels[0].result.at.load);
  EXPECT_EQ(v.wheels[4].result.at.rut_slip, v.wheels[2].result.at.slip);
}

TEST(VehicleFile, IsWrittenAndReadToTheBit) {
  VehicleCase written = rover();
  written.source = "made: for this test", written.drive_line = DriveLine::motors, written.power = 1234.5;
  written.mass = 40.0 / 3.0, written.centre_of_gravity = {0.1 / 3.0, 0.01, 0.4};
  written.axles[0].motor = GearedMotor{{{0.0, 20.0}, {6.0, 5.0}}, 3.0, 0.9};
  written.axles[1].driven = YesNo::no, written.axles[1].steered = YesNo::yes, written.axles[1].largest_steer = 0.3;
  written.effects = {{"multipass", "stiffer", {}}};
  for (VehicleAxle& axle : written.axles) axle.tire.name = "wheel", axle.stiffness = 1e5 / 7.0;
  written.condition = {0.1, -0.05, 0.7, 33.3};
  written.drive.duration = 12.0, written.drive.profile = {{.at = 1.0}, {.at = 4.0, .longitudinal_incline = 0.2}};
  const bekker_wong::CatalogueVocabulary effects;
  const std::string text = write_vehicle_case(written, effects);
  const VehicleCase read = parse_vehicle_case(make_source_text(text, "vehicle.yaml"), Library(), effects);
  EXPECT_EQ(write_vehicle_case(read, effects), text);
  EXPECT_EQ(read.mass, written.mass);
  EXPECT_EQ(read.centre_of_gravity.x, written.centre_of_gravity.x);
  EXPECT_EQ(read.condition.pull, written.condition.pull);
  ASSERT_EQ(read.axles.size(), 2u);
  EXPECT_EQ(read.axles[0].motor->torque_curve[1].speed, 6.0);
  EXPECT_EQ(read.axles[1].stiffness, written.axles[1].stiffness);
  EXPECT_EQ(read.axles[1].tire.radius, written.axles[1].tire.radius);
  EXPECT_EQ(read.soil.semi_empirical->k_phi.value, written.soil.semi_empirical->k_phi.value);
  EXPECT_EQ(read.drive.profile[1].longitudinal_incline, 0.2);
}

TEST(VehicleFile, WritesItsDifferentials) {
  VehicleCase written = open_in_front();
  written.centre_differential = Differential::open, written.axles[1].torque_share = 2.0 / 3.0;
  for (VehicleAxle& axle : written.axles) axle.tire.name = "wheel";
  const bekker_wong::CatalogueVocabulary effects;
  const std::string text = write_vehicle_case(written, effects);
  const VehicleCase read = parse_vehicle_case(make_source_text(text, "vehicle.yaml"), Library(), effects);
  EXPECT_EQ(write_vehicle_case(read, effects), text);
  EXPECT_EQ(read.centre_differential, Differential::open);
  EXPECT_EQ(read.axles[0].differential, Differential::open);
  EXPECT_EQ(read.axles[1].differential, Differential::locked);
  EXPECT_EQ(read.axles[1].torque_share, written.axles[1].torque_share);
}

TEST(Vehicle, SaysWhichWheelGaveOut) {
  VehicleCase question = rover();
  question.mass = 450.0, question.centre_of_gravity = {0.1, 0.0, 0.4};
  const auto wheels = wheels_of(question);
  try {
    SteadyVehicles(question, wheels, soft).pulling({});
    FAIL() << "the soil carries it";
  } catch (const VehicleGaveOut& error) {
    EXPECT_EQ(error.why(), GaveOut::wheel);
    EXPECT_EQ(wheels[*error.wheel()].axle, 1u);
    EXPECT_THAT(error.what(), HasSubstr("would sink deeper"));
  }
}

}  // namespace
}  // namespace soilbin::compare
