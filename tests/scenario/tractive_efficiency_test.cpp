#include "scenario/tractive_efficiency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenario/yawed_frames.hpp"

namespace soilbin {
namespace {

constexpr double degree_in_radians = std::numbers::pi / 180;

/// 300 N at 0.5 m/s out; 600 N m at 1 rad/s in, of a wheel of 0.625 m radius at 20 % slip.
TractionResult pulling_wheel() {
  TractionResult r;
  r.at.load = 2000, r.at.slip = 0.2;
  r.drawbar_pull = {300, 30}, r.torque = {600, 30}, r.lateral_force = {50, 20};
  r.tractive_efficiency = tractive_efficiency(r, 0.625);
  return r;
}

TEST(TractiveEfficiency, IsPowerOutOverPowerInOnLevelGround) {
  EXPECT_NEAR(pulling_wheel().tractive_efficiency, 300 * 0.5 / (600 * 1.0), 1e-15);
}

TEST(TractiveEfficiency, UphillThePullIsLessTheSlopesShareAndTheMotorAlonePutsIn) {
  TractionResult r = pulling_wheel();
  r.at.longitudinal_incline = 30 * degree_in_radians;
  EXPECT_NEAR(tractive_efficiency(r, 0.625), 300 * 0.5 / 600, 1e-15);
}

TEST(TractiveEfficiency, DownhillGravityPutsInToo) {
  TractionResult r = pulling_wheel();
  r.at.longitudinal_incline = -30 * degree_in_radians;  // pulls with 1000 N at 0.5 m/s: 500 W beside the motor's 600 W
  r.drawbar_pull.value = 1300;
  EXPECT_NEAR(tractive_efficiency(r, 0.625), 1300 * 0.5 / (600 + 500), 1e-12);
  EXPECT_LT(tractive_efficiency(r, 0.625), 1300 * 0.5 / 600) << "which would be 108 %";
}

TEST(TractiveEfficiency, CrossSlopesDoNoWorkAlongTravel) {
  TractionResult r = pulling_wheel();
  r.at.transverse_incline = -40 * degree_in_radians;
  EXPECT_NEAR(tractive_efficiency(r, 0.625), 0.25, 1e-15);
}

TEST(TractiveEfficiency, IsTheSameInBothFramesAndByBothSlips) {
  for (const double incline : {-0.2, 0.0, 0.2}) {
    TractionResult travel = pulling_wheel();
    travel.at.yaw = 0.5, travel.at.longitudinal_incline = incline;
    travel.tractive_efficiency = tractive_efficiency(travel, 0.625);
    TractionResult wheel = travel;
    const GroundForce force = turned({300, 50}, 0.5, ForceFrame::travel, ForceFrame::wheel);
    wheel.at.force_frame = ForceFrame::wheel;
    wheel.drawbar_pull.value = force.forward, wheel.lateral_force.value = force.left;
    wheel.tractive_efficiency = tractive_efficiency(wheel, 0.625);
    EXPECT_NEAR(wheel.tractive_efficiency, travel.tractive_efficiency, 1e-14);
    EXPECT_NEAR(mean_efficiency({&wheel, &travel}), travel.tractive_efficiency, 1e-14);
    TractionResult by_travel = travel;
    by_travel.at.slip = slip_by(0.2, 0.5, SlipBy::wheel_plane_speed, SlipBy::travel_speed);
    by_travel.at.slip_by = SlipBy::travel_speed;
    EXPECT_NEAR(tractive_efficiency(by_travel, 0.625), travel.tractive_efficiency, 1e-14);
  }
}

TEST(TractiveEfficiency, IsToldOnlyWhereItIsAShareOfThePowerPutIn) {
  TractionResult r = pulling_wheel();
  EXPECT_TRUE(has_efficiency(r));
  EXPECT_EQ(why_no_efficiency(r), "");
  r.drawbar_pull.value = -300;
  r.tractive_efficiency = tractive_efficiency(r, 0.625);
  EXPECT_NEAR(r.tractive_efficiency, -0.25, 1e-15) << "the bare ratio of a wheel that is pushed";
  EXPECT_TRUE(std::isnan(reported_efficiency(r)));
  r = pulling_wheel();
  r.drawbar_pull.value = 1500;
  r.tractive_efficiency = tractive_efficiency(r, 0.625);
  EXPECT_TRUE(std::isnan(reported_efficiency(r))) << "1.25 of what is put in";
  EXPECT_EQ(why_no_efficiency(r), "more power would come out than is put in");
  r.torque.value = -600;
  EXPECT_TRUE(std::isnan(tractive_efficiency(r, 0.625))) << "braked: nothing is put in";
  r = pulling_wheel(), r.at.slip = -1;
  EXPECT_TRUE(std::isnan(tractive_efficiency(r, 0.625))) << "locked";
  EXPECT_EQ(tractive_efficiency(
                [] {
                  auto spun = pulling_wheel();
                  spun.at.slip = 1;
                  return spun;
                }(),
                0.625),
            0.0);
}

// The error by small changes of each force and of the torque, downhill and in the wheel's axes.
TEST(TractiveEfficiency, HasTheErrorsOfForcesAndTorque) {
  TractionResult r = pulling_wheel();
  r.at.yaw = 0.4, r.at.longitudinal_incline = -0.1, r.at.force_frame = ForceFrame::wheel;
  r.tractive_efficiency = tractive_efficiency(r, 0.625);
  const auto change = [&](Estimate TractionResult::*channel) {
    TractionResult up = r, down = r;
    const double h = 1e-4 * (r.*channel).value;
    (up.*channel).value += h, (down.*channel).value -= h;
    return (tractive_efficiency(up, 0.625) - tractive_efficiency(down, 0.625)) / (2 * h) * (r.*channel).std_error;
  };
  const double expected = std::hypot(change(&TractionResult::drawbar_pull), change(&TractionResult::lateral_force),
                                     change(&TractionResult::torque));
  EXPECT_NEAR(efficiency_with_error(r).std_error, expected, 1e-8);
}

TEST(TractiveEfficiency, OfSeveralRunsIsAllPowerOutOverAllPowerIn) {
  TractionResult a = pulling_wheel(), b = pulling_wheel();
  b.drawbar_pull.value = -100, b.torque.value = 200;
  b.tractive_efficiency = tractive_efficiency(b, 0.625);
  EXPECT_NEAR(mean_efficiency({&a, &b}), (300 - 100) * 0.5 / (600 + 200), 1e-15);
}

}  // namespace
}  // namespace soilbin
