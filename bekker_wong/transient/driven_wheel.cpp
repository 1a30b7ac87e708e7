#include "bekker_wong/transient/driven_wheel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
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

/// dS/dd of a tread S(d) whose normal has this sine and cosine where the circle has theta.
double give_at(double theta, double sine, double cosine) {
  const double circle = std::sin(theta);
  return circle == 0.0 ? 1.0 : sine * std::cos(theta) / (cosine * circle);
}

bool flattens(const RollingWheel& wheel, const OperatingCondition& at) {
  ContactPatch patch;
  wheel.tread(at, entry_angle(deepest * wheel.tire().radius, wheel.tire().radius), {}, patch);
  return patch.deflection > 0.0;
}

}  // namespace

struct DrivenWheel::Tread {
  std::vector<double> travel;                               ///< of the belt since the entry, over r [rad]
  std::vector<double> stretch, normal_sine, normal_cosine;  ///< arc length over the circle's; the normal's angle
  std::vector<double> give;                                 ///< how fast it goes down, over the circle's speed
};

/// The belt's travel has corners where a carcass flattens, and j = R travel - the way over the ground has them too:
/// differences and cubics are taken of the rest. A circle's travel has none.
struct DrivenWheel::Cornered {
  std::array<double, 2> shares = {0.0, 0.0};  ///< of the travel in j along the wheel and across it [m]
  std::vector<double> rest;

  /// rolling: 0 of a wheel at rest, under which j has no corners, 1 of one that rolls.
  Cornered(const OnSoil& on, const Tread& rim, std::span<const double> j, double rolling) : rest(j.begin(), j.end()) {
    if (!on.flexes) return;
    const std::size_t n = rim.travel.size();
    shares[0] = std::clamp(rolling, 0.0, 1.0) * on.outline.shear_radius;
    if (j.size() > n) shares[1] = j.back() / rim.travel.back();
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= shares[k / n] * rim.travel[k % n];
  }
  double share(int across) const { return shares[static_cast<std::size_t>(across)]; }
};

struct DrivenWheel::Contact {
  Span span;
  Tread tread;
  double slip = 0.0;
};

struct DrivenWheel::Push {
  double forward = 0.0, left = 0.0, upward = 0.0, torque = 0.0;
  double compaction = 0.0, shear = 0.0, added = 0.0, carcass = 0.0, deflection = 0.0;

