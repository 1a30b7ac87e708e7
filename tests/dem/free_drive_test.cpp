// A wheel driven freely over grains: mechanics on a floor of cobbles, and on a small soft bed what must hold of it.
#include "dem/rig/free_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using test::small_wheel;
using test::with_threads;

constexpr double load = 20, carried_mass = load / 9.80665;

Rig small_rig() {
  Rig rig;
  rig.behind = 0.12, rig.ahead = 0.12;
  rig.lowering = 0.1, rig.resting = 0.05;
  return rig;
}

/// At a rim speed of 0.3 m/s for `duration`, on one slope with one load to pull.
Drive even_drive(double slope, double drawbar, double duration) {
  Drive drive;
  drive.load = load;
  drive.duration = duration;
  drive.controller.rim_speed = 0.3, drive.controller.ramp = 0.2;
  Waypoint start;
  start.longitudinal_incline = slope, start.drawbar = drawbar;
  drive.profile = {start};
  return drive;
}

/// A layer of equal spheres that fill the bin from wall to wall and carry each other: nothing of it can give way.
SettledBed cobbles() {
  constexpr double radius = 0.005;
  BedRecipe recipe;
  recipe.soil = test::soft_soil();
  recipe.soil.radius_min = recipe.soil.radius_max = radius;
  recipe.soil.youngs_modulus = 1e7;
  recipe.size = {0.6, 0.12, 2 * radius};
  Setup setup;
  setup.materials.add({"grains", recipe.soil.grain_density, recipe.soil.youngs_modulus, recipe.soil.poisson_ratio},
                      {.restitution = 0.4, .sliding_friction = 1});
  setup.domain = {{-radius, -radius, -radius}, {0.6 + radius, 0.12 + radius, 1}};
  setup.numerics.dt = longest_step(recipe.soil);
  setup.numerics.threads = 1;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -recipe.gravity});
  Body bin;
  bin.name = "bin";
  for (const Plane& wall : {Plane{{}, {0, 0, 1}}, Plane{{}, {1, 0, 0}}, Plane{{}, {0, 1, 0}},
                            Plane{{0.6, 0, 0}, {-1, 0, 0}}, Plane{{0, 0.12, 0}, {0, -1, 0}}})
    bin.surfaces.push_back({wall, grain_material});
  simulation.add_body(bin);
  for (int row = 0; row < 12; ++row)
    for (int k = 0; k < 60; ++k) simulation.add_grain({0.005 + 0.01 * k, 0.005 + 0.01 * row, radius}, radius, 0);
  simulation.run(1);
  return {.recipe = recipe, .setup = simulation.setup(), .state = simulation.state(), .report = {}};
}

// Far below the limit of friction the wheel only creeps on its elastic contacts, by a share c of the way that it turns,
// so the torque turns and pushes it as one: a = M/r/(m + I/(r^2 (1 - c))). The setpoint comes on as 3 u^2 - 2 u^3 over
// a ramp R: its first integral is t - R/2 at t, its second (t - R)^2/2 + (t - R) R/2 + 0.15 R^2.
TEST(SlowFreeDrive, OnCobblesTheTorqueMovesMassAndInertia) {
  constexpr double torque = 0.2, ramp = 0.1, t = 0.5, r = 0.1;
  for (const double share : {0.1, 1.0}) {
    Drive drive = even_drive(0, 0, t);
    drive.controller = {.torque = torque, .ramp = ramp};
    drive.inertia = share * carried_mass * r * r;
    Rig rig = small_rig();
    rig.meshing.edge = 0.003;
    const GrainDriveRecord record = drive_freely(
        {cobbles(), small_wheel(), {.restitution = 0.9, .sliding_friction = 1, .rolling_friction = 0}, rig}, drive, 50,
        with_threads(1));
    ASSERT_EQ(record.end, DriveEnd::time_is_up);
    const GrainDriveSample& end = record.samples.back();
    double rolled = 0;
    for (std::size_t k = 1; k < record.samples.size(); ++k)
      rolled += record.samples[k].rim_speed * (record.samples[k].time - record.samples[k - 1].time);
    const double impulse = torque / r * (t - ramp / 2);
    EXPECT_NEAR(carried_mass * (end.speed + share * end.rim_speed), impulse, 0.02 * impulse);
    const double creep = 1 - end.travelled / rolled;
    EXPECT_GT(creep, 0);
    EXPECT_LT(creep, 0.15) << "a tenth of the friction is asked for";
    const double way = torque / r / (carried_mass * (1 + share / (1 - creep))) *
                       ((t - ramp) * (t - ramp) / 2 + (t - ramp) * ramp / 2 + 0.15 * ramp * ramp);
    EXPECT_NEAR(end.travelled, way, 0.02 * way);
  }
}

