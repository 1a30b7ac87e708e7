// Measured plates beside grains: which pressures are asked, and grains that are pressed as the plates were.
#include "compare/experiments/plate_curves.hpp"

#include <gmock/gmock.h>

#include "compare/experiments/element_experiments.hpp"
#include "compare/report/report.hpp"
#include "compare/telling/reports.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::compare {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// p = 2 MN/m^3 z, pressed to this depth in 40 readings.
MeasuredPlate straight(double diameter, double deepest, double factor = 1.0) {
  MeasuredPlate plate{.test = "made", .curve = {.radius = diameter / 2, .pressure = {}, .sinkage = {}}};
  for (int k = 1; k <= 40; ++k) {
    plate.curve.sinkage.push_back(deepest * k / 40);
    plate.curve.pressure.push_back(factor * 2e6 * deepest * k / 40);
  }
  return plate;
}

std::vector<std::string> names_of(const std::vector<Target>& targets) {
  std::vector<std::string> names;
  for (const Target& target : targets) names.push_back(target.name);
  return names;
}

TEST(PlateCurves, AskForPressuresAtHalvedSinkages) {
  const std::vector tests{straight(0.15, 0.080)};
  const auto points = points_of(tests);
  const auto targets = targets_of(tests, points);
  EXPECT_THAT(names_of(targets), ElementsAre("pressure.10mm", "pressure.20mm", "pressure.40mm", "pressure.80mm"));
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(targets[k].measured.value, 2e6 * points[k].sinkage, 1e-6 * 2e6);
    EXPECT_NEAR(targets[k].measured.std_error, 0.1 * targets[k].measured.value, 1e-3);
    EXPECT_NEAR(*targets[k].tolerance, 2 * targets[k].measured.std_error, 1e-9);
  }
}

TEST(PlateCurves, EachSizeGoesAsDeepAsItsShallowestTest) {
  const std::vector tests{straight(0.3, 0.02), straight(0.15, 0.08), straight(0.15, 0.04)};
  const auto points = points_of(tests);
  ASSERT_EQ(points.size(), 8U);
  EXPECT_DOUBLE_EQ(points[3].diameter, 0.15);
  EXPECT_THAT(points[3].sinkage, DoubleNear(0.04, 1e-12));
  EXPECT_THAT(points[7].sinkage, DoubleNear(0.02, 1e-12));
  EXPECT_EQ(targets_of(tests, points).front().name, "pressure.150mm.5mm");
  EXPECT_THAT(points_of(tests, 0.01)[3].sinkage, DoubleNear(0.01, 1e-12));
}

TEST(PlateCurves, WithoutTestsNothingIsAsked) {
  EXPECT_TRUE(points_of({}).empty());
  EXPECT_TRUE(beside_measured({}, {}, {}).features.empty());
}

// Grains bear from 5 mm above their mean surface on, 1 kPa 3 mm above it: 2 mm below that the pressure is that at -1
// mm.
TEST(PlateCurves, SinkageOfGrainsCountsFromTheSeat) {
  dem::PlateRun run{.diameter = 0.15, .speed = 0, .curve = {}};
  for (const auto& [sinkage, pressure] : {std::pair{-5e-3, 100.0}, {-3e-3, 1100.0}, {-1e-3, 4000.0}, {1e-3, 9000.0}})
    run.curve.push_back({sinkage, pressure});
  EXPECT_EQ(run.seat(), -3e-3);
  EXPECT_NEAR(simulated({0.15, 2e-3}, {run}).value, 4000.0, 1e-9);
}

// Two tests, 0.5 and 1.5 of their mean: the error is that of their mean, half of it, and not the 10 % taken elsewhere.
TEST(PlateCurves, ErrorsCoverWhatTestsDiffer) {
  const std::vector tests{straight(0.15, 0.08, 0.5), straight(0.15, 0.08, 1.5)};
  for (const Target& target : targets_of(tests, points_of(tests)))
    EXPECT_NEAR(target.measured.std_error / target.measured.value, 0.5, 1e-9);
}

