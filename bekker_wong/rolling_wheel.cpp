#include "bekker_wong/rolling_wheel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "bekker_wong/balance_search.hpp"
#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/contact_stages.hpp"
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

void press(ContactPatch& patch, const Outline& outline, const Surroundings& around) {
  for (const auto& effect : around.effects) effect->soil_depth(patch, around);
  fill_pressure(patch, around.soil, outline);
  for (const auto& effect : around.effects) effect->pressure(patch, around.soil, outline, around);
}

PressureLaw pressure_law(std::span<const std::shared_ptr<const Effect>> effects) {
  PressureLaw most = PressureLaw::declared;
  for (const auto& effect : effects) most = std::max(most, effect->pressure_law());
  return most;
}

/// What one condition fixes before any trial sinkage.
struct RollingWheel::Prepared {
  const OperatingCondition& at;
  Outline outline;
  Surroundings around;
  NodeLayout layout;
  std::shared_ptr<const Tire> pumped = {};  ///< the tire at the condition's own pressure; null: as declared
};

RollingWheel::RollingWheel(const Tire& tire, const SoilValues& soil, EffectList effects, std::optional<Bin> bin)
    : tire_(tire), soil_(soil), effects_(std::move(effects)), bin_(bin) {
  const auto need = [](bool ok, const char* what) {
    if (!ok) throw InputError(what);
  };
  need(tire_.radius > 0.0 && std::isfinite(tire_.radius), "the wheel's radius must be positive");
  need(tire_.width > 0.0 && std::isfinite(tire_.width), "the wheel's width must be positive");
  need(std::isfinite(tire_.lugs.height), "the lugs' height must be a number");
  for (const auto member : soil_members) need(std::isfinite(soil_.*member), "each value of the soil must be a number");
  need(std::isfinite(soil_.density) && std::isfinite(soil_.gravity), "the soil's density and gravity must be numbers");
  need(soil_.exponent > 0.0, "the soil's exponent n must be positive");
  need(soil_.shear_modulus > 0.0, "the soil's shear modulus K must be positive");
  need(soil_.cohesion >= 0.0, "the soil's cohesion must not be negative");
  need(soil_.friction_angle >= 0.0 && soil_.friction_angle < std::numbers::pi / 2,
       "the soil's friction angle must lie in 0 .. 90 deg");
  need(soil_.pressure_modulus(tire_.width) > 0.0, "k_c/b + k_phi must be positive: this soil carries nothing");
}

RollingWheel::Prepared RollingWheel::prepare(const OperatingCondition& at) const {
  if (!(at.load > 0.0 && std::isfinite(at.load))) throw InputError("the load must be positive");
  if (!(at.speed >= 0.0 && std::isfinite(at.speed))) throw InputError("the speed must be 0 or more: slip has the sign");
  if (!std::isfinite(at.longitudinal_incline + at.transverse_incline)) throw InputError("an incline must be a number");
  if (at.inflation_pressure && !(*at.inflation_pressure >= 0.0 && std::isfinite(*at.inflation_pressure)))
    throw InputError("the inflation pressure must be 0 or more");
  auto pumped = at.inflation_pressure ? std::make_shared<const Tire>(tire_at(tire_, at)) : nullptr;
  const Tire& tire = pumped ? *pumped : tire_;
  Prepared p{
      .at = at,
      .outline = {.radius = tire_.radius,
                  .width = tire_.width,
                  .shear_radius = tire_.radius,
                  .slip_radius = tire_.radius},
      .around = {.tire = tire, .declared = soil_, .at = at, .motion = kinematics(at), .bin = bin_, .effects = effects_},
      .layout = {},
      .pumped = std::move(pumped)};
  p.around.normal_load = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
  if (!(p.around.normal_load > 0.0)) throw InputError("on this incline no load presses on the ground");
  for (const auto& effect : effects_) effect->motion(p.around.motion);
  for (const auto& effect : effects_) effect->soil(p.around.soil, p.around);
  for (const auto& effect : effects_) effect->outline(p.outline, p.around);
  return p;
}

