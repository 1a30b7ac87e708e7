// Standard errors of a balanced wheel's channels, from the standard deviations of the soil's parameters and of the
// tire's carcass pressure, and of the effects' where a fit found both.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/scenario.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::bekker_wong {

/// How a balanced wheel's channels change with the soil, by the implicit function theorem: where the load carried,
/// V(theta_1, p) = W, keeps theta_1 in balance, dr/dp = r_p - r_theta V_p/V_theta (subscripts: partial derivatives).
/// No soil but the declared one needs a balance, so the derivatives exist up to the largest load, where V_theta = 0.
///
/// Partial derivatives are central differences on the nodes of the balanced wheel; one-sided where the other side
/// passes a bound of the parameter or has no wheel. They agree with differences of balanced wheels to 1e-5
/// (standard_errors_test.cpp).
class BalanceDerivatives {
 public:
  using Channels = std::array<double, traction_channels.size()>;

  /// balance_angle: theta_1 of the wheel in balance [rad]. What is referred to must outlive this.
  BalanceDerivatives(const Tire& tire, const SoilValues& soil, const EffectList& effects, const std::optional<Bin>& bin,
                     const OperatingCondition& at, double balance_angle);

  /// By soil_parameters[parameter]; `sd`, its standard deviation, sets the step [SI]. Not finite where there is none.
  /// By n: with the pressure at the soil's reference sinkage held.
  Channels by(std::size_t parameter, double sd) const;
  /// By the carcass pressure of the tire, with its standard deviation [Pa].
  Channels by_carcass_pressure(double sd) const;
  /// Slopes by a parameter of choices[effect], the effects of which `effects` was made.
  Channels by(const std::vector<EffectChoice>& choices, std::size_t effect, const std::string& parameter,
              double sd) const;

 private:
  /// What a wheel carries and shows at one value of what is varied.
  struct Point {
    double x = 0.0;
    double carried = 0.0;
    Channels channels{};
  };
  using OnePoint = std::optional<Point>;

  OnePoint point(const SoilValues& soil, const EffectList& effects, double theta_1, double x) const {
    return point(tire_, soil, effects, theta_1, x);
  }
  OnePoint point(const Tire& tire, const SoilValues& soil, const EffectList& effects, double theta_1, double x) const;
  /// Slopes of the balanced channels, from points at the balanced theta_1 on both sides.
  Channels balanced(const OnePoint& below, const OnePoint& above) const;
  /// Slopes over x, in place of values; one-sided where a point is missing, not a number without both.
  Point slopes(const OnePoint& below, const OnePoint& above) const;

  const Tire& tire_;
  const SoilValues& soil_;
  const EffectList& effects_;
  const std::optional<Bin>& bin_;
  const OperatingCondition& at_;
  double theta_1_;
  NodeLayout nodes_;
  OnePoint here_;
  Point by_angle_;
};

/// How a balanced wheel's channels err, to first order: by the parameters that have a standard deviation, of the soil,
/// the carcass and the effects, with their correlations, which are none but for what scenario.errors says of a fit.
class ChannelErrors {
 public:
  /// What is referred to must outlive this.
  ChannelErrors(const RolledWheel& balanced, const Scenario& scenario, const EffectList& effects);

  /// Of the sum of the channels, each times its factor: the root of g'C g, with g its slopes over the parameters and C
  /// their covariance, and of the misfits' squares.
  double of(const BalanceDerivatives::Channels& factors) const;

  /// Each parameter whose derivative does not exist; `of` leaves it out.
  const std::vector<std::string>& without() const { return without_; }

 private:
  /// What a parameter's standard deviation does to the channels.
  struct Shift {
    std::string parameter{};
    BalanceDerivatives::Channels channels{};  ///< sd dr/dp
  };
  void add(const std::string& parameter, double sd, BalanceDerivatives::Channels slopes);

  std::vector<Shift> shifts_;
  std::vector<double> correlations_;  ///< of each shift with those before it, pair by pair; empty: there are none
  std::vector<std::string> without_;
  const Scenario& scenario_;
};

/// Sets the channels' standard errors and names in without_error_of what they leave out.
void add_standard_errors(TractionResult& result, const RolledWheel& balanced, const Scenario& scenario,
                         const EffectList& effects);

}  // namespace soilbin::bekker_wong
