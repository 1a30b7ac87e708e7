#include "resistive_force/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>

#include "resistive_force/response.hpp"
#include "scenario/errors.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::resistive_force {
namespace {

constexpr double deepest_share = 0.9;  // of the radius
constexpr int steps_down = 64;         // in which the first balance is looked for
constexpr int precise_bits = 46;       // of the balanced depth
constexpr double least_push = 1e-9;    // cosine of motion and normal; below it an element slides along itself

/// A wheel's motion over a plane, in the frame of travel: x along it, y left, z out of the ground.
struct Motion {
  Vec3 axle, heading;    ///< to the left; in the wheel's plane, along the ground
  Vec3 velocity;         ///< of the axle, in units in which the tread base turns at 1
  double turning = 1.0;  ///< speed of the tread base about the axle: 1, locked 0
};

Motion motion_of(const OperatingCondition& at) {
  const double slip = slip_by(at.slip, at.yaw, at.slip_by, SlipBy::travel_speed);
  Motion m;
  m.heading = {std::cos(at.yaw), std::sin(at.yaw), 0};
  m.axle = {-std::sin(at.yaw), std::cos(at.yaw), 0};
  const bool locked = slip <= -1.0;
  m.turning = locked ? 0.0 : 1.0;
  m.velocity = {locked ? 1.0 : speed_ratio(slip), 0, 0};
  return m;
}

/// A vector of the wheel, turned by an angle about its axle and to its heading.
Vec3 in_travel(const Vec3& of_wheel, double turn, const Motion& m) {
  const double c = std::cos(turn), s = std::sin(turn);
  const double forward = c * of_wheel.x + s * of_wheel.z, up = c * of_wheel.z - s * of_wheel.x;
  return forward * m.heading + of_wheel.y * m.axle + Vec3{0, 0, up};
}

}  // namespace

/// Sums over the contacts at one depth: of forces per xi_n, and of what they change by with depth.
struct PushedWheel::Sums {
  SoilForces forces, by_depth;
};

PushedWheel::PushedWheel(const TreadElements& elements, const Tire& tire, const OperatingCondition& at)
    : tire_(tire), at_(at) {
  const Motion m = motion_of(at);
  axle_ = m.axle;
  gravity_share_ = std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
  const int turns = elements.turns;
  turns_ = turns;
  contacts_.reserve(elements.all.size() * static_cast<std::size_t>(turns) / 2);
  for (int k = 0; k < turns; ++k) {
    const double turn = elements.pitch * k / turns;
    for (const Element& e : elements.all) {
      const Vec3 place = in_travel(e.place, turn, m);
      const double level = -place.z - tire.radius;
      if (level <= -deepest_share * tire.radius) continue;  // above the ground at every depth
      const Vec3 velocity = m.velocity + (m.turning / tire.radius) * cross(m.axle, place);
      const double speed = length(velocity);
      if (speed < 1e-12) continue;
      const Vec3 normal = in_travel(e.normal, turn, m);
      double push = dot(normal, velocity) / speed;
      if (std::abs(push) < least_push) push = dot(normal, m.heading);  // it slides along itself: a little more forward
      if (push < -least_push) continue;
      const double area =
          push < least_push ? 0.5 * e.area : e.area;  // a side without yaw: to the left and to the right
      const Response r = response(normal, velocity / speed, {0, 0, 1});
      contacts_.push_back({place, area * r.normal, area * r.tangential, level, e.part});
    }
  }
}

std::vector<Vec3> PushedWheel::weighed(const Medium& medium) const {
  std::vector<Vec3> all;
  all.reserve(contacts_.size());
  const double scale = gravity_share_ / turns_;
  for (const Contact& c : contacts_) all.push_back(scale * traction({c.normal, c.tangential}, medium.surface_friction));
  return all;
}

void PushedWheel::add(SoilForces& to, const Vec3& force, const Contact& contact) const {
  to.pull += force.x, to.left += force.y, to.vertical += force.z;
  to.torque -= dot(cross(contact.place, force), axle_);
}

PushedWheel::Sums PushedWheel::sums(const std::vector<Vec3>& by_depth, double sinkage) const {
  Sums s;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double depth = sinkage + contacts_[i].level;
    if (depth <= 0.0) continue;
    add(s.by_depth, by_depth[i], contacts_[i]);
    add(s.forces, depth * by_depth[i], contacts_[i]);
  }
  return s;
}

