#include "bekker_wong/transient/driven_wheel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/transient/shear_line.hpp"
#include "scenario/drive_record.hpp"
#include "scenario/errors.hpp"
#include "scenario/number_check.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double rolling_in_share = 0.2;  // of the contact's length, see Drive's page: the elastic part of the sinkage
constexpr double floor_share = 0.02;      // of the depth at rest: below it the contact fades
constexpr double deepest = 0.95;          // of the radius: the equations end there

/// A hint at a form of the same effect that holds in time; "" where there is none.
std::string in_another_form(const EffectForm& form) {
  for (const EffectForm& other : effect_catalogue())
    if (other.id == form.id && other.steady_only.empty())
      return fmt::format("\n  hint: write {{id: {}, form: {}}}", other.id, other.form);
  return "";
}

EffectList time_effects(const std::vector<EffectChoice>& choices) {
  for (const EffectChoice& choice : choices) {
    const EffectForm& form = find_form(choice);
    if (!form.steady_only.empty())
      throw InputError(fmt::format("a wheel driven in time can't take the effect {} ({}): {}{}", form.id, form.form,
                                   form.steady_only, in_another_form(form)));
  }
  return make_effects(choices);
}

SoilValues soil_values(const Soil& soil) {
  if (!soil.semi_empirical)
    throw InputError("soil '" + soil.name + "' has no semi_empirical values, which a drive needs");
  return values_of(*soil.semi_empirical);
}

double entry_angle(double z, double radius) {
  return 2 * std::asin(std::sqrt(std::clamp(z / (2 * radius), 0.0, deepest / 2)));
}

}  // namespace

struct DrivenWheel::Push {
  double forward = 0.0, left = 0.0, upward = 0.0, torque = 0.0;
  double compaction = 0.0, shear = 0.0, added = 0.0;

  /// What the contact gives where the share `s` of it lies on the other soil.
  void blend(const Push& other, double s) {
    for (auto member :
         {&Push::forward, &Push::left, &Push::upward, &Push::torque, &Push::compaction, &Push::shear, &Push::added})
      this->*member += s * (other.*member - this->*member);
  }
};

DrivenWheel::DrivenWheel(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics)
    : tire_(scenario.tire),
      drive_(drive),
      way_(drive.profile, scenario.tire.radius),
      nodes_(numerics.nodes),
      turns_(way_.turns()),
      mass_(mass_of(drive, soil_values(scenario.soil).gravity)),
      inertia_(inertia_of(drive, scenario.tire.radius, soil_values(scenario.soil).gravity)) {
  if (nodes_ < 6) throw InputError("the shear displacement needs at least 6 nodes along the contact");
  check_numbers(drive_);
  if (!scenario.effects.empty()) throw InputError("a drive's effects are those of Drive::effects, not of its scenario");
  const EffectList effects = time_effects(drive.effects);
  std::vector<SoilValues> soils = {soil_values(scenario.soil)};
  for (const Soil& soil : way_.soils()) {
    if (gravity_of(soil) != gravity_of(scenario.soil))
      throw InputError("soil '" + soil.name + "' lies under another gravity than the case's soil");
    soils.push_back(soil_values(soil));
  }
  const OperatingCondition at = condition(way_.at(0.0), 0.0, 0.0, 0.0);
  for (const SoilValues& soil : soils) {
    RollingWheel wheel(tire_, soil, effects, scenario.bin);
    const Outline outline = wheel.outline(at);
    soils_.push_back({std::move(wheel), outline});
  }
  std::vector<double> state(state_size(), 0.0);
  const double z = held_depth(state), entry = entry_angle(z, tire_.radius);
  floor_ = floor_share * z;
  rolling_in_ = rolling_in_share * tire_.radius * entry;
  const SoilValues& soil = soils[way_.at(0.0).soil];
  const double strength =
      drive_.load * std::tan(soil.friction_angle) + soil.cohesion * tire_.width * tire_.radius * entry;
  if (strength > 0.0) shear_time_ = 2 * drive_.damping * std::sqrt(mass_ * soil.shear_modulus / strength);
  const double stiffness = (soil.exponent + 0.5) * drive_.load / z;  // dF_z/dz of a load that grows as z^(n + 1/2)
  heave_damping_ = 2 * drive_.damping * std::sqrt(mass_ * stiffness);
}

