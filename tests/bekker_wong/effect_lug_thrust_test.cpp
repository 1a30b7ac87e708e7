// lug_thrust: what lugs add to the tread's shear.
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/earth_pressure.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

Tire smooth() {
  Tire tire;
  tire.radius = radius;
  tire.width = width;
  return tire;
}

double gain(const char* form, const OperatingCondition& at) {
  return with({"lug_thrust", form, {}}, at).drawbar_pull - base(at).drawbar_pull;
}

TEST(LugThrust, ZeroAmplitudeIsTheBaseModel) {
  expect_base_at_zero("lug_thrust", driven());
  expect_heard("lug_thrust", driven());  // on a wheel that declares no lugs
}

// Lugs grip more soil: more pull and more torque at working slip. More shear carries more load: no deeper sinkage.
TEST(LugThrust, PullsMore) {
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id != "lug_thrust") continue;
    SCOPED_TRACE(form.form);
    for (const double slip : {0.1, 0.3, 0.6}) {
      const Reading r = with({form.id, form.form, {}}, driven(800, slip)), b = base(driven(800, slip));
      EXPECT_GT(r.drawbar_pull, b.drawbar_pull);
      EXPECT_GT(r.torque, b.torque);
      EXPECT_LT(r.sinkage, b.sinkage * (1 + 1e-12));
    }
  }
}

// Blades and sides hold a braked wheel back as well; the larger shear circle of a wheel whose slip is counted at its
// tread base slides less when braked, so it drags less.
TEST(LugThrust, BrakedWheel) {
  const OperatingCondition at = driven(500, -0.3);
  for (const char* form : {"side_factors", "passive_blade", "free_blade"}) EXPECT_LT(gain(form, at), 0.0) << form;
  EXPECT_GT(gain("shear_radius", at), 0.0);
}

// Slip counted at the tread base is too low by about h/r for the shear circle, so the gain is largest at low slip and
// gone where the shear is saturated; counted at the shear circle the gain at low slip is small.
TEST(LugThrust, TheRadiusOfTheSlipMattersAtLowSlip) {
  EXPECT_GT(gain("shear_radius", driven(800, 0.0)), 3 * std::abs(gain("shear_radius_own_slip", driven(800, 0.0))));
  EXPECT_GT(gain("shear_radius", driven(800, 0.05)), 4 * gain("shear_radius", driven(800, 0.6)));
}

// Under a surcharge the blades' thrust grows with the load; without it, only with the length of the contact.
TEST(LugThrust, SurchargeTellsTheBladesApartByLoad) {
  const auto growth = [](const char* form) { return gain(form, driven(1600, 0.4)) / gain(form, driven(400, 0.4)); };
  EXPECT_GT(growth("passive_blade"), 2.5);
  EXPECT_LT(growth("free_blade"), 2.5);
}

// Closed form: K -> 0 and phi = 0 give tau = c all along the arc: M = r b c theta_1 R_s with R_s = r + lambda_s h.
TEST(LugThrust, ShearRadiusInClosedForm) {
  SoilValues soil = sand();
  soil.friction_angle = 0, soil.shear_modulus = 1e-9;
  const double h = 0.05 * radius;
  const EffectList effects = make_effects({{"lug_thrust", "shear_radius", {{"lambda_s", 0.8}}}});
  const RolledWheel w = RollingWheel(smooth(), soil, effects).roll(driven(800, 0.5));
  EXPECT_NEAR(w.forces.torque, radius * width * soil.cohesion * w.balance_angle * (radius + 0.8 * h), 1e-6);
}

// Slip counted at the tread base: the shear circle slides by j_x = R_s (theta_1 - theta) - r (1 - s)(sin - sin).
TEST(LugThrust, ShearCircleSlidesOverTheSoilsOwnPath) {
  const double lambda = 0.8, rs = radius + lambda * 0.05 * radius;
  const EffectList effects = make_effects({{"lug_thrust", "shear_radius", {{"lambda_s", lambda}}}});
  const ContactPatch p = RollingWheel(smooth(), sand(), effects).roll(driven(800, 0.3)).patch;
  for (int i = 0; i < p.count; ++i) {
    const double t = p.theta[i], t1 = p.angles.entry;
    EXPECT_NEAR(p.j_x[i], rs * (t1 - t) - radius * 0.7 * (std::sin(t1) - std::sin(t)), 1e-15);
  }
}