ContactAngles RollingWheel::angles(const Prepared& p, double theta_1) const {
  ContactAngles angles = base_angles(theta_1, p.around.soil, p.around.motion);
  for (const auto& effect : effects_) effect->angles(angles, p.outline, p.around);
  return angles;
}

void RollingWheel::fill_patch(const Prepared& p, double theta_1, ContactPatch& patch,
                              const DisplacementFill& displacement_of) const {
  fill_geometry(patch, angles(p, theta_1), p.outline, p.around.motion, p.layout);
  for (const auto& effect : effects_) effect->geometry(patch, p.outline, p.around);
  press(patch, p.outline, p.around);
  if (displacement_of)
    displacement_of(patch, p.outline);
  else
    fill_displacement(patch, p.outline, p.around.motion);
  fill_strength(patch, p.around.soil);
  for (const auto& effect : effects_) effect->strength(patch, p.around.soil, p.outline, p.around);
  ContactPatch::Array j;
  fill_mobilised(patch, j, p.around.motion);
  const std::span<const double> displacement{j.data(), static_cast<std::size_t>(patch.count)};
  for (const auto& effect : effects_) effect->mobilise(patch, displacement, p.around.soil, p.around);
  fill_shear(patch, j);
}

namespace {

double sinkage_of(const ContactPatch& patch, const Outline& outline) {
  const double s = std::sin(0.5 * patch.angles.entry);
  return outline.radius * 2 * s * s - patch.deflection;
}

/// Sum over the nodes in four lanes, an order that the compiler may take side by side and that is always the same.
template <class Term>
double sum_over(const ContactPatch& patch, const Term& term) {
  std::array<double, 4> lane{};
  const auto count = static_cast<std::size_t>(patch.count), whole = count / 4 * 4;
  for (std::size_t i = 0; i < whole; i += 4)
    for (std::size_t k = 0; k < 4; ++k) lane[k] += term(i + k);
  for (std::size_t i = whole; i < count; ++i) lane[i - whole] += term(i);
  return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

/// ln(share), continued as a line where next to nothing is carried, or less than nothing (a braked wheel is pulled
/// down).
constexpr double small_share = 0.05;
double log_share(double share) {
  return share > small_share ? std::log(share) : std::log(small_share) + (share - small_share) / small_share;
}
double share_of(double log_share) {
  const double below = log_share - std::log(small_share);
  return below > 0.0 ? std::exp(log_share) : small_share * (1 + below);
}

constexpr std::array stress_members = {&ContactPatch::sigma, &ContactPatch::tau_x, &ContactPatch::tau_y};

std::string force(double newton) {
  return std::abs(newton) < 1e4 ? fmt::format("{:.4g} N", newton) : fmt::format("{:.4g} kN", newton / 1000);
}

double deepest_angle() { return std::acos(1.0 - max_sinkage_share); }

}  // namespace

NoSolution crushed_tire(double carried, double load) {
  return NoSolution(fmt::format(
      "the tire is crushed before the soil gives way: with its inflation and carcass pressure it carries at most {} "
      "of {}. Raise the inflation pressure or lower the load",
      force(carried), force(load)));
}

WheelForces RollingWheel::integrate(const Prepared& p, const ContactPatch& patch) const {
  const auto sum = [&](auto term) { return sum_over(patch, [&](std::size_t i) { return patch.arc[i] * term(i); }); };
  const double thrust = sum([&](std::size_t i) { return patch.tau_x[i] * patch.normal_cosine[i]; });
  const double compaction = -sum([&](std::size_t i) { return patch.sigma[i] * patch.normal_sine[i]; });
  const double side = sum([&](std::size_t i) { return patch.tau_y[i]; });
  const double torque = sum([&](std::size_t i) { return patch.tau_x[i] * patch.arm[i]; });
  const double vertical = sum(
      [&](std::size_t i) { return patch.sigma[i] * patch.normal_cosine[i] + patch.tau_x[i] * patch.normal_sine[i]; });
  const double b = p.outline.width;
  WheelForces f;
  if (!effects_.empty()) {
    const Rolling rolling{p.around, p.around.soil, p.outline, patch, sinkage_of(patch, p.outline)};
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

NodeLayout RollingWheel::layout_at(const Prepared& p, double theta_1) const {
  return node_layout(p.around.soil, p.outline, p.around.motion, angles(p, theta_1));
}

/// Load that the stresses carry [N].
double RollingWheel::pressed(const Prepared& p, const ContactPatch& patch) {
  return p.outline.width * sum_over(patch, [&](std::size_t i) {
           return patch.arc[i] * (patch.sigma[i] * patch.normal_cosine[i] + patch.tau_x[i] * patch.normal_sine[i]);
         });
}

/// Load that the added forces carry [N].
double RollingWheel::lifted(const Prepared& p, const ContactPatch& patch) const {
  if (std::none_of(effects_.begin(), effects_.end(), [](const auto& effect) { return effect->lifts(); })) return 0.0;
  const Rolling rolling{p.around, p.around.soil, p.outline, patch, sinkage_of(patch, p.outline)};
  ForceLedger added;
  for (const auto& effect : effects_)
    if (effect->lifts()) effect->added_forces(added, rolling);
  return added.vertical();
}

/// Load carried [N]: all that a search asks of a trial sinkage.
double RollingWheel::vertical(const Prepared& p, const ContactPatch& patch) const {
  return pressed(p, patch) + lifted(p, patch);
}

/// theta_1 of the wheel standing still, by Bekker's formula: where a search starts.
double RollingWheel::static_angle(const Prepared& p) const {
  SoilValues guessed = p.around.soil;
  guessed.exponent = std::min(guessed.exponent, 2.5);  // Bekker's formula ends at 3
  const double share =
      bekker_static_sinkage(guessed, p.outline.radius, p.outline.width, p.around.normal_load) / p.outline.radius;
  return std::acos(1.0 - std::min(share, 0.8 * max_sinkage_share));
}

/// A braked wheel's shear stress pushes it down, so that the load carried may rise, fall and, where the shear
/// displacement turns back, rise again. Looks from a root downward until even what lifts the wheel would not carry the
/// load.
bool RollingWheel::is_smallest(const Prepared& p, double log_theta) const {
  if (!p.around.motion.locked && p.around.motion.forward <= 1.0) return true;
  constexpr double step = 0.05, lowest = -7.0;
  ContactPatch patch;
  for (double x = log_theta - step; x > lowest; x -= step) {
    fill_patch(p, std::exp(x), patch);
    if (vertical(p, patch) > p.around.normal_load) return false;
    const double lifting = p.outline.width * sum_over(patch, [&](std::size_t i) {
                             return patch.arc[i] * (patch.sigma[i] * patch.normal_cosine[i] +
                                                    std::max(patch.tau_x[i], 0.0) * patch.normal_sine[i]);
                           });
    if (lifting < p.around.normal_load) return true;
  }
  return true;
}

/// The share of its stresses with which a patch carries the load. Added forces carry too, and some of them rise with
/// the stresses: those of faces that soil is pressed against, in proportion until the soil gives way.
double RollingWheel::carrying_share(const Prepared& p, const ContactPatch& patch) const {
  const double by_stresses = pressed(p, patch), by_forces = lifted(p, patch);
  if (by_forces == 0.0) return p.around.normal_load / by_stresses;
  ContactPatch bare = patch;
  for (auto member : stress_members) std::ranges::fill(bare.of(member), 0.0);
  const double load = p.around.normal_load, alone = lifted(p, bare);
  double share = (load - alone) / (by_stresses + (by_forces - alone));
  for (int round = 0; round < 50 && share > 0.0; ++round) {  // where the forces are not in proportion
    for (auto member : stress_members)
      for (std::size_t i = 0; i < static_cast<std::size_t>(patch.count); ++i)
        (bare.*member)[i] = share * (patch.*member)[i];
    const double missing = load - share * by_stresses - lifted(p, bare);
    if (!(std::abs(missing) > 1e-12 * load)) break;
    share += missing / by_stresses;
  }
  return share;
}

FirstRoot RollingWheel::balance(Prepared& p, const NearBalance& known, ContactPatch& patch) const {
  const double load = p.around.normal_load, upper = std::log(deepest_angle());
  // ln(carried/load) against ln(theta_1) is nearly a line of slope 2n + 1.
  const auto imbalance = [&](double log_theta) {
    fill_patch(p, std::exp(log_theta), patch);
    return log_share(vertical(p, patch) / load);
  };
  const double start = known.angle > 0.0 ? known.angle : static_angle(p);
  p.layout = layout_at(p, start);
  if (known.steepness > 0.0)
    if (const auto root = rising_root(imbalance, std::log(start), known.steepness, upper, 1e-8))
      if (is_smallest(p, root->x)) return {root->x, {}};
  p.layout = coarse(p.layout);
  const auto near = rising_root(imbalance, std::log(start), 2 * p.around.soil.exponent + 1, upper, 1e-4);
  if (near && is_smallest(p, near->x)) {
    p.layout = layout_at(p, std::exp(near->x));
    if (const auto root = rising_root(imbalance, near->x, near->slope, upper, 1e-12)) return {root->x, {}};
  }
  if (known.angle > 0.0)
    if (const gsl::Sample top = climb(imbalance, std::log(known.angle), upper); top.f < 0.0) return {{}, top};
  p.layout = layout_at(p, deepest_angle());
  const FirstRoot found = first_rising_root(imbalance, upper);
  if (found.x) fill_patch(p, std::exp(*found.x), patch);
  return found;
}

void RollingWheel::refuse(const Prepared& p, double highest, ContactPatch& patch) const {
  if (highest >= 0.0) throw NoSolution("no sinkage balances the load: the added forces alone lift the wheel");
  fill_patch(p, deepest_angle(), patch);
  const double load = p.around.normal_load, carried = vertical(p, patch), most = share_of(highest) * load;
  if (!std::isfinite(carried))
    throw NoSolution("the wheel or its load is too large or too small for the model's numbers");
  const bool crushed = patch.deflection > sinkage_of(patch, p.outline);
  if (crushed) throw crushed_tire(std::max(most, carried), load);
  throw NoSolution(fmt::format(
      "the wheel would sink deeper than {} of its radius: there the soil carries {} of {}{}", max_sinkage_share,
      force(carried), force(load),
      most > carried + 1e-6 * load ? fmt::format(", and at most {} at any depth above", force(most)) : std::string()));
}

double RollingWheel::settled(const Prepared& p, const ContactPatch& patch, double sinkage) const {
  double deeper = sinkage;
  for (const auto& effect : effects_)
    deeper = effect->settle(deeper, {p.around, p.around.soil, p.outline, patch, sinkage});
  return deeper;
}

void RollingWheel::settle(const Prepared& balanced, double deeper, RolledWheel& wheel) const {
  Prepared p = balanced;
  const double r = p.outline.radius;
  const auto felt_share = [&](double circle) {  // of the soil's stresses, where they flatten the carcass to this depth
    std::optional<double> share;
    for (const auto& effect : effects_)
      if (!share) share = effect->stress_share(deeper, circle, p.outline, balanced.around);
    return share;
  };
  // The share of the stresses there that carries the load, under a circle of this depth.
  double scale = 0.0;
  const auto carry = [&](double circle, double felt) {
    p.around.stress_share = felt;
    fill_patch(p, std::acos(1.0 - circle / r), wheel.patch);
    scale = carrying_share(p, wheel.patch);
  };
  const auto too_deep = [](double share) {
    return NoSolution(
        fmt::format("the wheel would dig itself in to {:.3g} of its radius, deeper than {}", share, max_settled_share));
  };
  if (deeper > max_settled_share * r) throw too_deep(deeper / r);
  const bool flexes = felt_share(deeper).has_value();
  carry(deeper, flexes ? 0.0 : 1.0);
  if (flexes && scale > 0.0) try {
      // Both shares are one where the carcass bears what the soil does. Over 90 deg of contact carry less again.
      const auto excess = [&](double circle) {
        const double felt = felt_share(circle).value();
        carry(circle, felt);
        return felt - scale;
      };
      double low = deeper, high = std::clamp(deeper, r, max_settled_share * r);
      if (excess(high) < 0.0) low = std::exchange(high, max_settled_share * r);
      if (high > r && excess(high) < 0.0) throw too_deep(high / r);
      excess(gsl::bracketed_root(excess, low, high, 1e-14, 1e-11, "how deep a carcass that gives way digs itself in"));
    } catch (const std::domain_error&) {
      throw NoSolution("no balance of the load at the deeper position");
    }
  if (!(scale > 0.0) || !std::isfinite(scale)) throw NoSolution("no balance of the load at the deeper position");
  for (auto member : stress_members)
    for (double& stress : wheel.patch.of(member)) stress *= scale;
  wheel.sinkage = deeper, wheel.stress_share = scale;
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
  wheel.unmeasured = r;
  for (const auto& effect : effects_) effect->sensor(r, p.around);
}

double RollingWheel::finish(const Prepared& p, double theta_1, RolledWheel& wheel) const {
  wheel.at = p.at;
  wheel.motion = p.around.motion;
  wheel.balance_angle = theta_1;
  wheel.sinkage = sinkage_of(wheel.patch, p.outline);
  const double deeper = settled(p, wheel.patch, wheel.sinkage);
  const bool settles = deeper != wheel.sinkage;
  const double carried = settles ? vertical(p, wheel.patch) : 0.0;
  if (settles) settle(p, deeper, wheel);
  wheel.forces = integrate(p, wheel.patch);
  read(p, wheel);
  return settles ? carried : wheel.forces.vertical;
}

RolledWheel RollingWheel::roll(const OperatingCondition& at) const {
  Prepared p = prepare(at);
  RolledWheel wheel;
  const FirstRoot found = balance(p, {}, wheel.patch);
  if (!found.x) refuse(p, found.highest.f, wheel.patch);
  finish(p, std::exp(*found.x), wheel);
  return wheel;
}

RolledWheel RollingWheel::roll_or_give_way(const OperatingCondition& at, const NearBalance& near) const {
  Prepared p = prepare(at);
  RolledWheel wheel;
  const FirstRoot found = balance(p, near, wheel.patch);
  wheel.gives_way = !found.x;
  const double theta_1 = std::exp(found.x.value_or(found.highest.x));
  if (wheel.gives_way) {
    if (found.highest.f >= 0.0) refuse(p, found.highest.f, wheel.patch);
    p.layout = layout_at(p, theta_1);
    fill_patch(p, theta_1, wheel.patch);
  }
  const double carried = finish(p, theta_1, wheel);
  if (wheel.gives_way) wheel.shortfall = -log_share(carried / p.around.normal_load);
  return wheel;
}

WheelForces RollingWheel::hold(const OperatingCondition& at, double theta_1, const DisplacementFill& displacement,
                               ContactPatch& patch) const {
  Prepared p = prepare(at);
  p.layout = layout_at(p, theta_1);
  fill_patch(p, theta_1, patch, displacement);
  return integrate(p, patch);
}

void RollingWheel::tread(const OperatingCondition& at, double theta_1, std::span<const double> since_entry,
                         ContactPatch& patch) const {
  const Prepared p = prepare(at);
  fill_geometry(patch, angles(p, theta_1), p.outline, since_entry);
  for (const auto& effect : effects_) effect->geometry(patch, p.outline, p.around);
}

Outline RollingWheel::outline(const OperatingCondition& at) const { return prepare(at).outline; }

ContactAngles RollingWheel::angles(const OperatingCondition& at, double theta_1) const {
  return angles(prepare(at), theta_1);
}

NodeLayout RollingWheel::nodes(const OperatingCondition& at, double theta_1) const {
  return layout_at(prepare(at), theta_1);
}

RolledWheel RollingWheel::at_entry_angle(const OperatingCondition& at, double theta_1, const NodeLayout& nodes) const {
  if (!(theta_1 > 0.0 && theta_1 <= std::numbers::pi / 2)) throw InputError("theta_1 must lie in 0 .. 90 deg");
  Prepared p = prepare(at);
  p.layout = nodes;
  RolledWheel wheel;
  fill_patch(p, theta_1, wheel.patch);
  wheel.forces.vertical = finish(p, theta_1, wheel);
  return wheel;
}

RolledWheel RollingWheel::at_entry_angle(const OperatingCondition& at, double theta_1) const {
  return at_entry_angle(at, theta_1, nodes(at, theta_1));
}

}  // namespace soilbin::bekker_wong
