// What every form of every effect owes: the base model at amplitude 0, a derivative there that the implicit function
// theorem confirms, defaults inside their bounds, a budget that adds up, finite numbers at the conditions' corners.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/kinematics.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

struct Setting {
  const char* name;
  Tire tire;
  SoilValues soil;
  double load;
};

Tire tire(double r, double b, double lug_height = 0.0, std::optional<double> inflation = {}) {
  Tire t;
  t.radius = r;
  t.width = b;
  t.lugs.height = lug_height;
  if (lug_height > 0.0) t.lugs.count = 30;
  t.inflation_pressure = inflation;
  return t;
}

/// A soil-bin wheel on dry sand, a rover wheel on simulant, a tractor wheel on clay, a tire on snow.
const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = {
      {"sand", tire(0.25, 0.10), bed::sand(), 800},
      {"simulant",
       tire(0.157, 0.165, 0.010),
       {.exponent = 1,
        .k_c = 15600,
        .k_phi = 2.4e6,
        .cohesion = 250,
        .friction_angle = 31.9 * degree,
        .shear_modulus = 0.0115,
        .c1 = 0.35,
        .c2 = 0.1,
        .density = 1550},
       80},
      {"clay",
       tire(0.6, 0.4, 0.03, 120e3),
       {.exponent = 0.5,
        .k_c = 13190,
        .k_phi = 692150,
        .cohesion = 4140,
        .friction_angle = 13 * degree,
        .shear_modulus = 0.015,
        .c1 = 0.3,
        .c2 = 0.2,
        .density = 1700},
       9000},
      {"snow", tire(0.4, 0.25, 0, 60e3), values_of(test::snow()), 1200},
  };
  return all;
}

struct Question {
  const char* name;
  double load_share, slip, yaw_deg, alpha_deg, beta_deg;
  int pass;
};

/// Flat and straight first; then one thing at a time.
constexpr std::array<Question, 7> questions = {{
    {"driven", 1.0, 0.25, 0, 0, 0, 1},
    {"light", 0.4, 0.10, 0, 0, 0, 1},
    {"spinning", 0.7, 0.80, 0, 0, 0, 1},
    {"braked", 0.6, -0.30, 0, 0, 0, 1},
    {"yawed", 0.8, 0.30, -20, 0, 0, 1},
    {"sloping", 0.9, 0.35, 10, 8, 12, 1},
    {"third pass", 1.0, 0.20, 0, 0, 0, 3},
}};

OperatingCondition condition(const Setting& setting, const Question& q) {
  OperatingCondition at;
  at.load = q.load_share * setting.load;
  at.slip = q.slip;
  at.speed = 0.3;
  at.yaw = q.yaw_deg * degree;
  at.longitudinal_incline = q.alpha_deg * degree;
  at.transverse_incline = q.beta_deg * degree;
  at.pass = q.pass;
  at.moisture = 0.09;
  at.position = 2.5;
  at.run = 7;
  return at;
}

constexpr Bin bin{.depth = 0.5, .width = 1.0};

RollingWheel wheel_with(const Setting& s, const EffectForm& form, std::optional<double> amplitude = {}) {
  std::map<std::string, double> values;
  if (amplitude) values[form.parameters[0].name] = *amplitude;
  return {s.tire, s.soil, make_effects({{form.id, form.form, values}}), bin};
}

std::array<double, 4> channels(const Reading& r) { return {r.drawbar_pull, r.torque, r.sinkage, r.lateral_force}; }

std::string label(const EffectForm& form, const Setting& s, const Question& q) {
  return form.id + " " + form.form + ", " + s.name + ", " + q.name;
}

/// Sizes of the four channels.
std::array<double, 4> scales(const Setting& s) { return {s.load, s.load * s.tire.radius, s.tire.radius, s.load}; }

/// Everything to be differentiated: the four readings and the load carried.
using Vector = std::array<double, 5>;

Vector look(const RolledWheel& w) {
  const Reading& r = w.reading;
  return {r.drawbar_pull, r.torque, r.sinkage, r.lateral_force, w.forces.vertical};
}

Vector combine(double p, const Vector& a, double q, const Vector& b) {
  Vector v;
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = p * a[i] + q * b[i];
  return v;
}

