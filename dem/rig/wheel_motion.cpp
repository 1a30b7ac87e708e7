#include "dem/rig/wheel_motion.hpp"

#include <cmath>
#include <numbers>

#include "scenario/errors.hpp"

namespace soilbin::dem {

WheelStance wheel_stance(const OperatingCondition& at) {
  constexpr double right_angle = std::numbers::pi / 2;
  if (!(at.load > 0)) throw InputError("the load must be above 0");
  if (!(std::abs(at.yaw) <= right_angle)) throw InputError("yaw must lie in -90 .. 90 deg");
  if (!(std::abs(at.longitudinal_incline) < right_angle && std::abs(at.transverse_incline) < right_angle))
    throw InputError("inclines must lie between -90 and 90 deg");

  const double a = at.longitudinal_incline, b = at.transverse_incline;
  WheelStance stance;
  stance.up = {std::sin(a), std::cos(a) * std::sin(b), std::cos(a) * std::cos(b)};
  stance.load = -at.load * stance.up;
  stance.heading = {std::cos(at.yaw), std::sin(at.yaw), 0};
  stance.axle = {-std::sin(at.yaw), std::cos(at.yaw), 0};
  return stance;
}

WheelMotion wheel_motion(const OperatingCondition& at, double radius) {
  WheelMotion motion{wheel_stance(at)};
  if (at.pass < 1) throw InputError("the pass must be 1 or more");
  if (!(at.speed > 0)) throw InputError("the soil bin needs a forward speed above 0");
  if (!(at.slip >= -1 && at.slip < 1)) throw InputError("the soil bin needs a slip from -1 to below 1");
  const bool by_plane = at.slip_by == SlipBy::wheel_plane_speed;
  if (by_plane && std::cos(at.yaw) < 1e-12)
    throw InputError("at 90 deg of yaw the speed in the wheel's plane is zero: give the slip by travel speed");
  motion.speed = at.speed;
  const double over_ground = by_plane ? at.speed * std::cos(at.yaw) : at.speed;
  motion.rotation = over_ground / radius * (at.slip >= 0 ? 1 / (1 - at.slip) : 1 + at.slip);
  return motion;
}

double slip_of(double forward, double rotation, double radius) {
  const double rim = radius * rotation;
  if (rim >= forward) return rim > 0 ? 1 - forward / rim : 0;
  return rim / forward - 1;
}

NetForce net_force(const Vec3& of_soil, const WheelStance& stance, ForceFrame frame) {
  const Vec3 net = of_soil + stance.load;
  if (frame == ForceFrame::travel) return {net.x, net.y};
  return {dot(net, stance.heading), dot(net, stance.axle)};
}

}  // namespace soilbin::dem
