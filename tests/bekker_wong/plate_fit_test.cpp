// n, k_c and k_phi from plates: exact data come back exactly; the fifteen GRC-1 tests of Oravec 2009 give her values.
#include "bekker_wong/plate_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double kPa = 1e3, kN = 1e3;

PlateCurve curve(double radius, double n, double k_c, double k_phi) {
  PlateCurve c{.radius = radius, .pressure = {}, .sinkage = {}};
  for (double z = 0.001; z < 0.05; z += 0.002) {
    c.sinkage.push_back(z);
    c.pressure.push_back((k_c / radius + k_phi) * std::pow(z, n));
  }
  return c;
}

TEST(PlateFit, GivesBackExactData) {
  const std::vector<PlateCurve> plates = {curve(0.03, 1.1, 990, 1.5e6), curve(0.05, 1.1, 990, 1.5e6),
                                          curve(0.10, 1.1, 990, 1.5e6)};
  for (const PlateExponent exponent : {PlateExponent::mean_of_plates, PlateExponent::common}) {
    const PlateFit fit = fit_plates(plates, exponent);
    EXPECT_NEAR(fit.exponent, 1.1, 1e-12);
    EXPECT_NEAR(fit.k_c, 990, 1e-5);
    EXPECT_NEAR(fit.k_phi, 1.5e6, 1e-3);
  }
}

// Plates that follow different powers: the mean of 0.8 and 1.2 is 1; moduli are then those of the weighted means.
TEST(PlateFit, AveragesTheExponentsOfThePlates) {
  const std::vector<PlateCurve> plates = {curve(0.03, 0.8, 0, 1e6), curve(0.10, 1.2, 0, 1e6)};
  const PlateFit fit = fit_plates(plates);
  EXPECT_NEAR(fit.plate_exponents[0], 0.8, 1e-12);
  EXPECT_NEAR(fit.plate_exponents[1], 1.2, 1e-12);
  EXPECT_NEAR(fit.exponent, 1.0, 1e-12);
  EXPECT_NE(fit_plates(plates, PlateExponent::common).exponent, fit.exponent);
}

TEST(PlateFit, TheMeanCurveReproducesCubics) {
  const auto cubic = [](double p, double a) { return a * p * (1 + p * (0.3 - 0.02 * p)); };
  std::vector<PlateTest> repeats(2);
  for (std::size_t r = 0; r < 2; ++r) {
    repeats[r].radius = 0.05;
    for (const double p : {0.0, 0.7, 1.1, 2.9, 4.0, 5.3}) {
      repeats[r].pressure.push_back(p);
      repeats[r].sinkage.push_back(cubic(p, r == 0 ? 1.0 : 3.0));
    }
  }
  const PlateCurve mean = mean_curve(repeats, {.first = 0.5, .step = 0.5, .last = 6.0});
  ASSERT_EQ(mean.pressure.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(mean.sinkage[i], cubic(mean.pressure[i], 2.0), 1e-12);
}

TEST(PlateFit, RefusesWhatItCannotFit) {
  const PlateCurve plate = curve(0.05, 1, 0, 1e6);
  EXPECT_THROW(fit_plates(std::vector<PlateCurve>{}), InputError);
  EXPECT_THROW(fit_plates(std::vector<PlateCurve>{plate, plate}), InputError);
  EXPECT_THROW(fit_plates(std::vector<PlateCurve>{plate, {.radius = 0.1, .pressure = {1}, .sinkage = {1}}}),
               InputError);
  const PlateTest backwards{.radius = 0.05, .pressure = {0, 2, 1, 3}, .sinkage = {0, 1, 2, 3}};
  EXPECT_THROW(mean_curve(std::vector<PlateTest>{backwards}, {0.5, 0.5, 2}), InputError);
}

/// The GRC-1 plate tests by plate: small (38 mm radius), medium (51 mm), large (95 mm), five repeats each.
std::map<double, std::vector<PlateTest>> grc1_tests() {
  std::ifstream file(SOILBIN_SOURCE_DIR "/cases/measured/plates/grc1-plates.csv");
  std::string line;
  std::getline(file, line);
  std::map<std::string, PlateTest> tests;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::string diameter, id, sinkage, pressure;
    std::getline(row, diameter, ','), std::getline(row, id, ','), std::getline(row, sinkage, ',');
    std::getline(row, pressure, ',');
    PlateTest& test = tests[id];
    test.radius = std::stod(diameter) / 2;
    test.sinkage.push_back(std::stod(sinkage));
    test.pressure.push_back(std::stod(pressure) * kPa);
  }
  std::map<double, std::vector<PlateTest>> by_radius;
  for (const auto& [id, test] : tests) by_radius[test.radius].push_back(test);
  return by_radius;
}