/// One-sided derivative at 0 from steps h and h/2, Richardson: error of order h^2.
Vector right_derivative(const auto& f, double h) {
  const Vector zero = f(0.0);
  const Vector full = combine(1 / h, f(h), -1 / h, zero), half = combine(2 / h, f(h / 2), -2 / h, zero);
  return combine(2, half, -1, full);
}

struct Derivatives {
  Vector rolled;    ///< of the balanced wheel, by finite differences
  Vector implicit;  ///< theta_1 held, then corrected by d theta_1/da = -V_a/V_theta
};

/// A step from 0 that moves no channel by more than about 1e-4 of its scale.
double small_step(const Setting& s, const EffectForm& form, const OperatingCondition& at) {
  const double h = 1e-6 * std::abs(form.parameters[0].fallback);
  const Vector moved = combine(1, look(wheel_with(s, form, h).roll(at)), -1, look(wheel_with(s, form, 0.0).roll(at)));
  const std::array<double, 4> scale = scales(s);
  double most = 1e-6;
  for (std::size_t i = 0; i < scale.size(); ++i) most = std::max(most, std::abs(moved[i]) / scale[i]);
  return 1e-4 * h / most;
}

Derivatives derivatives(const Setting& s, const EffectForm& form, const OperatingCondition& at) {
  const double h = small_step(s, form, at);
  const double theta = wheel_with(s, form, 0.0).roll(at).balance_angle;
  const auto held = [&](double a, double angle) { return look(wheel_with(s, form, a).at_entry_angle(at, angle)); };
  const double d = 1e-5 * theta;
  const Vector by_angle = combine(0.5 / d, held(0.0, theta + d), -0.5 / d, held(0.0, theta - d));
  const Vector by_amplitude = right_derivative([&](double a) { return held(a, theta); }, h);
  return {.rolled = right_derivative([&](double a) { return look(wheel_with(s, form, a).roll(at)); }, h),
          .implicit = combine(1.0, by_amplitude, -by_amplitude[4] / by_angle[4], by_angle)};
}

/// Forms whose amplitude has no derivative at 0, and why.
const std::map<std::string, std::string> not_smooth_at_zero = {
    {"exit_angle rebound", "theta_2 grows as sqrt(lambda)"},
    {"interface_limit cap", "bites only where the mobilised share exceeds 1 - a: a kink that travels in from the exit"},
    {"tire_flexibility flat_section", "bites only where sigma nears p_g/a: every derivative at a = 0 is 0"},
};

std::string key(const EffectForm& form) { return form.id + " " + form.form; }

TEST(Effects, DefaultsLieInsideTheirBounds) {
  std::set<std::string> seen;
  for (const EffectForm& form : effect_catalogue()) {
    SCOPED_TRACE(key(form));
    EXPECT_TRUE(seen.insert(key(form)).second) << "twice in the catalogue";
    ASSERT_FALSE(form.parameters.empty());
    EXPECT_LE(form.parameters[0].lower, 0.0);
    EXPECT_GT(form.parameters[0].upper, 0.0);
    EXPECT_NE(form.parameters[0].fallback, 0.0);
    EXPECT_FALSE(form.equation.empty());
    EXPECT_FALSE(form.source.empty());
    for (const EffectParameter& p : form.parameters) {
      EXPECT_LE(p.lower, p.fallback) << p.name;
      EXPECT_GE(p.upper, p.fallback) << p.name;
      EXPECT_FALSE(p.meaning.empty()) << p.name;
      EXPECT_FALSE(p.unit.empty()) << p.name;
    }
  }
}

TEST(Effects, EveryIdOfTheCatalogueHasTwoFormsOrMore) {
  const std::vector<std::string> ids = {"exit_angle",      "slip_sinkage",
                                        "lug_thrust",      "bulldozing",
                                        "multipass",       "tire_flexibility",
                                        "rate_dependence", "interface_limit",
                                        "shear_hump",      "pressure_dependent_shear_modulus",
                                        "hard_layer",      "moisture",
                                        "slope_weakening", "sidewall_bulldozing",
                                        "bed_tilt",        "rig_friction",
                                        "sensor_offset",   "cross_talk",
                                        "soil_gradient",   "drift"};
  std::vector<std::string> found;
  std::map<std::string, int> forms;
  for (const EffectForm& form : effect_catalogue()) {
    if (found.empty() || found.back() != form.id) found.push_back(form.id);
    ++forms[form.id];
  }
  EXPECT_EQ(found, ids);  // each once, in the catalogue's order
  for (const auto& [id, count] : forms) EXPECT_GE(count, 2) << id;
}

