// lug_thrust: what lugs add to the tread's shear, and that it ends where the soil does.
#include <fmt/core.h>

#include <numeric>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/earth_pressure.hpp"
#include "scenario/yawed_frames.hpp"

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

// Lugs grip more soil: more pull and more torque at working slip. More shear carries more load: no deeper sinkage.
TEST(LugThrust, PullsMore) {
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id != "lug_thrust" || form.form == "tips") continue;  // which takes lugs that are declared alone
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

// A wheel on the tips of its lugs is the wheel of that radius whose rim has its own slip; the tread base sinks less by
// what lies between.
TEST(LugThrust, OnTheTipsIsAWheelOfThatRadius) {
  SoilValues soil = sand();
  soil.c2 = 0;  // theta_m asks for the slip of the tread base
  Tire larger = smooth(), lugged = smooth();
  lugged.lugs.height = 0.05 * radius;
  const double beyond = 0.7 * 0.05 * radius;
  larger.radius += beyond;
  const EffectList tips = make_effects({{"lug_thrust", "tips", {{"lambda", 0.7}}}});
  for (const double slip : {-0.2, 0.0, 0.05, 0.4}) {
    SCOPED_TRACE(slip);
    const double rim_slip = slip_of_ratio(speed_ratio(slip) * radius / larger.radius);
    const Reading r = RollingWheel(lugged, soil, tips).roll(driven(800, slip)).reading,
                  same = RollingWheel(larger, soil, {}).roll(driven(800, rim_slip)).reading;
    EXPECT_NEAR(r.drawbar_pull, same.drawbar_pull, 1e-8 * 800);
    EXPECT_NEAR(r.torque, same.torque, 1e-8 * 800 * radius);
    EXPECT_NEAR(r.sinkage, same.sinkage - beyond, 1e-10);
  }
  const OperatingCondition at = driven(800, 0.2);
  EXPECT_EQ(RollingWheel(smooth(), soil, tips).roll(at).reading.drawbar_pull,
            RollingWheel(smooth(), soil, {}).roll(at).reading.drawbar_pull);
}

