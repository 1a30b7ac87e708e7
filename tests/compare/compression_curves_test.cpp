// Triaxial compression as curves: what a curve says of a sand, files of measured tests, and grains pressed at their
// pressures.
#include "compare/experiments/compression_curves.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <tuple>

#include "compare/experiments/element_experiments.hpp"
#include "scenario/csv.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;

/// sine = s (1 - exp(-strain/k)), read every 0.01 %; volume falls in proportion.
CompressionCurve rising(double s, double k, double volume_at_end) {
  CompressionCurve curve{.test = "made", .confining = 100e3};
  curve.void_ratio = 0.7;
  for (int i = 1; i <= 2000; ++i) {
    curve.strain.push_back(i * 1e-4);
    curve.sine.push_back(s * (1 - std::exp(-i * 1e-4 / k)));
    curve.volumetric.push_back(volume_at_end * i / 2000);
  }
  return curve;
}

double of(const CompressionCurve& curve, CurveFeature feature) { return feature_of(curve, feature).value(); }

TEST(CompressionCurves, FeaturesOfAnExponentialCurveAreItsOwn) {
  const CompressionCurve curve = rising(0.55, 0.004, -0.03);
  EXPECT_NEAR(of(curve, CurveFeature::peak_angle), std::asin(0.55), 1e-6);
  EXPECT_NEAR(of(curve, CurveFeature::end_angle), std::asin(0.55), 1e-6);
  EXPECT_NEAR(of(curve, CurveFeature::half_strain), 0.004 * std::log(2), 1e-6);
  EXPECT_NEAR(of(curve, CurveFeature::volume), -0.03 * 0.95, 1e-4);  // mean over the last tenth
  EXPECT_EQ(of(curve, CurveFeature::void_ratio), 0.7);
}

TEST(CompressionCurves, AFeatureUpToAStrainKnowsNothingOfWhatComesLater) {
  CompressionCurve softening = rising(0.55, 0.004, -0.03);
  for (std::size_t i = 1000; i < softening.sine.size(); ++i) softening.sine[i] = 0.45;
  EXPECT_NEAR(*feature_of(softening, CurveFeature::end_angle, 0.1), std::asin(0.55), 1e-6);
  EXPECT_NEAR(*feature_of(softening, CurveFeature::end_angle, 0.2), std::asin(0.45), 1e-6);
}

TEST(CompressionCurves, WhatWasNotMeasuredIsNoTarget) {
  CompressionCurve curve = rising(0.55, 0.004, -0.03);
  curve.void_ratio.reset(), curve.volumetric.clear();
  std::vector<std::string> names;
  for (const Target& target : targets_of(std::vector{curve})) names.push_back(target.name);
  EXPECT_THAT(names, ElementsAre("peak_angle.made", "end_angle.made", "half_strain.made"));
}

TEST(CompressionCurves, CullinansDrainedTestsAreRead) {
  const auto tests =
      read_compression(read_source_text(SOILBIN_SOURCE_DIR "/cases/measured/cullinan/triaxial.csv", largest_csv));
  std::vector<std::string> names;
  for (const CompressionCurve& test : tests) names.push_back(test.test);
  EXPECT_THAT(names, ElementsAre("TX13", "TX15", "TX17"));  // the undrained ones are left aside
  EXPECT_EQ(tests[1].confining, 50e3);
  EXPECT_NEAR(of(tests[1], CurveFeature::peak_angle) / degree, 32.5, 0.2);
  EXPECT_LT(of(tests[2], CurveFeature::volume), -0.02);  // the dense one dilates
  EXPECT_GT(of(tests[0], CurveFeature::volume), 0.0);
}

std::vector<std::string> names_of(const std::vector<Factor>& factors) {
  std::vector<std::string> names;
  for (const Factor& factor : factors) names.push_back(factor.name);
  return names;
}

