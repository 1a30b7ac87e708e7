// Measured shear tests: exact curves give back what they were made of; a hump, one normal stress, files that are none.
#include "compare/bevameter/measured_shear.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>

#include "compare/bevameter/plate_tests.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/doubts/doubts.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

constexpr double made_cohesion = 2e3, made_phi = 31 * degree, made_modulus = 0.012;

/// Janosi's curve to 60 mm under a normal stress; behind `peak_at` it falls to `falls_to` of its top.
std::string rows_of_a_test(const std::string& name, double normal_stress, double c, double peak_at = 1.0,
                           double falls_to = 1.0) {
  std::string rows;
  for (int k = 1; k <= 60; ++k) {
    const double j = 1e-3 * k, top = c + normal_stress * std::tan(made_phi);
    double tau = -top * std::expm1(-j / made_modulus);
    if (j > peak_at) tau = falls_to * top;
    rows += fmt::format("{},{:.9g},{:.9g},{:.9g}\n", name, 1e3 * j, tau / 1e3, normal_stress / 1e3);
  }
  return rows;
}

constexpr const char* header = "test,displacement_mm,shear_stress_kPa,normal_stress_kPa\n";

std::vector<MeasuredShear> read(const std::string& rows) {
  return read_shear(make_source_text(header + rows, "shear.csv"));
}

TEST(MeasuredShear, GivesBackWhatExactCurvesWereMadeOf) {
  const auto tests = read(rows_of_a_test("a", 10e3, made_cohesion) + rows_of_a_test("b", 30e3, made_cohesion) +
                          rows_of_a_test("c", 60e3, made_cohesion));
  ASSERT_EQ(tests.size(), 3U);
  EXPECT_EQ(tests[1].test, "b");
  EXPECT_DOUBLE_EQ(tests[1].curve.normal_stress, 30e3);
  const MeasuredShearFit fit = fit_measured_shear(tests);
  EXPECT_NEAR(fit.cohesion.value, made_cohesion, 0.1);
  EXPECT_NEAR(fit.friction_angle.value, made_phi, 1e-6);
  EXPECT_NEAR(fit.shear_modulus.value, made_modulus, 1e-7);
  EXPECT_NEAR(fit.friction_angle.std_error, 0.0, 1e-6);
  EXPECT_FALSE(fit.one_stress);
  EXPECT_FALSE(fit.residual_angle);
}

TEST(MeasuredShear, FitsUpToAPeakAndTellsTheResidualStrength) {
  const auto tests = read(rows_of_a_test("a", 20e3, 0.0, 0.04, 0.7) + rows_of_a_test("b", 40e3, 0.0, 0.04, 0.7));
  const MeasuredShearFit fit = fit_measured_shear(tests);
  EXPECT_NEAR(fit.shear_modulus.value, made_modulus, 1e-6);
  EXPECT_NEAR(fit.friction_angle.value, made_phi, 1e-5);
  ASSERT_TRUE(fit.residual_angle);
  EXPECT_NEAR(fit.residual_angle->value, std::atan(0.7 * std::tan(made_phi)), 1e-6);
  EXPECT_NEAR(fit.tests[0].peak_at, 0.04, 1e-9);
}

TEST(MeasuredShear, DoesNotPartCohesionFromFrictionUnderOneStress) {
  const MeasuredShearFit fit =
      fit_measured_shear(read(rows_of_a_test("a", 20e3, made_cohesion) + rows_of_a_test("b", 20e3, made_cohesion)));
  EXPECT_TRUE(fit.one_stress);
  EXPECT_EQ(fit.cohesion.value, 0.0);
  EXPECT_NEAR(std::tan(fit.friction_angle.value), std::tan(made_phi) + made_cohesion / 20e3, 1e-6);
}

// Three stresses once each, on a smooth line: what beds scatter is not in that. Where one was tested twice, it is.
TEST(MeasuredShear, StressesThatWereNeverRepeatedAreTold) {
  const auto told = [](const std::string& rows) {
    const auto tests = read(rows);
    return doubts(fit_measured_shear(tests), tests);
  };
  const std::string once = rows_of_a_test("a", 10e3, made_cohesion) + rows_of_a_test("b", 30e3, made_cohesion) +
                           rows_of_a_test("c", 60e3, made_cohesion);
  EXPECT_THAT(told(once), testing::ElementsAre(test::tells(DoubtKind::no_repeated_shear_tests, {3})));
  EXPECT_THAT(told(once + rows_of_a_test("d", 31e3, made_cohesion)), testing::IsEmpty());
}

