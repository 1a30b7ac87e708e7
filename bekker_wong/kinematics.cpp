#include "bekker_wong/kinematics.hpp"

#include <cmath>
#include <numbers>

#include "scenario/errors.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::bekker_wong {

Kinematics kinematics(const OperatingCondition& at) {
  if (!(std::abs(at.slip) <= 1.0)) throw InputError("slip must lie in -1 .. 1");
  constexpr double right_angle = std::numbers::pi / 2;
  if (!(std::abs(at.yaw) <= right_angle * (1 + 1e-12))) throw InputError("yaw must lie in -90 .. 90 deg");
  const bool sideways = std::abs(at.yaw) > right_angle * (1 - 1e-12);
  const double c = sideways ? 0.0 : std::cos(at.yaw), s = std::sin(at.yaw);

  Kinematics k;
  if (at.slip == -1.0) {
    k.locked = true;
    k.slip = -1.0;
    k.forward = c;
    k.lateral = s;
    return k;
  }
  if (at.slip_by == SlipBy::travel_speed) {
    k.travel_ratio = speed_ratio(at.slip);
    k.forward = k.travel_ratio * c;
    k.lateral = k.travel_ratio * s;
    k.slip = at.yaw == 0.0 ? at.slip : slip_of_ratio(k.forward);
    return k;
  }
  if (sideways)
    throw InputError("at 90 deg of yaw the speed in the wheel's plane is zero: give the slip by travel speed");
  k.slip = at.slip;
  k.forward = speed_ratio(at.slip);
  k.lateral = k.forward * (s / c);
  k.travel_ratio = k.forward / c;
  return k;
}

}  // namespace soilbin::bekker_wong