TEST(CompressionCurves, SpecimensOfEachDensitySettleApart) {
  std::vector<CompressionCurve> tests(4, rising(0.5, 0.004, -0.01));
  for (const auto& [k, name, void_ratio] : {std::tuple{0, "a", 0.58}, {1, "b", 0.85}, {2, "c", 0.83}, {3, "d", 0.60}})
    tests[k].test = name, tests[k].void_ratio = void_ratio;
  const auto densities = by_density(tests);
  ASSERT_EQ(densities.size(), 2U);
  const auto tests_of = [&](std::size_t i) {
    std::vector<std::string> names;
    for (const CompressionCurve& test : densities[i]) names.push_back(test.test);
    return names;
  };
  EXPECT_THAT(tests_of(0), ElementsAre("b", "c"));  // the loosest first
  EXPECT_THAT(tests_of(1), ElementsAre("a", "d"));
  EXPECT_THAT(names_of(usual_factors_of_curves(tests)),
              ElementsAre("sliding_friction", "rolling_friction", "youngs_modulus", "settling_friction.b",
                          "settling_friction.a"));
  EXPECT_THAT(names_of(usual_factors_of_curves({tests[1], tests[2]})),
              ElementsAre("sliding_friction", "rolling_friction", "youngs_modulus", "settling_friction"));
}

constexpr const char* header = "test,cell_pressure_bar,axial_strain_percent,q_kPa,volumetric_strain_percent\n";

std::string rows(const std::string& name, double pressure_bar) {
  std::string text;
  for (int i = 0; i < 30; ++i)
    text += name + "," + std::to_string(pressure_bar) + "," + std::to_string(0.1 * i) + "," + std::to_string(8.0 * i) +
            "," + std::to_string(-0.05 * i) + "\n";
  return text;
}

TEST(CompressionCurves, LaboratoryStrainsBecomeLogarithmic) {
  const auto tests = read_compression(make_source_text(header + rows("a", 1), "lab.csv"));
  EXPECT_NEAR(tests[0].strain.back(), -std::log(1 - 0.029), 1e-12);
  EXPECT_NEAR(tests[0].volumetric.back(), -std::log(1 + 0.0145), 1e-12);
  EXPECT_NEAR(tests[0].sine.back(), 232e3 / (232e3 + 200e3), 1e-9);
  EXPECT_FALSE(tests[0].void_ratio);
}

std::string curves_refused(const std::string& text, const std::vector<std::string>& names = {}) {
  return refusal([&] { read_compression(make_source_text(text, "lab.csv"), names); });
}

TEST(CompressionCurves, AFileThatCannotBeMeantIsRefused) {
  EXPECT_THAT(curves_refused("test,q_kPa\na,1\n"), HasSubstr("no column 'cell_pressure_kPa'"));
  EXPECT_THAT(curves_refused(header + rows("a", 1) + rows("a", 2)), HasSubstr("test 'a' has a second cell pressure"));
  EXPECT_THAT(curves_refused(header + rows("first", 1), {"fist"}), HasSubstr("did you mean 'first'"));
  EXPECT_THAT(curves_refused(std::string(header) + "a,1,0.5,8,0\n"), HasSubstr("20 and 1 % are needed"));
  EXPECT_THAT(curves_refused(std::string(header) + "a,0,0.5,8,0\n"), HasSubstr("cell pressure must be above 0"));
}