TEST(MeasuredShear, CutsACohesionBelowZeroOff) {
  const MeasuredShearFit fit =
      fit_measured_shear(read(rows_of_a_test("a", 20e3, -500) + rows_of_a_test("b", 40e3, -500)));
  EXPECT_NEAR(fit.cohesion_as_fitted, -500.0, 0.1);
  EXPECT_EQ(fit.cohesion.value, 0.0);
  EXPECT_LT(fit.friction_angle.value, made_phi);
}

/// rows_of_a_test as a load cell logs it: the normal stress of each reading is a little other, by `share` of it at
/// most.
std::string logged_rows(const std::string& name, double normal_stress, double share) {
  std::string rows;
  for (int k = 1; k <= 60; ++k) {
    const double j = 1e-3 * k, top = normal_stress * std::tan(made_phi);
    rows += fmt::format("{},{:.9g},{:.9g},{:.9g}\n", name, 1e3 * j, -top * std::expm1(-j / made_modulus) / 1e3,
                        normal_stress * (1 + share * std::sin(7.0 * k)) / 1e3);
  }
  return rows;
}

TEST(MeasuredShear, ALoggedNormalStressIsItsTestsMean) {
  const auto tests = read(logged_rows("a", 20e3, 0.01) + logged_rows("b", 40e3, 0.01));
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].curve.displacement.size(), 60U);
  EXPECT_NEAR(tests[1].curve.normal_stress, 40e3, 0.001 * 40e3);
  EXPECT_NEAR(tests[1].normal_stress_spread, 0.01 * 40e3 / std::sqrt(2.0), 0.05 * 400) << "of a sine";
  EXPECT_NEAR(fit_measured_shear(tests).friction_angle.value, made_phi, 0.002);
  EXPECT_THAT(doubts(fit_measured_shear(tests), tests),
              testing::Not(testing::Contains(test::tells(DoubtKind::varying_normal_stress, {}))));
  const auto loose = read(logged_rows("a", 20e3, 0.1) + logged_rows("b", 40e3, 0.01));
  EXPECT_THAT(doubts(fit_measured_shear(loose), loose),
              testing::Contains(test::tells(DoubtKind::varying_normal_stress, {1})));
}

TEST(MeasuredShear, AStressThatWasSetTellsTestsOfOneLabelApart) {
  const auto tests = read(rows_of_a_test("sand", 20e3, 0.0) + rows_of_a_test("sand", 40e3, 0.0));
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[1].curve.normal_stress, 40e3);
  EXPECT_EQ(tests[1].normal_stress_spread, 0.0);
}

TEST(MeasuredShear, RefusesWhatIsNoShearTest) {
  const auto refused = [](const std::string& text) {
    return soilbin::test::refusal([&] { fit_measured_shear(read_shear(make_source_text(text, "shear.csv"))); });
  };
  EXPECT_THAT(refused("test,displacement_mm,shear_stress_kPa\n1,2,3\n"),
              HasSubstr("no column holds the normal stress"));
  EXPECT_THAT(refused("test,shear_stress_kPa,normal_stress_kPa\n1,2,3\n"),
              HasSubstr("no column holds the displacement"));
  EXPECT_THAT(refused(header + std::string("a,1,2,20\na,2,3,20\n")), HasSubstr("six are needed"));
  EXPECT_THAT(refused(header + logged_rows("a", 20e3, 0.01) + logged_rows("a", 40e3, 0.01)),
              HasSubstr("the normal stress of test 'a' goes from"));
  EXPECT_THAT(refused("test,displacement_m,shear_stress_kPa,normal_stress_kPa\na,20,10,20\na,40,12,20\n"),
              HasSubstr("the end of a column's name is the unit"));
}

}  // namespace
}  // namespace soilbin::compare
