// Firmer soil lets no wheel sink more, rigid or flexible, whatever makes it firmer.
//
// 'Firmer' is soil that presses harder at every depth of the contact and shears no worse. It lets a wheel sink less,
// and where its pressure depends on the depth alone, its compaction resistance R_c is smaller too. (Soil that resists
// speed presses hardest where the wheel enters the steepest: a flexible tire, which sinks hardly less there, meets more
// resistance.) The pull follows R_c where the whole shear strength of a soil without cohesion is called up:
// T = b Int sigma tan(phi) cos ds = tan(phi) (W - tan(phi) R_c), so F = W tan(phi) - R_c/cos^2(phi). Elsewhere a firmer
// soil's shorter contact may cost more thrust than R_c falls, on a rigid wheel too.
#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "bekker_wong/bed_fixture.hpp"
#include "scenario/errors.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

constexpr Bin bin{.depth = 0.5, .width = 1.0};
const char* const carcass_forms[] = {"flat_section", "carcass_spring", "substitute_circle"};

struct Setting {
  const char* name;
  Tire tire;
  SoilValues soil;
  std::vector<double> loads;
};

Tire inflated(double r, double b, double inflation, double carcass = 0.0) {
  Tire t = smooth_tire(r, b);
  t.inflation_pressure = inflation;
  t.carcass_pressure = Estimate{carcass};
  return t;
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = {
      {"truck tire on sandy loam",  // Wong's
       inflated(0.67, 0.43, 150e3, 20e3),
       {.exponent = 0.7,
        .k_c = 5270,
        .k_phi = 1515040,
        .cohesion = 1720,
        .friction_angle = 29 * degree,
        .shear_modulus = 0.025,
        .c1 = 0.43,
        .c2 = 0.32},
       {10e3, 37.5e3}},
      {"bin wheel on dry sand", inflated(0.25, 0.10, 60e3), sand(), {300, 800}},
      {"tire on snow", inflated(0.4, 0.25, 60e3), values_of(test::snow()), {1200}},
  };
  return all;
}

OperatingCondition asked(double load, double slip) {
  OperatingCondition at = driven(load, slip);
  at.speed = 2.0;
  at.pass = 4;
  at.moisture = 0.10;
  at.position = 2.5;
  at.run = 7;
  return at;
}

/// A wheel, or nothing where it has no balance.
std::optional<RolledWheel> rolled(const Tire& tire, const SoilValues& soil, const std::vector<EffectChoice>& choices,
                                  const OperatingCondition& at) {
  try {
    return RollingWheel(tire, soil, make_effects(choices), bin).roll(at);
  } catch (const NoSolution&) {
    return {};
  }
}

struct Firmness {
  double sign = 0.0;  // 1: firmer, -1: softer, 0: as before or neither
  bool by_depth_alone = true;
};

/// What an effect makes of the soil's pressure in this condition, at every depth that either wheel reaches and at
/// whatever angle it meets it. Where its strength changes the other way the soil is neither firmer nor softer.
Firmness firmness(const EffectChoice& choice, const Setting& s, const RolledWheel& without, const RolledWheel& with) {
  const double deepest =
      1.2 * std::max(with.sinkage + with.patch.deflection, without.sinkage + without.patch.deflection);
  const EffectList effects = make_effects({choice});
  Surroundings around{.tire = s.tire, .declared = s.soil, .at = with.at, .motion = with.motion, .bin = bin};
  around.normal_load = with.at.load;
  const Outline outline{s.tire.radius, s.tire.width, s.tire.radius, s.tire.radius};
  ContactPatch before;
  before.count = 256;
  before.angles.entry = std::acos(1 - deepest / s.tire.radius);
  for (int i = 0; i < before.count; ++i) {
    before.circle_depth[i] = deepest * (1 + i / 16) / 16;
    before.depth[i] = before.circle_depth[i] * (1 + i % 16) / 16;
  }
  ContactPatch after = before, under_axle = before;
  std::ranges::fill(under_axle.of(&ContactPatch::circle_depth), deepest);
  press(before, outline, around);
  around.effects = effects;
  for (const auto& effect : effects) effect->soil(around.soil, around);
  press(after, outline, around);
  press(under_axle, outline, around);
  const SoilValues &then = s.soil, &now = around.soil;
  const bool stronger = now.cohesion > then.cohesion || now.friction_angle > then.friction_angle ||
                        now.shear_modulus < then.shear_modulus;
  const bool weaker = now.cohesion < then.cohesion || now.friction_angle < then.friction_angle ||
                      now.shear_modulus > then.shear_modulus;
  Firmness is;
  bool more = false, less = false;
  for (int i = 0; i < before.count; ++i) {
    more = more || after.sigma[i] > before.sigma[i] * (1 + 1e-12);
    less = less || after.sigma[i] < before.sigma[i] * (1 - 1e-12);
    is.by_depth_alone = is.by_depth_alone && std::abs(under_axle.sigma[i] / after.sigma[i] - 1) < 1e-12;
  }
  if (more && !less && !weaker) is.sign = 1.0;
  if (less && !more && !stronger) is.sign = -1.0;
  return is;
}

