// Measured plates: what a file may look like, and that the fit gives back the soil that made the readings.

#include "compare/bevameter/measured_plates.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "bekker_wong/gsl.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using test::refusal;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double made_n = 0.9, made_k_c = 5e3, made_k_phi = 9e5;

/// Readings of a plate of this diameter on a soil whose modulus is `share` of the one above, every 2 mm.
std::string rows_of_a_plate(double diameter, const std::string& test, double share = 1.0, double exponent = made_n) {
  std::string text;
  for (int i = 1; i <= 12; ++i) {
    const double z = 0.002 * i, p = share * (made_k_c / (diameter / 2) + made_k_phi) * std::pow(z, exponent);
    text += fmt::format("{},{},{},{}\n", test, diameter, z, p / 1e3);
  }
  return text;
}

const std::string plate_columns = "test,plate_diameter_m,sinkage_m,pressure_kPa\n";

std::vector<MeasuredPlate> read_csv_of_plates(const std::string& csv,
                                              const std::vector<std::pair<std::string, std::string>>& only = {}) {
  return read_plates(make_source_text(csv, "plates.csv"), only);
}

TEST(MeasuredPlates, GiveBackTheSoilThatMadeThem) {
  const std::vector<MeasuredPlate> plates = read_csv_of_plates(plate_columns + rows_of_a_plate(0.06, "a") +
                                                               rows_of_a_plate(0.08, "b") + rows_of_a_plate(0.10, "c"));
  ASSERT_EQ(plates.size(), 3u);
  const MeasuredPlatesFit fit = fit_measured_plates(plates);
  EXPECT_NEAR(fit.exponent.estimate.value, made_n, 1e-5);
  EXPECT_NEAR(fit.k_c.estimate.value, made_k_c, 1e-3 * made_k_c);
  EXPECT_NEAR(fit.k_phi.estimate.value, made_k_phi, 1e-3 * made_k_phi);
  EXPECT_NEAR(fit.exponent.between_readings, 0.0, 1e-5);
  EXPECT_NEAR(fit.exponent.between_pressures, 0.0, 1e-5);
  EXPECT_LT(fit.pressure_error, 1e-4);
  EXPECT_EQ(fit.radii, (std::vector<double>{0.03, 0.04, 0.05}));
}

/// What re-tests scatter elsewhere, which counts as two more tests: of ln k, and of n.
constexpr double usual_k = 0.08, usual_n = 0.1, usual_freedom = 2.0;

// Two tests of each plate, of moduli 0.9 and 1.1: ln k scatters by ln(1.1/0.9)/sqrt 2 as two degrees of freedom tell,
// and as much count the usual 8 %. One test more of each plate scatters by that, and the mean of the two by half its
// square.
TEST(MeasuredPlates, ScatterOfRepeatsIsTheirError) {
  std::string csv = plate_columns;
  for (const double diameter : {0.06, 0.10})
    for (const double share : {0.9, 1.1}) csv += rows_of_a_plate(diameter, share < 1 ? "soft" : "firm", share);
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(csv));
  EXPECT_THAT(fit.tests, Each(2));
  const double own = std::log(1.1 / 0.9) / std::sqrt(2.0), variance = (own * own + usual_k * usual_k) / 2,
               student = gsl::student_factor(2 + usual_freedom);
  EXPECT_NEAR(fit.test_scatter, own, 1e-4);
  // k_phi = (k_2/u_2 - k_1/u_1)/(1/u_2 - 1/u_1) = (5 k_2 - 3 k_1)/2 with u = 1/b of 33.3 and 20 1/m, k_1 and k_2 the
  // means of two: a test's k has a share of 3/4 or 5/4. 0.9^2 + 1.1^2 = 2.02.
  const double small = made_k_c / 0.03 + made_k_phi, large = made_k_c / 0.05 + made_k_phi,
               squares = 2.02 * (std::pow(0.75 * small, 2) + std::pow(1.25 * large, 2));
  EXPECT_NEAR(fit.k_phi.between_tests, std::sqrt(3 * variance * squares) * student, 1e-3 * made_k_phi);
  EXPECT_NEAR(fit.k_phi.estimate.value, made_k_phi, 1e-3 * made_k_phi);
  // All have one n, and it still errs by half of the usual square: a test's share in n is that of its pressures'
  // squares.
  const double sum = 2.02 * (small * small + large * large),
               fourth = (std::pow(0.9, 4) + std::pow(1.1, 4)) * (std::pow(small, 4) + std::pow(large, 4));
  EXPECT_NEAR(fit.exponent.between_tests, std::sqrt(3 * usual_n * usual_n / 2 * fourth) / sum * student, 1e-4);
}