TEST(Effects, AmplitudeZeroIsTheBaseModelToTheBit) {
  for (const Setting& s : settings()) {
    const RollingWheel base(s.tire, s.soil, {}, bin);
    for (const Question& q : questions) {
      const OperatingCondition at = condition(s, q);
      const Reading expected = base.roll(at).reading;
      for (const EffectForm& form : effect_catalogue()) {
        SCOPED_TRACE(label(form, s, q));
        bed::expect_same_bits(wheel_with(s, form, 0.0).roll(at).reading, expected);
      }
    }
  }
}

TEST(Effects, AmplitudeZeroIsTheBaseModelAtTheCorners) {
  const Setting& s = settings()[0];
  OperatingCondition locked = bed::driven(200, -1.0), stuck = bed::driven(200, 1.0), sideways = bed::driven(200, 0.3);
  locked.yaw = 30 * degree;
  stuck.yaw = -30 * degree;
  sideways.yaw = 90 * degree;
  sideways.slip_by = SlipBy::travel_speed;
  sideways.force_frame = ForceFrame::wheel;
  for (const OperatingCondition& at : {locked, stuck, sideways, bed::driven(1e-3, 0.2)}) {
    const Reading expected = RollingWheel(s.tire, s.soil).roll(at).reading;
    for (const EffectForm& form : effect_catalogue()) {
      SCOPED_TRACE(key(form));
      bed::expect_same_bits(wheel_with(s, form, 0.0).roll(at).reading, expected);
    }
  }
}

// Who asks depends_on is told the truth: the answer moves with a condition where the form's description says so, and
// nowhere else.
TEST(Effects, DependOnTheConditionsThatTheirDescriptionsName) {
  const std::map<std::string, void (*)(OperatingCondition&)> changes = {
      {"pass", [](OperatingCondition& at) { at.pass = 2; }},
      {"speed", [](OperatingCondition& at) { at.speed *= 2; }},
      {"moisture", [](OperatingCondition& at) { at.moisture = 0.12; }},
      {"position", [](OperatingCondition& at) { at.position = 4; }},
      {"run", [](OperatingCondition& at) { at.run = 9; }}};
  const Setting& s = settings()[1];
  for (const EffectForm& form : effect_catalogue())
    for (const auto& [name, change] : changes) {
      OperatingCondition at = condition(s, questions[5]), other = at;
      change(other);
      const RollingWheel wheel = wheel_with(s, form);
      EXPECT_EQ(channels(wheel.roll(at).reading) != channels(wheel.roll(other).reading), depends_on(form, name))
          << key(form) << ", " << name;
    }
}

// Effects know nothing of each other: one at amplitude 0 beside another at its default changes no bit of the other's.
TEST(Effects, AmplitudeZeroBesideAnotherEffectIsThatEffectAlone) {
  const Setting& s = settings()[0];
  const OperatingCondition at = condition(s, questions[5]);
  for (const EffectForm& other : effect_catalogue()) {
    const Reading alone = wheel_with(s, other).roll(at).reading;
    for (const EffectForm& form : effect_catalogue()) {
      SCOPED_TRACE(key(other) + " beside " + key(form));
      const EffectChoice off{form.id, form.form, {{form.parameters[0].name, 0.0}}}, on{other.id, other.form, {}};
      bed::expect_same_bits(RollingWheel(s.tire, s.soil, make_effects({off, on}), bin).roll(at).reading, alone);
      bed::expect_same_bits(RollingWheel(s.tire, s.soil, make_effects({on, off}), bin).roll(at).reading, alone);
    }
  }
}

// Where an effect has its default size it answers with finite numbers, or says that there is no answer.
TEST(Effects, NeverAnswerWithANumberThatIsNone) {
  EXPECT_TRUE(rc::check([] {
    const auto share = [](int low, int high) { return *rc::gen::inRange(low, high + 1) / 100.0; };
    const EffectForm& form = *rc::gen::elementOf(effect_catalogue());
    const Setting& s = settings()[*rc::gen::inRange<std::size_t>(0, settings().size())];
    OperatingCondition at = condition(s, questions[0]);
    at.load = s.load * share(1, 150);
    at.slip = share(-100, 100);
    at.yaw = share(-100, 100) * 90 * degree;
    at.slip_by = SlipBy::travel_speed;
    at.longitudinal_incline = share(-30, 30);
    at.transverse_incline = share(-30, 30);
    at.pass = *rc::gen::inRange(1, 6);
    const EffectParameter& p = form.parameters[0];
    const double amplitude = std::clamp(p.fallback * share(0, 200), p.lower, p.upper);
    try {
      const RolledWheel w = wheel_with(s, form, amplitude).roll(at);
      for (const double value : channels(w.reading)) RC_ASSERT(std::isfinite(value));
      RC_ASSERT(w.forces.vertical > 0.0);
    } catch (const NoSolution&) {
      RC_SUCCEED("said so");
    }
  }));
}

