// tire_flexibility: a carcass that gives way before the soil does.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/closed_forms.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

const char* const carcass_forms[] = {"flat_section", "carcass_spring", "substitute_circle"};

Tire soft_tire(std::optional<double> inflation = {}) {
  Tire t;
  t.radius = radius;
  t.width = width;
  t.inflation_pressure = inflation;
  return t;
}

RolledWheel rolled_on(const EffectChoice& choice, const OperatingCondition& at, const Tire& t = soft_tire()) {
  return RollingWheel(t, sand(), make_effects({choice})).roll(at);
}

// A longer contact carries the load at less depth: less sinkage, less compaction resistance, more pull.
TEST(TireFlexibility, LongerShallowerContact) {
  for (const char* form : carcass_forms) {
    SCOPED_TRACE(form);
    const EffectChoice choice{"tire_flexibility", form, {}};
    for (const double load : {300.0, 800.0, 2000.0}) {
      const RolledWheel r = rolled_on(choice, driven(load)), b = RollingWheel(soft_tire(), sand()).roll(driven(load));
      EXPECT_LT(r.sinkage, b.sinkage);
      EXPECT_GT(r.forces.compaction, b.forces.compaction);
      EXPECT_GT(r.reading.drawbar_pull, b.reading.drawbar_pull);
    }
  }
}

// A condition's inflation pressure is the tire's there, for every form and to the bit.
TEST(TireFlexibility, RollsAtTheConditionsPressure) {
  for (const char* form : carcass_forms) {
    SCOPED_TRACE(form);
    const EffectChoice choice{"tire_flexibility", form, {}};
    OperatingCondition at = driven(800);
    const RolledWheel own = rolled_on(choice, at, soft_tire(40e3));
    at.inflation_pressure = 40e3;
    for (const Tire& t : {soft_tire(), soft_tire(200e3)}) {
      const RolledWheel told = rolled_on(choice, at, t);
      EXPECT_EQ(told.reading.drawbar_pull, own.reading.drawbar_pull);
      EXPECT_EQ(told.sinkage, own.sinkage);
    }
    EXPECT_NE(rolled_on(choice, driven(800), soft_tire(200e3)).sinkage, own.sinkage);
  }
  OperatingCondition sucked = driven(800);
  sucked.inflation_pressure = -1.0;
  EXPECT_THROW(rolled_on({"tire_flexibility", "", {}}, sucked), InputError);
}

// The cap's mark: a light wheel stays rigid, a heavy one loses a growing share of its sinkage.
TEST(TireFlexibility, FlatSectionSparesTheLightWheel) {
  const auto lost = [](double load) {
    return 1 - rolled_on({"tire_flexibility", "flat_section", {}}, driven(load)).sinkage / base(driven(load)).sinkage;
  };
  EXPECT_LT(lost(50), 1e-3);
  EXPECT_GT(lost(800), 10 * lost(200));
  EXPECT_GT(lost(2000), lost(800));
}

// Wong's rigid mode: where the soil presses with two thirds of p_g at the most, the contact ends under the axle, and
// the rounded corner moves the pull by less than 2 % of the load.
TEST(TireFlexibility, FlatSectionIsRigidWellBelowTheGroundPressure) {
  const RolledWheel rigid = RollingWheel(soft_tire(), sand()).roll(driven());
  const auto sigma = rigid.patch.of(&ContactPatch::sigma);
  const double most = *std::ranges::max_element(sigma);
  const RolledWheel w = rolled_on({"tire_flexibility", "flat_section", {}}, driven(), soft_tire(1.5 * most));
  EXPECT_NEAR(w.reading.drawbar_pull, rigid.reading.drawbar_pull, 0.02 * driven().load);
  EXPECT_NEAR(w.patch.angles.exit, 0.0, 0.005);
}

