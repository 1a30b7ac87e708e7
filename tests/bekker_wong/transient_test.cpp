// A wheel driven in time: its steady state is the static model, its energy adds up, and it stops where it must.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bekker_wong/drive_fixture.hpp"
#include "bekker_wong/limits.hpp"
#include "scenario/drive_way.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::bekker_wong {
namespace {

using namespace rover;

/// Drawbar pull that the static wheel lacks at the slip of the drive's end [N].
double steady_error(const Drive& d, int nodes) {
  const DriveRecord record = drive_wheel(scenario(), d, 20, {.nodes = nodes, .relative_tolerance = 1e-9});
  const DriveSample& end = record.samples.back();
  return steady(scenario(), d, end).reading.drawbar_pull - end.drawbar;
}

TEST(SlowTransient, SteadyStateIsTheStaticWheelUphillAndPulling) {
  for (const Drive& d : {drive(), drive(3 * degree), drive(-6 * degree), drive(0.0, 3.0)}) {
    SCOPED_TRACE(testing::Message() << d.profile[0].longitudinal_incline / degree << " deg, " << d.profile[0].drawbar
                                    << " N");
    const DriveRecord record = drive_wheel(scenario(), d, 20, fine);
    ASSERT_EQ(record.end, DriveEnd::time_is_up);
    const DriveSample& end = record.samples.back();
    const RolledWheel wheel = steady(scenario(), d, end);
    EXPECT_NEAR(wheel.reading.drawbar_pull, d.profile[0].drawbar, 2e-5 * load);
    EXPECT_NEAR(end.torque, wheel.reading.torque, 2e-5 * load * 0.09);
    EXPECT_NEAR(end.sinkage, wheel.reading.sinkage, 1e-5 * 0.09);
    EXPECT_NEAR(end.contact_slip, *end.slip, 1e-4) << "what the soil has seen is the slip of now";
  }
}

// The differences are of third order: halving the nodes' distance leaves an eighth of the error.
TEST(SlowTransient, SteadyErrorFallsWithTheCubeOfTheNodes) {
  const double coarse = steady_error(drive(0.0, 0.0, 20), 8), middle = steady_error(drive(0.0, 0.0, 20), 16),
               finest = steady_error(drive(0.0, 0.0, 20), 32);
  EXPECT_NEAR(coarse / middle, 8.0, 2.0);
  EXPECT_NEAR(middle / finest, 8.0, 2.0);
  EXPECT_LT(std::abs(finest), 5e-6 * load);
}

TEST(Transient, EnergyAddsUpAtEveryTime) {
  Drive d = drive(0.0, 2.0, 6.0);
  Waypoint up;
  up.at = 0.1, up.longitudinal_incline = 4 * degree, up.drawbar = 1.0;
  d.profile.push_back(up);
  for (const double tolerance : {1e-6, 1e-8}) {
    const DriveRecord record = drive_wheel(scenario(), d, 30, {.nodes = 32, .relative_tolerance = tolerance});
    const double work = record.samples.back().energy.motor;
    ASSERT_GT(work, 1.0);
    for (const DriveSample& s : record.samples)
      EXPECT_LT(std::abs(s.energy.unaccounted()), 10 * tolerance * work) << "at " << s.time << " s";
    EXPECT_GT(record.samples.back().energy.compaction, 0.1 * work);
    EXPECT_GT(record.samples.back().energy.shear, 0.1 * work);
  }
}

// Downhill a wheel brakes a little: its tread slides back, then forward again, and Janosi's stress goes back as it
// came, at a pressure that has grown. So the shear as a whole may give energy, as under the steady wheel. The soil
// never does, and what is given back stays below 1 % of what presses it.
TEST(Transient, ABrakedWheelsSoilTakesEnergyThoughItsShearGivesALittleBack) {
  Scenario s = scenario();
  s.tire.radius = 0.11, s.tire.width = 0.10;
  double worst = 0.0;
  for (const double slope : {-2.0, -5.0, -8.0, -10.0, -12.0, -15.0}) {
    const Drive d = drive(slope * degree);
    const DriveRecord record = drive_wheel(s, d);
    const DriveSample &middle = record.samples[record.samples.size() / 2], &end = record.samples.back();
    const double shear = end.energy.shear - middle.energy.shear,
                 compaction = end.energy.compaction - middle.energy.compaction;
    EXPECT_GT(shear + compaction, 0.0) << slope;
    EXPECT_NEAR(end.energy.unaccounted(), 0.0, 1e-4 * end.energy.compaction) << slope;
    // the steady wheel's own: M w - F v, less what presses the soil
    const RolledWheel wheel = steady(s, d, end);
    const double power = wheel.forces.torque * end.rim_speed / s.tire.radius - wheel.forces.thrust * end.speed;
    EXPECT_NEAR(shear / (end.time - middle.time), power, 1e-3 * compaction / (end.time - middle.time)) << slope;
    worst = std::min(worst, shear / compaction);
  }
  EXPECT_LT(worst, 0.0);  // it does give back
  EXPECT_GT(worst, -0.01);
}

TEST(Transient, RefusesWhatACaseMayNotHold) {
  Scenario with_effect = scenario();
  with_effect.effects.push_back({.id = "slip_sinkage", .form = "lyasko", .parameters = {}});
  EXPECT_THROW(drive_wheel(with_effect, drive(), 20), InputError) << "a drive has effects of its own";
  Drive heavy = drive(), unsorted = drive();
  heavy.inertia = -1.0;
  unsorted.profile = {{.at = 2}, {.at = 1}};
  for (const Drive& wrong : {heavy, unsorted}) EXPECT_THROW(drive_wheel(scenario(), wrong, 20), InputError);
  EXPECT_THROW(drive_wheel(scenario(), drive(), -3), InputError);
}

// Under the Moon's gravity the same load is six times the mass; on one way there is one gravity.
TEST(Transient, MassIsTheLoadOverTheSoilsGravity) {
  Scenario moon = scenario();
  moon.soil.semi_empirical->gravity = 1.62;
  Drive heavy = drive(0.0, 0.0, 2.0);
  heavy.mass = load / 1.62;
  const DriveRecord there = drive_wheel(moon, drive(0.0, 0.0, 2.0), 20), here = drive_wheel(scenario(), heavy, 20);
  EXPECT_EQ(there.samples.back().travelled, here.samples.back().travelled);
  EXPECT_LT(there.samples[2].speed, drive_wheel(scenario(), drive(0.0, 0.0, 2.0), 20).samples[2].speed);
  Drive two = drive();
  two.profile.push_back({.at = 0.5, .soil = dry_sand()});
  EXPECT_THROW(drive_wheel(moon, two, 20), InputError);
}

// Steady power by hand: M w = F_DP v + what presses the soil, -F_c v, + what shears it, the rest.
TEST(Transient, PowerOfCompactionIsResistanceTimesSpeed) {
  const DriveRecord record = drive_wheel(scenario(), drive(), 300);
  const DriveSample &a = record.samples[240], &b = record.samples[300];
  const RolledWheel wheel = steady(scenario(), drive(), b);
  const double way = b.travelled - a.travelled;
  EXPECT_NEAR((b.energy.compaction - a.energy.compaction) / way, -wheel.forces.compaction,
              1e-3 * -wheel.forces.compaction);
}

TEST(Transient, StartsFromRestWithoutAJump) {
  Drive d = drive(0.0, 0.0, 3.0);
  d.controller = {.torque = 1.6, .ramp = 2.0};
  const DriveRecord record = drive_wheel(scenario(), d, 600);
  const DriveSample& first = record.samples.front();
  EXPECT_EQ(first.speed, 0.0);
  EXPECT_EQ(first.forward, 0.0) << "a standing wheel presses the soil evenly before and behind the axle";
  EXPECT_EQ(first.torque, 0.0);
  for (std::size_t i = 1; i < record.samples.size(); ++i) {
    const DriveSample &a = record.samples[i - 1], &b = record.samples[i];
    // No force on the wheel jumps: in 5 ms the acceleration changes by less than a hundredth of gravity.
    EXPECT_LT(std::abs(b.forward - a.forward) / mass, 0.1) << "at " << b.time << " s";
    EXPECT_GE(b.travelled, a.travelled - 1e-9);
  }
  EXPECT_GT(record.samples.back().travelled, 0.01);
}

TEST(Transient, HeldOnASlopeAWheelStaysUntilItIsDriven) {
  Drive d = drive(8 * degree, 0.0, 3.0);
  d.controller.ramp = 1e6;  // the setpoint never comes
  const DriveRecord record = drive_wheel(scenario(), d, 30);
  for (const DriveSample& s : record.samples) {
    EXPECT_NEAR(s.travelled, 0.0, 1e-6);
    EXPECT_NEAR(s.forward, load * std::sin(8 * degree), 1e-4 * load);
  }
}

TEST(SlowTransient, ClimbsBelowTheSteepestSlopeAtTheStaticSlipAndSticksAbove) {
  const Scenario s = scenario();
  const RollingWheel wheel(s.tire, values_of(*s.soil.semi_empirical));
  OperatingCondition at;
  at.load = load;
  const double steepest = steepest_slope(wheel, at).value();
  at.longitudinal_incline = steepest - 2 * degree;
  const Drive below = drive(steepest - 2 * degree, 0.0, 25.0), above = drive(steepest + 0.5 * degree, 0.0, 60.0);
  const DriveRecord climbs = drive_wheel(s, below, 20);
  EXPECT_EQ(climbs.end, DriveEnd::time_is_up);
  EXPECT_NEAR(climbs.samples.back().slip.value(), slip_for_pull(wheel, at).value(), 2e-3);
  EXPECT_EQ(drive_wheel(s, above, 20).end, DriveEnd::stuck);
}

// The mean speed obeys its own little equation, dm/dt = (v - m)/(1 s) from the ramp's end on, and starts at 20 times
// the speed that counts as stuck. Followed by hand through the recorded speeds it crosses where the root was found.
TEST(Transient, StuckIsFoundWhereTheMeanSpeedSaysSo) {
  const Drive d = drive(10 * degree, 0.0, 12.0);
  const DriveRecord record = drive_wheel(scenario(), d, 12000);
  ASSERT_EQ(record.end, DriveEnd::stuck);
  double mean = 20 * d.stuck_speed, crossed = 0.0;
  for (std::size_t i = 1; i + 1 < record.samples.size(); ++i) {
    const DriveSample &a = record.samples[i - 1], &b = record.samples[i];
    if (a.time < 1.0 - 1e-9) continue;
    const double h = b.time - a.time;
    mean = (mean * (1 - h / 2) + h * (a.speed + b.speed) / 2) / (1 + h / 2);
    if (mean < d.stuck_speed && crossed == 0.0) crossed = b.time;
  }
  if (crossed == 0.0) crossed = record.samples.back().time;
  EXPECT_NEAR(record.end_time, crossed, 2e-3);
}

TEST(Transient, AWheelThatNeverStartsIsStuckAfterItsGrace) {
  Drive d = drive(0.0, 0.0, 20.0);
  d.controller = {.torque = 0.05, .ramp = 1.0};
  const DriveRecord record = drive_wheel(scenario(), d, 20);
  EXPECT_EQ(record.end, DriveEnd::stuck);
  EXPECT_NEAR(record.end_time, 1.0 + std::log(20.0), 0.1) << "20 times the stuck speed, falling by e a second";
}

TEST(Transient, ArrivesWhereItWasSent) {
  Drive d = drive();
  d.distance = 0.2;
  const DriveRecord record = drive_wheel(scenario(), d, 20);
  EXPECT_EQ(record.end, DriveEnd::arrived);
  EXPECT_NEAR(record.samples.back().travelled, 0.2, 1e-7);
  EXPECT_LT(record.end_time, 15.0);
}

TEST(Transient, AMotorAtItsLimitGivesThatAndNoMore) {
  Drive d = drive(0.0, 0.0, 60.0);
  d.controller.highest_torque = 1.2;  // less than the 1.64 N m of steady travel
  const DriveRecord record = drive_wheel(scenario(), d, 200);
  ASSERT_FALSE(record.happenings.empty());
  EXPECT_EQ(record.happenings.front().what, DriveEvent::torque_limit);
  for (const DriveSample& s : record.samples) EXPECT_LE(s.torque, 1.2 + 1e-6);
  EXPECT_EQ(record.end, DriveEnd::stuck);
}

TEST(Transient, AStrongMotorIsHeldAtItsHighestSpeed) {
  Drive d = drive(0.0, 0.0, 10.0);
  d.controller = {.torque = 3.0, .highest_rim_speed = 0.05, .ramp = 1.0};
  const DriveRecord record = drive_wheel(scenario(), d, 50);
  ASSERT_FALSE(record.happenings.empty());
  EXPECT_EQ(record.happenings.front().what, DriveEvent::speed_limit);
  EXPECT_NEAR(record.samples.back().rim_speed, 0.05, 1e-5);
}

// Over a crest of curvature k the ground's axes turn: at m v^2 |k| > W cos(alpha) nothing holds the wheel down.
TEST(Transient, OverASharpCrestAFastWheelLifts) {
  // k = -30 deg/0.2 m = -2.6 per metre: v^2 k is 5.9 m/s^2 at 1.5 m/s and 24 m/s^2 at 3 m/s.
  for (const double rim : {1.5, 4.2}) {
    Drive d = drive(0.0, 0.0, 12.0);
    d.controller = {.rim_speed = rim, .ramp = 1.0};
    d.distance = 9.0;
    Waypoint crest, beyond;
    crest.at = 8.0, beyond.at = 8.2, beyond.longitudinal_incline = -30 * degree;
    d.profile = {Waypoint{}, crest, beyond};
    const DriveRecord record = drive_wheel(scenario(), d, 1000);
    const auto happened = [&](DriveEvent what) {
      return std::any_of(record.happenings.begin(), record.happenings.end(),
                         [&](const DriveHappening& h) { return h.what == what; });
    };
    const auto at_crest = std::find_if(record.samples.begin(), record.samples.end(),
                                       [](const DriveSample& s) { return s.travelled >= 8.0; });
    ASSERT_NE(at_crest, record.samples.end());
    const double pull_away = at_crest->speed * at_crest->speed * 30 * degree / 0.2;
    SCOPED_TRACE(testing::Message() << at_crest->speed << " m/s at the crest");
    EXPECT_EQ(pull_away > 1.5 * 9.81, rim > 2.0);
    EXPECT_EQ(happened(DriveEvent::lifts), pull_away > 9.81);
    EXPECT_LT(std::abs(record.samples.back().energy.unaccounted()), 1e-4 * record.samples.back().energy.motor);
  }
}

TEST(Transient, YawAndCrossSlopeEndInTheStaticWheelToo) {
  Drive d = drive(0.0, 0.0, 12.0);
  d.profile[0].yaw = 10 * degree, d.profile[0].transverse_incline = 5 * degree;
  const DriveRecord record = drive_wheel(scenario(), d, 20, {.nodes = 48, .relative_tolerance = 1e-8});
  const DriveSample& end = record.samples.back();
  const RolledWheel wheel = steady(scenario(), d, end);
  EXPECT_NEAR(wheel.reading.drawbar_pull, 0.0, 1e-4 * load);
  EXPECT_NEAR(end.lateral, wheel.reading.lateral_force, 1e-4 * load);
  EXPECT_NEAR(end.torque, wheel.reading.torque, 1e-4 * load * 0.09);
}

TEST(Transient, ANewSoilUnderTheWheelIsTheStaticWheelThere) {
  Drive d = drive(0.0, 0.0, 15.0);
  Soil firm = dry_sand();
  firm.semi_empirical->k_phi.value *= 3, firm.semi_empirical->friction_angle.value = 35 * degree;
  Waypoint there;
  there.at = 0.15, there.soil = firm;
  d.profile.push_back(there);
  const DriveRecord record = drive_wheel(scenario(), d, 20, {.nodes = 48, .relative_tolerance = 1e-8});
  Scenario on_firm = scenario();
  on_firm.soil = firm;
  const DriveSample& end = record.samples.back();
  EXPECT_NEAR(steady(on_firm, d, end).reading.drawbar_pull, 0.0, 1e-4 * load);
  EXPECT_NEAR(steady(on_firm, d, end).reading.sinkage, end.sinkage, 1e-4 * 0.09);
  EXPECT_LT(std::abs(end.energy.unaccounted()), 1e-6 * end.energy.motor);
}

TEST(Transient, ASoilThatBeginsAtZeroIsUnderTheWholeWheel) {
  Scenario firmer = scenario();
  firmer.soil.semi_empirical->k_phi.value *= 5;
  Drive d = drive(0.0, 0.0, 3.0);
  const DriveRecord on_sand = drive_wheel(scenario(), d, 20);
  d.profile.front().soil = dry_sand();
  const DriveRecord from_zero = drive_wheel(firmer, d, 20);
  for (std::size_t k = 0; k < on_sand.samples.size(); ++k) {
    EXPECT_EQ(from_zero.samples[k].sinkage, on_sand.samples[k].sinkage) << k;
    EXPECT_EQ(from_zero.samples[k].travelled, on_sand.samples[k].travelled) << k;
  }
}

// A strip of soil that is shorter than the contact's passage from one soil to the next, a radius: what each soil bears
// changes evenly all the same.
TEST(Transient, SoilsCloserThanARadiusTakeOverWithoutAJump) {
  std::vector<Waypoint> points(2);
  points[0].at = 1.0, points[0].soil = dry_sand(), points[1].at = 1.1, points[1].soil = dry_sand();
  constexpr double radius = 0.25, step = 1e-3;
  const Way way(points, radius);
  const auto weights = [&](double x) {
    const Place place = way.at(x);
    std::array<double, 3> all{};
    all[place.soil] = 1.0;
    for (std::size_t next = place.soil + 1; next <= place.last_soil; ++next) {
      const double share = way.share(next, x);
      for (double& weight : all) weight *= 1 - share;
      all[next] += share;
    }
    return all;
  };
  for (double x = 0.8; x < 1.3; x += step)
    for (std::size_t soil = 0; soil < 3; ++soil)
      EXPECT_NEAR(weights(x)[soil], weights(x - step)[soil], 2.01 * step / radius) << x;
  EXPECT_EQ(weights(0.8)[0], 1.0);
  EXPECT_EQ(weights(1.3)[2], 1.0);
}

TEST(Transient, RefusesWhatItCannotAnswer) {
  Drive d = drive();
  d.effects = {{"slip_sinkage", "lyasko", {}}};
  EXPECT_THAT(soilbin::test::refusal([&] { drive_wheel(scenario(), d); }),
              testing::HasSubstr("slip_sinkage (lyasko): it moves the wheel after the balance"));
  EXPECT_THROW(drive_wheel(scenario(), drive(40 * degree)), NoSolution) << "it slides down before it is driven";
  Scenario bare = scenario();
  bare.soil.semi_empirical.reset();
  EXPECT_THROW(drive_wheel(bare, drive()), InputError);
}

}  // namespace
}  // namespace soilbin::bekker_wong