// Without cohesion the side factor is a rougher soil: tan(phi') = tan(phi) (1 + 0.64 x acot x), x = h/b = 0.125.
TEST(LugThrust, SideFactorInSandIsFriction) {
  SoilValues soil = sand(), rougher;
  soil.cohesion = 0;
  rougher = soil;
  const double x = 0.05 * radius / width;
  rougher.friction_angle = std::atan(std::tan(soil.friction_angle) * (1 + 0.64 * x * std::atan(1 / x)));
  const Reading a = roll(soil, make_effects({{"lug_thrust", "side_factors", {}}}), driven());
  const Reading b = roll(rougher, {}, driven());
  EXPECT_NEAR(a.drawbar_pull, b.drawbar_pull, 1e-9);
  EXPECT_NEAR(a.torque, b.torque, 1e-9);
}

// In clay (phi = 0, K -> 0) a blade holds b (gamma h^2/2 + 2 c h), r theta_1/(2 pi r/24) of them stand in the contact,
// and each turns the axle at r + h/2.
TEST(LugThrust, FreeBladesInClosedForm) {
  SoilValues clay = sand();
  clay.friction_angle = 0, clay.shear_modulus = 1e-12, clay.cohesion = 5000;
  const EffectList effects = make_effects({{"lug_thrust", "free_blade", {{"a", 1.0}}}});
  const RolledWheel w = RollingWheel(smooth(), clay, effects).roll(driven(800, 0.5));
  const double h = 0.05 * radius, blade = width * (0.5 * 1600 * 9.80665 * h * h + 2 * 5000 * h);
  ASSERT_EQ(w.forces.added.rows().size(), 1u);
  EXPECT_NEAR(w.forces.added.rows()[0].torque, 24 * w.balance_angle / (2 * std::numbers::pi) * blade * (radius + h / 2),
              1e-8);
}

// A track's lugs push by the way that they slide: not at all where the wheel doesn't slip, backward where it is braked.
// They push level, so they carry no load: the sinkage stays to the bit.
TEST(LugThrust, LevelBladesPushBySlip) {
  expect_same_bits(with({"lug_thrust", "level_blade", {}}, driven(800, 0.0)), base(driven(800, 0.0)));
  EXPECT_LT(gain("level_blade", driven(800, -0.3)), 0.0);
  EXPECT_LT(gain("level_blade", driven(800, 0.05)), gain("level_blade", driven(800, 0.3)));
  EXPECT_EQ(with({"lug_thrust", "level_blade", {}}, driven()).sinkage, base(driven()).sinkage);
}

// Closed form at K -> 0: b/S Int (gamma h^2 N_phi/2 + gamma d h N_phi + 2 c h sqrt(N_phi)) r d theta over 0 .. theta_1,
// d = r (cos theta - cos theta_1), turning the axle at (r + h/2) cos theta.
TEST(LugThrust, LevelBladesInClosedForm) {
  SoilValues soil = sand();
  soil.shear_modulus = 1e-12, soil.cohesion = 2000;
  const EffectList effects = make_effects({{"lug_thrust", "level_blade", {{"a", 1.0}}}});
  const RolledWheel w = RollingWheel(smooth(), soil, effects).roll(driven(800, 0.5));
  const double h = 0.05 * radius, t = w.balance_angle, n = flow_value(soil), gamma = specific_weight(soil);
  const double flat = 0.5 * gamma * h * h * n + 2 * soil.cohesion * h * std::sqrt(n), deep = gamma * h * n * radius;
  const double density = 24 * width / (2 * std::numbers::pi);
  ASSERT_EQ(w.forces.added.rows().size(), 1u);
  const AddedForce& row = w.forces.added.rows()[0];
  EXPECT_NEAR(row.forward, density * (flat * t + deep * (std::sin(t) - t * std::cos(t))), 1e-7);
  const double turning = flat * std::sin(t) + deep * 0.5 * (t - std::sin(t) * std::cos(t));
  EXPECT_NEAR(row.torque, density * (radius + h / 2) * turning, 1e-7);
}

// Declared lugs count: the height replaces 5 % of the radius, twice the lugs are twice the blades.
TEST(LugThrust, TakesWhatTheTireDeclares) {
  const EffectList effects = make_effects({{"lug_thrust", "free_blade", {}}});
  Tire lugged = smooth();
  lugged.lugs.height = 0.05 * radius;
  const double theta = 0.5;
  const auto thrust = [&](const Tire& tire) {
    return RollingWheel(tire, sand(), effects).at_entry_angle(driven(), theta).forces.added.rows()[0].forward;
  };
  EXPECT_DOUBLE_EQ(thrust(lugged), thrust(smooth()));
  lugged.lugs.count = 48;
  EXPECT_NEAR(thrust(lugged), 2 * thrust(smooth()), 1e-12);
  lugged.lugs.height = 0.02;
  EXPECT_GT(thrust(lugged), 2.1 * thrust(smooth()));
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
