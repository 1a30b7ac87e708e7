// The balance of the load: which root is found, and what is said where there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bekker_wong/balance_search.hpp"
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::bekker_wong {
namespace {

using bed::driven;
using bed::smooth_tire;
using ::testing::HasSubstr;

double carried(const RollingWheel& wheel, const OperatingCondition& at, double theta_1) {
  return wheel.at_entry_angle(at, theta_1).forces.vertical;
}

std::string refusal(const RollingWheel& wheel, const OperatingCondition& at) {
  return soilbin::test::refusal<NoSolution>([&] { wheel.roll(at); });
}

const SoilValues snow = values_of(test::snow());

/// A soil on which a braked wheel carries most at a middling depth: friction of 45 deg against z^0.5.
const SoilValues gripping{.exponent = 0.5,
                          .k_phi = 1e6,
                          .cohesion = 0,
                          .friction_angle = 45 * degree,
                          .shear_modulus = 0.002,
                          .c1 = 0.2,
                          .c2 = 0.3};

struct Hump {
  double load = 0.0, theta_1 = 0.0;
};

Hump top_of(const RollingWheel& wheel, double slip) {
  Hump top;
  for (double t = 0.01; t < std::acos(0.1); t += 0.002)
    if (const double c = carried(wheel, driven(1, slip), t); c > top.load) top = {c, t};
  return top;
}

TEST(Balance, CarriesTheLoad) {
  const RollingWheel wheel(smooth_tire(0.4, 0.25), snow);
  for (const double load : {1e-6, 1.0, 500.0, 2000.0})
    EXPECT_NEAR(wheel.roll(driven(load, 0.3)).forces.vertical, load, 1e-11 * load);
}

TEST(Balance, ABuriedWheelIsRefusedWithNumbers) {
  const RollingWheel wheel(smooth_tire(0.1, 0.05), snow);
  const double most = carried(wheel, driven(1, 0.1), std::acos(0.1));
  EXPECT_NEAR(wheel.roll(driven(0.999 * most, 0.1)).sinkage / 0.1, 0.9, 1e-3);
  const std::string said = refusal(wheel, driven(1e5, 0.1));
  EXPECT_THAT(said, HasSubstr("deeper than 0.9 of its radius"));
  EXPECT_THAT(said, HasSubstr("of 100 kN"));
  EXPECT_THAT(said, Not(HasSubstr("at most")));
}

TEST(Balance, ABrakedWheelMayCarryMostAtAMiddlingDepth) {
  const RollingWheel wheel(smooth_tire(0.3, 0.2), gripping);
  const Hump top = top_of(wheel, -1.0);
  const double deepest = carried(wheel, driven(1, -1.0), std::acos(0.1));
  ASSERT_GT(top.load, 1.5 * deepest);
  const std::string said = refusal(wheel, driven(1.01 * top.load, -1.0));
  EXPECT_THAT(said, HasSubstr("deeper than 0.9 of its radius"));
  EXPECT_THAT(said, HasSubstr("at most"));
}

// A wheel that is let down on the soil stops at the first depth that carries it; the second, on the falling side, is
// unstable. Loads up to the hump's very top are found.
TEST(Balance, TheRootIsTheFirstFromAbove) {
  const RollingWheel wheel(smooth_tire(0.3, 0.2), gripping);
  const Hump top = top_of(wheel, -1.0);
  for (const double share : {0.01, 0.3, 0.7, 0.9, 0.99, 0.9999}) {
    SCOPED_TRACE(share);
    const OperatingCondition at = driven(share * top.load, -1.0);
    const double theta_1 = wheel.roll(at).balance_angle;
    EXPECT_LT(theta_1, top.theta_1 + 0.002);
    for (int i = 1; i < 100; ++i) EXPECT_LT(carried(wheel, at, theta_1 * i / 100), at.load);
  }
}

// Where the shear displacement of a deep braked wheel turns back, the load carried rises a second time.
TEST(Balance, OfTwoRisingRootsTheSmallerIsFound) {
  constexpr double slip = -0.8, load = 5000;
  const RollingWheel wheel(smooth_tire(0.3, 0.2), gripping);
  std::vector<double> angles, loads;
  for (double t = 0.02; t < std::acos(0.1); t *= 1.002) {
    angles.push_back(t);
    loads.push_back(carried(wheel, driven(1, slip), t));
  }
  int rising = 0;
  for (std::size_t i = 1; i < loads.size(); ++i) rising += loads[i] >= load && loads[i - 1] < load;
  ASSERT_EQ(rising, 2);
  const double theta_1 = wheel.roll(driven(load, slip)).balance_angle;
  for (std::size_t i = 0; angles[i] < theta_1; ++i) EXPECT_LT(loads[i], load);
}

/// Ten times the pressure that the soil's values foretell: Bekker's sinkage, where the search starts, is then far too
/// deep.
class TenfoldPressure final : public Effect {
 public:
  void pressure(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings&) const override {
    for (double& sigma : patch.of(&ContactPatch::sigma)) sigma *= 10;
  }
};

TEST(Balance, TheSmallerIsFoundFromAStartBeyondTheHumpToo) {
  constexpr double slip = -0.7, load = 5500;
  const double expected = RollingWheel(smooth_tire(0.3, 0.2), gripping).roll(driven(load, slip)).balance_angle;
  const RollingWheel hardened(smooth_tire(0.3, 0.2), gripping, {std::make_shared<TenfoldPressure>()});
  EXPECT_NEAR(hardened.roll(driven(10 * load, slip)).balance_angle, expected, 1e-9);
}

TEST(Balance, ADrivenWheelCarriesMoreTheDeeperItStands) {
  for (const SoilValues& soil : {snow, gripping})
    for (const double slip : {0.0, 0.2, 0.6, 1.0}) {
      const RollingWheel wheel(smooth_tire(0.3, 0.2), soil);
      double before = 0.0;
      for (double t = 0.01; t < std::acos(0.1); t *= 1.03) {
        const double now = carried(wheel, driven(1, slip), t);
        EXPECT_GT(now, before) << "slip " << slip << " theta_1 " << t;
        before = now;
      }
    }
}

TEST(Balance, TheSameInputGivesTheSameBits) {
  const RollingWheel wheel(smooth_tire(0.3, 0.2), gripping);
  for (const double slip : {-1.0, -0.3, 0.0, 0.4}) {
    const Reading first = wheel.roll(driven(300, slip)).reading, again = wheel.roll(driven(300, slip)).reading;
    EXPECT_EQ(first.drawbar_pull, again.drawbar_pull);
    EXPECT_EQ(first.torque, again.torque);
    EXPECT_EQ(first.sinkage, again.sinkage);
  }
}

/// A locked wheel at 15 deg yaw: what the soil carries has a most.
OperatingCondition locked(double load) {
  OperatingCondition at = driven(load, -1.0);
  at.yaw = 15 * degree;
  return at;
}

/// The most that the soil carries down to 0.9 r, and where [rad].
std::pair<double, double> most_carried(const RollingWheel& wheel) {
  std::pair<double, double> most{0.0, 0.0};
  for (double t = std::acos(0.1); t > 0.02; t /= 1.0005) most = std::max(most, {carried(wheel, locked(1.0), t), t});
  return most;
}

/// Carries more the deeper the wheel stands; carries most half way down.
const std::array<SoilValues, 2> soft_and_firm = {snow, gripping};

TEST(GivingWay, TheMostIsAtTheDeepestOrAbove) {
  const double deepest = std::acos(0.1);
  EXPECT_EQ(most_carried(RollingWheel(smooth_tire(0.3, 0.2), snow)).second, deepest);
  EXPECT_LT(most_carried(RollingWheel(smooth_tire(0.3, 0.2), gripping)).second, 0.8 * deepest);
}

TEST(GivingWay, AWheelThatIsCarriedRollsAsItDoes) {
  for (const SoilValues& soil : soft_and_firm) {
    const RollingWheel wheel(smooth_tire(0.3, 0.2), soil);
    const double load = 0.9 * most_carried(wheel).first;
    const RolledWheel rolled = wheel.roll(locked(load));
    for (const double about : {0.0, 0.9 * rolled.balance_angle, 1.1 * rolled.balance_angle}) {
      const RolledWheel same = wheel.roll_or_give_way(locked(load), {about});
      EXPECT_FALSE(same.gives_way);
      EXPECT_EQ(same.shortfall, 0.0);
      EXPECT_NEAR(same.balance_angle, rolled.balance_angle, 1e-10);
      EXPECT_NEAR(same.reading.lateral_force, rolled.reading.lateral_force, 1e-8 * load);
      const RolledWheel near = wheel.roll_or_give_way(locked(load), {about, 2 * soil.exponent + 1});
      EXPECT_FALSE(near.gives_way);
      EXPECT_NEAR(near.forces.vertical, load, 1e-8 * load);
    }
  }
}

TEST(GivingWay, ASoilThatFallsShortIsReadWhereItCarriesMost) {
  for (const SoilValues& soil : soft_and_firm) {
    const RollingWheel wheel(smooth_tire(0.3, 0.2), soil);
    const auto [most, theta_1] = most_carried(wheel);
    const double load = 1.2 * most;
    EXPECT_THAT(refusal(wheel, locked(load)), HasSubstr("sink deeper"));
    for (const double about : {0.0, 0.9 * theta_1, theta_1, 0.5 * (theta_1 + std::acos(0.1))}) {
      const RolledWheel yielding = wheel.roll_or_give_way(locked(load), {about});
      EXPECT_TRUE(yielding.gives_way);
      EXPECT_NEAR(yielding.shortfall, std::log(1.2), 1e-4) << about / theta_1;
      EXPECT_NEAR(yielding.balance_angle, theta_1, 1e-2 * theta_1) << about / theta_1;
    }
  }
}

TEST(GivingWay, ReadingsGoOnFromTheLastLoadCarried) {
  for (const SoilValues& soil : soft_and_firm) {
    const RollingWheel wheel(smooth_tire(0.3, 0.2), soil);
    const double most = most_carried(wheel).first;
    const Reading last = wheel.roll(locked(most * (1 - 1e-6))).reading;
    const Reading beyond = wheel.roll_or_give_way(locked(most * (1 + 1e-6))).reading;
    EXPECT_NEAR(beyond.sinkage, last.sinkage, 1e-2 * last.sinkage);
    EXPECT_NEAR(beyond.lateral_force, last.lateral_force, 1e-2 * std::abs(last.lateral_force));
  }
}

TEST(BalanceSearch, ATopIsHighEnoughOrTheHighest) {
  int calls = 0;
  const auto wave = [&](double x) { return ++calls, std::cos(x); };
  const auto at = [](double x) { return gsl::Sample{x, std::cos(x)}; };
  EXPECT_NEAR(gsl::bracketed_maximum(wave, {at(-1), at(0.5), at(2)}, 1e-7, 2.0, "").x, 0.0, 1e-7);
  EXPECT_GE(gsl::bracketed_maximum(wave, {at(-1), at(0.5), at(2)}, 1e-7, 0.95, "").f, 0.95);
  EXPECT_NEAR(gsl::bracketed_maximum(wave, {at(5), at(6), at(8)}, 1e-5, 2.0, "").x, 2 * std::numbers::pi, 1e-5);
  EXPECT_NEAR(gsl::bracketed_maximum(wave, {at(-1), at(1), at(1.5)}, 1e-7, 2.0, "").x, 0.0, 1e-7)
      << "as high as before";
  EXPECT_LT(calls, 100);
  calls = 0;
  EXPECT_EQ(gsl::bracketed_maximum(wave, {at(-1), at(-0.5), at(0)}, 1e-7, 2.0, "").x, -0.5);
  EXPECT_EQ(calls, 0);
}

TEST(BalanceSearch, ClimbsToTheTopFromEitherSide) {
  const auto hill = [](double x) { return -0.25 - (x + 2) * (x + 2); };
  for (const double about : {-5.0, -2.0, -1.99, 0.4}) EXPECT_NEAR(climb(hill, about, 0.4).x, -2.0, 1e-4) << about;
  EXPECT_EQ(climb(hill, -3.0, -2.5).x, -2.5);
  EXPECT_EQ(climb(hill, -2.5, -2.5).x, -2.5);
  for (const double about : {-5.0, -1.96, -1.95}) EXPECT_NEAR(climb(hill, about, -1.95).x, -2.0, 1e-4) << about;
}

TEST(BalanceSearch, FindsAHumpBetweenTwoSteps) {
  const auto narrow = [](double x) { return 1e-5 - std::abs(x + 1.026); };
  const FirstRoot found = first_rising_root(narrow, 0.4);
  ASSERT_TRUE(found.x);
  EXPECT_NEAR(*found.x, -1.026 - 1e-5, 1e-12);
}

TEST(BalanceSearch, SaysHowNearItCame) {
  const FirstRoot found = first_rising_root([](double x) { return -0.25 - (x + 2) * (x + 2); }, 0.4);
  EXPECT_FALSE(found.x);
  EXPECT_NEAR(found.highest.f, -0.25, 1e-9);
  EXPECT_NEAR(found.highest.x, -2.0, 1e-4);
}

TEST(BalanceSearch, TheSecantMethodLeavesAFallingRootAlone) {
  EXPECT_FALSE(rising_root([](double x) { return -x; }, 0.3, 1.0, 1.0, 1e-12));
  EXPECT_FALSE(rising_root([](double x) { return x - 5; }, 0.3, 1.0, 1.0, 1e-12));
  const auto found = rising_root([](double x) { return std::exp(x) - 2; }, 0.0, 1.0, 1.0, 1e-12);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, std::numbers::ln2, 1e-12);
}

}  // namespace
}  // namespace soilbin::bekker_wong
