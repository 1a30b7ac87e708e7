// A vehicle driven in time: it settles into its steady state, of one wheel it is the driven wheel, its energy adds up,
// and what rolls backward is what looks the other way.
#include "compare/vehicle/vehicle_drive.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/gsl.hpp"
#include "bekker_wong/model.hpp"
#include "compare/vehicle/steady_vehicle.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_speed.hpp"
#include "scenario/yawed_frames.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

const bekker_wong::BekkerWong steady_model({.errors = false, .patch = false});
constexpr bekker_wong::DriveNumerics fine{.nodes = 48, .relative_tolerance = 1e-9};

VehicleAxle axle_of_rover(const std::string& name, double x) {
  VehicleAxle made;
  made.name = name, made.x = x, made.track = 0.8, made.tire = test::smooth_wheel(0.15, 0.12);
  return made;
}

/// 40 kg, 1.2 m between its axles, the centre of gravity 0.5 m before the rear one and 0.4 m high; 10 cm/s.
VehicleCase driven_rover() {
  VehicleCase made;
  made.name = "rover", made.mass = 40.0, made.centre_of_gravity = {0.5, 0.0, 0.4};
  made.axles = {axle_of_rover("front", 1.2), axle_of_rover("rear", 0.0)};
  made.hitch.at = {-0.2, 0.0, 0.3};
  made.soil.name = "dry sand", made.soil.semi_empirical = test::dry_sand();
  made.soil.semi_empirical->shear_modulus.std_error = 0;
  made.condition.speed = 0.1, made.drive.duration = 15.0;
  return made;
}

VehicleCase one_driven_wheel() {
  VehicleCase made = driven_rover();
  made.mass = 10.0, made.axles = {axle_of_rover("wheel", 0.0)}, made.axles[0].track.reset();
  made.centre_of_gravity = {0.0, 0.0, 0.15}, made.hitch.at = {0.0, 0.0, 0.15};
  return made;
}

VehicleDriveRecord driven(const VehicleCase& vehicle, const bekker_wong::DriveNumerics& numerics = {}) {
  return drive_vehicle(vehicle, wheels_of(vehicle), 50, numerics);
}

TEST(VehicleDrive, OfOneWheelIsTodaysDrive) {
  VehicleCase vehicle = one_driven_wheel();
  Waypoint level, up;
  level.drawbar = 3.0, up.at = 0.3, up.longitudinal_incline = 5 * degree, up.drawbar = 1.0;
  vehicle.drive.profile = {level, up};
  vehicle.drive.duration = 8.0;
  Scenario scenario = wheels_of(vehicle)[0].scenario;
  Drive drive;
  drive.load = 10.0 * standard_gravity, drive.duration = 8.0, drive.profile = vehicle.drive.profile;
  drive.controller.rim_speed = 0.1;
  const bekker_wong::DriveRecord wheel = bekker_wong::drive_wheel(scenario, drive, 50, fine);
  const VehicleDriveRecord record = driven(vehicle, fine);
  ASSERT_EQ(record.end, wheel.end);
  ASSERT_EQ(record.samples.size(), wheel.samples.size());
  for (std::size_t i = 0; i < wheel.samples.size(); ++i) {
    const bekker_wong::DriveSample& a = wheel.samples[i];
    const VehicleDriveSample& b = record.samples[i];
    EXPECT_NEAR(b.travelled, a.travelled, 1e-7) << a.time;
    EXPECT_NEAR(b.speed, a.speed, 1e-7) << a.time;
    EXPECT_NEAR(b.rim_speed, a.rim_speed, 1e-7) << a.time;
    EXPECT_NEAR(b.axles[0].sinkage, a.sinkage, 1e-7) << a.time;
    EXPECT_NEAR(b.torque, a.torque, 1e-5 * drive.load * 0.15) << a.time;
    EXPECT_NEAR(b.axles[0].forward, a.forward, 1e-5 * drive.load) << a.time;
    EXPECT_NEAR(b.energy.motor, a.energy.motor, 1e-6) << a.time;
    EXPECT_NEAR(b.energy.height, a.energy.height, 1e-6) << a.time;
  }
}