// A single test of each plate tells no scatter: the usual one is its error, twice, of the next test and of its own.
TEST(MeasuredPlates, ASingleTestErrsByWhatReTestsScatterElsewhere) {
  const MeasuredPlatesFit fit =
      fit_measured_plates(read_plates(make_source_text(plate_columns + rows_of_a_plate(0.1, "a"), "plates.csv")));
  const double error = std::sqrt(2.0) * gsl::student_factor(usual_freedom);
  EXPECT_NEAR(fit.k_phi.between_tests, usual_k * error * fit.k_phi.estimate.value, 1.0);
  EXPECT_NEAR(fit.exponent.between_tests, usual_n * error, 1e-6);
  EXPECT_THAT(doubts(fit), testing::Contains(test::tells(DoubtKind::no_repeated_plates, {})));
}

/// How often the errors of k_c and k_phi hold what one more test of each of three plates gives, where moduli scatter
/// so.
std::pair<double, double> held_re_tests(int tests, double scatter) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  constexpr int made = 400;
  int k_c = 0, k_phi = 0;
  const auto pressed = [&](int count) {
    std::vector<MeasuredPlate> plates;
    for (const double radius : {0.03, 0.04, 0.05})
      for (int test = 0; test < count; ++test) {
        MeasuredPlate& plate = plates.emplace_back();
        plate.curve.radius = radius;
        const double modulus = std::exp(scatter * normal(random)) * (made_k_c / radius + made_k_phi);
        for (int reading = 1; reading <= 12; ++reading) {
          plate.curve.sinkage.push_back(0.002 * reading);
          plate.curve.pressure.push_back(modulus * std::pow(0.002 * reading, made_n));
        }
      }
    return fit_measured_plates(plates);
  };
  for (int i = 0; i < made; ++i) {
    const MeasuredPlatesFit fit = pressed(tests), again = pressed(1);
    k_c += std::abs(fit.k_c.estimate.value - again.k_c.estimate.value) < fit.k_c.estimate.std_error;
    k_phi += std::abs(fit.k_phi.estimate.value - again.k_phi.estimate.value) < fit.k_phi.estimate.std_error;
  }
  return {static_cast<double>(k_c) / made, static_cast<double>(k_phi) / made};
}

// Three plates, three tests each, that scatter as usual: the errors hold what three more tests give as often as they
// say.
TEST(MeasuredPlates, ErrorsOfFewTestsHoldReTestsInTwoThirds) {
  const auto [k_c, k_phi] = held_re_tests(3, usual_k);
  EXPECT_NEAR(k_c, 0.683, 0.06);
  EXPECT_NEAR(k_phi, 0.683, 0.06);
}

// Where re-tests scatter by other than the usual share, six tests of each plate tell most of it.
TEST(MeasuredPlates, TheirOwnScatterCountsMore) {
  for (const double scatter : {0.04, 0.16}) {
    const auto [k_c, k_phi] = held_re_tests(6, scatter);
    EXPECT_NEAR(k_phi, 0.683, 0.1) << scatter;
    EXPECT_NEAR(k_c, 0.683, 0.1) << scatter;
  }
}

// A soil that is no power law: n is 1 below half of the largest pressure (there z = 14 mm) and, by the p^2-weighted fit
// to the rest, 0.5656; half of the difference is the error.
std::vector<MeasuredPlate> bent_plates() {
  std::string text = plate_columns;
  for (const char* test : {"a,0.06", "b,0.1"})
    for (int i = 1; i <= 40; ++i) {
      const double z = 0.001 * i, p = z < 0.02 ? 2e6 * z : 2e6 * std::sqrt(0.02 * z);  // n = 1, then 1/2
      text += fmt::format("{},{},{}\n", test, z, p / 1e3);
    }
  return read_csv_of_plates(text);
}

TEST(MeasuredPlates, AnotherExponentAtHighPressuresIsAnError) {
  const MeasuredPlatesFit fit = fit_measured_plates(bent_plates());
  EXPECT_NEAR(fit.exponent.between_pressures, (1.0 - 0.5656) / 2, 1e-4);
  EXPECT_NEAR(fit.low_exponent, 1.0, 1e-4);
  EXPECT_NEAR(fit.high_exponent, 0.5656, 1e-4);
  EXPECT_THAT(doubts(fit), testing::Contains(test::tells(DoubtKind::curve_flattens, {fit.low_exponent})));
  EXPECT_FALSE(tell_of(doubts(fit), DoubtKind::curve_stiffens));
  EXPECT_GT(fit.exponent.estimate.value, 0.5);
  EXPECT_LT(fit.exponent.estimate.value, 1.0);
}

