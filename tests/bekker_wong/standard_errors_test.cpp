// Standard errors by the implicit function theorem: against differences of wheels balanced anew where these exist, and
// where they do not: at the bounds of the soil's parameters and just below the largest load.
#include "bekker_wong/standard_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

using Channels = BalanceDerivatives::Channels;

/// Wong's dry sand under a 250 mm wheel, each parameter with a standard deviation.
Scenario sand_scenario() {
  Scenario scenario;
  scenario.tire = bed::smooth_tire();
  scenario.tire.lugs = {.height = 0.02, .count = 24, .thickness = 0.006};
  scenario.tire.inflation_pressure = 60e3;
  scenario.soil.semi_empirical = SemiEmpiricalSoil{.exponent = {1.1, 0.05},
                                                   .k_c = {990, 300},
                                                   .k_phi = {1.52843e6, 150e3},
                                                   .cohesion = {1040, 300},
                                                   .friction_angle = {28 * degree, 2 * degree},
                                                   .shear_modulus = {0.02, 0.005},
                                                   .stress_angle_c1 = {0.18, 0.08},
                                                   .stress_angle_c2 = {0.32, 0.08},
                                                   .density = 1600};
  return scenario;
}

SemiEmpiricalSoil& soil_of(Scenario& scenario) { return *scenario.soil.semi_empirical; }

/// Channels of the wheel balanced on this soil.
Channels balanced(const Scenario& scenario, const SoilValues& soil, const OperatingCondition& at) {
  const RollingWheel wheel(scenario.tire, soil, make_effects(scenario.effects), scenario.bin);
  const Reading reading = wheel.roll(at).reading;
  Channels all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = reading.*reading_members[i];
  return all;
}

/// Slopes of the balanced channels over a parameter, to fourth order in h: (8 [f(h) - f(-h)] - [f(2h) - f(-2h)])/(12
/// h).
Channels central(const Scenario& scenario, const OperatingCondition& at, std::size_t parameter, double h) {
  const auto f = [&](double by) {
    SoilValues soil = values_of(*scenario.soil.semi_empirical);
    soil.*soil_members[parameter] += by;
    return balanced(scenario, soil, at);
  };
  const Channels a = f(h), b = f(-h), c = f(2 * h), d = f(-2 * h);
  Channels slopes{};
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
  return slopes;
}

/// Slopes from the value to one side alone, to second order: (-3 f(0) + 4 f(h) - f(2h))/(2 h).
Channels one_sided(const Scenario& scenario, const OperatingCondition& at, std::size_t parameter, double h) {
  const auto f = [&](double by) {
    SoilValues soil = values_of(*scenario.soil.semi_empirical);
    soil.*soil_members[parameter] += by;
    return balanced(scenario, soil, at);
  };
  const Channels zero = f(0), one = f(h), two = f(2 * h);
  Channels slopes{};
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = (-3 * zero[i] + 4 * one[i] - two[i]) / (2 * h);
  return slopes;
}

Channels implicit(const Scenario& scenario, const OperatingCondition& at, std::size_t parameter) {
  const SemiEmpiricalSoil& declared = *scenario.soil.semi_empirical;
  const SoilValues soil = values_of(declared);
  const EffectList effects = make_effects(scenario.effects);
  const RolledWheel wheel = RollingWheel(scenario.tire, soil, effects, scenario.bin).roll(at);
  return BalanceDerivatives(scenario.tire, soil, effects, scenario.bin, at, wheel.balance_angle)
      .by(parameter, (declared.*soil_parameters[parameter].value).std_error);
}

/// What a channel is told in shares of: the load, the load times the radius, the radius.
Channels wholes(const Scenario& scenario, const OperatingCondition& at) {
  const double r = scenario.tire.radius;
  return {at.load, at.load * r, r, at.load};
}

/// What one standard deviation of a parameter moves, by both slopes, agrees to `tolerance` of itself and of a tenth of
/// the channel's whole.
void expect_alike(const Scenario& scenario, const OperatingCondition& at, std::size_t parameter, const Channels& found,
                  const Channels& expected, double tolerance) {
  const double sd = ((*scenario.soil.semi_empirical).*soil_parameters[parameter].value).std_error;
  const Channels whole = wholes(scenario, at);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(sd * found[i], sd * expected[i], tolerance * (std::abs(sd * expected[i]) + 0.1 * whole[i]))
        << soil_parameters[parameter].name << ", " << traction_channels[i].name << ", slip " << at.slip << ", yaw "
        << at.yaw << (scenario.effects.empty() ? "" : ", " + scenario.effects.front().id);
}