/// A vehicle at the end of a drive on one slope, and its steady state there.
void expect_settled(const VehicleCase& vehicle) {
  const auto wheels = wheels_of(vehicle);
  const VehicleDriveRecord record = driven(vehicle, fine);
  ASSERT_EQ(record.end, DriveEnd::time_is_up);
  const VehicleDriveSample& end = record.samples.back();
  const SteadyVehicles vehicles(vehicle, wheels, steady_model);
  const SteadyVehicle steady = vehicles.pulling(vehicle.condition);
  const double G = vehicles.weight();
  EXPECT_NEAR(*end.slip, steady.slip, 5e-6);
  EXPECT_NEAR(end.rim_speed, 0.1, 1e-7);
  EXPECT_NEAR(end.speed, 0.1 * speed_ratio(steady.slip), 5e-7);
  for (const std::size_t i : {0, 1}) {
    const SteadyWheel& wheel = steady.wheels[2 * i];
    EXPECT_NEAR(end.axles[i].normal_load, wheel.normal_load, 2e-6 * G) << i;
    EXPECT_NEAR(end.axles[i].sinkage, wheel.result.sinkage.value, 2e-7) << i;
    EXPECT_NEAR(end.axles[i].torque, wheel.result.torque.value, 2e-6 * G * 0.15) << i;
    EXPECT_NEAR(*end.axles[i].slip, wheel.result.at.slip, 1e-5) << i;
  }
}

TEST(SlowVehicleDrive, SettlesIntoTheSteadyVehicle) {
  for (const auto& [slope, pull] : {std::pair(0.0, 0.0), {6 * degree, 0.0}, {-5 * degree, 0.0}, {0.0, 20.0}}) {
    SCOPED_TRACE(testing::Message() << slope / degree << " deg, " << pull << " N");
    VehicleCase vehicle = driven_rover();
    vehicle.condition.slope = slope, vehicle.condition.pull = pull;
    expect_settled(vehicle);
  }
}

TEST(SlowVehicleDrive, SettlesUnderEveryDriveLine) {
  VehicleCase leads = driven_rover();
  leads.axles[0].lead = 0.05;
  expect_settled(leads);
  leads.drive_line = DriveLine::open_axles;
  expect_settled(leads);
  leads.drive_line = DriveLine::motors;
  expect_settled(leads);
  VehicleCase trailing = driven_rover();
  trailing.axles[0].driven = YesNo::no;
  trailing.drive.duration = 40.0;
  expect_settled(trailing);
}

TEST(SlowVehicleDrive, RearWheelsRollInTheRutsOfThoseBefore) {
  VehicleCase vehicle = driven_rover();
  const EffectChoice multipass{"multipass", "stiffer", {}};
  vehicle.effects = {multipass};
  for (const bekker_wong::EffectParameter& p : bekker_wong::find_form(multipass).parameters)
    vehicle.effects[0].parameters[p.name] = p.fallback;
  expect_settled(vehicle);
  const VehicleDriveSample in_ruts = driven(vehicle).samples.back();
  vehicle.effects.clear();
  EXPECT_LT(in_ruts.axles[1].sinkage, 0.95 * driven(vehicle).samples.back().axles[1].sinkage);
}