  /// What the contact gives where the share `s` of it lies on the other soil.
  void blend(const Push& other, double s) {
    for (auto member : {&Push::forward, &Push::left, &Push::upward, &Push::torque, &Push::compaction, &Push::shear,
                        &Push::added, &Push::carcass, &Push::deflection})
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
  const OperatingCondition at = condition(way_.at(0.0), drive_.load, 0.0, 0.0, 0.0);
  for (const SoilValues& soil : soils) {
    RollingWheel wheel(tire_, soil, effects, scenario.bin);
    const Outline outline = wheel.outline(at);
    const bool flexes = flattens(wheel, at);
    soils_.push_back({std::move(wheel), outline, flexes});
  }
  std::vector<double> state(state_size(), 0.0);
  const double z = held_depth(way_.at(0.0), drive_.load, state), entry = entry_angle(z, tire_.radius);
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

OperatingCondition DrivenWheel::condition(const Place& place, double load, double slip, double v, double x) const {
  OperatingCondition at;
  at.load = load;
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

DrivenWheel::Span DrivenWheel::contact_span(const OnSoil& on, double z, double z_rate,
                                            const OperatingCondition& at) const {
  const double r = tire_.radius, held = std::max(z, floor_);
  const OperatingCondition any = on.flexes ? at : condition({}, at.load, 0.0, 0.0, 0.0);
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

DrivenWheel::Tread DrivenWheel::tread(const OnSoil& on, const Span& span, const OperatingCondition& at) const {
  const auto n = static_cast<std::size_t>(nodes_);
  Tread t{std::vector<double>(n), std::vector<double>(n, 1.0), std::vector<double>(n), std::vector<double>(n), {}};
  t.give = t.stretch;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = static_cast<double>(k + 1) / nodes_, theta = span.entry - u * span.length();
    t.travel[k] = u * span.length(), t.normal_sine[k] = std::sin(theta), t.normal_cosine[k] = std::cos(theta);
  }
  if (!on.flexes) return t;
  ContactPatch patch;
  on.wheel.tread(at, span.entry, t.travel, patch);
  for (std::size_t k = 0; k < n; ++k) {
    t.travel[k] = patch.since_entry[k], t.stretch[k] = patch.arc[k] / on.outline.radius;
    t.normal_sine[k] = patch.normal_sine[k], t.normal_cosine[k] = patch.normal_cosine[k];
    t.give[k] = give_at(patch.theta[k], patch.normal_sine[k], patch.normal_cosine[k]);
  }
  return t;
}

/// A carcass gives way to the soil that acts, and what acts may depend on the slip: both are found in turn.
DrivenWheel::Contact DrivenWheel::contact(const OnSoil& on, const Place& place, double load,
                                          std::span<const double> state) const {
  constexpr int most_rounds = 8;
  Contact c;
  for (int round = 0; round < most_rounds; ++round) {
    const OperatingCondition at = condition(place, load, c.slip, state[speed], state[travelled]);
    const Span span = contact_span(on, state[depth], state[sinking], at);
    if (round > 0 && span.exit == c.span.exit) break;
    c.span = span, c.tread = tread(on, span, at);
    c.slip = slip_in_contact(on, span, c.tread, state);
    if (!on.flexes) break;
  }
  return c;
}

/// The v/(r w) of a steady wheel with this j at the exit, as a slip.
double DrivenWheel::slip_in_contact(const OnSoil& on, const Span& span, const Tread& tread,
                                    std::span<const double> state) const {
  const double at_exit = state[first_node + static_cast<std::size_t>(nodes_) - 1];
  const double ratio = (on.outline.shear_radius * tread.travel.back() - at_exit) /
                       (on.outline.slip_radius * (std::sin(span.entry) - std::sin(span.exit)));
  constexpr double highest = 1e3;  // a wheel that is dragged: all but locked
  const double held = std::clamp(ratio, 0.0, highest);
  return held <= 1.0 ? 1 - held : 1 / held - 1;
}

void DrivenWheel::node_rates(const OnSoil& on, const Contact& contact, const Place& place,
                             std::span<const double> state, std::span<double> out) const {
  const Span& span = contact.span;
  const Tread& rim = contact.tread;
  const double scale = on.outline.slip_radius / tire_.radius, v = state[speed];
  const double along = v * std::cos(place.yaw), across = v * std::sin(place.yaw);
  const std::span<const double> nodes = state.subspan(first_node);
  const Cornered j(on, rim, nodes, 1.0);
  const auto slope = [&](int across_it, int i, bool with_stream) {
    return j.share(across_it) * rim.stretch[static_cast<std::size_t>(i)] * span.length() +
           slope_at(line(j.rest, across_it), i, with_stream);
  };
  for (int i = 0; i < nodes_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double u = static_cast<double>(i + 1) / nodes_;
    const double stream =
        (state[spin] / rim.stretch[k] + span.entry_rate - u * (span.entry_rate - span.exit_rate)) / span.length();
    const double sliding = on.outline.shear_radius * state[spin] +
                           scale * (state[sinking] * rim.give[k] * rim.normal_sine[k] - along * rim.normal_cosine[k]);
    out[k] = span.grip * sliding - stream * slope(0, i, stream >= 0.0);
    if (!turns_) continue;
    const std::size_t y = k + static_cast<std::size_t>(nodes_);
    out[y] = span.grip * scale * across - stream * slope(1, i, stream >= 0.0);
  }
}

DrivenWheel::Push DrivenWheel::push(const OnSoil& on, const Contact& touching, const OperatingCondition& at,
                                    std::span<const double> state, std::span<const double> effective_j) const {
  ContactPatch patch;
  const Cornered j(on, touching.tread, effective_j, state[rolled]);
  const WheelForces f = on.wheel.hold(
      at, touching.span.entry,
      [&](ContactPatch& p, const Outline&) {
        const double length = p.angles.entry - p.angles.exit;
        for (int i = 0; i < p.count; ++i) {
          const double u = (on.flexes ? p.angles.entry - p.theta[i] : p.since_entry[i]) / length;
          p.j_x[i] = j.share(0) * p.since_entry[i] + value_at(line(j.rest, 0), u);
          p.j_y[i] = turns_ ? j.share(1) * p.since_entry[i] + value_at(line(j.rest, 1), u) : 0.0;
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
    const double area = b * patch.arc[i], give = on.flexes ? give_at(patch.theta[i], s, c) : 1.0;
    p.compaction += area * patch.sigma[i] * (e * along * s + dz * give * c);
    p.shear += area * (patch.tau_x[i] * (patch.arm[i] * w - along * c + dz * give * s) + patch.tau_y[i] * across);
    p.carcass += area * (1 - give) * dz * (patch.sigma[i] * c + patch.tau_x[i] * s);
  }
  p.deflection = patch.deflection;
  const double c = std::cos(at.yaw), s = std::sin(at.yaw);
  p.forward = forward * c - left * s, p.left = forward * s + left * c;
  p.upward = f.vertical, p.torque = f.torque;
  return p;
}

DrivenWheel::Push DrivenWheel::push(const Place& place, const Contact& touching, const OperatingCondition& at,
                                    std::span<const double> state, std::span<const double> effective_j) const {
  Push p = push(soils_[place.soil], touching, at, state, effective_j);
  for (std::size_t i = place.soil + 1; i <= place.last_soil; ++i) {
    const OnSoil& next = soils_[i];
    const Span span = contact_span(next, state[depth], state[sinking], at);
    p.blend(push(next, {span, tread(next, span, at), touching.slip}, at, state, effective_j),
            way_.share(i, state[travelled]));
  }
  return p;
}

Instant DrivenWheel::touch(const Place& place, double load, std::span<const double> state,
                           std::span<double> node_rate) const {
  Instant now;
  now.place = place;
  const OnSoil& on = soils_[place.soil];
  const Contact touching = contact(on, place, load, state);
  const Span& span = touching.span;
  node_rates(on, touching, place, state, node_rate);
  now.contact_slip = touching.slip;
  const OperatingCondition at = condition(place, load, now.contact_slip, state[speed], state[travelled]);
  // Shear is damped by looking ahead along dj/dt, which is 0 where the wheel's motion is steady.
  std::vector<double> ahead(node_rate.size());
  for (std::size_t k = 0; k < ahead.size(); ++k) ahead[k] = state[first_node + k] + shear_time_ * node_rate[k];
  const Push p = push(place, touching, at, state, ahead);
  const double g = span.grip;
  const double damping = std::max(g * heave_damping_ * state[sinking], -g * p.upward);  // soil doesn't pull
  now.soil_torque = g * p.torque, now.forward = g * p.forward, now.left = g * p.left;
  now.upward = g * p.upward + damping;
  now.compaction = g * p.compaction, now.shear = g * p.shear, now.added = g * p.added, now.carcass = g * p.carcass;
  now.damping = damping * state[sinking];
  now.deflection = g * p.deflection;
  return now;
}

Instant DrivenWheel::assemble(double time, std::span<const double> state, const Motor& motor,
                              std::span<double> node_rate) const {
  Instant now = touch(way_.at(state[travelled]), drive_.load, state, node_rate);
  now.motor_torque = motor.torque(time, state[spin], state[speed_error]);
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
  out[rolled] = rolled_rate(v, state[rolled]);
  out[mean_speed] = time < drive_.controller.ramp ? 0.0 : (v - state[mean_speed]) / drive_limits::memory;
  out[speed_error] = motor.integral_rate(time, state[spin], state[speed_error]);
}

/// The push on a wheel that does not move, at the start.
DrivenWheel::Push DrivenWheel::push_at_rest(const Place& start, double load, std::span<const double> state) const {
  const OnSoil& on = soils_[start.soil];
  const Contact touching = contact(on, start, load, state);
  return push(start, touching, condition(start, load, touching.slip, 0.0, 0.0), state, state.subspan(first_node));
}

/// Depth at which the soil carries the load with the shear that the state holds; the state gets it.
double DrivenWheel::held_depth(const Place& start, double vertical_load, std::vector<double>& state) const {
  const double load = vertical_load * std::cos(start.longitudinal_incline) * std::cos(start.transverse_incline);
  Push p;
  const auto carried = [&](double z) {
    state[depth] = z;
    p = push_at_rest(start, vertical_load, state);
    return p.upward - load;
  };
  const double low = 1e-9 * tire_.radius, high = max_sinkage_share * tire_.radius;
  if (carried(high) < 0.0) {
    if (p.deflection > high - p.deflection) throw crushed_tire(p.upward, load);
    throw NoSolution(
        fmt::format("the wheel sinks deeper than {} of its radius before it is driven", max_sinkage_share));
  }
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

Instant DrivenWheel::rest(const Place& place, double load, double displacement, std::vector<double>& state) const {
  lay_held_shear(state, displacement);
  held_depth(place, load, state);
  const Push p = push_at_rest(place, load, state);
  Instant now;
  now.place = place, now.soil_torque = p.torque, now.forward = p.forward, now.upward = p.upward;
  now.deflection = p.deflection;
  return now;
}

void turn_about(double& rolled_so_far, std::span<double> nodes) {
  rolled_so_far = -rolled_so_far;
  for (double& j : nodes) j = -j;
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
    held_depth(start, drive_.load, state);
    p = push_at_rest(start, drive_.load, state);
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