std::vector<OperatingCondition> conditions() {
  std::vector<OperatingCondition> all;
  for (const double slip : {-0.3, 0.05, 0.3, 0.8}) all.push_back(bed::driven(800, slip));
  all.push_back(bed::driven(800, 0.2));
  all.back().yaw = 15 * degree, all.back().speed = 0.3;
  all.push_back(bed::driven(500, 0.4));
  all.back().longitudinal_incline = 10 * degree, all.back().transverse_incline = 5 * degree;
  return all;
}

TEST(StandardErrors, AgreeWithDifferencesOfBalancedWheels) {
  const Scenario scenario = sand_scenario();
  for (const OperatingCondition& at : conditions())
    for (std::size_t p = 0; p < soil_parameters.size(); ++p) {
      const double sd = ((*scenario.soil.semi_empirical).*soil_parameters[p].value).std_error;
      expect_alike(scenario, at, p, implicit(scenario, at, p), central(scenario, at, p, 0.02 * sd), 1e-6);
    }
}

// An effect that settles the wheel deeper, one that changes the outline, one that adds forces, one of the instruments.
TEST(StandardErrors, AgreeWithEffectsToo) {
  for (const char* id : {"slip_sinkage", "tire_flexibility", "bulldozing", "lug_thrust", "multipass", "cross_talk"}) {
    Scenario scenario = sand_scenario();
    scenario.effects = {{id, "", {}}};
    OperatingCondition at = bed::driven(800, 0.3);
    at.pass = 2, at.yaw = 10 * degree;
    for (std::size_t p = 0; p < soil_parameters.size(); ++p) {
      const double sd = (soil_of(scenario).*soil_parameters[p].value).std_error;
      expect_alike(scenario, at, p, implicit(scenario, at, p), central(scenario, at, p, 0.02 * sd), 1e-5);
    }
  }
}

// sigma^2 = sum of (sd dr/dp)^2: with one parameter in doubt the error is its slope times its standard deviation.
TEST(StandardErrors, AreSlopesTimesStandardDeviations) {
  const OperatingCondition at = bed::driven();
  Scenario scenario = sand_scenario();
  const TractionResult all = BekkerWong().evaluate(scenario, at);
  Channels squares{};
  for (std::size_t p = 0; p < soil_parameters.size(); ++p) {
    Scenario one = sand_scenario();
    for (const SoilParameter& other : soil_parameters)
      if (&other != &soil_parameters[p]) (soil_of(one).*other.value).std_error = 0;
    const TractionResult result = BekkerWong().evaluate(one, at);
    const double sd = (soil_of(one).*soil_parameters[p].value).std_error;
    const Channels slopes = central(one, at, p, 0.02 * sd);
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const double error = (result.*traction_channels[i].predicted).std_error;
      EXPECT_NEAR(error, sd * std::abs(slopes[i]), 1e-6 * wholes(one, at)[i]) << soil_parameters[p].name;
      squares[i] += error * error;
    }
  }
  for (std::size_t i = 0; i < squares.size(); ++i)
    EXPECT_NEAR((all.*traction_channels[i].predicted).std_error, std::sqrt(squares[i]),
                1e-12 * wholes(scenario, at)[i]);
  EXPECT_TRUE(all.without_error_of.empty());
}

/// The scenario with one parameter of this value, which alone has a standard deviation.
Scenario with_only(const std::string& name, double value, double sd) {
  Scenario scenario = sand_scenario();
  for (const SoilParameter& p : soil_parameters) (soil_of(scenario).*p.value).std_error = 0;
  if (name == "exponent")  // the same pressure at a tenth of the radius
    soil_of(scenario).k_phi.value *= std::pow(0.1 * scenario.tire.radius, soil_of(scenario).exponent.value - value),
        soil_of(scenario).k_c.value *= std::pow(0.1 * scenario.tire.radius, soil_of(scenario).exponent.value - value);
  soil_of(scenario).*soil_parameter(name).value = {value, sd};
  return scenario;
}

std::size_t index_of(const std::string& name) { return &soil_parameter(name) - soil_parameters.data(); }