std::size_t DrivenWheel::state_size() const { return first_node + static_cast<std::size_t>(nodes_) * (turns_ ? 2 : 1); }

std::vector<double> DrivenWheel::tolerances(double relative) const {
  const double r = tire_.radius, rim = drive_.controller.rim_speed.value_or(0.1);
  std::vector<double> scale(state_size(), soils_[way_.at(0.0).soil].wheel.soil().shear_modulus);
  scale[travelled] = r, scale[speed] = rim, scale[depth] = 0.1 * r, scale[sinking] = rim, scale[turned] = 1.0;
  scale[spin] = rim / r, scale[rolled] = 1.0, scale[mean_speed] = rim, scale[speed_error] = 0.1;
  for (double& s : scale) s *= relative;
  return scale;
}

Motor DrivenWheel::motor(double hold_torque) const {
  return {drive_.controller, tire_.radius, inertia_ + mass_ * tire_.radius * tire_.radius, hold_torque};
}

OperatingCondition DrivenWheel::condition(const Place& place, double slip, double v, double x) const {
  OperatingCondition at;
  at.load = drive_.load;
  at.slip = slip;
  at.speed = std::abs(v);
  at.longitudinal_incline = place.longitudinal_incline;
  at.transverse_incline = place.transverse_incline;
  at.yaw = place.yaw;
  at.pass = drive_.pass;
  at.position = x;
  return at;
}

std::span<const double> DrivenWheel::line(std::span<const double> nodes, int across) const {
  const auto n = static_cast<std::size_t>(nodes_);
  return nodes.subspan(static_cast<std::size_t>(across) * n, n);
}

DrivenWheel::Span DrivenWheel::contact_span(const OnSoil& on, double z, double z_rate) const {
  const double r = tire_.radius, held = std::max(z, floor_);
  const OperatingCondition any = condition({}, 0.0, 0.0, 0.0);
  Span span;
  span.entry = entry_angle(held, r);
  span.exit = on.wheel.angles(any, span.entry).exit;
  span.grip = floor_ > 0.0 ? std::clamp(z / floor_, 0.0, 1.0) : 1.0;
  if (z <= floor_) return span;
  constexpr double nudge = 1e-6;
  const double exit_slope = (on.wheel.angles(any, span.entry * (1 + nudge)).exit - span.exit) / (span.entry * nudge);
  span.entry_rate = z_rate / (r * std::sin(span.entry));
  span.exit_rate = exit_slope * span.entry_rate;
  return span;
}

/// The v/(r w) of a steady wheel with this j at the exit, as a slip.
double DrivenWheel::slip_in_contact(const OnSoil& on, const Span& span, std::span<const double> state) const {
  const double at_exit = state[first_node + static_cast<std::size_t>(nodes_) - 1];
  const double ratio = (on.outline.shear_radius * span.length() - at_exit) /
                       (on.outline.slip_radius * (std::sin(span.entry) - std::sin(span.exit)));
  constexpr double highest = 1e3;  // a wheel that is dragged: all but locked
  const double held = std::clamp(ratio, 0.0, highest);
  return held <= 1.0 ? 1 - held : 1 / held - 1;
}

void DrivenWheel::node_rates(const OnSoil& on, const Span& span, const Place& place, std::span<const double> state,
                             std::span<double> out) const {
  const double scale = on.outline.slip_radius / tire_.radius, v = state[speed];
  const double along = v * std::cos(place.yaw), across = v * std::sin(place.yaw);
  const std::span<const double> nodes = state.subspan(first_node);
  for (int i = 0; i < nodes_; ++i) {
    const double u = static_cast<double>(i + 1) / nodes_, theta = span.entry - u * span.length();
    const double stream = (state[spin] + span.entry_rate - u * (span.entry_rate - span.exit_rate)) / span.length();
    const double sliding =
        on.outline.shear_radius * state[spin] + scale * (state[sinking] * std::sin(theta) - along * std::cos(theta));
    const auto k = static_cast<std::size_t>(i);
    out[k] = span.grip * sliding - stream * slope_at(line(nodes, 0), i, stream >= 0.0);
    if (!turns_) continue;
    const std::size_t y = k + static_cast<std::size_t>(nodes_);
    out[y] = span.grip * scale * across - stream * slope_at(line(nodes, 1), i, stream >= 0.0);
  }
}