// Locked, spinning on the spot and sideways at once, where a ratio of speeds may be 0/0: a light wheel stands there.
TEST(Effects, AnswerWithANumberAtTheCornersOfTheMotion) {
  for (const EffectForm& form : effect_catalogue())
    for (const Setting& s : settings())
      for (const double slip : {-1.0, 0.0, 1.0})
        for (const double yaw : {-90.0, 0.0, 90.0}) {
          OperatingCondition at = bed::driven(0.02 * s.load, slip);
          at.yaw = yaw * degree;
          at.slip_by = SlipBy::travel_speed;
          SCOPED_TRACE(fmt::format("{}, {}, slip {}, yaw {} deg", key(form), s.name, slip, yaw));
          EXPECT_NO_THROW({
            for (const double value : channels(wheel_with(s, form).roll(at).reading)) EXPECT_TRUE(std::isfinite(value));
          });
        }
}

// No form grows without end over passes, slips and loads: after many passes one more changes nothing, and at any slip
// and load the pull stays within a few times what the weight and the cohesion could give; what drags a locked wheel
// that has dug itself in may be ten times as much.
TEST(Effects, EveryFormHasALimit) {
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id == "lug_thrust" || form.measurement) continue;  // a rig's friction and drift are the rig's
    for (const Setting& s : settings())
      for (const double slip : {-1.0, -0.5, 0.0, 0.2, 0.6, 0.9, 1.0})
        for (const double load : {0.1, 0.5, 1.0, 1.5}) {
          OperatingCondition at = condition(s, questions[0]);
          at.slip = slip, at.load = load * s.load;
          SCOPED_TRACE(fmt::format("{}, {}, slip {}, {} N", key(form), s.name, slip, at.load));
          const auto answer = [&](int pass) -> std::optional<Reading> {
            at.pass = pass;
            try {
              return wheel_with(s, form).roll(at).reading;
            } catch (const NoSolution&) {
              return {};
            }
          };
          const double most = 3 * (at.load + s.soil.cohesion * s.tire.width * s.tire.radius);
          for (const int pass : {1, 2, 10, 100, 1000})
            if (const auto found = answer(pass)) {
              EXPECT_LT(found->drawbar_pull, most) << pass;
              EXPECT_GT(found->drawbar_pull, -10 * most) << pass;
              EXPECT_LT(std::abs(found->torque), most * s.tire.radius) << pass;
              EXPECT_LT(std::abs(found->sinkage), 3 * s.tire.radius) << pass;
            }
          const auto hundred = answer(100), thousand = answer(1000);
          ASSERT_EQ(hundred.has_value(), thousand.has_value());
          if (!hundred) continue;
          EXPECT_NEAR(hundred->drawbar_pull, thousand->drawbar_pull, 1e-6 * at.load);
          EXPECT_NEAR(hundred->sinkage, thousand->sinkage, 1e-6 * s.tire.radius);
        }
  }
}