// The window's middle, 40.3 kPa, lies where the law changes: one half is all of n = 1, the other all of n = 1/2.
TEST(MeasuredPlates, AWindowIsHalvedAtItsOwnMiddle) {
  const MeasuredPlatesFit fit = fit_measured_plates(bent_plates(), {24e3, 57e3});
  EXPECT_NEAR(fit.exponent.between_pressures, 0.25, 1e-6);
}

TEST(MeasuredPlates, OnlyTheReadingsOfAWindowCount) {
  const std::vector<MeasuredPlate> plates =
      read_csv_of_plates(plate_columns + rows_of_a_plate(0.06, "a") + rows_of_a_plate(0.1, "b"));
  const MeasuredPlatesFit fit = fit_measured_plates(plates, {5e3, 35e3});
  EXPECT_GE(fit.lowest, 5e3);
  EXPECT_LE(fit.highest, 35e3);
}

// Bekker's b is a round plate's radius and a strip's whole width, as it is a wheel's.
TEST(MeasuredPlates, AStripCountsByItsWidth) {
  const std::vector<MeasuredPlate> strips =
      read_csv_of_plates("test,plate_width_m,sinkage_m,pressure_kPa\na,0.05,0.01,9\na,0.05,0.02,18\n");
  ASSERT_EQ(strips.size(), 1u);
  EXPECT_DOUBLE_EQ(strips[0].curve.radius, 0.05);
}

// The same readings in other columns and units.
TEST(MeasuredPlates, ColumnsTellTheirUnits) {
  std::string csv = "box,nr,tool,depth_mm,force_N,time_s\n";
  for (const auto& [tool, diameter] : {std::pair{"plate_d60mm", 0.06}, {"d100mm", 0.1}})
    for (int i = 1; i <= 12; ++i) {
      const double z = 0.002 * i, p = (made_k_c / (diameter / 2) + made_k_phi) * std::pow(z, made_n);
      csv += fmt::format("large,1,{},{},{},{}\n", tool, 1e3 * z, p * std::numbers::pi * diameter * diameter / 4, i);
    }
  const std::vector<MeasuredPlate> plates = read_csv_of_plates(csv + "small,1,d100mm,1,-3,1\n", {{"box", "large"}});
  ASSERT_EQ(plates.size(), 2u) << "a time does not tell tests apart, and the small box is left out";
  EXPECT_EQ(plates[0].test, "large, 1");
  EXPECT_NEAR(fit_measured_plates(plates).k_phi.estimate.value, made_k_phi, 1e-3 * made_k_phi);
}

TEST(MeasuredPlates, AColumnsUnitMayStandInBrackets) {
  const std::string rows = rows_of_a_plate(0.1, "1") + rows_of_a_plate(0.2, "2");
  const auto moduli = [&](const std::string& header) {
    const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(header + rows));
    return std::pair(fit.k_c.estimate.value, fit.k_phi.estimate.value);
  };
  const auto [k_c, k_phi] = moduli(plate_columns);
  EXPECT_NEAR(k_phi, made_k_phi, 1e-3 * made_k_phi);
  EXPECT_EQ(moduli("Test no.,Plate diameter [m],Sinkage (m),Pressure [kPa]\n"), std::pair(k_c, k_phi));
}

TEST(MeasuredPlates, BadFilesAreRefused) {
  EXPECT_THAT(
      refusal([] { read_csv_of_plates("test,sinkage_m,pressure_kPa\na,0.1,1\n"); }),
      AllOf(StartsWith("plates.csv:1:1: no column holds the size of the plate"), HasSubstr("plate_diameter_m")));
  EXPECT_THAT(refusal([] { read_csv_of_plates("tool,pressure_kPa\nd60mm,1\n"); }),
              HasSubstr("no column holds the sinkage"));
  EXPECT_THAT(refusal([] { read_csv_of_plates("tool,sinkage_m,pressure_kPa\nround,0.1,1\n"); }),
              StartsWith("plates.csv:2:1: 'round' gives no size of a plate"));
  EXPECT_THAT(refusal([] { read_csv_of_plates("tool,sinkage_m,pressure_kPa\nd60mm,deep,1\n"); }),
              StartsWith("plates.csv:2:7: column 'sinkage_m': expected a finite number, not 'deep'"));
  EXPECT_THAT(refusal([] { read_csv_of_plates("tool,sinkage_m,pressure_kPa\nd60mm,12 mm,1\n"); }),
              HasSubstr("hint: write 12: the unit of the whole column (m) stands in its name"));
  EXPECT_THAT(refusal([] {
                read_csv_of_plates(plate_columns + rows_of_a_plate(0.06, "a"), {{"tset", "a"}});
              }),
              HasSubstr("did you mean 'test'?"));
  EXPECT_THAT(refusal([] {
                fit_measured_plates(read_csv_of_plates(plate_columns + "a,0.06,0.01,1\n" + rows_of_a_plate(0.1, "b")));
              }),
              HasSubstr("test 'a' of the plate of b = 30 mm has 1 reading"));
}