// phi = 0 and c = 0 are soils, and so are n = 0.05 and n = 5: their errors are slopes to the admissible side.
TEST(StandardErrors, AreOneSidedAtABound) {
  struct Bound {
    const char* name;
    double value, sd;
    double slip = 0.3;
  };
  for (const Bound& bound :
       {Bound{"friction_angle", 0.0, 3 * degree}, Bound{"cohesion", 0.0, 400.0}, Bound{"exponent", 0.05, 0.02},
        Bound{"exponent", 5.0, 0.2}, Bound{"stress_angle_c1", 0.0, 0.1, 0.0}, Bound{"stress_angle_c2", -1.0, 0.1}}) {
    const OperatingCondition at = bed::driven(300, bound.slip);
    const Scenario scenario = with_only(bound.name, bound.value, bound.sd);
    const TractionResult result = BekkerWong().evaluate(scenario, at);
    EXPECT_TRUE(result.without_error_of.empty()) << bound.name;
    const std::size_t p = index_of(bound.name);
    const double inward = soil_parameters[p].range.lower == bound.value ? 1.0 : -1.0;
    const Channels slopes = one_sided(scenario, at, p, inward * 1e-3 * bound.sd);
    for (std::size_t i = 0; i < slopes.size(); ++i)
      EXPECT_NEAR((result.*traction_channels[i].predicted).std_error, bound.sd * std::abs(slopes[i]),
                  2e-4 * bound.sd * std::abs(slopes[i]) + 1e-7 * wholes(scenario, at)[i])
          << bound.name << " = " << bound.value << ", " << traction_channels[i].name;
  }
}

/// The largest load that the soil carries, to a part in 1e9.
double largest_load(const Scenario& scenario, OperatingCondition at) {
  const RollingWheel wheel(scenario.tire, values_of(*scenario.soil.semi_empirical), make_effects(scenario.effects));
  double carried = 10, buried = 1e6;
  while (buried / carried > 1 + 1e-9) {
    at.load = std::sqrt(carried * buried);
    try {
      wheel.roll(at);
      carried = at.load;
    } catch (const NoSolution&) {
      buried = at.load;
    }
  }
  return carried;
}

/// Three largest loads: of a driven wheel, which rests 0.9 of its radius deep; of one that digs itself in as deep as an
/// effect may settle it; and of a wheel braked hard on strong soil, whose shear stress pulls it down so that the load
/// carried has a maximum over the depth, where V_theta = 0.
struct LargestLoad {
  const char* name;
  Scenario scenario;
  double slip;
};

std::vector<LargestLoad> largest_loads() {
  LargestLoad deepest{"at the deepest place", sand_scenario(), 0.3}, fold{"at the maximum", sand_scenario(), -0.9};
  soil_of(deepest.scenario).k_phi = {2e5, 4e4};
  LargestLoad dug_in = deepest;
  dug_in.name = "dug in", dug_in.slip = 0.8, dug_in.scenario.effects = {{"slip_sinkage", "lyasko", {}}};
  SemiEmpiricalSoil& soil = soil_of(fold.scenario);
  soil.k_phi = {2e5, 4e4}, soil.exponent.value = 0.6, soil.friction_angle.value = 45 * degree;
  soil.shear_modulus = {0.005, 0.001}, soil.stress_angle_c1.value = 0.4, soil.stress_angle_c2.value = 0.2;
  return {deepest, dug_in, fold};
}

// Just below the largest load a soil that is softer by a thousandth of its standard deviation carries too little. The
// answer has its errors all the same.
TEST(StandardErrors, StandBelowTheLargestLoad) {
  for (const auto& [name, scenario, slip] : largest_loads()) {
    SCOPED_TRACE(name);
    const OperatingCondition at = bed::driven(0.99999 * largest_load(scenario, bed::driven(0, slip)), slip);
    SoilValues softer = values_of(*scenario.soil.semi_empirical);
    softer.k_phi -= 1e-3 * scenario.soil.semi_empirical->k_phi.std_error;
    EXPECT_THROW(balanced(scenario, softer, at), NoSolution) << "no difference of balanced wheels gives this error";
    const TractionResult result = BekkerWong().evaluate(scenario, at);
    EXPECT_TRUE(result.without_error_of.empty());
    for (const TractionChannel& channel : traction_channels)
      EXPECT_TRUE((result.*channel.predicted).std_error > 0.0 || channel.name == "lateral_force") << channel.name;
  }
}

TEST(StandardErrors, AgreeAtAThousandthBelowTheLargestLoad) {
  for (const auto& [name, scenario, slip] : largest_loads()) {
    SCOPED_TRACE(name);
    const OperatingCondition at = bed::driven(0.999 * largest_load(scenario, bed::driven(0, slip)), slip);
    for (std::size_t p = 0; p < soil_parameters.size(); ++p) {
      const double sd = ((*scenario.soil.semi_empirical).*soil_parameters[p].value).std_error;
      expect_alike(scenario, at, p, implicit(scenario, at, p), central(scenario, at, p, 1e-4 * sd), 1e-4);
    }
  }
}