// A carcass has its closed form beside effects that leave the pressure alone, and one of the depth alone beside those
// that look at nothing else: what each effect says of itself.
TEST(Effects, ThatChangeThePressureSayThatTheyDo) {
  const Setting& s = settings().front();
  const std::optional<Bin> in_bin = bin;
  const Outline outline{
      .radius = s.tire.radius, .width = s.tire.width, .shear_radius = s.tire.radius, .slip_radius = s.tire.radius};
  int change = 0;
  for (const EffectForm& form : effect_catalogue()) {
    const OperatingCondition at = condition(s, questions.back());
    const EffectList effects = make_effects({{form.id, form.form, {}}});
    Surroundings around{.tire = s.tire, .declared = s.soil, .at = at, .motion = kinematics(at), .bin = in_bin};
    around.effects = effects, around.normal_load = at.load;
    ContactPatch plain;
    plain.count = 3, plain.angles.entry = 0.6;
    for (const std::size_t i : {0, 1, 2})
      plain.depth[i] = plain.circle_depth[i] = 0.005 + 0.015 * static_cast<double>(i);
    ContactPatch pressed = plain;
    fill_pressure(plain, s.soil, outline);
    press(pressed, outline, around);
    const bool changes = !std::ranges::equal(plain.of(&ContactPatch::sigma), pressed.of(&ContactPatch::sigma));
    change += changes;
    const PressureLaw law = effects.front()->pressure_law();
    EXPECT_TRUE(law != PressureLaw::declared || !changes) << key(form);
    ContactPatch elsewhere = plain;
    elsewhere.angles.entry = 0.8;
    for (double& depth : elsewhere.of(&ContactPatch::circle_depth)) depth *= 1.5;
    press(elsewhere, outline, around);
    const bool by_place = !std::ranges::equal(pressed.of(&ContactPatch::sigma), elsewhere.of(&ContactPatch::sigma));
    EXPECT_EQ(law == PressureLaw::by_place, by_place) << key(form);
  }
  EXPECT_GE(change, 5);
}

// Gravity acts through the soil's weight alone: on the Moon as where the soil is as much lighter. What sets soil in
// motion asks for its mass.
TEST(Effects, FeelGravityThroughTheWeightOfTheSoil) {
  constexpr double moon = 1.62;
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id == "rate_dependence") continue;
    for (Setting s : settings()) {
      const OperatingCondition at = condition(s, questions[5]);
      s.soil.gravity = moon;
      const std::array<double, 4> there =
          channels(wheel_with(s, form, 0.1 * form.parameters[0].fallback).roll(at).reading);
      s.soil.gravity = standard_gravity, s.soil.density *= moon / standard_gravity;
      const std::array<double, 4> lighter =
          channels(wheel_with(s, form, 0.1 * form.parameters[0].fallback).roll(at).reading);
      for (std::size_t c = 0; c < there.size(); ++c)
        EXPECT_NEAR(there[c], lighter[c], 1e-12 * s.load) << label(form, s, questions[5]);
    }
  }
}

// The search for the balance asks those forms alone that say that they may lift the wheel: none does it unasked.
TEST(Effects, EveryFormLeavesTheLoadCarried) {
  for (const EffectForm& form : effect_catalogue())
    for (const Setting& s : settings())
      for (const Question& q : questions) {
        const OperatingCondition at = condition(s, q);
        const double load = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
        const double small = 0.1 * form.parameters[0].fallback;  // so that none digs itself in
        EXPECT_NEAR(wheel_with(s, form, small).roll(at).forces.vertical, load, 1e-9 * load) << label(form, s, q);
      }
}

// Where another effect settles the wheel, the stresses of a form there are scaled, and with them what its faces lift.
TEST(Effects, EveryFormLeavesTheLoadCarriedWhereTheWheelSettles) {
  const EffectChoice digs[] = {{"slip_sinkage", "lyasko", {}},
                               {"slip_sinkage", "linear", {}},
                               {"slip_sinkage", "reece", {}},
                               {"slip_sinkage", "sliding", {}},
                               {"multipass", "rut_power", {}}};
  std::size_t asked = 0, answered = 0;
  for (const EffectForm& form : effect_catalogue())
    for (const EffectChoice& deeper : digs)
      for (const Setting& s : settings())
        for (const Question& q : questions) {
          if (form.id == deeper.id) continue;
          const OperatingCondition at = condition(s, q);
          const double load = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
          ++asked;
          try {
            const RollingWheel wheel(s.tire, s.soil, make_effects({{form.id, form.form, {}}, deeper}), bin);
            EXPECT_NEAR(wheel.roll(at).forces.vertical, load, 1e-9 * load) << label(form, s, q) << ", " << deeper.form;
            ++answered;
          } catch (const NoSolution&) {  // digs itself in
          }
        }
  EXPECT_GT(answered, asked * 3 / 4);
}