namespace {

SoilForces scaled(double by, const SoilForces& f) { return {by * f.pull, by * f.left, by * f.vertical, by * f.torque}; }

SoilForces sum(const SoilForces& a, const SoilForces& b) {
  return {a.pull + b.pull, a.left + b.left, a.vertical + b.vertical, a.torque + b.torque};
}

}  // namespace

SoilForces PushedWheel::forces(const Medium& medium, double sinkage) const {
  return scaled(medium.xi_n, sums(weighed(medium), sinkage).forces);
}

Balance PushedWheel::balance(const Medium& medium) const {
  const std::vector<Vec3> by_depth = weighed(medium);
  const double load = at_.load * gravity_share_;
  const auto excess = [&](double sinkage) {
    double vertical = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      vertical += std::max(0.0, sinkage + contacts_[i].level) * by_depth[i].z;
    return medium.xi_n * vertical - load;
  };
  const double highest = -tire_.lugs.height, deepest = deepest_share * tire_.radius;
  double above = highest, below = highest, at_below = -load, most = -load;
  for (int k = 1; k <= steps_down && at_below < 0.0; ++k) {
    above = below;
    below = highest + (deepest - highest) * k / steps_down;
    at_below = excess(below);
    most = std::max(most, at_below);
  }
  if (at_below < 0.0)
    throw NoSolution(
        fmt::format("no depth down to {} of the radius carries the load: the soil carries at most {:.4g} N of {:.4g} N",
                    deepest_share, most + load, load));
  std::uintmax_t most_steps = 60;
  const auto [low, high] =
      boost::math::tools::toms748_solve(excess, above, below, excess(above), at_below,
                                        boost::math::tools::eps_tolerance<double>(precise_bits), most_steps);
  Balance b;
  b.sinkage = 0.5 * (low + high);

  const Sums here = sums(by_depth, b.sinkage);
  b.forces = scaled(medium.xi_n, here.forces);

  // What xi_n changes at this depth, and how the depth then changes so that the load is carried again.
  b.by_xi_n.sinkage = -here.forces.vertical / (medium.xi_n * here.by_depth.vertical);
  b.by_xi_n.forces = sum(here.forces, scaled(medium.xi_n * b.by_xi_n.sinkage, here.by_depth));
  return b;
}

std::array<SoilForces, 3> PushedWheel::forces_of_parts(const Medium& medium, double sinkage) const {
  const std::vector<Vec3> by_depth = weighed(medium);
  std::array<SoilForces, 3> parts{};
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (const double depth = sinkage + contacts_[i].level; depth > 0.0)
      add(parts[static_cast<std::size_t>(contacts_[i].part)], medium.xi_n * depth * by_depth[i], contacts_[i]);
  return parts;
}

std::vector<StripStress> PushedWheel::strips(const Medium& medium, double sinkage, int count) const {
  const std::vector<Vec3> by_depth = weighed(medium);
  const double width = 2 * std::numbers::pi / count, area = width * tire_.radius * tire_.width;
  std::vector<Vec3> on(static_cast<std::size_t>(count));  // normal, shear, lateral
  const Vec3 heading = cross(axle_, {0, 0, 1});
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double depth = sinkage + contacts_[i].level;
    if (depth <= 0.0 || contacts_[i].part == WheelPart::sides) continue;
    const Vec3& place = contacts_[i].place;
    const double theta = std::atan2(dot(place, heading), -place.z);
    const Vec3 out = std::sin(theta) * heading - std::cos(theta) * Vec3{0, 0, 1};
    const Vec3 forward = std::cos(theta) * heading + std::sin(theta) * Vec3{0, 0, 1};
    const Vec3 force = medium.xi_n * depth * by_depth[i];
    const int strip = std::clamp(static_cast<int>((theta + std::numbers::pi) / width), 0, count - 1);
    on[static_cast<std::size_t>(strip)] += Vec3{-dot(force, out), dot(force, forward), dot(force, axle_)} / area;
  }
  std::vector<StripStress> strips;
  for (int k = 0; k < count; ++k)
    if (const Vec3& s = on[static_cast<std::size_t>(k)]; !(s == Vec3{}))
      strips.push_back({(k + 0.5) * width - std::numbers::pi, s.x, s.y, s.z});
  return strips;
}

}  // namespace soilbin::resistive_force
