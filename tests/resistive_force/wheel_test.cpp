// A wheel by 3D-RFT: balance, scaling, mirror images, energy, derivatives, and how fine its elements have to be.
#include "resistive_force/wheel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "dem/surface/mesh_files.hpp"
#include "dem/surface/shapes.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::resistive_force {
namespace {

Tire smooth() {
  Tire tire;
  tire.radius = 0.0625, tire.width = 0.06;
  return tire;
}

Tire lugged() {
  Tire tire;
  tire.radius = 0.6, tire.width = 0.42;
  tire.lugs = {.height = 0.035, .count = 22, .thickness = 0.04, .pattern = LugPattern::chevron};
  return tire;
}

constexpr Medium sand{.xi_n = 8e5, .surface_friction = 0.5};

Balance balanced(const Tire& tire, const OperatingCondition& at, const Medium& medium = sand) {
  return PushedWheel(tread_elements(tire), tire, at).balance(medium);
}

void expect_forces(const SoilForces& a, const SoilForces& b, double tolerance) {
  EXPECT_NEAR(a.pull, b.pull, tolerance);
  EXPECT_NEAR(a.left, b.left, tolerance);
  EXPECT_NEAR(a.vertical, b.vertical, tolerance);
  EXPECT_NEAR(a.torque, b.torque, tolerance);
}

TEST(PushedWheel, CarriesWhatPressesOnTheGround) {
  const OperatingCondition at{
      .load = 20e3, .slip = 0.2, .longitudinal_incline = 10 * degree, .transverse_incline = 5 * degree};
  EXPECT_NEAR(balanced(lugged(), at).forces.vertical, 20e3 * std::cos(10 * degree) * std::cos(5 * degree), 1e-4);
}

TEST(PushedWheel, HasForcesOfTheStiffnessAtTheSameLoadOverIt) {
  const Balance one = balanced(smooth(), {.load = 80, .slip = 0.2});
  const Balance three =
      balanced(smooth(), {.load = 240, .slip = 0.2}, {.xi_n = 3 * sand.xi_n, .surface_friction = 0.5});
  EXPECT_NEAR(three.sinkage, one.sinkage, 1e-12);
  expect_forces({3 * one.forces.pull, 0, 3 * one.forces.vertical, 3 * one.forces.torque}, three.forces, 1e-8);
}

TEST(PushedWheel, TenTimesAsLargeSinksTenTimesAsDeepUnderAThousandfoldLoad) {
  Tire large = smooth();
  large.radius *= 10, large.width *= 10;
  const Balance one = balanced(smooth(), {.load = 80, .slip = 0.2}), ten = balanced(large, {.load = 80e3, .slip = 0.2});
  EXPECT_NEAR(ten.sinkage, 10 * one.sinkage, 1e-10);
  EXPECT_NEAR(ten.forces.pull, 1e3 * one.forces.pull, 1e-6);
  EXPECT_NEAR(ten.forces.torque, 1e4 * one.forces.torque, 1e-5);
}

TEST(PushedWheel, KnowsNoSpeed) {
  const Balance slow = balanced(smooth(), {.load = 80, .slip = 0.2, .speed = 0.01});
  const Balance fast = balanced(smooth(), {.load = 80, .slip = 0.2, .speed = 10});
  EXPECT_EQ(slow.sinkage, fast.sinkage);
  EXPECT_EQ(slow.forces.pull, fast.forces.pull);
}

TEST(PushedWheel, HasMirrorImages) {
  for (const auto& [yaw, across] : {std::pair{15.0, 0.0}, std::pair{0.0, 10.0}, std::pair{-20.0, 10.0}}) {
    const OperatingCondition at{.load = 80, .slip = 0.2, .transverse_incline = across * degree, .yaw = yaw * degree};
    OperatingCondition image = at;
    image.transverse_incline = -at.transverse_incline, image.yaw = -at.yaw;
    const Balance one = balanced(smooth(), at), other = balanced(smooth(), image);
    EXPECT_NEAR(one.sinkage, other.sinkage, 1e-9 * one.sinkage);
    EXPECT_NEAR(one.forces.left, -other.forces.left, 1e-9);
    EXPECT_NEAR(one.forces.pull, other.forces.pull, 1e-9);
  }
}

TEST(PushedWheel, OnASlopeIsTheWheelOfLevelGroundWithLessGravity) {
  const OperatingCondition level{.load = 80, .slip = 0.2};
  OperatingCondition uphill = level;
  uphill.longitudinal_incline = 15 * degree, uphill.transverse_incline = 5 * degree;
  const double share = std::cos(15 * degree) * std::cos(5 * degree);
  const Balance one = balanced(smooth(), level), other = balanced(smooth(), uphill);
  EXPECT_NEAR(other.sinkage, one.sinkage, 1e-12);
  EXPECT_NEAR(other.forces.pull, share * one.forces.pull, 1e-9);
  EXPECT_NEAR(other.forces.left, 0.0, 1e-9);
}

TEST(PushedWheel, IsPushedToItsLeftWhereItPointsLeft) {
  EXPECT_GT(balanced(smooth(), {.load = 80, .slip = 0.2, .yaw = 15 * degree}).forces.left, 5.0);
}

TEST(SlowPushedWheel, GivesNoMorePowerThanIsPutIn) {
  for (const Tire& tire : {smooth(), lugged()})
    for (double slip : {-0.5, -0.1, 0.0, 0.1, 0.3, 0.6, 0.95})
      for (double yaw : {0.0, 20.0}) {
        const OperatingCondition at{.load = tire.radius < 0.1 ? 15.0 : 8e3, .slip = slip, .yaw = yaw * degree};
        const Balance b = balanced(tire, at);
        const double ratio = (slip >= 0 ? 1 - slip : 1 / (1 + slip)) / std::cos(at.yaw);  // v/(r w)
        EXPECT_GE(b.forces.torque / tire.radius, b.forces.pull * ratio) << slip << " " << yaw;
      }
}

TEST(PushedWheel, PullsMoreWithLugs) {
  Tire bare = lugged();
  bare.lugs = {};
  const OperatingCondition at{.load = 15e3, .slip = 0.3};
  EXPECT_GT(balanced(lugged(), at).forces.pull, balanced(bare, at).forces.pull + 0.05 * at.load);
}

TEST(PushedWheel, IsHeldBackWhereLocked) {
  const Balance locked = balanced(smooth(), {.load = 25, .slip = -1});
  EXPECT_LT(locked.forces.pull, 0.0);
  EXPECT_LT(locked.forces.torque, 0.0);
}

TEST(PushedWheel, ChangesWithXiNAsItsSlopesSay) {
  const Tire tire = lugged();
  const OperatingCondition at{.load = 15e3, .slip = 0.3, .longitudinal_incline = 8 * degree, .yaw = 5 * degree};
  const PushedWheel wheel(tread_elements(tire), tire, at);
  const Balance here = wheel.balance(sand);
  const auto difference = [&](Medium low, Medium high, double step, const Balance::Slopes& slopes) {
    const Balance a = wheel.balance(low), b = wheel.balance(high);
    EXPECT_NEAR((b.sinkage - a.sinkage) / step / slopes.sinkage, 1.0, 1e-3);
    EXPECT_NEAR((b.forces.pull - a.forces.pull) / step, slopes.forces.pull, 5e-3 * std::abs(slopes.forces.pull));
    EXPECT_NEAR((b.forces.torque - a.forces.torque) / step, slopes.forces.torque,
                5e-3 * std::abs(slopes.forces.torque));
    EXPECT_NEAR((b.forces.left - a.forces.left) / step, slopes.forces.left, 5e-3 * std::abs(slopes.forces.left));
  };
  difference({(1 - 1e-6) * sand.xi_n, 0.5}, {(1 + 1e-6) * sand.xi_n, 0.5}, 2e-6 * sand.xi_n, here.by_xi_n);
}

TEST(PushedWheel, HardlyChangesWithFinerElements) {
  for (const Tire& tire : {smooth(), lugged()}) {
    const OperatingCondition at{.load = tire.radius < 0.1 ? 60.0 : 15e3, .slip = 0.3};
    const Balance fine = PushedWheel(tread_elements(tire, 0.5), tire, at).balance(sand), used = balanced(tire, at);
    EXPECT_NEAR(used.sinkage, fine.sinkage, 0.003 * fine.sinkage);
    EXPECT_NEAR(used.forces.pull, fine.forces.pull, 0.003 * at.load);
    EXPECT_NEAR(used.forces.torque, fine.forces.torque, 0.003 * fine.forces.torque);
  }
}

// Of a drawing as coarse as its shape allows, whose triangles are halved here.
TEST(PushedWheel, OfADrawingIsTheWheelThatWasDrawn) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "lugged.stl";
  const OperatingCondition at{.load = 20e3, .slip = 0.2, .yaw = 0.1};
  Tire tire = lugged();
  dem::write_stl(file, dem::tire_surface(tire, {.edge = 0.2}), 1e-3);
  const Balance made = balanced(tire, at);
  const auto near = [&](const Balance& drawn) {
    EXPECT_NEAR(drawn.sinkage, made.sinkage, 0.01 * made.sinkage);
    expect_forces(drawn.forces, made.forces, 0.01 * at.load);
  };
  near(PushedWheel(drawn_elements(file.string(), tire), tire, at).balance(sand));
  tire.lugs.count.reset();  // the drawing has them
  near(PushedWheel(drawn_elements(file.string(), tire), tire, at).balance(sand));
  tire.width *= 1.5;
  EXPECT_THROW(drawn_elements(file.string(), tire), InputError);
  std::filesystem::remove(file);
}

