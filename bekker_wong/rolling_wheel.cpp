#include "bekker_wong/rolling_wheel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/gsl.hpp"
#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {

void ForceLedger::add(const AddedForce& force) {
  if (count_ == rows_.size()) throw std::length_error("ForceLedger holds at most 16 added forces");
  rows_[count_++] = force;
}

double ForceLedger::vertical() const {
  double sum = 0.0;
  for (const AddedForce& f : rows()) sum += f.vertical;
  return sum;
}

/// What one condition fixes before any trial sinkage.
struct RollingWheel::Prepared {
  const OperatingCondition& at;
  Kinematics motion;
  SoilValues soil;
  Outline outline;
  Surroundings around;
  int nodes;
};

RollingWheel::RollingWheel(const Tire& tire, const SoilValues& soil, EffectList effects, std::optional<Bin> bin)
    : tire_(tire), soil_(soil), effects_(std::move(effects)), bin_(bin) {
  const auto need = [](bool ok, const char* what) {
    if (!ok) throw InputError(what);
  };
  need(tire_.radius > 0.0 && std::isfinite(tire_.radius), "the wheel's radius must be positive");
  need(tire_.width > 0.0 && std::isfinite(tire_.width), "the wheel's width must be positive");
  need(soil_.exponent > 0.0, "the soil's exponent n must be positive");
  need(soil_.shear_modulus > 0.0, "the soil's shear modulus K must be positive");
  need(soil_.cohesion >= 0.0, "the soil's cohesion must not be negative");
  need(soil_.friction_angle >= 0.0 && soil_.friction_angle < std::numbers::pi / 2,
       "the soil's friction angle must lie in 0 .. 90 deg");
  need(soil_.pressure_modulus(tire_.width) > 0.0, "k_c/b + k_phi must be positive: this soil carries nothing");
}

RollingWheel::Prepared RollingWheel::prepare(const OperatingCondition& at) const {
  if (!(at.load > 0.0 && std::isfinite(at.load))) throw InputError("the load must be positive");
  Prepared p{.at = at,
             .motion = kinematics(at),
             .soil = soil_,
             .outline = {.radius = tire_.radius, .width = tire_.width, .shear_radius = tire_.radius},
             .around = {tire_, soil_, at, p.motion, bin_, 0.0},
             .nodes = 0};
  p.around.normal_load = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
  if (!(p.around.normal_load > 0.0)) throw InputError("on this incline no load presses on the ground");
  for (const auto& effect : effects_) effect->soil(p.soil, p.around);
  for (const auto& effect : effects_) effect->outline(p.outline, p.around);
  p.nodes = nodes_per_segment(p.soil, p.outline, p.motion);
  return p;
}

void RollingWheel::fill_patch(const Prepared& p, double theta_1, ContactPatch& patch) const {
  ContactAngles angles = base_angles(theta_1, p.soil, p.motion);
  for (const auto& effect : effects_) effect->angles(angles, p.outline, p.around);
  fill_geometry(patch, angles, p.outline, p.motion, p.nodes);
  for (const auto& effect : effects_) effect->geometry(patch, p.outline, p.around);
  fill_pressure(patch, p.soil, p.outline);
  for (const auto& effect : effects_) effect->pressure(patch, p.soil, p.outline, p.around);
  fill_displacement(patch, p.outline, p.motion);
  for (const auto& effect : effects_) effect->displacement(patch, p.outline, p.around);
  fill_strength(patch, p.soil);
  for (const auto& effect : effects_) effect->strength(patch, p.soil, p.outline, p.around);
  ContactPatch::Array j;
  fill_mobilised(patch, j, p.motion);
  const std::span<const double> displacement{j.data(), static_cast<std::size_t>(patch.count)};
  for (const auto& effect : effects_) effect->mobilise(patch, displacement, p.soil, p.around);
  fill_shear(patch, j);
}

namespace {

double sinkage_of(const ContactPatch& patch, const Outline& outline) {
  const double s = std::sin(0.5 * patch.angles.entry);
  return outline.radius * 2 * s * s - patch.deflection;
}

double deepest_angle() { return std::acos(1.0 - max_sinkage_share); }

}  // namespace

WheelForces RollingWheel::integrate(const Prepared& p, const ContactPatch& patch) const {
  double thrust = 0, compaction = 0, side = 0, vertical = 0, torque = 0;
  for (int i = 0; i < patch.count; ++i) {
    const double w = patch.arc[i], c = patch.normal_cosine[i], s = patch.normal_sine[i];
    thrust += w * patch.tau_x[i] * c;
    compaction -= w * patch.sigma[i] * s;
    vertical += w * (patch.sigma[i] * c + patch.tau_x[i] * s);
    side += w * patch.tau_y[i];
    torque += w * patch.tau_x[i] * patch.arm[i];
  }
  const double b = p.outline.width;
  WheelForces f;
  if (!effects_.empty()) {
    const Rolling rolling{p.around, p.soil, p.outline, patch, sinkage_of(patch, p.outline)};
    for (const auto& effect : effects_) effect->added_forces(f.added, rolling);
  }
  f.thrust = b * thrust;
  f.compaction = b * compaction;
  f.side = b * side;
  f.vertical = b * vertical + f.added.vertical();
  f.torque = b * torque;
  for (const AddedForce& added : f.added.rows()) f.torque += added.torque;
  return f;
}