// An unloading and its return say nothing of the pressure that a depth bears.
TEST(PlateCurves, ReadTheLoadingAlone) {
  MeasuredPlate plain = straight(0.15, 0.08), held = plain;
  const auto at = [](std::vector<double>& values, int place) { return values.begin() + place; };
  held.curve.pressure.insert(at(held.curve.pressure, 20), {1.2e4, 4e3, 1.6e4, 6e4});
  held.curve.sinkage.insert(at(held.curve.sinkage, 20), {0.0398, 0.0396, 0.0397, 0.0399});
  const std::vector first{plain}, second{held};
  const auto points = points_of(first);
  const auto a = targets_of(first, points), b = targets_of(second, points);
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(b[k].measured.value, a[k].measured.value, 1.0);
}

GranularSoil grains() {
  GranularSoil soil = dem::test::soft_soil();
  soil.youngs_modulus = 2e7;
  return soil;
}

// Half of the pressure at 20 mm is ten errors of 5 % off, all of it at 10 mm none.
TEST(PlateCurves, AnAnswerBeginsWithHowNearGrainsCome) {
  const MeasuredPlate plate = straight(0.15, 20e-3);
  dem::PlateRun run{.diameter = 0.15, .speed = 0, .curve = {{0, 2e3}, {20e-3, 20e3}}};
  const MeasuredBeside<MeasuredPlate> beside{
      {plate},
      {{{"pressure.10mm", {20e3, 1e3}, "kPa"}, {20e3, 0}}, {{"pressure.20mm", {40e3, 2e3}, "kPa"}, {20e3, 0}}}};
  EXPECT_THAT(text_of(report_on(std::vector{run}, "sand", beside)),
              HasSubstr("Grains are within 2 errors of the measured tests at 1 of 2 features; farthest off is "
                        "pressure.20mm: 20.00 kPa for 40.0 ± 2.0 measured."));
}

// The virtual test is dem::plate_sinkage with the measured plates; a soil whose measured plates are its own grains
// differs from them by nothing.
TEST(SlowPlateCurves, GrainsArePressedAsTheMeasuredPlates) {
  const double grain = mean_diameter(grains());
  ContactQuestion question;
  question.test = SandTest::plate, question.how.threads = 1;
  question.plates = {straight(6 * grain, grain)};
  const auto points = points_of(question.plates);
  question.targets = targets_of(question.plates, points);
  question.factors = {{"sliding_friction", 0.2, 0.8, "-"}, {settling_friction_factor, 0, 1, "-"}};
  Soil soil;
  soil.granular = grains();
  const std::vector<Estimate> answer = contact_test(soil, question).run(Eigen::Vector2d(0.6, 0.5), 1);

  GranularSoil own = grains();
  own.grain_grain.sliding_friction = 0.6;
  dem::PlateSettings settings = pressed_as(points, own, {});
  EXPECT_THAT(settings.diameters, ElementsAre(DoubleNear(6, 1e-12)));
  settings.bed.specimen.settling_friction = 0.5;
  static_cast<dem::LawFlags&>(settings.bed.specimen.laws) = dem::laws_of(own);
  const auto runs = dem::plate_sinkage(own, settings, question.how);
  ASSERT_EQ(answer.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(answer[k].value, simulated(points[k], runs).value);

  MeasuredPlate itself{.test = "grains", .curve = {.radius = 3 * grain, .pressure = {}, .sinkage = {}}};
  const double seat = runs.front().seat();
  for (const dem::PlateSample& at : runs.front().curve)
    if (at.sinkage > seat && at.pressure > 0)
      itself.curve.sinkage.push_back(at.sinkage - seat), itself.curve.pressure.push_back(at.pressure);
  for (const FeatureBeside& one : beside_measured({itself}, points_of(std::vector{itself}, 0.9 * grain), runs).features)
    EXPECT_NEAR(one.off(), 0, 0.5) << one.measured.name;
}

}  // namespace
}  // namespace soilbin::compare