// At the maximum the wheel sinks under any further load: the errors grow as 1/sqrt(1 - load/maximum).
TEST(StandardErrors, GrowTowardTheMaximum) {
  const LargestLoad fold = largest_loads().back();
  const double most = largest_load(fold.scenario, bed::driven(0, fold.slip));
  const auto error = [&](double short_of) {
    return BekkerWong().evaluate(fold.scenario, bed::driven((1 - short_of) * most, fold.slip)).sinkage.std_error;
  };
  EXPECT_NEAR(error(1e-6) / error(1e-4), 10.0, 0.3);
}

// A value never disappears because its error can't be computed; the parameter that lacks one is named.
TEST(StandardErrors, TellWhichOneIsMissing) {
  Scenario scenario = sand_scenario();
  soil_of(scenario).k_c.std_error = 1e200;
  const TractionResult result = BekkerWong().evaluate(scenario, bed::driven());
  EXPECT_EQ(result.without_error_of, std::vector<std::string>{"k_c"});
  EXPECT_GT(result.drawbar_pull.std_error, 0.0) << "the others' part is there";
  EXPECT_TRUE(std::isfinite(result.drawbar_pull.std_error));
}

// (k_c/b + k_phi) z^n: what k_c puts on, a k_phi that errs the other way takes off.
TEST(StandardErrors, OfAFitCancelWhereTheirParametersDo) {
  Scenario scenario = sand_scenario();
  for (const SoilParameter& p : soil_parameters) (soil_of(scenario).*p.value).std_error = 0;
  const double sd = 100e3;
  soil_of(scenario).k_phi.std_error = sd, soil_of(scenario).k_c.std_error = sd * scenario.tire.width;
  const TractionResult apart = BekkerWong().evaluate(scenario, bed::driven());
  scenario.errors = {{"k_c", {}, {}}, {"k_phi", {}, {-1.0}}};
  const TractionResult together = BekkerWong().evaluate(scenario, bed::driven());
  EXPECT_GT(apart.sinkage.std_error, 1e-4);
  EXPECT_LT(together.sinkage.std_error, 1e-5 * apart.sinkage.std_error);
  EXPECT_LT(together.drawbar_pull.std_error, 1e-5 * apart.drawbar_pull.std_error);
  scenario.errors.back().correlations = {1.0};  // k_c/b and k_phi move the pressure alike: the sum in place of the root
  const TractionResult alike = BekkerWong().evaluate(scenario, bed::driven());
  EXPECT_NEAR(alike.sinkage.std_error, std::sqrt(2.0) * apart.sinkage.std_error, 1e-6 * alike.sinkage.std_error);
}

// Of a sum of channels: one alone is the channel's own to the bit; of one doubt the sum of the signed slopes.
TEST(StandardErrors, OfASumOfChannels) {
  Scenario scenario = sand_scenario();
  const OperatingCondition at = bed::driven();
  const RolledWheel balanced = RollingWheel(scenario.tire, values_of(soil_of(scenario)), {}, scenario.bin).roll(at);
  scenario.misfit = {3.0, 0.2, 0.0, 0.0};
  const TractionResult own = BekkerWong().evaluate(scenario, at);
  EXPECT_EQ(ChannelErrors(balanced, scenario, {}).of({1.0}), own.drawbar_pull.std_error);
  EXPECT_EQ(ChannelErrors(balanced, scenario, {}).of({0.0, 1.0}), own.torque.std_error);

  for (const SoilParameter& p : soil_parameters) (soil_of(scenario).*p.value).std_error = 0;
  EXPECT_EQ(ChannelErrors(balanced, scenario, {}).of({2.0, 10.0}), std::hypot(2.0 * 3.0, 10.0 * 0.2));
  scenario.misfit = {};
  const double sd = 2e3;
  soil_of(scenario).cohesion.std_error = sd;
  const SoilValues soil = values_of(soil_of(scenario));
  const auto cohesion = static_cast<std::size_t>(
      std::ranges::find(soil_parameters, std::string("cohesion"), &SoilParameter::name) - soil_parameters.begin());
  const auto slopes =
      BalanceDerivatives(scenario.tire, soil, {}, scenario.bin, at, balanced.balance_angle).by(cohesion, sd);
  const double sum = (2.0 * slopes[0] - 10.0 * slopes[1]) * sd;
  EXPECT_NEAR(ChannelErrors(balanced, scenario, {}).of({2.0, -10.0}), std::abs(sum), 1e-12 * std::abs(sum));
}