double RollingWheel::balance(const Prepared& p) const {
  const double load = p.around.normal_load, deepest = deepest_angle(), growth = 2 * p.soil.exponent + 1;
  ContactPatch patch;
  // ln(carried/load) against ln(theta_1) is nearly a line of slope 2n + 1; continued as a line where little is carried.
  const auto imbalance = [&](double log_theta) {
    fill_patch(p, std::exp(log_theta), patch);
    const double share = integrate(p, patch).vertical / load;
    constexpr double small = 0.05;
    return share > small ? std::log(share) : std::log(small) + (share - small) / small;
  };
  const double static_sinkage =
      bekker_static_sinkage(p.soil, p.outline.radius, p.outline.width, load) / p.outline.radius;
  double upper_limit = std::log(deepest);
  double near = std::min(std::log(std::acos(1.0 - std::min(static_sinkage, 0.8 * max_sinkage_share))), upper_limit);
  double f_near = imbalance(near);
  const bool up = f_near < 0.0;
  double far = near, f_far = f_near, most = f_near;
  while ((f_far < 0.0) == up && f_far != 0.0) {
    near = far, f_near = f_far;
    if (up && near >= upper_limit) break;
    const double step = std::clamp(1.05 * std::abs(f_near) / growth + 1e-3, 0.0, up ? 0.25 : 1.5);
    far = up ? std::min(near + step, upper_limit) : near - step;
    if (far < -40.0) throw NoSolution("no sinkage balances the load: the added forces alone lift the wheel");
    f_far = imbalance(far);
    most = std::max(most, f_far);
  }
  if (f_far == 0.0) return std::exp(far);
  if ((f_far < 0.0) == up) {
    const double carried = integrate(p, (fill_patch(p, deepest, patch), patch)).vertical;
    throw NoSolution(fmt::format(
        "the wheel would sink deeper than {} of its radius: there the soil carries {:.4g} N of {:.4g} N{}",
        max_sinkage_share, carried, load,
        most > imbalance(upper_limit) + 1e-9 ? fmt::format(" (at most {:.3g} of the load at any depth)", std::exp(most))
                                            : std::string()));
  }
  const auto [lower, upper] = std::minmax(near, far);
  return std::exp(gsl::bracketed_root(imbalance, lower, upper, 1e-15, 1e-14, "the balance of the load"));
}

void RollingWheel::settle(const Prepared& p, RolledWheel& wheel) const {
  wheel.sinkage = sinkage_of(wheel.patch, p.outline);
  if (effects_.empty()) return;
  double deeper = wheel.sinkage;
  for (const auto& effect : effects_)
    deeper = effect->settle(deeper, {p.around, p.soil, p.outline, wheel.patch, wheel.sinkage});
  if (deeper == wheel.sinkage) return;
  const double share = (deeper + wheel.patch.deflection) / p.outline.radius;
  if (share > max_sinkage_share)
    throw NoSolution(fmt::format("the wheel would dig itself in to {:.3g} of its radius, deeper than {}", share,
                                 max_sinkage_share));
  fill_patch(p, std::acos(1.0 - share), wheel.patch);
  const WheelForces unscaled = integrate(p, wheel.patch);
  const double added = unscaled.added.vertical();
  const double scale = (p.around.normal_load - added) / (unscaled.vertical - added);
  if (!(scale > 0.0) || !std::isfinite(scale)) throw NoSolution("no balance of the load at the deeper position");
  for (auto member : {&ContactPatch::sigma, &ContactPatch::tau_x, &ContactPatch::tau_y})
    for (double& stress : wheel.patch.of(member)) stress *= scale;
  wheel.forces = integrate(p, wheel.patch);
  wheel.sinkage = deeper;
}

void RollingWheel::read(const Prepared& p, RolledWheel& wheel) const {
  const OperatingCondition& at = p.at;
  double forward = wheel.forces.thrust + wheel.forces.compaction, left = wheel.forces.side;
  for (const AddedForce& added : wheel.forces.added.rows()) forward += added.forward, left += added.lateral;
  const double c = std::cos(at.yaw), s = std::sin(at.yaw);
  const double slope = -at.load * std::sin(at.longitudinal_incline);
  const double cross = -at.load * std::cos(at.longitudinal_incline) * std::sin(at.transverse_incline);
  Reading& r = wheel.reading;
  if (at.force_frame == ForceFrame::travel) {
    r.drawbar_pull = forward * c - left * s + slope;
    r.lateral_force = forward * s + left * c + cross;
  } else {
    r.drawbar_pull = forward + slope * c + cross * s;
    r.lateral_force = left - slope * s + cross * c;
  }
  r.torque = wheel.forces.torque;
  r.sinkage = wheel.sinkage;
  for (const auto& effect : effects_) effect->sensor(r, p.around);
}

RolledWheel RollingWheel::roll(const OperatingCondition& at) const {
  const Prepared p = prepare(at);
  RolledWheel wheel;
  wheel.at = at;
  wheel.motion = p.motion;
  wheel.balance_angle = balance(p);
  fill_patch(p, wheel.balance_angle, wheel.patch);
  wheel.forces = integrate(p, wheel.patch);
  settle(p, wheel);
  read(p, wheel);
  return wheel;
}

RolledWheel RollingWheel::at_entry_angle(const OperatingCondition& at, double theta_1) const {
  if (!(theta_1 > 0.0 && theta_1 <= std::numbers::pi / 2)) throw InputError("theta_1 must lie in 0 .. 90 deg");
  const Prepared p = prepare(at);
  RolledWheel wheel;
  wheel.at = at;
  wheel.motion = p.motion;
  wheel.balance_angle = theta_1;
  fill_patch(p, theta_1, wheel.patch);
  wheel.forces = integrate(p, wheel.patch);
  const double carried = wheel.forces.vertical;
  settle(p, wheel);
  read(p, wheel);
  wheel.forces.vertical = carried;
  return wheel;
}

}  // namespace soilbin::bekker_wong