// Ground that gives way by less than the lugs are high holds the tread base up.
TEST(LugThrust, OnHardGroundTheTreadBaseStaysAbove) {
  SoilValues hard = sand();
  hard.k_phi *= 1e4;
  const EffectList tips = make_effects({{"lug_thrust", "tips", {{"lambda", 1.0}}}});
  Tire lugged = smooth();
  const double height = lugged.lugs.height = 0.05 * radius,
               sinkage = RollingWheel(lugged, hard, tips).roll(driven(800, 0.2)).reading.sinkage;
  EXPECT_LT(sinkage, 0.0);
  EXPECT_GT(sinkage, -height);
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
// and each turns the axle at r + h/2; a quarter of the lug height acts. Of all of it the soil bears no more than what
// the tread, c b r sin(theta_1), leaves of c b (r + h) theta_1.
TEST(LugThrust, FreeBladesInClosedForm) {
  SoilValues clay = sand();
  clay.friction_angle = 0, clay.shear_modulus = 1e-12, clay.cohesion = 5000;
  const auto roll = [&](double a) {
    return RollingWheel(smooth(), clay, make_effects({{"lug_thrust", "free_blade", {{"a", a}}}}))
        .roll(driven(800, 0.5));
  };
  const RolledWheel w = roll(0.25), all = roll(1.0);
  const double h = 0.25 * 0.05 * radius, blade = width * (0.5 * 1600 * 9.80665 * h * h + 2 * 5000 * h);
  ASSERT_EQ(w.forces.added.rows().size(), 1u);
  EXPECT_NEAR(w.forces.added.rows()[0].torque, 24 * w.balance_angle / (2 * std::numbers::pi) * blade * (radius + h / 2),
              1e-8);
  const double theta = all.balance_angle;
  EXPECT_NEAR(all.forces.added.rows()[0].forward, 5000 * width * radius * (1.05 * theta - std::sin(theta)), 1e-8);
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

/// Upland sandy loam (Wong 1980).
SoilValues sandy_loam() {
  return {.exponent = 1.10,
          .k_c = 74.6e3,
          .k_phi = 2080e3,
          .cohesion = 3300,
          .friction_angle = 33.7 * degree,
          .shear_modulus = 0.02,
          .c1 = 0.18,
          .c2 = 0.32,
          .density = 1550};
}

SoilValues clay() {
  SoilValues soil = sandy_loam();
  soil.exponent = 0.5, soil.k_c = 13.2e3, soil.k_phi = 692e3, soil.cohesion = 4140, soil.friction_angle = 13 * degree;
  return soil;
}

Tire lugged(double r, double b, double height, int count) {
  Tire tire;
  tire.radius = r, tire.width = b;
  tire.lugs = {.height = height, .count = count, .thickness = {}};
  return tire;
}

double faces(const RolledWheel& w) {
  double sum = 0.0;
  for (const AddedForce& row : w.forces.added.rows()) sum += row.forward;
  return sum;
}

/// c A + W tan phi on the surface through the tips of the lugs.
double bound(const RolledWheel& w, const Tire& tire, const SoilValues& soil, double load) {
  const std::span<const double> arcs = w.patch.of(&ContactPatch::arc);
  const double length = std::accumulate(arcs.begin(), arcs.end(), 0.0);
  return soil.cohesion * tire.width * length * (1 + tire.lugs.height / tire.radius) +
         load * std::tan(soil.friction_angle);
}

struct Ground {
  const char* name;
  SoilValues soil;
};

struct Wheel {
  double radius, width, load;
};

// However many lugs, however high, however much of them acts: the soil between them shears off on the surface through
// their tips, and what that bears is the end. 'Nothing carries' is an answer as well; a lifted wheel is not.
TEST(LugThrust, NeverPassesWhatTheSoilBears) {
  const std::vector<Ground> grounds = {{"sand", sand()}, {"sandy loam", sandy_loam()}, {"clay", clay()}};
  const std::vector<Wheel> wheels = {{0.1, 0.08, 60}, {0.25, 0.1, 300}, {0.65, 0.42, 20e3}};
  int answers = 0, near = 0;
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id != "lug_thrust") continue;
    const EffectParameter& a = form.parameters[0];
    for (const double amplitude : {a.fallback, 1.0, a.upper}) {
      const EffectList effects = make_effects({{form.id, form.form, {{a.name, amplitude}}}});
      for (const Ground& ground : grounds)
        for (const Wheel& wheel : wheels)
          for (const int count : {8, 24, 150})
            for (const double height : {0.01, 0.05, 0.3})
              for (const double share : {0.2, 1.0})
                for (const double slip : {0.0, 0.05, 0.3, 1.0}) {
                  const Tire tire = lugged(wheel.radius, wheel.width, height * wheel.radius, count);
                  const double load = share * wheel.load;
                  try {
                    const RolledWheel w = RollingWheel(tire, ground.soil, effects).roll(driven(load, slip));
                    const double thrust = w.forces.thrust + faces(w), most = bound(w, tire, ground.soil, load);
                    ++answers;
                    if (thrust > 0.9 * most) ++near;
                    EXPECT_LE(thrust, most * (1 + 1e-9))
                        << fmt::format("{}, a = {}, {}, r {}, {} lugs of {} r, {} N, slip {}", form.form, amplitude,
                                       ground.name, wheel.radius, count, height, load, slip);
                    EXPECT_NEAR(w.forces.vertical, load, 1e-9 * load);
                  } catch (const NoSolution& error) {
                    EXPECT_EQ(std::string(error.what()).find("lift"), std::string::npos) << form.form << error.what();
                  }
                }
    }
  }
  EXPECT_GT(answers, 8000);
  EXPECT_GT(near, 100) << "the limit is reached";
}

// More lugs and higher ones never push less, in the same place.
TEST(LugThrust, RisesWithNumberAndHeight) {
  for (const char* form : {"passive_blade", "free_blade", "level_blade", "side_factors"})
    for (const double slip : {0.05, 0.3, 0.9}) {
      const EffectList effects = make_effects({{"lug_thrust", form, {}}});
      const auto thrust = [&](int count, double height) {
        const RolledWheel w = RollingWheel(lugged(radius, width, height * radius, count), sand(), effects)
                                  .at_entry_angle(driven(300, slip), 0.5);
        return w.forces.thrust + faces(w);
      };
      double before = 0.0;
      for (const int count : {8, 12, 16, 24, 32, 48, 64, 96, 150}) {
        EXPECT_GE(thrust(count, 0.05), before * (1 - 1e-12)) << form << ", " << count << " lugs, slip " << slip;
        before = thrust(count, 0.05);
      }
      before = 0.0;
      for (const double height : {0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3}) {
        EXPECT_GE(thrust(24, height), before * (1 - 1e-12)) << form << ", height " << height << " r, slip " << slip;
        before = thrust(24, height);
      }
    }
}