TEST(SlowVehicleDrive, ClimbsBelowTheSteepestSlopeOfTheSteadyVehicleAndSticksAbove) {
  VehicleCase vehicle = driven_rover();
  const VehicleLimit up = steepest_slopes(vehicle, wheels_of(vehicle), steady_model)[0];
  Waypoint level, climb;
  level.at = 0.2, climb.at = 1.2;
  vehicle.drive.profile = {level, climb};
  vehicle.drive.duration = 90.0;
  vehicle.drive.profile[1].longitudinal_incline = up.angle->value - 0.5 * degree;
  const VehicleDriveRecord climbs = driven(vehicle);
  EXPECT_EQ(climbs.end, DriveEnd::time_is_up);
  EXPECT_GT(climbs.samples.back().travelled, 1.5);
  EXPECT_FALSE(climbs.gave_out);
  vehicle.drive.profile[1].longitudinal_incline = up.angle->value + 0.5 * degree;
  const VehicleDriveRecord sticks = driven(vehicle);
  EXPECT_EQ(sticks.end, DriveEnd::stuck);
  EXPECT_LT(sticks.samples.back().slope, up.angle->value + 0.2 * degree);
  EXPECT_TRUE(sticks.gave_out);
  EXPECT_FALSE(sticks.at_motors_limit) << "its wheels turn: the soil gives out";
}

TEST(VehicleDrive, EnergyAddsUpAtEveryTime) {
  VehicleCase vehicle = driven_rover();
  Waypoint level, up;
  level.drawbar = 5.0, up.at = 0.3, up.longitudinal_incline = 6 * degree;
  vehicle.drive.profile = {level, up};
  vehicle.axles[1].driven = YesNo::no;
  const VehicleDriveRecord record = driven(vehicle);
  const double work = record.samples.back().energy.motor;
  ASSERT_GT(work, 10.0);
  for (const VehicleDriveSample& s : record.samples)
    EXPECT_LT(std::abs(s.energy.unaccounted()), 1e-5 * work) << "at " << s.time << " s";
}

/// Rolls as its slope tells it: the motors let go within a fifth of a second.
VehicleCase let_go(VehicleCase vehicle, double slope) {
  vehicle.condition.slope = slope;
  Controller none;
  none.torque = 1e-9, none.ramp = 0.2;
  vehicle.drive.controller = none;
  for (VehicleAxle& axle : vehicle.axles) axle.inertia = 1e-3;
  return vehicle;
}

// F = m a: the steady wheel at the slip at which its torque is none gives F.
TEST(VehicleDrive, LetGoDownhillItGainsGravitysShareLessTheSoilsResistance) {
  for (const double slope : {-15 * degree, -20 * degree}) {
    VehicleCase vehicle = let_go(one_driven_wheel(), slope);
    vehicle.drive.duration = 2.0;
    const VehicleDriveRecord record = driven(vehicle);
    ASSERT_EQ(record.end, DriveEnd::time_is_up);
    OperatingCondition at{.load = 10.0 * standard_gravity, .longitudinal_incline = slope};
    const Scenario scenario = wheels_of(vehicle)[0].scenario;
    const auto torque = [&](double slip) {
      at.slip = slip;
      return steady_model.evaluate(scenario, at).torque.value;
    };
    const double towed = gsl::bracketed_root(torque, -0.3, 0.3, 1e-12, 1e-9, "the towed wheel's slip");
    torque(towed);
    const double gain = steady_model.evaluate(scenario, at).drawbar_pull.value / 10.0;
    EXPECT_LT(gain, standard_gravity * std::sin(-slope));
    EXPECT_NEAR(record.samples.back().acceleration, gain, 0.005 * gain) << slope / degree;
    EXPECT_NEAR(*record.samples.back().slip, towed, 2e-3);
  }
}