// Softer is softer: sinkage falls with the amplitude and rises with the inflation pressure.
TEST(TireFlexibility, FollowsAmplitudeAndPressure) {
  for (const char* form : carcass_forms) {
    SCOPED_TRACE(form);
    double before = base(driven()).sinkage;
    for (const double a : {0.2, 0.4, 0.8, 1.6}) {
      const double z = rolled_on({"tire_flexibility", form, {{"a", a}}}, driven()).sinkage;
      EXPECT_LT(z, before);
      before = z;
    }
    const EffectChoice choice{"tire_flexibility", form, {}};
    const auto at_pressure = [&](double p) { return rolled_on(choice, driven(), soft_tire(p)).sinkage; };
    EXPECT_LT(at_pressure(60e3), at_pressure(100e3));
    EXPECT_LT(at_pressure(100e3), at_pressure(300e3));
    // 100 kPa is what an undeclared pressure means.
    EXPECT_EQ(at_pressure(100e3), rolled_on(choice, driven()).sinkage);
  }
}

// The ground pressure caps the soil's: p_g/a = 40 kPa, reached nearly under a load that needs a long flat.
TEST(TireFlexibility, FlatSectionCapsThePressure) {
  const RolledWheel w = rolled_on({"tire_flexibility", "flat_section", {{"a", 2.5}}}, driven(1500));
  const auto sigma = w.patch.of(&ContactPatch::sigma);
  const double most = *std::max_element(sigma.begin(), sigma.end());
  EXPECT_LT(most, 40e3);
  EXPECT_GT(most, 38e3);
  const auto rigid = RollingWheel(soft_tire(), sand()).roll(driven(1500));
  const auto unbounded = rigid.patch.of(&ContactPatch::sigma);
  EXPECT_GT(*std::max_element(unbounded.begin(), unbounded.end()), 60e3);
}

// Soil and carcass in series, node by node ahead of theta_m: the circle's depth less the tread's is the spring's
// deflection (r a^2/2) sigma/p_g. The contact ends where the circle rises from the rut.
TEST(TireFlexibility, CarcassSpringInEquilibrium) {
  const double a = 0.4;
  const RolledWheel w = rolled_on({"tire_flexibility", "carcass_spring", {{"a", a}}}, driven());
  const ContactAngles& angles = w.patch.angles;
  int front = 0;
  for (int i = 0; i < w.patch.count; ++i) {
    if (w.patch.theta[i] < angles.max_stress) continue;
    const double circle = radius * (std::cos(w.patch.theta[i]) - std::cos(angles.entry));
    EXPECT_NEAR(circle - w.patch.depth[i], 0.5 * radius * a * a * w.patch.sigma[i] / 100e3, 1e-15);
    ++front;
  }
  EXPECT_GT(front, 8);
  EXPECT_NEAR(w.sinkage + w.patch.deflection, radius * (1 - std::cos(angles.entry)), 1e-15);
  EXPECT_NEAR(radius * (1 - std::cos(angles.exit)), w.patch.deflection, 1e-15);
}

/// The flattened wheel at a given theta_1, summed over 20,000 equal steps of theta, in the order of its definition:
/// outline y = S(d), exit by its own law, slope, arc, belt travel, pressure by depth and behind theta_m by mirror
/// angle, Janosi shear.
template <class Law, class AtExit>
std::array<double, 3> summed(const Law& law, const AtExit& at_exit, double theta_1, double slip) {
  const SoilValues soil = sand();
  const double k = soil.pressure_modulus(width), theta_m = (soil.c1 + soil.c2 * slip) * theta_1;
  const auto circle = [&](double t) { return radius * (std::cos(t) - std::cos(theta_1)); };
  const double exit = -std::acos(std::cos(theta_1) + at_exit(circle(0)) / radius);
  constexpr int steps = 20000;
  const double dt = (theta_1 - exit) / steps;
  double j = 0, forward = 0, vertical = 0, torque = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = theta_1 - (i + 0.5) * dt, mirror = theta_1 - (t - exit) / (theta_m - exit) * (theta_1 - theta_m);
    const double step = 1e-7 * radius, d = circle(t);
    const double slope = (law(d + step) - law(std::max(0.0, d - step))) / (step + std::min(d, step));
    const double incline = std::atan(slope * std::tan(t)), dx = radius * std::cos(t) * dt, ds = dx / std::cos(incline);
    const double sigma = k * std::pow(law(t > theta_m ? d : circle(mirror)), soil.exponent);
    j += ds - (1 - slip) * dx;
    const double strength = soil.cohesion + sigma * std::tan(soil.friction_angle);
    const double tau = strength * (1 - std::exp(-j / soil.shear_modulus));
    forward += width * ds * (tau * std::cos(incline) - sigma * std::sin(incline));
    vertical += width * ds * (sigma * std::cos(incline) + tau * std::sin(incline));
    torque += width * ds * tau * radius;
  }
  return {forward, vertical, torque};
}

