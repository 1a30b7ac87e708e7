#include "scenario/yawed_frames.hpp"

#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin {

double slip_by(double slip, double yaw, SlipBy from, SlipBy to) {
  if (from == to || yaw == 0.0 || slip == -1.0) return slip;
  constexpr double smallest_cosine = 1e-9;
  const double c = std::cos(yaw);
  if (to == SlipBy::wheel_plane_speed) return slip_of_ratio(speed_ratio(slip) * (c < smallest_cosine ? 0.0 : c));
  if (c < smallest_cosine) throw InputError("at a yaw of 90 deg slip in the wheel's plane doesn't tell that of travel");
  return slip_of_ratio(speed_ratio(slip) / c);
}

GroundForce turned(const GroundForce& force, double yaw, ForceFrame from, ForceFrame to) {
  if (from == to) return force;
  const double c = std::cos(yaw), s = std::sin(yaw);
  if (to == ForceFrame::wheel) return {force.forward * c + force.left * s, force.left * c - force.forward * s};
  return {force.forward * c - force.left * s, force.forward * s + force.left * c};
}

}  // namespace soilbin
