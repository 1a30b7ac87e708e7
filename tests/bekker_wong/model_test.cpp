// The soil of a case as the wheel takes it.
#include "bekker_wong/model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenario/soil_parameters.hpp"

namespace soilbin::bekker_wong {
namespace {

TEST(ValuesOf, EachParameterGoesToItsOwnMember) {
  SemiEmpiricalSoil soil;
  for (std::size_t i = 0; i < soil_parameters.size(); ++i)
    soil.*soil_parameters[i].value = {1.0 + static_cast<double>(i), 0.5};
  soil.density = 1234;
  const SoilValues values = values_of(soil);
  EXPECT_EQ(values.exponent, soil.exponent.value);
  EXPECT_EQ(values.k_c, soil.k_c.value);
  EXPECT_EQ(values.k_phi, soil.k_phi.value);
  EXPECT_EQ(values.cohesion, soil.cohesion.value);
  EXPECT_EQ(values.friction_angle, soil.friction_angle.value);
  EXPECT_EQ(values.shear_modulus, soil.shear_modulus.value);
  EXPECT_EQ(values.c1, soil.stress_angle_c1.value);
  EXPECT_EQ(values.c2, soil.stress_angle_c2.value);
  EXPECT_EQ(values.density, 1234);
}

TEST(ContactArea, IsWhatARigidWheelsContactCoversSeenFromAbove) {
  Scenario scenario;
  scenario.tire.radius = 0.3, scenario.tire.width = 0.2;
  SemiEmpiricalSoil& soil = scenario.soil.semi_empirical.emplace();
  soil.exponent.value = 1.0, soil.k_phi.value = 1e6, soil.friction_angle.value = 0.5, soil.shear_modulus.value = 0.01;
  soil.stress_angle_c1.value = 0.3, soil.stress_angle_c2.value = 0.2;
  const TractionResult r = BekkerWong().evaluate(scenario, {.load = 800, .slip = 0.2});
  EXPECT_NEAR(r.contact_area, 0.2 * 0.3 * (std::sin(r.entry_angle) - std::sin(r.exit_angle)), 1e-12);
}

}  // namespace
}  // namespace soilbin::bekker_wong
