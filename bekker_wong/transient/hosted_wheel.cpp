#include "bekker_wong/transient/hosted_wheel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bekker_wong/transient/cvodes.hpp"
#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {
namespace {

/// What is integrated; the nodes of the shear displacement follow.
enum HostedPlace : std::size_t { hosted_x, hosted_depth, hosted_rolled, first_hosted_node };

Drive with_any_motor(Drive drive) {
  if (!drive.controller.rim_speed && !drive.controller.torque) drive.controller.rim_speed = 1.0;
  if (drive.duration <= 0.0) drive.duration = 1.0;
  return drive;
}

}  // namespace

struct HostedWheel::Body {
  Body(const Scenario& scenario, const Drive& asked, const DriveNumerics& numerics)
      : load(asked.load), wheel(scenario, with_any_motor(asked), numerics) {
    std::vector<double> state(wheel.state_size(), 0.0);
    wheel.rest(wheel.way().at(0.0), load, 0.0, state);
    std::vector<double> y(first_hosted_node + state.size() - first_node, 0.0);
    y[hosted_depth] = motion.depth = state[bekker_wong::depth];
    const std::vector<double> scale = wheel.tolerances(numerics.relative_tolerance);
    sundials::Problem p;
    p.rate = [this](double, auto at, auto out) { rate(at, out); };
    p.roots = [](double, auto at, auto out) { out[0] = at[hosted_rolled] - turns_at; };
    p.root_count = 1;
    p.summands = [this](double, auto at, auto out) { out[0] = power(at); };
    p.sum_count = 1;
    p.relative_tolerance = numerics.relative_tolerance;
    p.absolute_tolerances = {scale[travelled], scale[bekker_wong::depth], scale[rolled]};
    p.absolute_tolerances.insert(p.absolute_tolerances.end(), scale.begin() + first_node, scale.end());
    p.sum_tolerance = numerics.relative_tolerance * load * wheel.radius();
    integrator.emplace(std::move(p), 0.0, std::move(y));
  }

  Instant look(std::span<const double> y, std::span<double> node_rate) const {
    Place place = wheel.way().at(y[hosted_x]);
    place.longitudinal_incline *= heading;
    std::vector<double> state(wheel.state_size(), 0.0);
    state[travelled] = y[hosted_x], state[speed] = heading * motion.speed, state[spin] = heading * motion.spin;
    state[bekker_wong::depth] = y[hosted_depth], state[sinking] = heave, state[rolled] = y[hosted_rolled];
    std::ranges::copy(y.subspan(first_hosted_node), state.begin() + first_node);
    Instant now = wheel.touch(place, load, state, node_rate);
    now.forward *= heading, now.soil_torque *= heading;
    return now;
  }
  void rate(std::span<const double> y, std::span<double> out) const {
    look(y, out.subspan(first_hosted_node));
    out[hosted_x] = motion.speed, out[hosted_depth] = heave;
    out[hosted_rolled] = wheel.rolled_rate(heading * motion.speed, y[hosted_rolled]);
  }
  double power(std::span<const double> y) const {
    std::vector<double> rates(y.size());
    const Instant now = look(y, std::span(rates).subspan(first_hosted_node));
    return now.compaction + now.shear + now.added + now.damping;
  }

  static constexpr double turns_at = -0.9;  // three lengths of rolling-in, as of a vehicle's wheels
  double load;
  DrivenWheel wheel;
  HostedMotion motion;
  double heave = 0.0, heading = 1.0, time = 0.0;
  std::optional<sundials::Integrator> integrator;
};

HostedWheel::HostedWheel(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics)
    : body_(std::make_unique<Body>(scenario, drive, numerics)) {}
HostedWheel::~HostedWheel() = default;

Instant HostedWheel::advance(double step, const HostedMotion& reached) {
  Body& b = *body_;
  if (!(step > 0.0 && std::isfinite(step))) throw InputError("a step of a hosted wheel is longer than 0 s");
  for (const double one : {reached.speed, reached.spin, reached.depth})
    if (!std::isfinite(one)) throw InputError("the motion of a hosted wheel is a number throughout");
  if (reached.depth > max_sinkage_share * b.wheel.radius())
    throw InputError("a hosted wheel is deeper than the model answers for: 0.9 of its radius");
  b.heave = (reached.depth - depth()) / step, b.motion = reached;
  b.integrator->restart();
  const double until = b.time + step;
  while (b.time < until) {
    const sundials::Stop stop = b.integrator->advance(until);
    b.time = stop.time;
    if (!stop.at_root() || stop.signs[0] > 0) continue;
    std::vector<double> y = b.integrator->state();
    turn_about(y[hosted_rolled], std::span(y).subspan(first_hosted_node));
    b.heading = -b.heading;
    b.integrator->restart(y);
  }
  const std::vector<double>& y = b.integrator->state();
  std::vector<double> rates(y.size());
  return b.look(y, std::span(rates).subspan(first_hosted_node));
}

double HostedWheel::depth() const { return body_->integrator->state()[hosted_depth]; }
double HostedWheel::given_to_soil() const { return body_->integrator->sums()[0]; }
bool HostedWheel::turned_about() const { return body_->heading < 0.0; }

}  // namespace soilbin::bekker_wong
