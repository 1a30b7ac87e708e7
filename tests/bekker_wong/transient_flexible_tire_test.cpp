// A tire that flattens, driven in time: its steady state is the static wheel's, its sinkage leaves out the deflection,
// and the carcass keeps an account of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/drive_fixture.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double truck_load = 37.5e3;

/// A truck's tire of 150 kPa on sandy loam (Wong's table, K, c1 and c2 chosen).
Scenario truck() {
  Scenario s;
  s.tire.radius = 0.67, s.tire.width = 0.43;
  s.tire.inflation_pressure = 150e3, s.tire.carcass_pressure = Estimate{20e3, 0.0};
  s.soil.name = "sandy-loam";
  s.soil.semi_empirical = SemiEmpiricalSoil{.exponent = {0.7, 0},
                                            .k_c = {5270, 0},
                                            .k_phi = {1515.04e3, 0},
                                            .cohesion = {1720, 0},
                                            .friction_angle = {29 * degree, 0},
                                            .shear_modulus = {0.02, 0},
                                            .stress_angle_c1 = {0.18, 0},
                                            .stress_angle_c2 = {0.32, 0},
                                            .density = 1550};
  return s;
}

Drive truck_drive(std::vector<EffectChoice> effects, double slope = 0.0, double drawbar = 0.0, double yaw = 0.0) {
  Drive d;
  d.load = truck_load, d.duration = 15.0, d.controller.rim_speed = 1.0;
  Waypoint start;
  start.longitudinal_incline = slope, start.drawbar = drawbar, start.yaw = yaw;
  d.profile = {start};
  d.effects = std::move(effects);
  return d;
}

EffectChoice flexible(const std::string& form) { return {"tire_flexibility", form, {}}; }

TEST(SlowTransientFlexibleTire, EndsInItsStaticWheel) {
  const EffectChoice slips_in{"slip_sinkage", "ding", {}}, firmer{"moisture", "stiffness", {}},
      lugs{"lug_thrust", "shear_radius", {}};
  const std::vector<std::vector<EffectChoice>> all = {{flexible("flat_section")},
                                                      {flexible("carcass_spring")},
                                                      {flexible("flat_section"), slips_in},
                                                      {slips_in, flexible("carcass_spring")},
                                                      {flexible("flat_section"), lugs, firmer}};
  for (const auto& effects : all)
    for (const Drive& d : {truck_drive(effects), truck_drive(effects, 8 * degree), truck_drive(effects, 0.0, 8e3),
                           truck_drive(effects, -4 * degree, 0.0, 4 * degree)}) {
      SCOPED_TRACE(testing::Message() << effects.front().form << " and " << effects.size() - 1 << " more, "
                                      << d.profile[0].longitudinal_incline / degree << " deg, " << d.profile[0].drawbar
                                      << " N");
      const DriveRecord record = drive_wheel(truck(), d, 20, {.nodes = 32, .relative_tolerance = 1e-7});
      ASSERT_EQ(record.end, DriveEnd::time_is_up);
      const DriveSample& end = record.samples.back();
      const RolledWheel wheel = rover::steady(truck(), d, end);
      ASSERT_GT(wheel.patch.deflection, 0.02);
      EXPECT_NEAR(wheel.reading.drawbar_pull, d.profile[0].drawbar, 3e-4 * truck_load);
      EXPECT_NEAR(end.torque, wheel.reading.torque, 3e-4 * truck_load * 0.67);
      EXPECT_NEAR(end.sinkage, wheel.reading.sinkage, 2e-5 * 0.67);
      EXPECT_NEAR(end.contact_slip, *end.slip, 1e-4);
    }
}

TEST(TransientFlexibleTire, EnergyAddsUpAtEveryTimeWithWhatTheCarcassHolds) {
  Drive d = truck_drive({flexible("flat_section")}, 0.0, 4e3);
  Waypoint up;
  up.at = 2.0, up.longitudinal_incline = 5 * degree;
  d.profile.push_back(up);
  const DriveRecord record = drive_wheel(truck(), d, 60);
  const double work = record.samples.back().energy.motor;
  double most = 0.0;
  for (const DriveSample& s : record.samples) {
    EXPECT_LT(std::abs(s.energy.unaccounted()), 1e-5 * work) << "at " << s.time << " s";
    most = std::max(most, std::abs(s.energy.carcass));
  }
  EXPECT_GT(most, 1e-5 * work) << "the wheel rises when it begins to roll, and the carcass flexes otherwise";
  EXPECT_LT(most, truck_load * 0.05) << "the load over the deflection is the most that a carcass can hold";
  EXPECT_NEAR(record.samples.back().energy.carcass, record.samples[50].energy.carcass, 1e-6 * work) << "steady";
}

TEST(TransientFlexibleTire, PullsFromRestWhatTheRigidWheelCannot) {
  const double drawbar = 12e3;  // at 20 % slip the rigid wheel pulls 8.1 kN, the flexible one 17.1 kN
  const DriveRecord flexing = drive_wheel(truck(), truck_drive({flexible("flat_section")}, 0.0, drawbar)),
                    rigid = drive_wheel(truck(), truck_drive({}, 0.0, drawbar));
  EXPECT_EQ(flexing.end, DriveEnd::time_is_up);
  EXPECT_NE(rigid.end, DriveEnd::time_is_up);
  EXPECT_LT(flexing.samples.front().sinkage, 0.6 * rigid.samples.front().sinkage) << "at rest it sinks less, too";
}

TEST(TransientFlexibleTire, OfAlmostNoSoftnessIsTheRigidWheel) {
  Scenario hard = truck();
  hard.tire.inflation_pressure = 20e6;
  const DriveSample stiff = drive_wheel(hard, truck_drive({flexible("flat_section")})).samples.back(),
                    rigid = drive_wheel(hard, truck_drive({})).samples.back();
  EXPECT_NEAR(stiff.travelled, rigid.travelled, 1e-5);
  EXPECT_NEAR(stiff.torque, rigid.torque, 1e-4 * rigid.torque);
  EXPECT_NEAR(stiff.sinkage, rigid.sinkage, 1e-6);
}

TEST(TransientFlexibleTire, ThatIsCrushedIsNoWeakSoil) {
  Scenario flat = truck();
  flat.tire.inflation_pressure = 10e3, flat.tire.carcass_pressure.reset();
  EXPECT_THAT(soilbin::test::refusal<NoSolution>([&] { drive_wheel(flat, truck_drive({flexible("flat_section")})); }),
              testing::HasSubstr("the tire is crushed before the soil gives way"));
}

// The larger circle of Schmid's form has no rim that the shear displacement could be followed along.
TEST(TransientFlexibleTire, AsALargerCircleIsRefusedWithTheFormToTake) {
  EXPECT_THAT(soilbin::test::refusal([&] { drive_wheel(truck(), truck_drive({flexible("substitute_circle")})); }),
              testing::HasSubstr("write {id: tire_flexibility, form: flat_section}"));
}

}  // namespace
}  // namespace soilbin::bekker_wong