// The virtual test is the cell itself: its answers are the features of the curves that dem::triaxial gives.
TEST(SlowCompressionCurves, GrainsArePressedAsTheMeasuredTests) {
  Soil soil;
  soil.granular = dem::test::soft_soil();
  CompressionCurve measured = rising(0.5, 0.004, -0.01);
  measured.confining = 20e3;
  ContactQuestion question;
  question.factors = {
      {"sliding_friction", 0.2, 0.8, "-"}, {"youngs_modulus", 1e6, 1e8, "MPa"}, {settling_friction_factor, 0, 1, "-"}};
  question.curves = {measured}, question.targets = targets_of(question.curves), question.how.threads = 1;
  const VirtualTest test = contact_test(soil, question);
  Eigen::Vector3d values(0.6, 2e7, 0.5);
  const std::vector<Estimate> answer = test.run(values, 1);

  GranularSoil grains = *soil.granular;
  grains.grain_grain.sliding_friction = 0.6, grains.youngs_modulus = 2e7;
  dem::TriaxialSettings cell;
  cell.stresses = {20e3}, cell.strain = 0.2, cell.samples = 1000;
  cell.specimen.settling_friction = 0.5;
  static_cast<dem::LawFlags&>(cell.specimen.laws) = dem::laws_of(grains);
  dem::WorkOptions how;
  how.threads = 1;
  const CompressionCurve curve = curve_of(dem::triaxial(grains, cell, how).runs.front());
  ASSERT_EQ(answer.size(), static_cast<std::size_t>(curve_features));
  for (int k = 0; k < curve_features; ++k)
    EXPECT_EQ(answer[static_cast<std::size_t>(k)].value, of(curve, static_cast<CurveFeature>(k)));
}

// A test of another density has the answers that it has alone, by its own way of settling.
TEST(SlowCompressionCurves, ADenserTestIsAnsweredAsByItself) {
  Soil soil;
  soil.granular = dem::test::soft_soil();
  soil.granular->youngs_modulus = 2e7;
  CompressionCurve loose = rising(0.5, 0.004, -0.01), dense = loose;
  loose.confining = dense.confining = 20e3;
  loose.test = "loose", dense.test = "dense", dense.void_ratio = 0.55;
  const auto answers = [&](const std::vector<CompressionCurve>& tests, const std::vector<double>& settling) {
    ContactQuestion question;
    question.curves = tests, question.targets = targets_of(tests), question.how.threads = 1;
    for (const Factor& factor : usual_factors_of_curves(tests))
      if (factor.name.starts_with(settling_friction_factor)) question.factors.push_back(factor);
    std::vector<double> values;
    for (const Estimate& one :
         contact_test(soil, question).run(Eigen::Map<const Eigen::VectorXd>(settling.data(), settling.size()), 1))
      values.push_back(one.value);
    return values;
  };
  std::vector<double> apart = answers({loose}, {1.0});
  const std::vector<double> denser = answers({dense}, {0.0});
  apart.insert(apart.end(), denser.begin(), denser.end());
  EXPECT_EQ(answers({loose, dense}, {1.0, 0.0}), apart);
}

TEST(SlowCompressionCurves, StandBesideTheGrainsAtTheirPressure) {
  CompressionCurve measured = rising(0.5, 0.004, -0.01);
  measured.confining = 20e3;
  dem::TriaxialSettings cell;
  cell.side = 5, cell.height = 8;
  cell = pressed_as(std::vector{measured}, cell);
  EXPECT_THAT(cell.stresses, ElementsAre(20e3));
  EXPECT_EQ(cell.strain, measured.strain.back());
  cell.strain = 0.1, cell.samples = 200;
  GranularSoil grains = dem::test::soft_soil();
  grains.youngs_modulus = 2e7;
  const auto runs = dem::triaxial(grains, cell).runs;
  const MeasuredBeside beside = beside_measured({measured}, runs);
  ASSERT_EQ(beside.features.size(), static_cast<std::size_t>(curve_features));
  const FeatureBeside& peak = beside.features.front();
  EXPECT_EQ(peak.measured.name, "peak_angle.made");
  EXPECT_EQ(peak.grains.value, of(curve_of(runs.front()), CurveFeature::peak_angle));
  EXPECT_DOUBLE_EQ(peak.off() * peak.measured.measured.std_error,
                   peak.grains.value - peak.measured.measured.value);  // one packing has no error of its own
}

}  // namespace
}  // namespace soilbin::compare
