#include "bekker_wong/standard_errors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bekker_wong/model.hpp"
#include "scenario/errors.hpp"
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
      here_(point(soil, theta_1_, 0.0)) {
  const auto turned = [&](double by) { return point(soil_, theta_1_ + by, by); };
  by_angle_ = slopes(turned(-angle_step * theta_1_), turned(angle_step * theta_1_));
}

BalanceDerivatives::OnePoint BalanceDerivatives::point(const SoilValues& soil, double theta_1, double x) const try {
  const RolledWheel wheel = RollingWheel(tire_, soil, effects_, bin_).at_entry_angle(at_, theta_1, nodes_);
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

BalanceDerivatives::Channels BalanceDerivatives::by(std::size_t parameter, double sd) const {
  const auto member = soil_members[parameter];
  const double x = soil_.*member;
  const Neighbours beside = neighbours(x, step_of(x, sd), soil_parameters[parameter].range);
  const auto with = [&](double value) {
    SoilValues soil = soil_;
    soil.*member = value;
    return point(soil, theta_1_, value - x);
  };
  const Point direct = slopes(with(beside.below), with(beside.above));
  const double turn = -direct.carried / by_angle_.carried;  // d theta_1/dp
  Channels all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = direct.channels[i] + by_angle_.channels[i] * turn;
  return all;
}

void add_standard_errors(TractionResult& result, const RolledWheel& balanced, const Scenario& scenario,
                         const EffectList& effects) {
  const SemiEmpiricalSoil& declared = *scenario.soil.semi_empirical;
  const auto sd_of = [&](const SoilParameter& p) { return (declared.*p.value).std_error; };
  if (std::none_of(soil_parameters.begin(), soil_parameters.end(), [&](const auto& p) { return sd_of(p) > 0.0; }))
    return;
  const SoilValues soil = values_of(declared);
  const BalanceDerivatives derivatives(scenario.tire, soil, effects, scenario.bin, balanced.at, balanced.balance_angle);
  std::array<double, traction_channels.size()> variance{};
  for (std::size_t p = 0; p < soil_parameters.size(); ++p) {
    const double sd = sd_of(soil_parameters[p]);
    if (!(sd > 0.0)) continue;
    const auto slope = derivatives.by(p, sd);
    if (!std::all_of(slope.begin(), slope.end(), [&](double s) { return std::isfinite(sd * s * sd * s); })) {
      result.without_error_of.emplace_back(soil_parameters[p].name);
      continue;
    }
    for (std::size_t i = 0; i < variance.size(); ++i) variance[i] += sd * slope[i] * sd * slope[i];
  }
  for (std::size_t i = 0; i < variance.size(); ++i)
    (result.*traction_channels[i].predicted).std_error = std::sqrt(variance[i]);
}

}  // namespace soilbin::bekker_wong
