// What must hold of any wheel on any soil, whatever the formulas.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <optional>
#include <thread>
#include <vector>

#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::bekker_wong {
namespace {

struct Wheel {
  Tire tire;
  SoilValues soil;
  OperatingCondition at;
};

double between(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 100001) / 1e5; }

/// A level wheel of 5 cm to 1 m on soils from snow to clay, loaded to sink 1 to 60 % of its radius without slip.
Wheel any_wheel(double lowest_slip, double highest_slip) {
  Wheel w;
  w.tire.radius = between(0.05, 1.0);
  w.tire.width = w.tire.radius * between(0.2, 1.5);
  w.soil.exponent = between(0.2, 1.8);
  w.soil.k_phi = std::pow(10, between(3.5, 5.5)) / std::pow(0.1 * w.tire.radius, w.soil.exponent);
  w.soil.k_c = between(-0.3, 0.3) * w.soil.k_phi * w.tire.width;
  w.soil.cohesion = between(0, 2e4);
  w.soil.friction_angle = between(0, 44) * degree;
  w.soil.shear_modulus = std::pow(10, between(-3, -1));
  w.soil.c1 = between(0, 0.6), w.soil.c2 = between(0, 0.5);
  w.at.slip = between(lowest_slip, highest_slip);
  w.at.load = 1.0;
  OperatingCondition rest = w.at;
  rest.slip = 0.0;
  w.at.load = RollingWheel(w.tire, w.soil).at_entry_angle(rest, std::acos(1 - between(0.01, 0.6))).forces.vertical;
  return w;
}

std::optional<RolledWheel> roll(const Wheel& w) {
  try {
    return RollingWheel(w.tire, w.soil).roll(w.at);
  } catch (const NoSolution&) {
    return {};
  }
}

double scale_of(const RolledWheel& w) { return std::abs(w.forces.thrust) - w.forces.compaction + w.at.load; }

TEST(Invariants, ADrivenWheelCarriesMoreWhenItSinksDeeper) {
  EXPECT_TRUE(rc::check([] {
    const Wheel w = any_wheel(0, 1);
    const RollingWheel wheel(w.tire, w.soil);
    double last = 0.0;
    for (double t = 0.02; t < 1.47; t *= 1.1) {
      const double now = wheel.at_entry_angle(w.at, t).forces.vertical;
      RC_ASSERT(now > last);
      last = now;
    }
  }));
}

TEST(Invariants, MoreLoadSinksDeeper) {
  EXPECT_TRUE(rc::check([] {
    Wheel w = any_wheel(-1, 1);
    const auto light = roll(w);
    w.at.load *= 1.1;
    const auto heavy = roll(w);
    RC_PRE(light && heavy);
    RC_ASSERT(heavy->sinkage > light->sinkage);
  }));
}

TEST(Invariants, TorqueExceedsThePullsMoment) {
  EXPECT_TRUE(rc::check([] {
    const Wheel w = any_wheel(0, 1);
    const auto rolled = roll(w);
    RC_PRE(rolled.has_value());
    RC_ASSERT(rolled->reading.torque >= w.tire.radius * rolled->reading.drawbar_pull);
  }));
}

// Coulomb's limit: no pull beyond the cohesion of the contact area and the friction of the load.
TEST(Invariants, PullStaysWithinTheSoilsStrength) {
  EXPECT_TRUE(rc::check([] {
    const Wheel w = any_wheel(0, 1);
    const auto rolled = roll(w);
    RC_PRE(rolled.has_value());
    const double area = w.tire.radius * w.tire.width * rolled->patch.angles.entry;
    const double strength = w.soil.cohesion * area + w.at.load * std::tan(w.soil.friction_angle);
    RC_ASSERT(rolled->reading.drawbar_pull <= strength * (1 + 1e-12));
  }));
}

// At r w = 1: power in is M/r, power out the drawbar pull times v. Driven, braked and yawed.
TEST(Invariants, NoMorePowerComesOutThanGoesIn) {
  EXPECT_TRUE(rc::check([] {
    Wheel w = any_wheel(-0.99, 1);
    w.at.yaw = between(-60, 60) * degree;
    const auto rolled = roll(w);
    RC_PRE(rolled.has_value());
    const double in = rolled->reading.torque / w.tire.radius;
    const double out = rolled->reading.drawbar_pull * rolled->motion.travel_ratio;
    RC_ASSERT(out <= in + 1e-9 * scale_of(*rolled) * (1 + rolled->motion.travel_ratio));
  }));
}