DrivenWheel::Push DrivenWheel::push(const OnSoil& on, const Span& span, const OperatingCondition& at,
                                    std::span<const double> state, std::span<const double> j) const {
  ContactPatch patch;
  const WheelForces f = on.wheel.hold(
      at, span.entry,
      [&](ContactPatch& p, const Outline&) {
        const double length = p.angles.entry - p.angles.exit;
        for (int i = 0; i < p.count; ++i) {
          p.j_x[i] = value_at(line(j, 0), p.since_entry[i] / length);
          p.j_y[i] = turns_ ? value_at(line(j, 1), p.since_entry[i] / length) : 0.0;
        }
      },
      patch);
  const double b = tire_.width, e = state[rolled], v = state[speed], w = state[spin], dz = state[sinking];
  const double along = v * std::cos(at.yaw), across = v * std::sin(at.yaw);
  Push p;
  double forward = f.thrust + e * f.compaction, left = f.side;
  for (const AddedForce& added : f.added.rows()) {
    // What resists travel needs travel; what the rim pushes with does not.
    const double share = added.torque == 0.0 && added.vertical == 0.0 ? e : 1.0;
    forward += share * added.forward, left += share * added.lateral;
    p.added += added.torque * w - share * (added.forward * along - added.lateral * across) + added.vertical * dz;
  }
  for (int i = 0; i < patch.count; ++i) {
    const double s = patch.normal_sine[i], c = patch.normal_cosine[i];
    p.compaction += b * patch.arc[i] * patch.sigma[i] * (e * along * s + dz * c);
    p.shear += b * patch.arc[i] * (patch.tau_x[i] * (patch.arm[i] * w - along * c + dz * s) + patch.tau_y[i] * across);
  }
  const double c = std::cos(at.yaw), s = std::sin(at.yaw);
  p.forward = forward * c - left * s, p.left = forward * s + left * c;
  p.upward = f.vertical, p.torque = f.torque;
  return p;
}

DrivenWheel::Push DrivenWheel::push(const Place& place, const Span& span, const OperatingCondition& at,
                                    std::span<const double> state, std::span<const double> effective_j) const {
  Push p = push(soils_[place.soil], span, at, state, effective_j);
  for (std::size_t i = place.soil + 1; i <= place.last_soil; ++i) {
    const OnSoil& next = soils_[i];
    p.blend(push(next, contact_span(next, state[depth], state[sinking]), at, state, effective_j),
            way_.share(i, state[travelled]));
  }
  return p;
}

Instant DrivenWheel::assemble(double time, std::span<const double> state, const Motor& motor,
                              std::span<double> node_rate) const {
  Instant now;
  now.place = way_.at(state[travelled]);
  const OnSoil& on = soils_[now.place.soil];
  const Span span = contact_span(on, state[depth], state[sinking]);
  node_rates(on, span, now.place, state, node_rate);
  now.contact_slip = slip_in_contact(on, span, state);
  const OperatingCondition at = condition(now.place, now.contact_slip, state[speed], state[travelled]);
  // Shear is damped by looking ahead along dj/dt, which is 0 where the wheel's motion is steady.
  std::vector<double> ahead(node_rate.size());
  for (std::size_t k = 0; k < ahead.size(); ++k) ahead[k] = state[first_node + k] + shear_time_ * node_rate[k];
  const Push p = push(now.place, span, at, state, ahead);
  const double g = span.grip;
  const double damping = std::max(g * heave_damping_ * state[sinking], -g * p.upward);  // soil doesn't pull
  now.motor_torque = motor.torque(time, state[spin], state[speed_error]);
  now.soil_torque = g * p.torque, now.forward = g * p.forward, now.left = g * p.left;
  now.upward = g * p.upward + damping;
  now.compaction = g * p.compaction, now.shear = g * p.shear, now.added = g * p.added;
  now.damping = damping * state[sinking];
  return now;
}

Instant DrivenWheel::look(double time, std::span<const double> state, const Motor& motor) const {
  std::vector<double> node_rate(state_size() - first_node);
  return assemble(time, state, motor, node_rate);
}