// Uphill the vehicle rolls backward, its rear axle first: as the mirrored vehicle rolls forward downhill.
TEST(VehicleDrive, RollingBackwardItIsTheMirroredVehicle) {
  VehicleCase uphill = let_go(driven_rover(), 18 * degree);
  uphill.drive.duration = 5.0;
  const VehicleDriveRecord back = driven(uphill);
  ASSERT_EQ(back.end, DriveEnd::rolled_back);
  VehicleCase downhill = let_go(mirrored(driven_rover()), -18 * degree);
  downhill.drive.distance = -back.samples.back().travelled;
  const VehicleDriveRecord forward = driven(downhill);
  ASSERT_EQ(forward.end, DriveEnd::arrived);
  const VehicleDriveSample &a = back.samples.back(), &b = forward.samples.back();
  EXPECT_NEAR(a.travelled, -0.6, 1e-6);
  EXPECT_NEAR(a.acceleration, -b.acceleration, 0.01 * b.acceleration);
  EXPECT_NEAR(a.speed, -b.speed, 0.05 * b.speed) << "they begin with other shear";
  for (const std::size_t i : {0, 1}) {
    EXPECT_NEAR(a.axles[i].sinkage, b.axles[i].sinkage, 0.01 * b.axles[i].sinkage) << i;
    EXPECT_NEAR(a.axles[i].normal_load, b.axles[i].normal_load, 0.005 * 40 * standard_gravity) << i;
    EXPECT_NEAR(a.axles[i].forward, -b.axles[i].forward, 0.02 * std::abs(b.axles[i].forward)) << i;
  }
  EXPECT_LT(std::abs(a.energy.unaccounted()), 1e-4 * std::abs(a.energy.height));
}

TEST(VehicleDrive, IsDrivenMirroredTwiceAsItIs) {
  const VehicleCase once = driven_rover(), twice = mirrored(mirrored(driven_rover()));
  EXPECT_EQ(driven(once).samples.back().travelled, driven(twice).samples.back().travelled);
}

// Moments about the rear wheels' ground, on ground that is all but level under the vehicle:
// 2 N_f L = G cos(a) l_r - (G sin(a) + m v') h + Sum 2 (F_i r - M_i).
TEST(VehicleDrive, AccelerationShiftsLoadsByItsMomentAtTheCentreOfGravity) {
  VehicleCase vehicle = driven_rover();
  Controller sudden;
  sudden.rim_speed = 0.3, sudden.ramp = 0.2;
  vehicle.drive.controller = sudden, vehicle.drive.duration = 1.0;
  const VehicleDriveRecord record = driven(vehicle);
  const double G = 40.0 * standard_gravity;
  double most = 0.0;
  for (const VehicleDriveSample& s : record.samples) {
    double moment = G * 0.5 - 40.0 * s.acceleration * 0.4;
    for (const DrivenAxle& axle : s.axles) moment += 2 * (axle.forward * 0.15 - axle.torque);
    EXPECT_NEAR(2 * s.axles[0].normal_load, moment / 1.2, 2e-3 * G) << s.time;
    EXPECT_NEAR(2 * (s.axles[0].normal_load + s.axles[1].normal_load), G, 1e-9 * G) << s.time;
    most = std::max(most, s.acceleration);
  }
  EXPECT_GT(most, 1.0) << "the acceleration is felt: 3 % of the weight";
}

TEST(VehicleDrive, StopsOnASlopeAndStartsFromThere) {
  VehicleCase vehicle = driven_rover();
  vehicle.condition.slope = 4 * degree;
  vehicle.drive.duration = 30.0,
  vehicle.drive.stop = VehicleStop{5.0, 3.0};  // braked from 5 to 6 s, at rest until 9 s, on its way from 10 s
  const VehicleDriveRecord record = drive_vehicle(vehicle, wheels_of(vehicle), 300);
  ASSERT_EQ(record.end, DriveEnd::time_is_up);
  const auto at = [&](double time) -> const VehicleDriveSample& {
    return *std::ranges::find_if(record.samples,
                                 [&](const VehicleDriveSample& s) { return std::abs(s.time - time) < 1e-9; });
  };
  const VehicleDriveSample travels = at(4.5), rests = at(8.5), again = at(30.0);
  EXPECT_NEAR(rests.speed, 0.0, 1e-3 * travels.speed);
  EXPECT_NEAR(rests.rim_speed, 0.0, 1e-3 * travels.rim_speed);
  EXPECT_NEAR(rests.travelled, at(7.5).travelled, 1e-4);
  double holds = 0.0;
  for (const DrivenAxle& axle : rests.axles) holds += 2 * axle.forward;
  EXPECT_NEAR(holds, 40 * standard_gravity * std::sin(4 * degree), 0.1) << "the soil holds it";
  const auto stands_on = wheels_of(vehicle);
  const SteadyVehicle steady = SteadyVehicles(vehicle, stands_on, steady_model).pulling(vehicle.condition);
  EXPECT_NEAR(*again.slip, steady.slip, 1e-4) << "as if it had not stopped";
  EXPECT_LT(std::abs(again.energy.unaccounted()), 1e-5 * again.energy.motor);
}

