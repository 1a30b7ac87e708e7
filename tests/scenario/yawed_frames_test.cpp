#include "scenario/yawed_frames.hpp"

#include <gtest/gtest.h>

#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin {
namespace {

constexpr SlipBy by_plane = SlipBy::wheel_plane_speed, by_travel = SlipBy::travel_speed;

// Slip 0.25 in the plane of a wheel at 60 deg: v cos 60/(r w) = 0.75, so v/(r w) = 1.5, and s = 1/1.5 - 1 = -1/3.
TEST(SlipBy, DiffersByTheCosineOfTheYaw) {
  EXPECT_NEAR(slip_by(0.25, 60 * degree, by_plane, by_travel), -1.0 / 3, 1e-12);
  EXPECT_NEAR(slip_by(-1.0 / 3, 60 * degree, by_travel, by_plane), 0.25, 1e-12);
  for (const double slip : {-0.8, -0.1, 0.0, 0.3, 1.0})
    EXPECT_NEAR(slip_by(slip_by(slip, -0.4, by_plane, by_travel), -0.4, by_travel, by_plane), slip, 1e-12);
}

TEST(SlipBy, IsOneNumberWithoutYawAndForALockedWheel) {
  EXPECT_EQ(slip_by(0.3, 0.0, by_plane, by_travel), 0.3);
  EXPECT_EQ(slip_by(-1.0, 0.5, by_travel, by_plane), -1.0);
  EXPECT_EQ(slip_by(0.3, 90 * degree, by_travel, by_plane), 1.0) << "a wheel that slides sideways rolls nowhere";
  EXPECT_THROW(slip_by(0.3, 90 * degree, by_plane, by_travel), InputError);
}

// A wheel at 90 deg points to the left: what is left of travel is ahead of the wheel, and what is ahead is to its
// right.
TEST(GroundForce, TurnsWithTheWheel) {
  const GroundForce wheel = turned({3, 4}, 90 * degree, ForceFrame::travel, ForceFrame::wheel);
  EXPECT_NEAR(wheel.forward, 4, 1e-12);
  EXPECT_NEAR(wheel.left, -3, 1e-12);
  const GroundForce back =
      turned(turned({3, 4}, 0.3, ForceFrame::travel, ForceFrame::wheel), 0.3, ForceFrame::wheel, ForceFrame::travel);
  EXPECT_NEAR(back.forward, 3, 1e-12);
  EXPECT_NEAR(back.left, 4, 1e-12);
  EXPECT_EQ(turned({3, 4}, 0.3, ForceFrame::wheel, ForceFrame::wheel).left, 4.0);
}

}  // namespace
}  // namespace soilbin