/// Every form of the catalogue but the carcass's own, at its default and with its amplitude turned round where it may
/// be negative.
std::vector<EffectChoice> every_other_form() {
  std::vector<EffectChoice> all;
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id == "tire_flexibility") continue;
    const EffectParameter& a = form.parameters[0];
    for (const double amplitude : {a.fallback, -a.fallback})
      if (amplitude >= a.lower && amplitude <= a.upper) all.push_back({form.id, form.form, {{a.name, amplitude}}});
  }
  return all;
}

std::string label(const char* carcass, const EffectChoice& choice, const Setting& s, const OperatingCondition& at) {
  return fmt::format("{}, {}:{} {}, {}, {} N, slip {}", carcass, choice.id, choice.form,
                     choice.parameters.begin()->second, s.name, at.load, at.slip);
}

/// One effect on a wheel that is rigid or flexible.
struct Pair {
  const RolledWheel &without, &with;
  Firmness is;
};

/// Calls back with every pair of an effect and a form of the flexible tire, or the rigid one, that has a balance in
/// this setting and finds the soil firmer or softer.
void for_each_pair(const Setting& s, const OperatingCondition& at, const auto& check) {
  for (const char* carcass : {"", "flat_section", "carcass_spring", "substitute_circle"}) {
    std::vector<EffectChoice> tire;
    if (*carcass != '\0') tire.push_back({"tire_flexibility", carcass, {}});
    const auto without = rolled(s.tire, s.soil, tire, at);
    ASSERT_TRUE(without);
    for (const EffectChoice& choice : every_other_form()) {
      std::vector<EffectChoice> both = tire;
      both.push_back(choice);
      const auto with = rolled(s.tire, s.soil, both, at);
      if (!with) continue;
      const Firmness is = firmness(choice, s, *without, *with);
      if (is.sign == 0.0) continue;
      SCOPED_TRACE(label(carcass, choice, s, at));
      check(Pair{*without, *with, is});
    }
  }
}

// The attack: each effect beside each form of the flexible tire, on firmer and on softer soil than without it.
TEST(Firmness, FirmerSoilLetsNoWheelSinkMore) {
  int firmer = 0, softer = 0;
  for (const Setting& s : settings())
    for (const double load : s.loads)
      for (const double slip : {0.2, 0.6})
        for_each_pair(s, asked(load, slip), [&](const Pair& pair) {
          const auto& [without, with, is] = pair;
          ++(is.sign > 0.0 ? firmer : softer);
          EXPECT_GE(is.sign * (without.sinkage - with.unmeasured.sinkage), -1e-9 * s.tire.radius)
              << without.sinkage << " m before, " << with.sinkage << " m after";
          if (!is.by_depth_alone) return;
          EXPECT_GE(is.sign * (with.forces.compaction - without.forces.compaction), -1e-9 * load)
              << without.forces.compaction << " N before, " << with.forces.compaction << " N after";
        });
  EXPECT_GT(firmer, 100);
  EXPECT_GT(softer, 100);
}

// The pull follows where the shear is called up whole.
TEST(Firmness, SofterSoilNeverGivesMorePullWhereItsWholeStrengthIsCalledUp) {
  int compared = 0;
  for (Setting s : settings()) {
    s.soil.cohesion = 0.0, s.soil.shear_modulus = 1e-5 * s.tire.radius;
    for (const double load : s.loads)
      for_each_pair(s, asked(load, 0.6), [&](const Pair& pair) {
        if (!pair.is.by_depth_alone) return;
        const double before = pair.without.unmeasured.drawbar_pull, after = pair.with.unmeasured.drawbar_pull;
        EXPECT_GE(pair.is.sign * (after - before), -1e-4 * load) << before << " N before, " << after << " N after";
        ++compared;
      });
  }
  EXPECT_GT(compared, 200);
}

