#include "bekker_wong/standard_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/errors.hpp"
#include "scenario/fitted_errors.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double angle_step = 1e-5;                       // relative, of theta_1
constexpr double share_of_sd = 1e-4;                      // a parameter's step
constexpr double least_step = 1e-7, largest_step = 1e-3;  // relative to the parameter, where it is not 0

/// A step of the parameter that is far above the rounding of the stress integrals and small beside what it varies by.
double step_of(double x, double sd) {
  if (x == 0.0) return share_of_sd * sd;
  return std::clamp(share_of_sd * sd, least_step * std::abs(x), largest_step * std::abs(x));
}

}  // namespace

BalanceDerivatives::BalanceDerivatives(const Tire& tire, const SoilValues& soil, const EffectList& effects,
                                       const std::optional<Bin>& bin, const OperatingCondition& at,
                                       double balance_angle)
    : tire_(tire),
      soil_(soil),
      effects_(effects),
      bin_(bin),
      at_(at),
      theta_1_(balance_angle),
      nodes_(RollingWheel(tire, soil, effects, bin).nodes(at, balance_angle)),
      here_(point(soil, effects, theta_1_, 0.0)) {
  const auto turned = [&](double by) { return point(soil_, effects_, theta_1_ + by, by); };
  by_angle_ = slopes(turned(-angle_step * theta_1_), turned(angle_step * theta_1_));
}

BalanceDerivatives::OnePoint BalanceDerivatives::point(const Tire& tire, const SoilValues& soil,
                                                       const EffectList& effects, double theta_1, double x) const try {
  const RolledWheel wheel = RollingWheel(tire, soil, effects, bin_).at_entry_angle(at_, theta_1, nodes_);
  Point point{.x = x, .carried = wheel.forces.vertical};
  for (std::size_t i = 0; i < point.channels.size(); ++i) point.channels[i] = wheel.reading.*reading_members[i];
  return point;
} catch (const InputError&) {
  return std::nullopt;  // this soil carries nothing
} catch (const NoSolution&) {
  return std::nullopt;  // an effect would bury the wheel
} catch (const std::domain_error&) {
  return std::nullopt;
}

BalanceDerivatives::Point BalanceDerivatives::slopes(const OnePoint& below, const OnePoint& above) const {
  const OnePoint &low = below ? below : here_, &high = above ? above : here_;
  if (!low || !high) return {not_a_number, not_a_number, {not_a_number, not_a_number, not_a_number, not_a_number}};
  const double dx = high->x - low->x;
  Point slopes{.x = dx, .carried = (high->carried - low->carried) / dx};
  for (std::size_t i = 0; i < slopes.channels.size(); ++i)
    slopes.channels[i] = (high->channels[i] - low->channels[i]) / dx;
  return slopes;
}

BalanceDerivatives::Channels BalanceDerivatives::balanced(const OnePoint& below, const OnePoint& above) const {
  const Point direct = slopes(below, above);
  const double turn = -direct.carried / by_angle_.carried;  // d theta_1/dp
  Channels all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = direct.channels[i] + by_angle_.channels[i] * turn;
  return all;
}

BalanceDerivatives::Channels BalanceDerivatives::by(std::size_t parameter, double sd) const {
  const auto member = soil_members[parameter];
  const double x = soil_.*member;
  const Neighbours beside = neighbours(x, step_of(x, sd), soil_parameters[parameter].range);
  const auto with = [&](double value) {
    SoilValues soil = soil_;
    soil.*member = value;
    if (member == &SoilValues::exponent) {
      const double follows = modulus_factor(soil.reference_sinkage, x, value);
      soil.k_c *= follows, soil.k_phi *= follows;
    }
    return point(soil, effects_, theta_1_, value - x);
  };
  return balanced(with(beside.below), with(beside.above));
}

BalanceDerivatives::Channels BalanceDerivatives::by_carcass_pressure(double sd) const {
  const double x = tire_.carcass_pressure->value;
  const Neighbours beside = neighbours(x, step_of(x, sd), zero_or_more);
  const auto with = [&](double value) {
    Tire tire = tire_;
    tire.carcass_pressure->value = value;
    return point(tire, soil_, effects_, theta_1_, value - x);
  };
  return balanced(with(beside.below), with(beside.above));
}