template <class Law, class AtExit>
void expect_summed(const char* form, double a, const Law& law, const AtExit& at_exit) {
  const RollingWheel wheel(soft_tire(), sand(), make_effects({{"tire_flexibility", form, {{"a", a}}}}));
  for (const double slip : {0.0, 0.3})
    for (const double theta_1 : {0.4, 0.8, 1.2}) {
      SCOPED_TRACE(fmt::format("{} {}, slip {}, theta_1 {}", form, a, slip, theta_1));
      const RolledWheel w = wheel.at_entry_angle(driven(800, slip), theta_1);
      const std::array<double, 3> sum = summed(law, at_exit, theta_1, slip);
      EXPECT_NEAR(w.forces.thrust + w.forces.compaction, sum[0], 1e-4 * sum[1]);
      EXPECT_NEAR(w.forces.vertical, sum[1], 1e-4 * sum[1]);
      EXPECT_NEAR(w.forces.torque, sum[2], 1e-4 * sum[1] * radius);
    }
}

// The patch's few nodes against brute force. The outline bends where the flat begins, so 1e-4 of the load instead of
// the rigid wheel's 1e-9.
TEST(TireFlexibility, PatchAgreesWithBruteForce) {
  const double k = sand().pressure_modulus(width), n = sand().exponent;
  const double deepest = std::pow(100e3 / k, 1 / n);
  const auto capped = [&](double corner) {
    return [=](double d) { return d * std::pow(1 + std::pow(d / deepest, corner), -1.0 / corner); };
  };
  expect_summed("flat_section", 1.0, capped(6), capped(24));
  for (const double a : {0.4, 1.0}) {
    const auto in_series = [&](double d) {
      double low = 0, high = d;
      for (int i = 0; i < 60; ++i) {
        const double y = 0.5 * (low + high);
        (y + 0.5 * radius * a * a * k * std::pow(y, n) / 100e3 < d ? low : high) = y;
      }
      return low;
    };
    expect_summed("carcass_spring", a, in_series, in_series);
  }
}

// In a rut that reloads, P(y) = k (y + h y/(y + e z_p))^n with h = a z_p (1 - exp(-1/p0)) on the second pass: the flat
// begins at the depth where that is p_g, found here by bisection.
TEST(TireFlexibility, ACapBeginsWhereAnotherPressureLawReachesIt) {
  const SoilValues soil = sand();
  const double load = 800.0, a = 0.6, p0 = 1.5, e = 0.2, theta_1 = 0.8;
  OperatingCondition at = driven(load);
  at.pass = 2;
  const RollingWheel wheel(soft_tire(), soil,
                           make_effects({{"tire_flexibility", "flat_section", {}},
                                         {"multipass", "reload", {{"a", a}, {"p0", p0}, {"e", e}}}}));
  const double k = soil.pressure_modulus(width), z_p = bekker_static_sinkage(soil, radius, width, load),
               h = -a * z_p * std::expm1(-1 / p0);
  double low = 0.0, high = radius;
  for (int i = 0; i < 100; ++i) {
    const double y = 0.5 * (low + high);
    (k * std::pow(y + h * y / (y + e * z_p), soil.exponent) < 100e3 ? low : high) = y;
  }
  const double d = radius * (1 - std::cos(theta_1)), tread = d * std::pow(1 + std::pow(d / low, 6), -1.0 / 6);
  EXPECT_NEAR(wheel.at_entry_angle(at, theta_1).patch.deflection, d - tread, 1e-12 * d);
}