TEST(PushedWheel, HasStressesThatCarryIt) {
  const Tire tire = smooth();
  const OperatingCondition at{.load = 40, .slip = 0.2};
  const PushedWheel wheel(tread_elements(tire), tire, at);
  const Balance b = wheel.balance(sand);
  double vertical = 0, torque = 0;
  const int count = 360;
  const double area = 2 * 3.14159265358979 / count * tire.radius * tire.width;
  for (const StripStress& s : wheel.strips(sand, b.sinkage, count)) {
    vertical += area * (s.normal * std::cos(s.theta) + s.shear * std::sin(s.theta));
    torque += area * tire.radius * s.shear;
  }
  EXPECT_NEAR(vertical, at.load, 0.005 * at.load);
  EXPECT_NEAR(torque, b.forces.torque, 0.01 * b.forces.torque);
}

TEST(PushedWheel, HasNoEndOfItsOwnWhereElementsSlideAlongThemselves) {
  // A smooth wheel that spins on the spot, or moves along its axle: only its front half pushes.
  for (const auto& [near, at] :
       {std::pair{OperatingCondition{.load = 10, .slip = 0.9999}, OperatingCondition{.load = 10, .slip = 1}},
        std::pair{OperatingCondition{.load = 10, .slip = 0.2, .yaw = 89.99 * degree, .slip_by = SlipBy::travel_speed},
                  OperatingCondition{.load = 10, .slip = 0.2, .yaw = 90 * degree, .slip_by = SlipBy::travel_speed}}}) {
    const Balance before = balanced(smooth(), near), here = balanced(smooth(), at);
    EXPECT_NEAR(here.sinkage, before.sinkage, 1e-3 * before.sinkage);
  }
}

TEST(PushedWheel, SaysWhenNothingCarriesTheLoad) {
  EXPECT_THROW(balanced(smooth(), {.load = 5000, .slip = 0.2}), NoSolution);
}

}  // namespace
}  // namespace soilbin::resistive_force