/// On a settled bed of grains of 20 mm.
class SlowFreeDriveOnGrains : public ::testing::Test {
 protected:
  static const SettledBed& bed() {
    static const SettledBed bed = settle_bed(test::small_recipe({1.2, 0.16, 0.08}), with_threads(1));
    return bed;
  }
  static GrainDriveRecord run(const Drive& drive, const Rig& rig = small_rig(), int samples = 200, int threads = 1) {
    return drive_freely({bed(), small_wheel(), bed().recipe.soil.grain_tire, rig}, drive, samples,
                        with_threads(threads));
  }
};

// Sums over samples of a millisecond, whose last one is the speed at the end to the change within a millisecond.
TEST_F(SlowFreeDriveOnGrains, WhatPushesItBecomesMomentumAndHeight) {
  const double slope = 4 * degree, drawbar = 1;
  const GrainDriveRecord record = run(even_drive(slope, drawbar, 0.6), small_rig(), 600);
  const GrainDriveSample &first = record.samples.front(), &end = record.samples.back();
  double impulse = 0;
  for (std::size_t k = 1; k < record.samples.size(); ++k)
    impulse += (record.samples[k].forward - load * std::sin(slope) - drawbar) *
               (record.samples[k].time - record.samples[k - 1].time);
  EXPECT_GT(end.speed, 0.1);
  EXPECT_NEAR(impulse, carried_mass * (end.speed - first.speed), 0.01 * carried_mass * end.speed);
  EXPECT_NEAR(end.energy.drawbar, drawbar * end.travelled, drawbar * end.speed * bed().setup.numerics.dt);
  const double lifted = end.travelled * std::sin(slope) - (end.sinkage - first.sinkage) * std::cos(slope);
  EXPECT_NEAR(end.energy.height, load * lifted, 0.01 * load * end.travelled * std::sin(slope));
}

/// Level, then uphill, with a load to pull and the grains' ledger told.
GrainDriveRecord told_drive(const SettledBed& bed, double duration, double dt) {
  Drive drive = even_drive(0, 1, duration);
  Waypoint up;
  up.at = 0.25, up.longitudinal_incline = 8 * degree, up.drawbar = 1;
  drive.profile.push_back(up);
  Rig rig = small_rig();
  rig.ledger = true, rig.dt = dt;
  return drive_freely({bed, small_wheel(), bed.recipe.soil.grain_tire, rig}, drive, 60, with_threads(1));
}

// The wheel's own balance is counted step by step as it moves: rounding alone is left.
TEST_F(SlowFreeDriveOnGrains, TheMotorsWorkIsAccountedFor) {
  const GrainDriveRecord record = told_drive(bed(), 1.2, 0);
  for (const GrainDriveSample& s : record.samples)
    EXPECT_NEAR(s.energy.unaccounted(), 0, 1e-9 * (1 + s.energy.motor)) << s.time;
  const GrainDriveEnergy& end = record.samples.back().energy;
  EXPECT_GT(end.motor, end.height + end.drawbar);
  EXPECT_GT(end.sliding, end.damping);
  EXPECT_GT(end.rolling, 0);
  EXPECT_GT(end.height, 0);
  // The grains' balance closes too, though couples tremble from step to step in every contact while gravity turns.
  EXPECT_NEAR(end.soil_unaccounted(), 0, 0.02 * end.soil);
}

// Without rolling resistance grains are livelier, and the time step leaves more over.
TEST(SlowFreeDrive, WhatTheGrainsWereGivenIsAccountedForWithoutRollingResistance) {
  BedRecipe recipe = test::small_recipe({1.0, 0.16, 0.06});
  recipe.soil.grain_grain.rolling_friction = recipe.soil.grain_tire.rolling_friction = 0;
  const SettledBed bed = settle_bed(recipe, with_threads(1));
  const GrainDriveEnergy end = told_drive(bed, 0.6, bed.setup.numerics.dt / 4).samples.back().energy;
  EXPECT_EQ(end.rolling, 0);
  EXPECT_GT(end.soil, 0.2 * end.motor);
  EXPECT_NEAR(end.soil_unaccounted(), 0, 0.005 * end.soil);
}

// The guided wheel holds the mean slip, the free one swings about it. Pull bends with slip, so that over 19 packings
// the guided one pulls 0.32 +- 0.10 N more, 1.6 % of the load.
TEST_F(SlowFreeDriveOnGrains, PullsWhatTheGuidedWheelPullsAtItsSlip) {
  const double drawbar = 2;
  Drive drive = even_drive(0, drawbar, 6);
  const GrainDriveRecord record = run(drive);
  ASSERT_EQ(record.end, DriveEnd::bed_ends);
  ASSERT_TRUE(record.steady.has_value()) << record.not_steady;
  const SteadyDrive& free = *record.steady;
  EXPECT_NEAR(free.forward.value, drawbar, 3 * free.forward.std_error + 0.02 * load);

  OperatingCondition at;
  at.load = load, at.slip = free.slip.value, at.speed = free.speed.value;
  Rig rig = small_rig();
  rig.mass = carried_mass;
  const WheelRun guided = run_wheel({bed(), small_wheel(), bed().recipe.soil.grain_tire, rig}, at, with_threads(1));
  const Estimate& pull = guided.result.drawbar_pull;
  EXPECT_NEAR(pull.value, drawbar, 3 * std::hypot(pull.std_error, free.forward.std_error) + 0.016 * load);
  const Estimate& torque = guided.result.torque;
  EXPECT_NEAR(torque.value, free.torque.value, 3 * std::hypot(torque.std_error, free.torque.std_error));
}

