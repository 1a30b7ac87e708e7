// The balance of the load: which root is found, and what is said where there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bekker_wong/balance_search.hpp"
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

using bed::driven;
using bed::smooth_tire;
using ::testing::HasSubstr;

double carried(const RollingWheel& wheel, const OperatingCondition& at, double theta_1) {
  return wheel.at_entry_angle(at, theta_1).forces.vertical;
}

std::string refusal(const RollingWheel& wheel, const OperatingCondition& at) {
  try {
    wheel.roll(at);
  } catch (const NoSolution& e) {
    return e.what();
  }
  return "(answered)";
}

const SoilValues snow{.exponent = 1.6,
                      .k_c = 4370,
                      .k_phi = 196720,
                      .cohesion = 1030,
                      .friction_angle = 19.7 * degree,
                      .shear_modulus = 0.04,
                      .c1 = 0.2,
                      .c2 = 0.3};

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
  EXPECT_THAT(said, HasSubstr("1e+05 N"));
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

TEST(BalanceSearch, FindsAHumpBetweenTwoSteps) {
  const auto narrow = [](double x) { return 1e-5 - std::abs(x + 1.026); };
  const FirstRoot found = first_rising_root(narrow, 0.4);
  ASSERT_TRUE(found.x);
  EXPECT_NEAR(*found.x, -1.026 - 1e-5, 1e-12);
}

TEST(BalanceSearch, SaysHowNearItCame) {
  const FirstRoot found = first_rising_root([](double x) { return -0.25 - (x + 2) * (x + 2); }, 0.4);
  EXPECT_FALSE(found.x);
  EXPECT_NEAR(found.highest, -0.25, 1e-9);
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