// Lengths times 3, pressures as they were: forces times 9, moments times 27.
TEST(Invariants, UnitsDoNotMatter) {
  EXPECT_TRUE(rc::check([] {
    const Wheel w = any_wheel(-1, 1);
    const auto small = roll(w);
    RC_PRE(small.has_value());
    Wheel l = w;
    l.tire.radius *= 3, l.tire.width *= 3, l.soil.shear_modulus *= 3;
    l.soil.k_phi *= std::pow(3, -w.soil.exponent), l.soil.k_c *= std::pow(3, 1 - w.soil.exponent);
    l.at.load *= 9;
    const auto large = roll(l);
    RC_ASSERT(large.has_value());
    RC_ASSERT(std::abs(large->sinkage / 3 - small->sinkage) < 1e-9 * small->sinkage);
    const double scale = scale_of(*small);
    RC_ASSERT(std::abs(large->reading.drawbar_pull / 9 - small->reading.drawbar_pull) < 1e-8 * scale);
    RC_ASSERT(std::abs(large->reading.torque / 27 - small->reading.torque) < 1e-8 * scale * w.tire.radius);
  }));
}

TEST(Invariants, YawToTheRightMirrorsYawToTheLeft) {
  EXPECT_TRUE(rc::check([] {
    Wheel w = any_wheel(-1, 1);
    w.at.yaw = between(0, 89) * degree;
    const auto left = roll(w);
    RC_PRE(left.has_value());
    w.at.yaw = -w.at.yaw;
    const auto right = roll(w);
    RC_ASSERT(right.has_value());
    RC_ASSERT(right->reading.lateral_force == -left->reading.lateral_force);
    RC_ASSERT(right->reading.drawbar_pull == left->reading.drawbar_pull);
    RC_ASSERT(right->reading.torque == left->reading.torque);
    RC_ASSERT(left->reading.lateral_force == 0.0 || left->forces.side >= 0.0);
  }));
}

TEST(Invariants, TheFrameTurnsTheForcesAndNothingElse) {
  EXPECT_TRUE(rc::check([] {
    Wheel w = any_wheel(-1, 1);
    w.at.yaw = between(-89, 89) * degree;
    w.at.longitudinal_incline = between(-15, 15) * degree, w.at.transverse_incline = between(-15, 15) * degree;
    const auto travel = roll(w);
    RC_PRE(travel.has_value());
    w.at.force_frame = ForceFrame::wheel;
    const auto wheel = roll(w);
    RC_ASSERT(wheel.has_value());
    const double along = travel->reading.drawbar_pull, across = travel->reading.lateral_force;
    const double c = std::cos(w.at.yaw), s = std::sin(w.at.yaw), scale = scale_of(*travel);
    RC_ASSERT(std::abs(wheel->reading.drawbar_pull - (along * c + across * s)) < 1e-12 * scale);
    RC_ASSERT(std::abs(wheel->reading.lateral_force - (across * c - along * s)) < 1e-12 * scale);
    RC_ASSERT(wheel->reading.torque == travel->reading.torque);
  }));
}

// A locked wheel is the limit of a nearly locked one, a straight wheel that of a hardly yawed one.
TEST(Invariants, LimitsAreReachedWithoutAJump) {
  EXPECT_TRUE(rc::check([] {
    Wheel w = any_wheel(-0.95, 1);
    const auto straight = roll(w);
    RC_PRE(straight.has_value());
    w.at.yaw = 1e-9;
    RC_ASSERT(std::abs(roll(w).value().reading.drawbar_pull - straight->reading.drawbar_pull) <
              1e-6 * scale_of(*straight));
    w.at.yaw = between(-60, 60) * degree;
    w.at.slip = -1.0;
    const auto locked = roll(w);
    RC_PRE(locked.has_value());
    w.at.slip = -1.0 + 1e-11;
    const auto nearly = roll(w);
    RC_ASSERT(nearly.has_value());
    RC_ASSERT(std::abs(nearly->reading.drawbar_pull - locked->reading.drawbar_pull) < 1e-6 * scale_of(*locked));
    RC_ASSERT(std::abs(nearly->reading.lateral_force - locked->reading.lateral_force) < 1e-6 * scale_of(*locked));
  }));
}

TEST(Invariants, ThreadsDoNotChangeABit) {
  const RollingWheel wheel(test::smooth_wheel(0.25, 0.1), values_of(test::dry_sand()));
  const auto sweep = [&] {
    std::vector<double> numbers;
    for (int i = -20; i <= 20; ++i) {
      OperatingCondition at;
      at.load = 700 + i, at.slip = i / 20.0, at.yaw = i * degree;
      const Reading r = wheel.roll(at).reading;
      numbers.insert(numbers.end(), {r.drawbar_pull, r.torque, r.sinkage, r.lateral_force});
    }
    return numbers;
  };
  std::vector<std::vector<double>> found(8);
  std::vector<std::thread> threads;
  for (auto& numbers : found) threads.emplace_back([&numbers, &sweep] { numbers = sweep(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& numbers : found) EXPECT_EQ(numbers, sweep());
}

}  // namespace
}  // namespace soilbin::bekker_wong