// Numbers a thousand times too large or too small are of another unit than the column's name says, and the error names
// the one that they can be in.
TEST(MeasuredPlates, NumbersUnderAWrongUnitAreRefused) {
  const std::string rows = rows_of_a_plate(0.06, "a") + rows_of_a_plate(0.1, "b");  // m, m, kPa
  const auto under = [&](const std::string& header) { return refusal([&] { read_csv_of_plates(header + rows); }); };
  EXPECT_THAT(
      under("test,plate_diameter_m,sinkage_mm,pressure_kPa\n"),
      AllOf(StartsWith("plates.csv:1:23: column 'sinkage_mm': the largest number is 0.024 mm; plates sink in by "
                       "0.5 to 2000 mm"),
            HasSubstr("if they are in m, call it sinkage_m")));
  EXPECT_THAT(under("test,plate_diameter_m,sinkage_m,pressure_MPa\n"),
              AllOf(HasSubstr("plates press on soil with 0.0002 to 5 MPa"), HasSubstr("call it pressure_kPa")));
  EXPECT_THAT(under("test,plate_diameter_mm,sinkage_m,pressure_kPa\n"), HasSubstr("plates measure 4 to 2000 mm"));
  EXPECT_NO_THROW(read_csv_of_plates(plate_columns + rows));
}

// What was not measured is an empty cell, and no reading; a plate without a size is none.
TEST(MeasuredPlates, AnEmptyCellIsNoReading) {
  const std::string rows = rows_of_a_plate(0.06, "a") + rows_of_a_plate(0.1, "b");
  const std::vector<MeasuredPlate> whole = read_csv_of_plates(plate_columns + rows),
                                   gaps = read_csv_of_plates(plate_columns + rows + "a,0.06,,20\nb,0.1,0.02,\n");
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(gaps[i].curve.pressure, whole[i].curve.pressure);
  EXPECT_THAT(refusal([&] { read_csv_of_plates(plate_columns + rows + "a,,0.02,20\n"); }),
              HasSubstr("column 'plate_diameter_m': empty; every reading needs the size of its plate"));
}

// The window is to blame for readings that it leaves out, and for no others.
TEST(MeasuredPlates, NumbersOfTheOtherSignAreRefusedAtTheirColumn) {
  const std::string rows = "a,0.06,0.01,-5\na,0.06,0.02,-9\n";
  EXPECT_THAT(refusal([&] { read_csv_of_plates(plate_columns + rows); }),
              AllOf(StartsWith("plates.csv:1:33: column 'pressure_kPa': every number is below 0"),
                    HasSubstr("hint: change their sign: down into the soil is positive")));
  const auto fit = [](const std::string& csv, const PressureWindow& window) {
    return refusal([&] { fit_measured_plates(read_csv_of_plates(csv), window); });
  };
  const std::string both = plate_columns + rows_of_a_plate(0.1, "b");
  EXPECT_THAT(fit(both + rows, {}), AllOf(HasSubstr("0 readings"), HasSubstr("a negative one is not counted"),
                                          testing::Not(HasSubstr("--pressure"))));
  EXPECT_THAT(fit(both, {0.0, 1.0}), HasSubstr("0 readings with a pressure and a sinkage above 0 in the window; 6 are "
                                               "needed\n  hint: widen --pressure"));
}