TEST(VehicleDrive, AMotorGivesNoMoreThanItsPower) {
  VehicleCase vehicle = driven_rover();
  vehicle.condition.slope = 5 * degree;
  const VehicleDriveSample strong = driven(vehicle).samples.back();
  const double asked = strong.torque * 0.1 / 0.15;
  vehicle.power = 0.6 * asked;
  const VehicleDriveRecord record = driven(vehicle);
  ASSERT_EQ(record.end, DriveEnd::time_is_up);
  EXPECT_TRUE(record.at_motors_limit);
  const VehicleDriveSample& end = record.samples.back();
  EXPECT_NEAR(end.torque * end.rim_speed / 0.15, *vehicle.power, 1e-4 * asked);
  EXPECT_NEAR(end.speed, 0.6 * strong.speed, 0.01 * strong.speed) << "at the slip of before";
  EXPECT_EQ(record.happenings.front().what, DriveEvent::torque_limit);
}

TEST(SlowVehicleDrive, SettlesWhereItsMotorsTorqueCurveLetsIt) {
  VehicleCase vehicle = driven_rover();
  vehicle.condition.slope = 4 * degree, vehicle.condition.speed = 0.2;
  const auto wheels = wheels_of(vehicle);
  const SteadyVehicle steady = SteadyVehicles(vehicle, wheels, steady_model).pulling(vehicle.condition);
  const double torque = steady.power.into_wheels * speed_ratio(steady.slip) * 0.15 / 0.2;
  vehicle.motor = GearedMotor{{{0.0, 2.0 * torque}, {10.0, 0.0}}, 10.0, 0.1};  // half way: 5 rad/s over 10
  const double fastest = fastest_of(vehicle, steady).speed->value;
  EXPECT_NEAR(fastest, 0.5 * 0.15 * speed_ratio(steady.slip), 1e-9);
  const VehicleDriveRecord record = driven(vehicle);
  ASSERT_EQ(record.end, DriveEnd::time_is_up);
  EXPECT_TRUE(record.at_motors_limit);
  EXPECT_NEAR(record.samples.back().speed, fastest, 1e-4 * fastest);
  EXPECT_NEAR(record.samples.back().torque, torque, 1e-4 * torque);
  vehicle.motor->torque_curve = {{0.0, 9.0 * torque}, {5.0, 9.0 * torque}};
  EXPECT_NEAR(driven(vehicle).samples.back().rim_speed, 0.5 * 0.15, 1e-5) << "its motor turns no faster";
}

TEST(VehicleDrive, OfTheMotorsTheWeakOneIsHeldAtItsLargestTorque) {
  VehicleCase vehicle = driven_rover();
  vehicle.drive_line = DriveLine::motors, vehicle.condition.pull = 20.0;
  vehicle.axles[0].largest_torque = 1.0;
  const VehicleDriveSample end = driven(vehicle).samples.back();
  EXPECT_NEAR(end.axles[0].torque, 1.0, 1e-5);
  EXPECT_LT(*end.axles[0].slip, *end.axles[1].slip);
}

