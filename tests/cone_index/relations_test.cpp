// The relations of a mobility number: published numbers, limits, slopes.
#include "cone_index/relations.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace soilbin::cone_index {
namespace {

/// The default tire of MAVS and the load of its test, with a deflection of 0.02 m (its test has 0.1 m).
const TireMeasures mavs{.diameter = 0.704, .width = 0.226, .section_height = 0.15, .deflection = 0.02};

TEST(Brixius, MeetsThePublishedNumber) { EXPECT_NEAR(brixius_number(310e3, mavs, 3892), 10.76, 0.005); }

TEST(Brixius, HasANetTractionOf0198At10PercentSlipAnd004LessWithoutTheRollingTermOfTheTorque) {
  const double number = brixius_number(310e3, mavs, 3892);
  EXPECT_NEAR(brixius(number, 0.1).net(), 0.1978, 1e-4);
  const double mavs_net[] = {0.1578, 0.2871, 0.3401};  // at 10, 20, 30 % slip, with the resistance's 0.04 alone
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(brixius(number, 0.1 * (i + 1)).net(), mavs_net[i] + 0.04, 1e-4) << i;
  TireMeasures flat = mavs;
  flat.deflection = 0.1;
  EXPECT_NEAR(brixius_number(310e3, flat, 3892), 27.9741, 1e-3);
  EXPECT_NEAR(brixius(27.9741, 0.1).gross, 0.476009, 1e-6);
  EXPECT_NEAR(brixius(27.9741, 0.1).resistance, 0.085201, 1e-6);
}

TEST(Brixius, OfAFreelyRollingWheelOnFirmGroundLeavesWhatTheTireTakes) {
  const Ratios r = brixius(1e9, 0.0);
  EXPECT_NEAR(r.gross, 0.04, 1e-9);
  EXPECT_NEAR(r.resistance, 0.04, 1e-8);
}

TEST(Brixius, PullsAtMost088OfTheLoad) { EXPECT_NEAR(brixius(1e9, 1.0).net(), 0.88 * -std::expm1(-7.5), 1e-4); }

// After Zoz and Grisso 2003: as stiff a soil, 27 % more thrust of a little slip, a tenth less resistance of the soil.
TEST(Brixius, OfARadialTirePullsMoreAtLittleSlipAndTheSameAtFullSlip) {
  const auto radial = [](double number, double slip) { return brixius(number, slip, Construction::radial); };
  const double slip = 1e-6, firm = 1e9;
  EXPECT_NEAR((radial(firm, slip).gross - 0.0325) / (brixius(firm, slip).gross - 0.04), 9.5 / 7.5, 1e-5);
  EXPECT_NEAR(radial(firm, 1.0).net(), 0.88 * -std::expm1(-9.5), 1e-4);
  EXPECT_NEAR((radial(20, 0).resistance - 0.0325) / (brixius(20, 0).resistance - 0.04), 0.9, 1e-12);
  EXPECT_EQ(brixius(20, 0.1, Construction::bias_ply).net(), brixius(20, 0.1).net());
  const double h = 1e-6;
  EXPECT_NEAR(radial(20, 0.1).net_slope(), (radial(20 + h, 0.1).net() - radial(20 - h, 0.1).net()) / (2 * h), 1e-8);
}

TEST(Turnage, HasANumberThatGrowsWithTheStrengthAndFallsWithTheLoad) {
  // G = 1 MPa/m: 1e6 (0.226 0.704)^1.5/3892 0.02/0.15
  const double number = turnage_number(1e6, mavs, 3892);
  EXPECT_NEAR(number, 1e6 * std::pow(0.226 * 0.704, 1.5) / 3892 * 0.02 / 0.15, 1e-12);
  EXPECT_NEAR(turnage_number(2e6, mavs, 7784), number, 1e-12);
}

TEST(Turnage, MeetsThePullAt20PercentSlip) {
  for (const double number : {5.0, 10.0, 30.0, 100.0})
    EXPECT_NEAR(turnage(number, 0.2).net(), 0.53 - 4.5 / (number + 3.7), 1e-12) << number;
}

TEST(Turnage, HasTheGrossTractionOfItsHyperbola) {
  const double s = 0.35, y = 4.71 + 1.72 / s;
  EXPECT_NEAR(turnage(20, s).gross, 0.66 - 0.66 * y / (20 + 10 + y), 1e-12);
  EXPECT_EQ(turnage(20, 0.0).gross, 0.0);
}

TEST(Turnage, ResistsMoreTheSofterTheSand) {
  EXPECT_NEAR(turnage(5, 0.3).resistance, 0.337, 0.001);
  for (double number = 5; number < 45; number += 5)
    EXPECT_GT(turnage(number, 0.1).resistance, turnage(number + 5, 0.1).resistance) << number;
}

TEST(BothRelations, HaveTheSlopesOfTheirRatios) {
  constexpr double step = 1e-5;
  for (Ratios (*relation)(double, double) : {+[](double number, double slip) { return brixius(number, slip); },
                                             +[](double number, double slip) { return turnage(number, slip); }})
    for (const double number : {6.0, 20.0, 60.0})
      for (const double slip : {0.05, 0.2, 0.6}) {
        const Ratios at = relation(number, slip), above = relation(number + step, slip),
                     below = relation(number - step, slip);
        EXPECT_NEAR(at.gross_slope, (above.gross - below.gross) / (2 * step), 1e-9);
        EXPECT_NEAR(at.resistance_slope, (above.resistance - below.resistance) / (2 * step), 1e-9);
      }
}

}  // namespace
}  // namespace soilbin::cone_index
