// What a wheel can do at best, where a fit says how the soil's values err together.
#include "compare/sweep/wheel_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

/// Errors of the wheel that is towed on a sand whose k_c/b and k_phi err by as much, with a correlation.
TowedWheel towed_with(const std::vector<FittedError>& errors) {
  Case question;
  question.scenario = soilbin::test::wheel_on_sand();
  SemiEmpiricalSoil& sand = *question.scenario.soil.semi_empirical;
  sand.shear_modulus.std_error = 0.0;
  sand.k_phi.std_error = 100e3, sand.k_c.std_error = 100e3 * question.scenario.tire.width;
  question.study.models.emplace_back().errors = errors;
  question.study.conditions = {soilbin::test::condition(80.0, 0.0)};
  return *limits_of(question).front().towed;
}

// The wheel knows (k_c/b + k_phi) alone.
TEST(TowedWheel, HearsOfCorrelations) {
  const TowedWheel apart = towed_with({}), none = towed_with({{"k_c", {}, {}}, {"k_phi", {}, {0.0}}}),
                   against = towed_with({{"k_c", {}, {}}, {"k_phi", {}, {-1.0}}}),
                   together = towed_with({{"k_c", {}, {}}, {"k_phi", {}, {1.0}}});
  for (Estimate TowedWheel::*of : {&TowedWheel::slip, &TowedWheel::resistance}) {
    const double error = (apart.*of).std_error;
    EXPECT_GT(error, 1e-4 * std::abs((apart.*of).value));
    EXPECT_EQ((none.*of).std_error, error);
    EXPECT_LT((against.*of).std_error, 1e-5 * error);
    EXPECT_NEAR((together.*of).std_error, std::sqrt(2.0) * error, 1e-6 * error);
  }
}

}  // namespace
}  // namespace soilbin::compare