// A wheel that slip has dug in stands as deep as it says: its circle lies deeper by the deflection. The carcass gives
// way to the stresses that carry the load there, not to those of soil pressed so deep.
TEST(TireFlexibility, FlattensByTheStressesOfTheWheelThatHasDugItselfIn) {
  const double a = 0.4, slip = 0.4;
  for (const char* form : {"flat_section", "carcass_spring"}) {
    SCOPED_TRACE(form);
    const EffectChoice flat{"tire_flexibility", form, {{"a", a}}}, digs{"slip_sinkage", "linear", {{"S", 2.0}}};
    const RolledWheel balanced = rolled_on(flat, driven(800, slip));
    const RolledWheel w = RollingWheel(soft_tire(), sand(), make_effects({flat, digs})).roll(driven(800, slip));
    EXPECT_NEAR(w.sinkage, balanced.sinkage * (1 + 2.0 * slip), 1e-9);
    EXPECT_NEAR(w.sinkage + w.patch.deflection, radius * (1 - std::cos(w.patch.angles.entry)), 1e-9);
    EXPECT_NEAR(w.forces.vertical, 800, 1e-6);
    for (int i = 0; i < w.patch.count; ++i) {
      EXPECT_LT(w.patch.sigma[i], 100e3 / a);
      if (std::string(form) != "carcass_spring" || w.patch.theta[i] < w.patch.angles.max_stress) continue;
      const double circle = radius * (std::cos(w.patch.theta[i]) - std::cos(w.patch.angles.entry));
      EXPECT_NEAR(circle - w.patch.depth[i], 0.5 * radius * a * a * w.patch.sigma[i] / 100e3, 1e-9);
    }
  }
}

// A carcass so soft that its tread nearly rests on the cap: digging by next to nothing changes next to nothing.
TEST(TireFlexibility, SettlesEvenlyOnTheSoftestTire) {
  const EffectChoice flat{"tire_flexibility", "flat_section", {{"a", 30.0}}}, digs{"slip_sinkage", "lyasko", {}};
  const RollingWheel still(soft_tire(), sand(), make_effects({flat})),
      wheel(soft_tire(), sand(), make_effects({flat, digs}));
  const RolledWheel without = still.roll(driven(100, 1e-4)), with_it = wheel.roll(driven(100, 1e-4));
  EXPECT_NEAR(with_it.reading.drawbar_pull, without.reading.drawbar_pull, 1e-2 * 100);
}

// Braked, rolling and driven by next to nothing are one wheel.
TEST(TireFlexibility, HasNoStepAtSlipZero) {
  for (const char* form : carcass_forms) {
    const EffectChoice choice{"tire_flexibility", form, {{"a", 1.0}}};
    const double rolling = rolled_on(choice, driven(800, 0.0)).reading.drawbar_pull;
    for (const double slip : {-1e-9, 1e-9})
      EXPECT_NEAR(rolled_on(choice, driven(800, slip)).reading.drawbar_pull, rolling, 1e-5 * 800) << form << slip;
  }
}

// Schmid's circle is as long as the tire's contact before and behind the axle: sqrt(2R z) = sqrt(2r (z + f)) +
// sqrt(2r f), z Bekker's static sinkage, f = r a^2/2 times W/(2 r b)/100 kPa.
TEST(TireFlexibility, SubstituteCircleInClosedForm) {
  const double a = 0.5, load = 800;
  const RolledWheel w = rolled_on({"tire_flexibility", "substitute_circle", {{"a", a}}}, driven(load));
  const double circle = w.sinkage / (1 - std::cos(w.balance_angle));
  const double z = bekker_static_sinkage(sand(), radius, width, load);
  const double f = 0.5 * radius * a * a * load / (2 * radius * width * 100e3);
  EXPECT_NEAR(std::sqrt(2 * circle * z), std::sqrt(2 * radius * (z + f)) + std::sqrt(2 * radius * f), 1e-12);
}

// What the balance needs: the load carried rises with theta_1, without a jump where the flat sets in.
TEST(TireFlexibility, LoadCarriedRisesSmoothlyWithDepth) {
  for (const char* form : carcass_forms) {
    SCOPED_TRACE(form);
    const RollingWheel wheel(soft_tire(), sand(), make_effects({{"tire_flexibility", form, {}}}));
    double before = 0.0;
    for (int i = 1; i <= 400; ++i) {
      const double carried = wheel.at_entry_angle(driven(), 0.003 * i).forces.vertical;
      EXPECT_GT(carried, before);
      if (i > 20) {
        EXPECT_LT(carried, 1.3 * before);
      }
      before = carried;
    }
  }
}