// A force beside a pressure says the same over the plate's area, or one of the two is wrong.
TEST(MeasuredPlates, AForceBesideAPressureMustAgree) {
  std::string agreeing = "test,plate_diameter_m,sinkage_m,pressure_kPa,force_N\n", other = agreeing;
  std::istringstream rows(rows_of_a_plate(0.06, "a") + rows_of_a_plate(0.1, "b"));
  for (std::string row; std::getline(rows, row);) {
    const double area = std::numbers::pi / 4 * (row.starts_with("a") ? 0.06 * 0.06 : 0.1 * 0.1),
                 force = 1e3 * std::stod(row.substr(row.rfind(',') + 1)) * area;
    agreeing += fmt::format("{},{:.4g}\n", row, force), other += fmt::format("{},{:.4g}\n", row, 2 * force);
  }
  EXPECT_NO_THROW(read_csv_of_plates(agreeing + "a,0.06,0.03,,70\n")) << "a pressure that was not measured";
  EXPECT_THAT(refusal([&] { read_csv_of_plates(other); }),
              AllOf(StartsWith("plates.csv:1:46: column 'force_N' over the plate's area gives "),
                    HasSubstr("hint: take the column out that is not to be used")));
}

// A number without a unit in its name would make each reading a test of its own.
TEST(MeasuredPlates, AColumnThatChangesInEachRowTellsNoTests) {
  std::string csv = "R2," + plate_columns;
  std::istringstream rows(rows_of_a_plate(0.06, "a") + rows_of_a_plate(0.1, "b"));
  int i = 0;
  for (std::string row; std::getline(rows, row);) csv += fmt::format("0.9{},{}\n", i++, row);
  EXPECT_THAT(refusal([&] { read_csv_of_plates(csv); }),
              AllOf(StartsWith("plates.csv:1:1: column 'R2' has no unit, so it identifies tests, and it has 24 values "
                               "in 24 rows"),
                    HasSubstr("hint: take it out of the file")));
}

// The tests on GRC-1 up to 50 kPa: Oravec (2009) published n = 1.232 and a negative k_phi from averaged repeats.
TEST(MeasuredPlates, TheShelfsFilesAreRead) {
  const std::string folder = SOILBIN_SOURCE_DIR "/cases/measured/plates/";
  const auto plates = read_plates(read_source_text(folder + "grc1-plates.csv", largest_plate_csv));
  ASSERT_EQ(plates.size(), 15u);
  const MeasuredPlatesFit low = fit_measured_plates(plates, {0.5e3, 50e3}), whole = fit_measured_plates(plates);
  EXPECT_LT(low.k_phi.estimate.value, 0.0);
  EXPECT_NEAR(low.exponent.estimate.value, 1.232, 2 * low.exponent.estimate.std_error);
  EXPECT_LT(whole.exponent.estimate.value, low.exponent.estimate.value) << "GRC-1 is no power law";
  EXPECT_THAT(doubts(low), testing::Contains(test::tells(DoubtKind::negative_modulus, {"k_phi"})));
  EXPECT_EQ(read_plates(read_source_text(folder + "cmu-plates.csv", largest_plate_csv), {{"box", "large-box"}}).size(),
            9u);
}

/// One reading, to put among others by hand.
struct PlateReadingAt {
  double sinkage, pressure;  // mm, kPa
};

/// Tests on n = 1, k_c = 10 kN/m^2, k_phi = 1000 kN/m^3: plates of 100 and 150 mm in turn, every 2 mm to 16 mm,
/// pressures to four digits; `change` may alter the readings of a test, numbered from 1.
std::string dirty_plates(int tests, const auto& change) {
  std::string csv = "test,plate_diameter_mm,sinkage_mm,pressure_kPa\n";
  for (int test = 1; test <= tests; ++test) {
    const double diameter = test % 2 == 1 ? 100 : 150;
    std::vector<PlateReadingAt> readings;
    for (int z = 2; z <= 16; z += 2) readings.push_back({1.0 * z, (20000 / diameter + 1000) * z / 1000});
    change(test, readings);
    for (const auto& [sinkage, pressure] : readings)
      csv += fmt::format("{},{},{:.6g},{:.4g}\n", test, diameter, sinkage, pressure);
  }
  return csv;
}

/// The fit gives n = 1, k_c = 10 and k_phi = 1000, and what readings and pressures leave open is below two thousandths;
/// the rest of the error is what re-tests scatter elsewhere.
void expect_the_clean_soil(const MeasuredPlatesFit& fit) {
  for (const auto& [value, truth] : {std::pair{fit.exponent, 1.0}, {fit.k_c, 1e4}, {fit.k_phi, 1e6}}) {
    const double error = std::hypot(value.between_pressures, value.between_readings);
    EXPECT_NEAR(value.estimate.value, truth, 2e-3 * truth);
    EXPECT_LT(error, 2e-3 * truth);
  }
  EXPECT_LT(fit.test_scatter, 2e-3);
}

std::vector<int> lines_aside(const MeasuredPlatesFit& fit) {
  std::vector<int> lines;
  for (const PlateReadingsAside& one : fit.aside) lines.insert(lines.end(), one.lines.begin(), one.lines.end());
  return lines;
}

