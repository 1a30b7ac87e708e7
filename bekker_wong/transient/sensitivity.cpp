#include "bekker_wong/transient/sensitivity.hpp"

#include "bekker_wong/transient/cvodes.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double nudge = 1e-4;  // relative, of a soil value: the stress integrals are smooth to 2e-9

Scenario nudged(const Scenario& scenario, const SoilParameter& parameter, double share) {
  Scenario changed = scenario;
  ((*changed.soil.semi_empirical).*parameter.value).value *= 1 + share;
  return changed;
}

/// A wheel at rest on a soil, ready to be driven.
struct Ready {
  Ready(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics)
      : wheel(scenario, drive, numerics), held(wheel.hold()), motor(wheel.motor(held.torque)) {}
  std::vector<double> rate(double t, std::span<const double> y) const {
    std::vector<double> out(wheel.state_size());
    wheel.rate(t, y, motor, out);
    return out;
  }
  DrivenWheel wheel;
  Held held;
  Motor motor;
};

/// The same drive with one value a little larger and a little smaller.
struct Pair {
  Ready up, down;
  double step;  ///< of the value [SI]
};

/// d(rate)/dp along dy/dp.
void along(const Pair& pair, double t, std::span<const double> y, std::span<const double> s, std::span<double> sdot) {
  std::vector<double> above(y.begin(), y.end()), below(y.begin(), y.end());
  for (std::size_t k = 0; k < y.size(); ++k) above[k] += pair.step * s[k], below[k] -= pair.step * s[k];
  const std::vector<double> up = pair.up.rate(t, above), down = pair.down.rate(t, below);
  for (std::size_t k = 0; k < y.size(); ++k) sdot[k] = (up[k] - down[k]) / (2 * pair.step);
}

double travelled_by(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics) {
  const Ready ready(scenario, drive, numerics);
  sundials::Problem p;
  p.rate = [&](double t, auto y, auto out) { ready.wheel.rate(t, y, ready.motor, out); };
  p.relative_tolerance = numerics.relative_tolerance;
  p.absolute_tolerances = ready.wheel.tolerances(numerics.relative_tolerance);
  sundials::Integrator integrator(std::move(p), 0.0, ready.held.state);
  integrator.advance(drive.duration);
  return integrator.state()[travelled];
}

}  // namespace

TravelSensitivity travel_sensitivity(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics) {
  const Ready ready(scenario, drive, numerics);
  std::vector<Pair> pairs;
  sundials::Problem p;
  for (const SoilParameter& parameter : drive_parameters) {
    const double value = ((*scenario.soil.semi_empirical).*parameter.value).value;
    pairs.push_back({Ready(nudged(scenario, parameter, nudge), drive, numerics),
                     Ready(nudged(scenario, parameter, -nudge), drive, numerics), nudge * value});
    const Pair& pair = pairs.back();
    std::vector<double> start(pair.up.held.state);
    for (std::size_t k = 0; k < start.size(); ++k) start[k] = (start[k] - pair.down.held.state[k]) / (2 * pair.step);
    p.parameter_scales.push_back(value);
    p.sensitivity_starts.push_back(std::move(start));
  }
  p.rate = [&](double t, auto y, auto out) { ready.wheel.rate(t, y, ready.motor, out); };
  p.sensitivity = [&](int i, double t, auto y, auto, auto s, auto sdot) {
    along(pairs[static_cast<std::size_t>(i)], t, y, s, sdot);
  };
  p.relative_tolerance = numerics.relative_tolerance;
  p.absolute_tolerances = ready.wheel.tolerances(numerics.relative_tolerance);
  sundials::Integrator integrator(std::move(p), 0.0, ready.held.state);
  integrator.advance(drive.duration);
  TravelSensitivity result{integrator.state()[travelled], {}};
  for (std::size_t i = 0; i < pairs.size(); ++i)
    result.by_value[i] = integrator.sensitivity(static_cast<int>(i))[travelled];
  return result;
}

TravelSensitivity travel_differences(const Scenario& scenario, const Drive& drive, double step,
                                     const DriveNumerics& numerics) {
  TravelSensitivity result{travelled_by(scenario, drive, numerics), {}};
  for (std::size_t i = 0; i < drive_parameters.size(); ++i) {
    const SoilParameter& parameter = drive_parameters[i];
    const double value = ((*scenario.soil.semi_empirical).*parameter.value).value;
    const double up = travelled_by(nudged(scenario, parameter, step), drive, numerics);
    const double down = travelled_by(nudged(scenario, parameter, -step), drive, numerics);
    result.by_value[i] = (up - down) / (2 * step * value);
  }
  return result;
}

}  // namespace soilbin::bekker_wong