void DrivenWheel::rate(double time, std::span<const double> state, const Motor& motor, std::span<double> out) const {
  const Instant now = assemble(time, state, motor, out.subspan(first_node));
  const double v = state[speed], dz = state[sinking], alpha = now.place.longitudinal_incline;
  const double normal_load = drive_.load * std::cos(alpha) * std::cos(now.place.transverse_incline);
  const double turning = mass_ * now.place.curvature * v;  // the ground's axes turn with the slope: forces without work
  out[travelled] = v;
  out[speed] = (now.forward - drive_.load * std::sin(alpha) - now.place.drawbar - turning * dz) / mass_;
  out[depth] = dz;
  out[sinking] = (normal_load + turning * v - now.upward) / mass_;
  out[turned] = state[spin];
  out[spin] = (now.motor_torque - now.soil_torque) / inertia_;
  out[rolled] = (v - std::abs(v) * state[rolled]) / rolling_in_;
  out[mean_speed] = time < drive_.controller.ramp ? 0.0 : (v - state[mean_speed]) / drive_limits::memory;
  out[speed_error] = motor.integral_rate(time, state[spin], state[speed_error]);
}

/// The push on a wheel that does not move, at the start.
DrivenWheel::Push DrivenWheel::push_at_rest(const Place& start, std::span<const double> state) const {
  const OnSoil& on = soils_[start.soil];
  const Span span = contact_span(on, state[depth], 0.0);
  const double slip = slip_in_contact(on, span, state);
  return push(start, span, condition(start, slip, 0.0, 0.0), state, state.subspan(first_node));
}

/// Depth at which the soil carries the load with the shear that the state holds; the state gets it.
double DrivenWheel::held_depth(std::vector<double>& state) const {
  const Place start = way_.at(0.0);
  const double load = drive_.load * std::cos(start.longitudinal_incline) * std::cos(start.transverse_incline);
  const auto carried = [&](double z) {
    state[depth] = z;
    return push_at_rest(start, state).upward - load;
  };
  const double low = 1e-9 * tire_.radius, high = max_sinkage_share * tire_.radius;
  if (carried(high) < 0.0)
    throw NoSolution(
        fmt::format("the wheel sinks deeper than {} of its radius before it is driven", max_sinkage_share));
  state[depth] = gsl::bracketed_root(carried, low, high, 1e-13, 1e-11 * load, "the depth of the wheel at rest");
  return state[depth];
}

/// A wheel that has slid back by `displacement` before it was held; nothing at the very entry.
void DrivenWheel::lay_held_shear(std::vector<double>& state, double displacement) const {
  for (int i = 0; i < nodes_; ++i) {
    const double u = static_cast<double>(i + 1) / nodes_;
    state[first_node + static_cast<std::size_t>(i)] = displacement * (1 - std::pow(1 - u, 8));
  }
}

Held DrivenWheel::hold() const {
  Held held{std::vector<double>(state_size(), 0.0), 0.0};
  std::vector<double>& state = held.state;
  state[mean_speed] = drive_limits::first_speed * drive_.stuck_speed;
  const Place start = way_.at(0.0);
  const double pull = drive_.load * std::sin(start.longitudinal_incline) + start.drawbar;
  Push p;
  const auto spare = [&](double displacement) {
    lay_held_shear(state, displacement);
    held_depth(state);
    p = push_at_rest(start, state);
    return p.forward - pull;
  };
  if (pull == 0.0) {
    spare(0.0);
    return held;
  }
  const double modulus = std::copysign(soils_[start.soil].wheel.soil().shear_modulus, pull);
  constexpr double most = 32.0;
  double share = 0.25;
  while (spare(share * modulus) * pull < 0.0)
    if ((share *= 2) > most)
      throw NoSolution(
          fmt::format("the soil can't hold the wheel at rest: {:.4g} N pull it {}, the soil's shear holds {:.4g} N",
                      std::abs(pull), pull > 0.0 ? "back" : "forward", std::abs(p.forward)));
  const double far = share * modulus;
  const double root = gsl::bracketed_root(spare, std::min(0.0, far), std::max(0.0, far), 1e-12, 1e-10 * std::abs(pull),
                                          "the shear that holds the wheel at rest");
  spare(root);
  held.torque = p.torque;
  return held;
}

}  // namespace soilbin::bekker_wong