TEST(Effects, DerivativeAtZeroIsThatOfTheImplicitFunctionTheorem) {
  for (const EffectForm& form : effect_catalogue()) {
    if (not_smooth_at_zero.contains(key(form))) continue;
    double strongest = 0.0;
    for (const Setting& s : settings()) {
      for (const Question& q : questions) {
        SCOPED_TRACE(label(form, s, q));
        const OperatingCondition at = condition(s, q);
        const Derivatives d = derivatives(s, form, at);
        const std::array<double, 4> scale = scales(s);
        for (std::size_t i = 0; i < scale.size(); ++i) {
          const double unit = scale[i] / std::abs(form.parameters[0].fallback);
          EXPECT_NEAR(d.rolled[i], d.implicit[i], 2e-6 * unit + 2e-6 * std::abs(d.implicit[i])) << "channel " << i;
          strongest = std::max(strongest, std::abs(d.implicit[i]) / unit);
        }
      }
    }
    EXPECT_GT(strongest, 1e-4) << key(form) << " leaves no trace in any of these conditions";
  }
}

// The exempted forms: rebound answers in sqrt(lambda), so quartering a small lambda halves the answer.
TEST(Effects, ReboundGrowsAsTheRootOfItsAmplitude) {
  const Setting& s = settings()[0];
  const OperatingCondition at = condition(s, questions[0]);
  const EffectForm& form = find_form({"exit_angle", "rebound", {}});
  const double base = RollingWheel(s.tire, s.soil).roll(at).reading.drawbar_pull;
  const auto gain = [&](double lambda) { return wheel_with(s, form, lambda).roll(at).reading.drawbar_pull - base; };
  EXPECT_GT(gain(1e-8), 0.0);
  EXPECT_NEAR(gain(4e-8) / gain(1e-8), 2.0, 1e-3);
}

// A cap at 1 - a bites nobody while exp(-j/K) > a everywhere, and then only downward.
TEST(Effects, InterfaceCapIsSilentUntilItBites) {
  const Setting& s = settings()[0];
  const OperatingCondition at = condition(s, questions[1]);
  const EffectForm& form = find_form({"interface_limit", "cap", {}});
  const RolledWheel base = RollingWheel(s.tire, s.soil).roll(at);
  double most = 0.0;
  for (const double m : base.patch.of(&ContactPatch::mobilised)) most = std::max(most, m);
  bed::expect_same_bits(wheel_with(s, form, 0.999 * (1 - most)).roll(at).reading, base.reading);
  EXPECT_LT(wheel_with(s, form, 1.1 * (1 - most)).roll(at).reading.torque, base.reading.torque);
}

// Far below the ground pressure the tire is rigid: the change falls as a^(6/n) (the corner of the tread's depth), so
// with n = 1.1 a tenth of the amplitude leaves 10^(-6/1.1) = 3.5e-6 of it.
TEST(Effects, FlatSectionFadesFasterThanItsAmplitude) {
  const Setting& s = settings()[0];
  const OperatingCondition at = condition(s, questions[0]);
  const EffectForm& form = find_form({"tire_flexibility", "flat_section", {}});
  const double base = RollingWheel(s.tire, s.soil).roll(at).reading.sinkage;
  const auto change = [&](double a) { return base - wheel_with(s, form, a).roll(at).reading.sinkage; };
  EXPECT_GT(change(0.1), 0.0);
  EXPECT_NEAR(std::log(change(0.1) / change(0.01)) / std::log(10.0), 6 / 1.1, 0.05);
}

TEST(Effects, BudgetAddsUpToTheDrawbarPull) {
  for (const Setting& s : settings()) {
    for (const Question& q : questions) {
      for (const ForceFrame frame : {ForceFrame::travel, ForceFrame::wheel}) {
        for (const EffectForm& form : effect_catalogue()) {
          SCOPED_TRACE(label(form, s, q));
          OperatingCondition at = condition(s, q);
          at.force_frame = frame;
          try {
            const TractionResult result = traction_result(wheel_with(s, form).roll(at), s.tire, false);
            const double sum = std::accumulate(result.budget.begin(), result.budget.end(), 0.0,
                                               [](double a, const Contribution& c) { return a + c.force; });
            EXPECT_NEAR(sum, result.drawbar_pull.value, 4e-12 * at.load);
            EXPECT_LE(std::abs(result.budget_rest.force), result.budget_rest.bound);
            EXPECT_LT(result.budget_rest.bound, 1e-12 * at.load);
          } catch (const NoSolution&) {
            EXPECT_NE(form.id, "rig_friction");  // an effect of the rig can't bury the wheel
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace soilbin::bekker_wong
