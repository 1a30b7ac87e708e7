// Errors of a drive's steady state, from the soil's standard deviations.
#include "compare/drives/drive_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/effect_vocabulary.hpp"
#include "scenario/case.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

Case driven_case() {
  const std::string cases = SOILBIN_SOURCE_DIR "/cases";
  Case question =
      read_case(cases + "/studies/drive-in-grains.yaml", Library({cases}), bekker_wong::CatalogueVocabulary());
  for (const SoilParameter& p : soil_parameters) ((*question.scenario.soil.semi_empirical).*p.value).std_error = 0;
  return question;
}

DriveSide side_of(const Case& question) { return analytic_side(run_drive(question, 40)); }

// [f(x + sd) - f(x - sd)]/2, by drives of two soils.
TEST(SlowDriveSides, AnErrorIsHalfOfWhatLiesBetweenTheSoilsAStandardDeviationAway) {
  const auto sinkage_at = [](double k_phi) {
    Case question = driven_case();
    question.scenario.soil.semi_empirical->k_phi.value = k_phi;
    return side_of(question).steady.value().sinkage.value;
  };
  Case question = driven_case();
  Estimate& k_phi = question.scenario.soil.semi_empirical->k_phi;
  k_phi.std_error = 0.1 * k_phi.value;
  const double expected = std::abs(sinkage_at(1.1 * k_phi.value) - sinkage_at(0.9 * k_phi.value)) / 2;
  EXPECT_NEAR(side_of(question).steady.value().sinkage.std_error, expected, 1e-6 * expected);
}

// A clay without friction, in doubt: the error is the change to the admissible side.
TEST(SlowDriveSides, AnErrorAtABoundIsOneSided) {
  Case question = driven_case();
  SemiEmpiricalSoil& soil = *question.scenario.soil.semi_empirical;
  soil.exponent.value = 1.0, soil.cohesion.value = 20e3, soil.friction_angle = {0.0, 0.03};
  const DriveSide side = side_of(question);
  ASSERT_TRUE(side.steady.has_value()) << side.not_steady;
  soil.friction_angle = {0.03, 0.0};
  const double expected = std::abs(side_of(question).steady.value().speed.value - side.steady->speed.value);
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(side.steady->speed.std_error, expected, 1e-6 * expected);
}

}  // namespace
}  // namespace soilbin::compare
