// An operating condition as vectors in the frame of the bin: x the direction of travel, y to its left, z the normal of
// the undisturbed surface. Inclines turn gravity, not the bin. Signs: docs/reference/conventions.md.
#pragma once

#include "dem/surface/vec3.hpp"
#include "scenario/operating_condition.hpp"

namespace soilbin::dem {

/// How a wheel stands in the bin.
struct WheelStance {
  Vec3 up;             ///< against gravity, unit
  Vec3 load;           ///< the load as a force, W down [N]
  Vec3 heading, axle;  ///< of the wheel: forward in its plane, and to its left; unit
};

/// Reads load, inclines and yaw. Throws InputError for a load that isn't above 0, a yaw or inclines of 90 deg or more.
WheelStance wheel_stance(const OperatingCondition& at);

/// How it is moved along the bin.
struct WheelMotion : WheelStance {
  double speed = 0;     ///< of the axle along x [m/s]
  double rotation = 0;  ///< about the axle, forward positive [rad/s]
};

/// Throws InputError where wheel_stance does, for a speed that isn't above 0, a slip outside -1
/// .. 1, slip 1 (the wheel stands and spins: a speed says nothing of its
/// rotation), a pass below 1.
WheelMotion wheel_motion(const OperatingCondition& at, double radius);

/// The slip of a wheel that turns at `rotation` [rad/s] while its axle goes on
/// at `forward` [m/s]: 1 - v/(r w) driven, r w/v - 1 braked.
double slip_of(double forward, double rotation, double radius);

/// A force of the soil on the wheel plus the load's share, in the axes that are
/// asked for: along and to the left [N].
struct NetForce {
  double drawbar_pull, lateral;
};
NetForce net_force(const Vec3& of_soil, const WheelStance& stance, ForceFrame frame);

}  // namespace soilbin::dem
