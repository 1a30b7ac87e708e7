// What a yawed wheel's slip and forces are by either definition (docs/reference/conventions.md): the speed of travel or
// its part in the wheel's plane, the axes of travel or those of the wheel.
#pragma once

#include "scenario/operating_condition.hpp"

namespace soilbin {

/// v/(r w) from a slip of the conventions: driven s = 1 - v/(r w), braked s = r w/v - 1. s above -1.
inline double speed_ratio(double slip) { return slip >= 0.0 ? 1.0 - slip : 1.0 / (1.0 + slip); }
/// The slip of a ratio v/(r w) of 0 or more.
inline double slip_of_ratio(double ratio) { return ratio <= 1.0 ? 1.0 - ratio : 1.0 / ratio - 1.0; }

/// The slip of a motion by another speed: v cos(yaw)/(r w) and v/(r w) differ by cos(yaw) [rad]. A locked wheel's is
/// -1 by either. Throws InputError where at 90 deg of yaw the speed in the wheel's plane, 0, is to tell the speed of
/// travel.
double slip_by(double slip, double yaw, SlipBy from, SlipBy to);

/// A force along the ground [N] by its parts in one frame: along travel and to its left, or in the wheel's plane and
/// across it to the left.
struct GroundForce {
  double forward = 0.0, left = 0.0;
};

/// A force in another frame: the wheel's axes stand `yaw` [rad] to the left of those of travel.
GroundForce turned(const GroundForce& force, double yaw, ForceFrame from, ForceFrame to);

}  // namespace soilbin