PlateFit fit_grc1(const PressureGrid& small, const PressureGrid& medium, const PressureGrid& large,
                  PlateExponent exponent = PlateExponent::mean_of_plates) {
  const auto tests = grc1_tests();
  const std::vector<PlateCurve> curves = {mean_curve(tests.at(0.038), small), mean_curve(tests.at(0.051), medium),
                                          mean_curve(tests.at(0.095), large)};
  return fit_plates(curves, exponent);
}

// Oravec 2009, Fig. 5.52: up to 50 kPa (the large plate's tests end near 31 kPa), every 0.5 kPa; the small plate's
// first pressures are left out. The table's six digits limit the agreement.
TEST(PlateFit, Grc1UpTo50kPa) {
  const PressureGrid usual{0.5 * kPa, 0.5 * kPa, 50 * kPa};
  const PlateFit fit = fit_grc1({1.5 * kPa, 0.5 * kPa, 50 * kPa}, usual, {0.5 * kPa, 0.5 * kPa, 30 * kPa});
  EXPECT_NEAR(fit.exponent, 1.23202, 5e-6);
  EXPECT_NEAR(fit.k_c, 4096.3537 * kN, 1e-5 * 4096 * kN);
  EXPECT_NEAR(fit.k_phi, -22284.5788 * kN, 1e-5 * 22284 * kN);
}

// Oravec 2009, Fig. 5.53: the whole range, 160, 105 and 30 kPa.
TEST(PlateFit, Grc1WholeRange) {
  const PlateFit fit =
      fit_grc1({0.5 * kPa, 0.5 * kPa, 160 * kPa}, {0.5 * kPa, 0.5 * kPa, 105 * kPa}, {0.5 * kPa, 0.5 * kPa, 30 * kPa});
  EXPECT_NEAR(fit.exponent, 0.80563, 1e-5);
  EXPECT_NEAR(fit.k_c, 97.06 * kN, 1e-4 * 97 * kN);
  EXPECT_NEAR(fit.k_phi, 1744.25 * kN, 1e-4 * 1744 * kN);
}

// b is the plate's radius: with the diameter in its place k_c comes out twice as large and nothing else changes.
TEST(PlateFit, BIsTheRadius) {
  const double n = 1.0, k_c = 2000, k_phi = 1e6;
  std::vector<PlateCurve> plates = {curve(0.03, n, k_c, k_phi), curve(0.10, n, k_c, k_phi)};
  for (PlateCurve& plate : plates) plate.radius *= 2;
  const PlateFit fit = fit_plates(plates);
  EXPECT_NEAR(fit.k_c, 2 * k_c, 1e-4);
  EXPECT_NEAR(fit.k_phi, k_phi, 1e-3);
}

// What a fit hides: from the same fifteen tests one exponent for all plates moves k_c by more than a third.
TEST(PlateFit, TheEstimatorMovesTheAnswer) {
  const PressureGrid to_50{0.5 * kPa, 0.5 * kPa, 50 * kPa}, to_30{0.5 * kPa, 0.5 * kPa, 30 * kPa};
  const PlateFit wong = fit_grc1(to_50, to_50, to_30);
  const PlateFit common = fit_grc1(to_50, to_50, to_30, PlateExponent::common);
  EXPECT_GT(std::abs(common.k_c / wong.k_c - 1), 0.29);
}

}  // namespace
}  // namespace soilbin::bekker_wong