// One sinkage of 240 mm for 10 mm among 32 exact readings gave n = 0.25 +- 0.91.
TEST(DirtyPlates, ASpikeOfTheSinkageIsSetAsideWithItsLine) {
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(
      dirty_plates(4, [](int test, auto& readings) { readings[4].sinkage = test == 1 ? 240 : 10; })));
  expect_the_clean_soil(fit);
  EXPECT_EQ(lines_aside(fit), (std::vector<int>{6}));
  ASSERT_TRUE(fit.kept);
  EXPECT_NEAR((*fit.kept)[0], 0.25, 0.01) << "what the answer was with the spike";
  const Report report = report_on(fit, {}, "x");
  EXPECT_THAT(text_of(report), HasSubstr("Set aside as spikes: 1 reading of 1 test "
                                         "(line 6).\nWith everything kept: n = 0.2501"));
  const Json document = report.data();
  EXPECT_EQ(document["set_aside"][0]["why"], "sinkage_spike");
  EXPECT_EQ(document["set_aside"][0]["lines"][0], 6);
}

// Wherever one reading is off, by either sensor, up or down, it is that reading that goes and no other.
TEST(DirtyPlates, ASpikeAnywhereIsFound) {
  for (std::size_t at = 0; at < 8; ++at)
    for (const double factor : {20.0, 1 / 20.0})
      for (const bool force : {true, false}) {
        if (!force && factor > 1 && at == 0) continue;  // a first reading of 40 mm: see below
        const MeasuredPlatesFit fit =
            fit_measured_plates(read_csv_of_plates(dirty_plates(4, [&](int test, auto& readings) {
              if (test == 2) (force ? readings[at].pressure : readings[at].sinkage) *= factor;
            })));
        SCOPED_TRACE(fmt::format("{} of reading {} times {}", force ? "pressure" : "sinkage", at, factor));
        for (const auto& [value, truth] : {std::pair{fit.exponent, 1.0}, {fit.k_c, 1e4}, {fit.k_phi, 1e6}})
          EXPECT_NEAR(value.estimate.value, truth, std::max(value.estimate.std_error, 0.01 * truth));
        EXPECT_LE(fit.readings_aside(),
                  at == 1 && !force ? 2u : 1u);  // is the first too deep, or the second not enough?
      }
}

// 240 mm first, then 4 mm under more pressure: no soil lifts a plate that is pressed on.
TEST(DirtyPlates, AFirstReadingTooDeepIsASpike) {
  const MeasuredPlatesFit fit = fit_measured_plates(
      read_csv_of_plates(dirty_plates(4, [](int test, auto& readings) { readings[0].sinkage = test == 3 ? 240 : 2; })));
  expect_the_clean_soil(fit);
  EXPECT_EQ(lines_aside(fit), (std::vector<int>{18}));
}

// Unloaded at 10 mm to nearly nothing and loaded again, on a slope of 1000 times the pressure a metre.
TEST(DirtyPlates, UnloadingAndReloadingAreLeftOutAndGiveKu) {
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(dirty_plates(4, [](int, auto& readings) {
    const double top = readings[4].pressure;
    std::vector<PlateReadingAt> branch;
    for (const double back : {0.3, 0.6, 0.9, 0.7, 0.4}) branch.push_back({10 - back, top * (1 - back)});
    readings.insert(readings.begin() + 5, branch.begin(), branch.end());
  })));
  expect_the_clean_soil(fit);
  EXPECT_EQ(fit.readings_aside(), 20u);
  for (const PlateReadingsAside& one : fit.aside) {
    EXPECT_EQ(one.readings.why, AsideWhy::unloading);
    ASSERT_TRUE(one.readings.unloading_stiffness);
    EXPECT_NEAR(*one.readings.unloading_stiffness, 1000 * one.readings.pressure, 5 * one.readings.pressure);
  }
  EXPECT_THAT(text_of(report_on(fit, {}, "x")),
              HasSubstr("Set aside as unloading, reloading or holding: 20 readings of 4 tests"));
}