/// A tire of stiffness K_0 + K_1 p by its maker's table.
Tire tire_with_table(double pressure) {
  Tire t = soft_tire(pressure);
  t.deflection.emplace();
  for (const double p : {50e3, 150e3})
    for (const double load : {200.0, 2000.0}) t.deflection->rows.push_back({load, p, load / (20e3 + 0.2 * p)});
  return t;
}

// On ground that gives way by nothing and shears at nothing the tire deflects by what its maker measured.
TEST(TireFlexibility, SpringMeetsTheMakersTable) {
  SoilValues ground;
  ground.k_phi = 1e13;
  for (const double pressure : {50e3, 80e3, 150e3})
    for (const double load : {200.0, 700.0, 2000.0}) {
      const RollingWheel wheel(tire_with_table(pressure), ground,
                               make_effects({{"tire_flexibility", "carcass_spring", {}}}));
      const RolledWheel w = wheel.roll(driven(load));
      const double f = load / (20e3 + 0.2 * pressure);
      EXPECT_NEAR(w.patch.deflection, f, 1e-6 * f) << load << " " << pressure;
      EXPECT_LT(w.sinkage, 1e-6 * f);
    }
}

// Schmid's circle of the tire's own deflection.
TEST(TireFlexibility, CircleTakesTheMakersDeflection) {
  const double load = 700, pressure = 80e3;
  const RollingWheel wheel(tire_with_table(pressure), sand(),
                           make_effects({{"tire_flexibility", "substitute_circle", {}}}));
  const double share = load / (20e3 + 0.2 * pressure) / bekker_static_sinkage(sand(), radius, width, load);
  const double root = std::sqrt(1 + share) + std::sqrt(share);
  EXPECT_NEAR(wheel.outline(driven(load)).radius, root * root * radius, 1e-12);
}

// The cap keeps to its pressure, and a table leaves nothing to presume of the carcass.
TEST(TireFlexibility, CapKeepsToThePressure) {
  const EffectChoice flat{"tire_flexibility", "flat_section", {}}, spring{"tire_flexibility", "carcass_spring", {}};
  EXPECT_EQ(rolled_on(flat, driven(800), tire_with_table(80e3)).sinkage,
            rolled_on(flat, driven(800), soft_tire(80e3)).sinkage);
  EXPECT_NE(rolled_on(spring, driven(800), tire_with_table(80e3)).sinkage,
            rolled_on(spring, driven(800), soft_tire(80e3)).sinkage);
  EXPECT_TRUE(presumptions({spring}, tire_with_table(80e3)).empty());
  EXPECT_FALSE(presumptions({flat}, tire_with_table(80e3)).empty());
  EXPECT_FALSE(depends_on(find_form(flat), "deflection"));
  EXPECT_TRUE(depends_on(find_form(spring), "deflection"));
}

// An inextensible belt on a lossless carcass: dj = ds - v/(r w) dx, torque = r b Int tau ds. So M - r (1 - s) F is what
// the slipping of the soil and its compaction take: never negative.
TEST(TireFlexibility, PowerInCoversPowerOut) {
  for (const char* form : carcass_forms) {
    for (const double slip : {-0.3, 0.0, 0.1, 0.5, 1.0}) {
      const Reading r = rolled_on({"tire_flexibility", form, {}}, driven(600, slip)).reading;
      const double ratio = slip >= 0 ? 1 - slip : 1 / (1 + slip);
      EXPECT_GT(r.torque, radius * ratio * r.drawbar_pull) << form << " " << slip;
    }
  }
}

// On the flat the tread slides by s of its way: dj/dx = s. A hard cap makes the flat nearly plane there.
TEST(TireFlexibility, FlatSlidesBySlip) {
  const double slip = 0.3;
  const ContactPatch p = rolled_on({"tire_flexibility", "flat_section", {{"a", 6.0}}}, driven(600, slip)).patch;
  int ahead = -1, behind = -1;
  for (int i = 0; i < p.count; ++i) {
    if (p.theta[i] < 0.3 * p.angles.entry && ahead < 0) ahead = i;
    if (p.theta[i] > -0.3 * p.angles.entry) behind = i;
  }
  ASSERT_GT(behind, ahead);
  const double way = radius * (std::sin(p.theta[ahead]) - std::sin(p.theta[behind]));
  EXPECT_NEAR((p.j_x[behind] - p.j_x[ahead]) / way, slip, 2e-3);
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
