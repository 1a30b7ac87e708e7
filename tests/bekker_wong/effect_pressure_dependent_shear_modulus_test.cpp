// pressure_dependent_shear_modulus: K that follows the normal stress.
#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

const std::string pressed_modulus = "pressure_dependent_shear_modulus";
const char* const modulus_forms[] = {"power", "linear", "constant_stiffness"};

ContactPatch patch(const EffectChoice& choice) { return wheel_on(sand(), make_effects({choice})).roll(driven()).patch; }

double torque_ratio(const char* form, const OperatingCondition& at) {
  return with({pressed_modulus, form, {}}, at).torque / base(at).torque;
}

// Where the shear test pressed with b p0, the declared K holds there: f(b) = 1.
TEST(PressureDependentShearModulus, DeclaredModulusHoldsAtThePivot) {
  const double p0 = sand().pressure_modulus(width) * std::pow(0.15 * radius, sand().exponent);
  const ContactPatch linear = patch({pressed_modulus, "linear", {{"a", 2.0}, {"b", 0.5}}});
  const ContactPatch power = patch({pressed_modulus, "power", {{"m", 0.4}, {"b", 3.0}}});
  for (int i = 0; i < linear.count; ++i) {
    const double x = std::max(linear.sigma[i] / p0, 0.02), y = std::max(power.sigma[i] / p0, 0.02);
    EXPECT_NEAR(linear.modulus[i], 0.02 * (1 + 2 * x) / 2, 1e-12);
    EXPECT_NEAR(power.modulus[i], 0.02 * std::pow(y / 3, 0.4), 1e-12);
  }
}

// K is softer than declared above p_0 and harder below it: at little slip the heavy wheel loses torque and pull, the
// light wheel gains.
TEST(PressureDependentShearModulus, HeavyWheelsLoseLightWheelsGain) {
  for (const char* form : modulus_forms) {
    SCOPED_TRACE(form);
    EXPECT_LT(torque_ratio(form, driven(2000, 0.1)), 0.97);
    EXPECT_GT(torque_ratio(form, driven(100, 0.1)), 1.03);
    EXPECT_LT(with({pressed_modulus, form, {}}, driven(2000, 0.1)).drawbar_pull, base(driven(2000, 0.1)).drawbar_pull);
    EXPECT_GT(with({pressed_modulus, form, {}}, driven(100, 0.1)).drawbar_pull, base(driven(100, 0.1)).drawbar_pull);
  }
  // A falling K turns the signs round.
  EXPECT_GT(with({pressed_modulus, "power", {{"m", -0.4}}}, driven(2000, 0.1)).torque, base(driven(2000, 0.1)).torque);
}

// The more slip, the less K matters; a locked wheel's shear knows no K at all.
TEST(PressureDependentShearModulus, FadesWithSlip) {
  for (const char* form : modulus_forms) {
    SCOPED_TRACE(form);
    double before = 1.0;
    for (const double slip : {0.05, 0.2, 0.5, 1.0}) {
      const double change = std::abs(torque_ratio(form, driven(1500, slip)) - 1);
      EXPECT_LT(change, before);
      before = change;
    }
    EXPECT_LT(before, 0.02);
    expect_silent(pressed_modulus, driven(100, -1.0));
  }
}

// The forms' equations at the nodes, p_0 = k (0.15 r)^n; sigma/p_0 is held above 0.02.
TEST(PressureDependentShearModulus, IsWhatTheFormsSay) {
  const SoilValues soil = sand();
  const double p0 = soil.pressure_modulus(width) * std::pow(0.15 * radius, soil.exponent), k0 = soil.shear_modulus;
  const double friction = std::tan(soil.friction_angle);
  const ContactPatch power = patch({pressed_modulus, "power", {{"m", 0.5}}}),
                     linear = patch({pressed_modulus, "linear", {{"a", 2.0}}});
  const ContactPatch stiff = patch({pressed_modulus, "constant_stiffness", {{"a", 1.0}}});
  int seen = 0;
  for (int i = 0; i < power.count; ++i) {
    if (power.sigma[i] < 0.02 * p0 || linear.sigma[i] < 0.02 * p0 || stiff.sigma[i] < 0.02 * p0) continue;
    ++seen;
    EXPECT_NEAR(power.modulus[i], k0 * std::sqrt(power.sigma[i] / p0), 1e-14);
    EXPECT_NEAR(linear.modulus[i], k0 / 3 * (1 + 2 * linear.sigma[i] / p0), 1e-14);
    // a = 1: the slope strength/K of the shear curve is the same at every node.
    EXPECT_NEAR(stiff.strength[i] / stiff.modulus[i], (soil.cohesion + p0 * friction) / k0, 1e-6);
  }
  EXPECT_GT(seen, 10);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