TEST(VehicleDrive, TheFrontAxleMeetsANewSoilFirst) {
  VehicleCase vehicle = driven_rover();
  Waypoint start, soft;
  soft.at = 0.9, soft.soil = vehicle.soil;
  soft.soil->semi_empirical->k_phi.value /= 4;
  vehicle.drive.profile = {start, soft};
  vehicle.drive.duration = 9.0;
  double front = 0.0, rear = 0.0;  // where each has sunk half as deep again
  const VehicleDriveRecord record = drive_vehicle(vehicle, wheels_of(vehicle), 900);
  const std::vector<DrivenAxle>& first = record.samples.front().axles;
  for (const VehicleDriveSample& s : record.samples) {
    if (front == 0.0 && s.axles[0].sinkage > 1.5 * first[0].sinkage) front = s.travelled;
    if (rear == 0.0 && s.axles[1].sinkage > 1.5 * first[1].sinkage) rear = s.travelled;
  }
  EXPECT_NEAR(front, 0.9 - 0.7, 0.12);
  EXPECT_EQ(rear, 0.0) << "the rear axle, 0.5 m behind the centre of gravity, is not there yet";
}

TEST(VehicleDrive, TipsOverWhereItsMotorsLiftItsFront) {
  VehicleCase vehicle = driven_rover();
  vehicle.centre_of_gravity = {0.02, 0.0, 0.5};
  Controller sudden;
  sudden.rim_speed = 1.0, sudden.ramp = 0.1;
  vehicle.drive.controller = sudden;
  const VehicleDriveRecord record = driven(vehicle);
  EXPECT_EQ(record.end, DriveEnd::tips_over);
  EXPECT_NEAR(record.samples.back().axles[0].normal_load, 0.0, 1.0);
}

TEST(VehicleDrive, WhereSoilOrMotorsCantHoldItItDoesNotStart) {
  VehicleCase steep = driven_rover(), weak = driven_rover();
  steep.condition.slope = 40 * degree, weak.condition.slope = 10 * degree;
  Controller too_weak;
  too_weak.rim_speed = 0.1, too_weak.highest_torque = 0.1;
  weak.drive.controller = too_weak;
  for (const VehicleCase& vehicle : {steep, weak}) try {
      driven(vehicle);
      FAIL() << "it stands";
    } catch (const VehicleGaveOut& error) {
      EXPECT_EQ(error.why(), GaveOut::hold);
    }
}

TEST(VehicleDrive, RefusesWhatIsNotAlikeOnBothSides) {
  VehicleCase askew = driven_rover();
  askew.centre_of_gravity.y = 0.1;
  EXPECT_THROW(driven(askew), InputError);
  VehicleCase across = driven_rover();
  across.condition.cross_slope = 0.1;
  EXPECT_THROW(driven(across), InputError);
  VehicleCase trike = driven_rover();
  trike.axles[1].track.reset();
  EXPECT_EQ(driven(trike).end, DriveEnd::time_is_up);
}

TEST(AxleLoads, AreTheTextbooksOfTwoAxlesAndOfAnAxleOffTheGround) {
  const std::vector<CarryingAxle> two = {{2.0, 1.2, 1.2}, {2.0, 0.0, 0.0}};
  const std::vector<double> loads = axle_loads(two, 100.0, 100.0 * 0.5);
  EXPECT_NEAR(loads[0], 100.0 * 0.5 / 1.2, 1e-12);
  EXPECT_NEAR(loads[1], 100.0 * 0.7 / 1.2, 1e-12);
  const std::vector<CarryingAxle> three = {{1.0, 2.0, 2.0}, {1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}};
  const std::vector<double> lifted = axle_loads(three, 100.0, 100.0 * 1.9);  // the weight stands at 1.9
  EXPECT_NEAR(lifted[0], 90.0, 1e-12);
  EXPECT_NEAR(lifted[1], 10.0, 1e-12);
  EXPECT_EQ(lifted[2], 0.0);
}

}  // namespace
}  // namespace soilbin::compare