// Two effects and the carcass on a soil whose stiffness alone changes, doubled and doubled again.
TEST(Firmness, AStifferSoilLetsNoPairSinkMore) {
  for (const Setting& s : settings())
    for (const char* carcass : carcass_forms)
      for (const EffectChoice& choice : every_other_form()) {
        const OperatingCondition at = asked(s.loads[0], 0.3);
        double before = 0.0;
        for (const double factor : {4.0, 2.0, 1.0}) {
          SoilValues soil = s.soil;
          soil.k_c *= factor, soil.k_phi *= factor;
          const auto wheel = rolled(s.tire, soil, {{"tire_flexibility", carcass, {}}, choice}, at);
          if (!wheel) continue;
          EXPECT_GT(wheel->sinkage, before) << label(carcass, choice, s, at) << ", stiffness times " << factor;
          before = wheel->sinkage;
        }
      }
}

// p_g/a is the most that a flat section bears, whatever acts beside it.
TEST(Firmness, NoStressPassesWhatTheFlatSectionBears) {
  for (const Setting& s : settings())
    for (const double load : s.loads)
      for (const EffectChoice& choice : every_other_form()) {
        const OperatingCondition at = asked(load, 0.3);
        const auto wheel = rolled(s.tire, s.soil, {{"tire_flexibility", "flat_section", {}}, choice}, at);
        if (!wheel) continue;
        SCOPED_TRACE(label("flat_section", choice, s, at));
        const auto sigma = wheel->patch.of(&ContactPatch::sigma);
        EXPECT_LT(*std::ranges::max_element(sigma), *declared_ground_pressure(s.tire));
      }
}

TEST(Firmness, TheCarcassActsAlikeBeforeAndAfterAnyOtherEffectInTheList) {
  for (const Setting& s : settings())
    for (const char* carcass : carcass_forms)
      for (const EffectChoice& choice : every_other_form()) {
        const OperatingCondition at = asked(s.loads.back(), 0.3);
        const EffectChoice tire{"tire_flexibility", carcass, {}};
        const auto first = rolled(s.tire, s.soil, {tire, choice}, at),
                   last = rolled(s.tire, s.soil, {choice, tire}, at);
        SCOPED_TRACE(label(carcass, choice, s, at));
        ASSERT_EQ(first.has_value(), last.has_value());
        if (!first) continue;
        EXPECT_NEAR(first->reading.drawbar_pull, last->reading.drawbar_pull, 1e-9 * at.load);
        EXPECT_NEAR(first->reading.torque, last->reading.torque, 1e-9 * at.load * s.tire.radius);
        EXPECT_NEAR(first->reading.sinkage, last->reading.sinkage, 1e-9 * s.tire.radius);
      }
}

// Where the soil is no power law, the tread still rests where soil and carcass press alike: ahead of theta_m the spring
// gives (r a^2/2) sigma/p_g, node by node.
TEST(Firmness, TheTreadRestsWhereSoilAndCarcassPressAlike) {
  const Setting& s = settings()[0];
  const double a = 0.3, p_g = 170e3;
  for (const EffectChoice& choice : std::vector<EffectChoice>{{"multipass", "stiffer", {}},
                                                              {"hard_layer", "hyperbolic", {}},
                                                              {"hard_layer", "logarithmic", {}},
                                                              {"hard_layer", "transition", {}},
                                                              {"rate_dependence", "quasi_static", {}},
                                                              {"slip_sinkage", "loosening", {}}})
    for (const double load : s.loads) {
      const OperatingCondition at = asked(load, 0.3);
      const auto w = rolled(s.tire, s.soil, {{"tire_flexibility", "carcass_spring", {{"a", a}}}, choice}, at);
      ASSERT_TRUE(w);
      SCOPED_TRACE(choice.form);
      const ContactAngles& angles = w->patch.angles;
      int front = 0;
      for (int i = 0; i < w->patch.count; ++i) {
        if (w->patch.theta[i] < angles.max_stress) continue;
        const double circle = s.tire.radius * (std::cos(w->patch.theta[i]) - std::cos(angles.entry));
        EXPECT_NEAR(circle - w->patch.depth[i], 0.5 * s.tire.radius * a * a * w->patch.sigma[i] / p_g, 1e-9);
        ++front;
      }
      EXPECT_GT(front, 8);
      EXPECT_NEAR(w->sinkage + w->patch.deflection, s.tire.radius * (1 - std::cos(angles.entry)), 1e-12);
      EXPECT_NEAR(w->forces.vertical, load, 1e-9 * load);
    }
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