TEST_F(SlowFreeDriveOnGrains, IsStuckWhereTheSlopeIsTooSteep) {
  Drive drive = even_drive(0, 0, 30);
  Waypoint up;
  up.at = 0.5, up.longitudinal_incline = 40 * degree;
  drive.profile.push_back(up);
  const GrainDriveRecord record = run(drive);
  EXPECT_TRUE(record.end == DriveEnd::stuck || record.end == DriveEnd::buried) << word_of(record.end);
  const GrainDriveSample& end = record.samples.back();
  EXPECT_EQ(end.time, record.end_time);
  EXPECT_GT(end.travelled, 0.05);
  EXPECT_LT(end.travelled, 0.5);
  EXPECT_LT(end.longitudinal_incline, 40 * degree);
  EXPECT_GT(*end.slip, 0.9);
  EXPECT_FALSE(record.steady.has_value());
  EXPECT_THAT(record.not_steady, testing::HasSubstr(std::string(word_of(record.end))));
}

TEST_F(SlowFreeDriveOnGrains, ArrivesToTheStepAndHasTheSameBitsOnTwoThreads) {
  Drive drive = even_drive(3 * degree, 0.5, 3);
  drive.distance = 0.03;
  const GrainDriveRecord one = run(drive), two = run(drive, small_rig(), 200, 2);
  ASSERT_EQ(one.end, DriveEnd::arrived);
  EXPECT_FALSE(one.samples.front().slip.has_value()) << "it stands on its brake";
  EXPECT_GE(one.samples.back().travelled, 0.03);
  EXPECT_LT(one.samples.back().travelled, 0.03 + 0.4 * bed().setup.numerics.dt);
  ASSERT_EQ(one.samples.size(), two.samples.size());
  for (std::size_t k = 0; k < one.samples.size(); ++k) {
    EXPECT_EQ(one.samples[k].travelled, two.samples[k].travelled);
    EXPECT_EQ(one.samples[k].torque, two.samples[k].torque);
    EXPECT_EQ(one.samples[k].energy.soil, two.samples[k].energy.soil);
  }
}

TEST_F(SlowFreeDriveOnGrains, AWeakMotorReachesItsHighestTorqueAndStays) {
  Drive drive = even_drive(0, 0, 2);
  drive.controller.highest_torque = 0.2;
  const GrainDriveRecord record = run(drive);
  ASSERT_FALSE(record.happenings.empty());
  EXPECT_EQ(record.happenings.front().what, DriveEvent::torque_limit);
  for (const GrainDriveSample& s : record.samples) EXPECT_LE(s.torque, 0.2 + 1e-12);
}

TEST_F(SlowFreeDriveOnGrains, StopsWhenAskedAndSaysWhatItCannotHold) {
  WorkOptions how = with_threads(1);
  std::stop_source source;
  source.request_stop();
  how.stop = source.get_token();
  EXPECT_THROW(
      drive_freely({bed(), small_wheel(), bed().recipe.soil.grain_tire, small_rig()}, even_drive(0, 0, 1), 10, how),
      Stopped);
  Rig patient = small_rig();
  patient.lowering = 0.5;
  EXPECT_THROW(run(even_drive(50 * degree, 0, 1), patient), NoSolution) << "steeper than the grains' own slope";
  Drive weak = even_drive(8 * degree, 0, 1);
  weak.controller.highest_torque = 0.01;
  EXPECT_THROW(run(weak), NoSolution);
}

TEST(FreeDrive, RefusesWhatTheBinCannotDo) {
  Drive drive = even_drive(0, 0, 1);
  EXPECT_NO_THROW(check_drive(drive));
  drive.pass = 2;
  EXPECT_THROW(check_drive(drive), InputError);
  drive.pass = 1;
  Waypoint later;
  later.at = 1, later.yaw = 5 * degree;
  drive.profile.push_back(later);
  EXPECT_THROW(check_drive(drive), InputError);
  drive.profile.front().yaw = 5 * degree;
  EXPECT_NO_THROW(check_drive(drive));
  drive.profile.back().soil = Soil{};
  EXPECT_THROW(check_drive(drive), InputError);
}

TEST(FreeDrive, NeedsABedForItsWay) {
  Drive drive = even_drive(0, 0, 1);
  EXPECT_EQ(bed_length_for(drive, small_rig()), 0);
  drive.distance = 1.5;
  EXPECT_DOUBLE_EQ(bed_length_for(drive, small_rig()), 0.12 + 1.5 + 0.12);
}

}  // namespace
}  // namespace soilbin::dem