// Lifted by 0.4 mm, held there a hundred readings long while the pressure relaxes, pressed on again: k_u is the slope
// of the way down, 200 MN/m^3, not that of the hold.
TEST(DirtyPlates, AHoldDoesNotHideKu) {
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(dirty_plates(2, [](int, auto& readings) {
    for (PlateReadingAt& reading : readings) reading.pressure *= 50;
    const double top = readings[4].pressure;
    std::vector<PlateReadingAt> branch;
    for (const double back : {0.1, 0.2, 0.3, 0.4}) branch.push_back({10 - back, top - 200 * back});
    for (int i = 1; i <= 100; ++i) branch.push_back({9.6, top - 80 - 0.1 * i});
    readings.insert(readings.begin() + 5, branch.begin(), branch.end());
  })));
  EXPECT_EQ(fit.readings_aside(), 208u);
  for (const PlateReadingsAside& one : fit.aside) {
    ASSERT_TRUE(one.readings.unloading_stiffness);
    EXPECT_NEAR(*one.readings.unloading_stiffness, 200e6, 4e6);
  }
}

// The pressure rises at 16 mm from 16 to 80 kPa: this gave n = 2.66 with an error that was no number.
TEST(DirtyPlates, ADepthSensorThatSticksIsLeftOutAndDoubted) {
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(dirty_plates(2, [](int, auto& readings) {
    for (const double pressure : {25.0, 35.0, 45.0, 60.0, 80.0}) readings.push_back({16, pressure});
  })));
  expect_the_clean_soil(fit);
  EXPECT_EQ(fit.readings_aside(), 10u);
  EXPECT_TRUE(tell_of(doubts(fit), DoubtKind::sensor_stuck));
  EXPECT_THAT(text_of(report_on(fit, {}, "x")), testing::Not(HasSubstr("nan")));
}

// A sensor that never moves gives no exponent, and no line for a file.
TEST(DirtyPlates, ASinkageThatNeverMovesIsRefused) {
  EXPECT_THAT(refusal([] {
                fit_measured_plates(read_csv_of_plates(dirty_plates(2, [](int test, auto& readings) {
                  for (PlateReadingAt& reading : readings)
                    if (test == 2) reading.sinkage = 16;
                })));
              }),
              AllOf(HasSubstr("test '2' of the plate of b = 75 mm has 1 reading"), HasSubstr("is a sensor stuck?")));
}

// Centimetres under a column in millimetres gave k_phi = -9800 kN/m^3.
TEST(DirtyPlates, ATestInAnotherUnitIsNamedAndSetAside) {
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(dirty_plates(4, [](int test, auto& readings) {
    for (PlateReadingAt& reading : readings) reading.sinkage /= test == 3 ? 10 : 1;
  })));
  expect_the_clean_soil(fit);
  EXPECT_THAT(in_words(doubts(fit)),
              testing::Contains(AllOf(HasSubstr("test '3' of the plate of b = 50 mm (lines 18 to 25) bears 10"),
                                      HasSubstr("sinkage in cm for mm"), HasSubstr("it was set aside"))));
}

// Millimetres under a column in centimetres, of all tests, so that none disowns another: 320 mm under a plate of 100
// mm.
TEST(DirtyPlates, APlateThatSinksFarBeyondItsSizeIsDoubted) {
  const auto fit_of = [](double factor) {
    return fit_measured_plates(read_csv_of_plates(dirty_plates(4, [&](int, auto& readings) {
      for (PlateReadingAt& reading : readings) reading.sinkage *= factor;
    })));
  };
  const MeasuredPlatesFit clean = fit_of(1), off = fit_of(20);
  EXPECT_FALSE(tell_of(doubts(clean), DoubtKind::sunk_beyond_plate));
  EXPECT_NEAR(off.deepest, 20 * clean.deepest, 1e-12);
  EXPECT_TRUE(tell_of(doubts(off), DoubtKind::sunk_beyond_plate));
}

// Re-tests that scatter as sand's do are none of them disowned, and one of four times the pressure is.
TEST(DirtyPlates, ATestThatDisagreesIsNamedAndRepeatsAreNot) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int disowned = 0, named = 0;
  for (int i = 0; i < 200; ++i)
    for (const double factor : {1.0, 4.0}) {
      const MeasuredPlatesFit fit =
          fit_measured_plates(read_csv_of_plates(dirty_plates(6, [&](int test, auto& readings) {
            const double share = std::exp(0.1 * normal(random)) * (test == 5 ? factor : 1.0);
            for (PlateReadingAt& reading : readings) reading.pressure *= share;
          })));
      const auto aside = std::ranges::count_if(fit.apart, [](const auto& one) { return one.apart.set_aside; });
      if (factor == 1.0)
        disowned += aside > 0;
      else
        named += aside == 1 && fit.apart.front().test == "5";
    }
  EXPECT_LE(disowned, 4);
  EXPECT_GE(named, 180);
}