// After Skonieczny, Moreland and Wettergreen: with h/r = 0.1 and z/r = 0.2 lugs 0.155 rad apart are close enough: as
// many as 2 pi/0.155 = 40 push for themselves, and 60, 96 or 150 push as 40 do.
TEST(LugThrust, MoreLugsThanTheSpacingRuleAsksForAddNothing) {
  const double z = 0.2, h = 0.1, surface = (1 - z) * (1 - z);
  const double apart = std::sqrt((1 + h) * (1 + h) - surface) - std::sqrt(1 - surface);
  EXPECT_NEAR(apart, 0.1550, 1e-4);
  const EffectList effects = make_effects({{"lug_thrust", "level_blade", {{"a", 0.01}}}});
  const auto push = [&](int count) {
    return faces(RollingWheel(lugged(radius, width, h * radius, count), sand(), effects)
                     .at_entry_angle(driven(300, 0.3), std::acos(1 - z)));
  };
  EXPECT_NEAR(push(60), push(10) / 10 * 2 * std::numbers::pi / apart, 1e-9 * push(60));
  EXPECT_DOUBLE_EQ(push(96), push(60));
  EXPECT_DOUBLE_EQ(push(150), push(60));
  EXPECT_NEAR(push(20), 2 * push(10), 1e-12);
}

// A tread base that sinks by 3 mm does not bury lugs of 30 mm: they act as lugs of 3 mm.
TEST(LugThrust, LugsActAsFarAsTheyAreBuried) {
  const double z = 0.003, theta = std::acos(1 - z / radius);
  for (const char* form : {"passive_blade", "free_blade", "level_blade"}) {
    const EffectList effects = make_effects({{"lug_thrust", form, {{"a", 0.1}}}});
    const auto push = [&](double height) {
      return faces(
          RollingWheel(lugged(radius, width, height, 8), sand(), effects).at_entry_angle(driven(300, 0.3), theta));
    };
    EXPECT_NEAR(push(0.030), push(0.015), 1e-9 * push(0.015)) << form;
    EXPECT_NEAR(push(0.001), 1.0 / 2 * push(0.002), 0.35 * push(0.001)) << form << ": those are buried";
    EXPECT_LT(push(0.002), push(0.015)) << form;
  }
}

// A heavy tire, about a 16.00R20, on upland sandy loam: at a = 1 its blades gave 32.1 kN where the soil bears 24.0.
TEST(LugThrust, AHeavyTireEndsAtTheSoilsBound) {
  const Tire tire = lugged(0.67, 0.43, 0.03, 36);
  const EffectList effects = make_effects({{"lug_thrust", "passive_blade", {{"a", 1.0}}}});
  for (const double load : {10e3, 20e3, 30e3, 40e3, 60e3})
    for (const double slip : {0.0, 0.1, 0.2, 0.5, 1.0}) {
      const RolledWheel w = RollingWheel(tire, sandy_loam(), effects).roll(driven(load, slip));
      EXPECT_LE(w.forces.thrust + faces(w), bound(w, tire, sandy_loam(), load)) << load << " N, slip " << slip;
      EXPECT_GT(faces(w), 0.0);
    }
}

// Where slip digs the wheel in, the stresses and the limited forces carry the load together.
TEST(LugThrust, CarriesTheLoadWhereSlipDigsItIn) {
  const Tire tire = lugged(0.67, 0.43, 0.05, 60);
  for (const double a : {0.3, 1.0, 3.0}) {
    const EffectList effects =
        make_effects({{"lug_thrust", "passive_blade", {{"a", a}}}, {"slip_sinkage", "linear", {}}});
    const RolledWheel w = RollingWheel(tire, sandy_loam(), effects).roll(driven(30e3, 0.4));
    EXPECT_NE(w.stress_share, 1.0);
    EXPECT_NEAR(w.forces.vertical, 30e3, 1e-6 * 30e3) << a;
  }
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