BalanceDerivatives::Channels BalanceDerivatives::by(const std::vector<EffectChoice>& choices, std::size_t effect,
                                                    const std::string& parameter, double sd) const {
  const EffectParameter& described = find_parameter(find_form(choices[effect]), parameter);
  const auto given = choices[effect].parameters.find(parameter);
  const double x = given == choices[effect].parameters.end() ? described.fallback : given->second;
  const Neighbours beside = neighbours(x, step_of(x, sd), {.lower = described.lower, .upper = described.upper});
  const auto with = [&](double value) {
    EffectChoice moved = choices[effect];
    moved.parameters[parameter] = value;
    EffectList effects = effects_;
    effects[effect] = make_effect(moved);
    return point(soil_, effects, theta_1_, value - x);
  };
  return balanced(with(beside.below), with(beside.above));
}

ChannelErrors::ChannelErrors(const RolledWheel& balanced, const Scenario& scenario, const EffectList& effects)
    : scenario_(scenario) {
  const SemiEmpiricalSoil& declared = *scenario.soil.semi_empirical;
  const bool exact_soil =
      std::ranges::none_of(soil_parameters, [&](const auto& p) { return (declared.*p.value).std_error > 0.0; });
  if (exact_soil && scenario.errors.empty() && !errs_by_carcass(scenario.tire, scenario.effects)) return;
  const SoilValues soil = values_of(declared);
  const BalanceDerivatives derivatives(scenario.tire, soil, effects, scenario.bin, balanced.at, balanced.balance_angle);
  for (std::size_t p = 0; p < soil_parameters.size(); ++p)
    if (const double sd = (declared.*soil_parameters[p].value).std_error; sd > 0.0)
      add(soil_parameters[p].name, sd, derivatives.by(p, sd));
  if (errs_by_carcass(scenario.tire, scenario.effects)) {
    const double sd = scenario.tire.carcass_pressure->std_error;
    add(carcass_pressure_key, sd, derivatives.by_carcass_pressure(sd));
  }
  for (const FittedError& error : scenario.errors)
    if (const auto place = find_effect_parameter(error.parameter, scenario.effects); place && error.std_error > 0.0)
      add(error.parameter, *error.std_error,
          derivatives.by(scenario.effects, place->effect, place->parameter, *error.std_error));
  for (std::size_t a = 0; a < shifts_.size() && !scenario.errors.empty(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      correlations_.push_back(correlation(scenario.errors, shifts_[a].parameter, shifts_[b].parameter));
}

void ChannelErrors::add(const std::string& parameter, double sd, BalanceDerivatives::Channels slopes) {
  for (double& s : slopes) s *= sd;
  if (std::ranges::all_of(slopes, [](double s) { return std::isfinite(s * s); }))
    shifts_.push_back({parameter, slopes});
  else
    without_.push_back(parameter);
}

double ChannelErrors::of(const BalanceDerivatives::Channels& factors) const {
  std::vector<double> shifts;
  for (const Shift& shift : shifts_)
    shifts.push_back(std::inner_product(factors.begin(), factors.end(), shift.channels.begin(), 0.0));
  double variance = 0.0;
  for (const double shift : shifts) variance += shift * shift;
  auto r = correlations_.begin();
  for (std::size_t a = 0; a < shifts.size() && r != correlations_.end(); ++a)
    for (std::size_t b = 0; b < a; ++b) variance += 2 * *r++ * shifts[a] * shifts[b];
  double error = std::sqrt(std::max(0.0, variance));
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (scenario_.misfit[i] > 0.0) error = std::hypot(error, factors[i] * scenario_.misfit[i]);
  return error;
}

void add_standard_errors(TractionResult& result, const RolledWheel& balanced, const Scenario& scenario,
                         const EffectList& effects) {
  const ChannelErrors errors(balanced, scenario, effects);
  result.without_error_of = errors.without();
  for (std::size_t i = 0; i < traction_channels.size(); ++i) {
    BalanceDerivatives::Channels alone{};
    alone[i] = 1.0;
    (result.*traction_channels[i].predicted).std_error = errors.of(alone);
  }
}

}  // namespace soilbin::bekker_wong