// Thirteen tests of one plate: n and k = k_c/b + k_phi, and a file that takes k_c = 0.
TEST(DirtyPlates, OneSizeOfPlateGivesNAndK) {
  std::string csv = plate_columns;
  for (int test = 0; test < 13; ++test)
    csv += rows_of_a_plate(0.1, fmt::format("t{}", test), 1.0 + 0.05 * (test % 3 - 1));
  const MeasuredPlatesFit fit = fit_measured_plates(read_csv_of_plates(csv));
  ASSERT_TRUE(fit.one_size());
  EXPECT_NEAR(fit.exponent.estimate.value, made_n, 1e-4);
  EXPECT_NEAR(fit.k_phi.estimate.value, made_k_c / 0.05 + made_k_phi, 1e-2 * made_k_phi);
  const double own = 0.05 * std::sqrt(8.0 / 12),
               scatter = std::sqrt((12 * own * own + usual_freedom * usual_k * usual_k) / (12 + usual_freedom));
  EXPECT_NEAR(fit.k_phi.between_tests,
              scatter * std::sqrt(14.0 / 13) * gsl::student_factor(12 + usual_freedom) * (made_k_c / 0.05 + made_k_phi),
              0.002 * made_k_phi);
  EXPECT_THAT(doubts(fit), testing::Contains(test::tells(DoubtKind::one_plate_size, {50})));
  const Report report = report_on(fit, {}, "x");
  EXPECT_THAT(text_of(report), AllOf(HasSubstr("k stands for k_c/b + k_phi at b = 50 mm"),
                                     HasSubstr("k_c: {value: 0 kN/m^(n+1), sd: 0")));
  EXPECT_TRUE(report.data()["k_c"].is_null());
  EXPECT_NO_THROW(
      read_plates(make_source_text("test,sinkage_m,pressure_kPa\na,0.01,9\na,0.02,18\n", "plates.csv"), {}, 0.1));
}

// The plates of the CMU sand, 3.5 % of whose readings jump by 2 to 30 times, a hundred times over: the clean answer,
// soon.
TEST(DirtyPlates, SpikesOnARealFileChangeNothing) {
  const std::string file = SOILBIN_SOURCE_DIR "/cases/measured/plates/cmu-plates.csv";
  const auto clean = read_plates(read_source_text(file, largest_plate_csv), {{"box", "large-box"}});
  std::vector<MeasuredPlate> dirty;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  for (int copy = 0; copy < 100; ++copy)
    for (MeasuredPlate plate : clean) {
      plate.test += fmt::format(", copy {}", copy);
      for (std::size_t i = 0; i < plate.curve.pressure.size(); ++i)
        if (uniform(random) < 0.035)
          (uniform(random) < 0.5 ? plate.curve.pressure : plate.curve.sinkage)[i] *= 2 + 28 * uniform(random);
      dirty.push_back(std::move(plate));
    }
  const MeasuredPlatesFit of_clean = fit_measured_plates(clean);
  for (const std::size_t tests : {std::size_t{9}, dirty.size()}) {
    const MeasuredPlatesFit fit = fit_measured_plates(std::span(dirty).first(tests));
    EXPECT_NEAR(fit.exponent.estimate.value, of_clean.exponent.estimate.value,
                0.1 * of_clean.exponent.estimate.std_error);
    EXPECT_NEAR(fit.k_phi.estimate.value, of_clean.k_phi.estimate.value, of_clean.k_phi.estimate.std_error);
    EXPECT_LT((*fit.kept)[0], 0.7) << "with the spikes";
    EXPECT_NEAR(static_cast<double>(fit.readings_aside()) / static_cast<double>(fit.readings + fit.readings_aside()),
                0.038, 0.008);
  }
}

// Of measured files that hold no spikes little goes: none of GRC-1's readings, and on the CMU sand the two holds of 9
// and 20 readings at a sinkage that stays.
TEST(DirtyPlates, CleanFilesLoseNothingButHolds) {
  const std::string folder = SOILBIN_SOURCE_DIR "/cases/measured/plates/";
  EXPECT_EQ(fit_measured_plates(read_plates(read_source_text(folder + "grc1-plates.csv", largest_plate_csv)))
                .readings_aside(),
            0u);
  const MeasuredPlatesFit cmu =
      fit_measured_plates(read_plates(read_source_text(folder + "cmu-plates.csv", largest_plate_csv)));
  EXPECT_EQ(cmu.readings_aside(), 29u);
  for (const PlateReadingsAside& one : cmu.aside) EXPECT_EQ(one.readings.why, AsideWhy::unloading);
}

}  // namespace
}  // namespace soilbin::compare