// With k = P/z_0^n, n and P independent: what a fit with these covariances says, and far less than n and k apart.
TEST(StandardErrors, OfAnExponentLeaveThePressureAtItsReference) {
  Scenario scenario = sand_scenario();
  SemiEmpiricalSoil& soil = soil_of(scenario);
  soil.k_c.std_error = 0;
  const TractionResult apart = BekkerWong().evaluate(scenario, bed::driven());
  const double z_0 = 0.03, of_n = soil.exponent.std_error, by_n = -std::log(z_0);
  soil.reference_sinkage = z_0;
  const TractionResult about = BekkerWong().evaluate(scenario, bed::driven());
  soil.reference_sinkage.reset();
  const double own = soil.k_phi.std_error, c = soil.k_c.value * by_n * of_n, phi = soil.k_phi.value * by_n * of_n;
  soil.k_c.std_error = c, soil.k_phi.std_error = std::hypot(own, phi);
  const double share = phi / soil.k_phi.std_error;  // of k_phi's error that n makes
  scenario.errors = {{"exponent", {}, {}}, {"k_c", {}, {1.0}}, {"k_phi", {}, {share, share}}};
  const TractionResult fitted = BekkerWong().evaluate(scenario, bed::driven());
  for (const auto value : {&TractionResult::drawbar_pull, &TractionResult::torque, &TractionResult::sinkage})
    EXPECT_NEAR((about.*value).std_error, (fitted.*value).std_error, 1e-4 * (fitted.*value).std_error);
  EXPECT_LT(about.sinkage.std_error, apart.sinkage.std_error);
}

TEST(StandardErrors, OfAFitHoldTheEffectsParametersToo) {
  Scenario scenario = sand_scenario();
  for (const SoilParameter& p : soil_parameters) (soil_of(scenario).*p.value).std_error = 0;
  const OperatingCondition at = bed::driven(800, 0.3);
  const double sd = 0.05, a = 0.6;
  const auto sinkage = [&](double amplitude) {
    scenario.effects = {{"slip_sinkage", "lyasko", {{"a", amplitude}}}};
    return BekkerWong().evaluate(scenario, at);
  };
  const double h = 1e-3, slope = (sinkage(a + h).sinkage.value - sinkage(a - h).sinkage.value) / (2 * h);
  EXPECT_EQ(sinkage(a).sinkage.std_error, 0.0);
  scenario.errors = {{"slip_sinkage.a", sd, {}}};
  EXPECT_NEAR(sinkage(a).sinkage.std_error, std::abs(slope) * sd, 1e-4 * std::abs(slope) * sd);
}

// The carcass pressure errs beside an exact soil; nothing hears of it without an effect that reads it.
TEST(StandardErrors, HoldTheCarcassPressures) {
  Scenario scenario = sand_scenario();
  for (const SoilParameter& p : soil_parameters) (soil_of(scenario).*p.value).std_error = 0.0;
  scenario.tire.carcass_pressure = Estimate{15e3, 4e3};
  const OperatingCondition at{.load = 800, .slip = 0.2};
  EXPECT_EQ(BekkerWong().evaluate(scenario, at).drawbar_pull.std_error, 0.0);
  scenario.effects = {{"tire_flexibility", "carcass_spring", {}}};
  const auto pull = [&](double carcass) {
    Scenario other = scenario;
    other.tire.carcass_pressure->value = carcass;
    return BekkerWong().evaluate(other, at).drawbar_pull.value;
  };
  const double h = 100, slope = (pull(15e3 + h) - pull(15e3 - h)) / (2 * h);
  EXPECT_NEAR(BekkerWong().evaluate(scenario, at).drawbar_pull.std_error, std::abs(4e3 * slope),
              1e-4 * std::abs(4e3 * slope));
}

// What a fit missed is a part of every answer's error.
TEST(StandardErrors, HoldAFitsMisfit) {
  Scenario scenario = sand_scenario();
  const OperatingCondition at{.load = 800, .slip = 0.2};
  const double before = BekkerWong().evaluate(scenario, at).drawbar_pull.std_error;
  scenario.misfit = {30.0, 0.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(BekkerWong().evaluate(scenario, at).drawbar_pull.std_error, std::hypot(before, 30.0));
}

}  // namespace
}  // namespace soilbin::bekker_wong
