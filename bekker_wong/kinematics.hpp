// How the wheel moves over the soil: its slip in its own plane, and its forward and lateral speeds over the rim's.
#pragma once

#include "scenario/operating_condition.hpp"

namespace soilbin::bekker_wong {

/// Motion of the wheel over the soil, as ratios to the rim speed r w, so that nothing depends on how fast it turns.
struct Kinematics {
  double slip = 0.0;          ///< s by the speed in the wheel's plane, -1 .. 1
  double forward = 1.0;       ///< v cos(yaw)/(r w); for a locked wheel cos(yaw)
  double lateral = 0.0;       ///< v sin(yaw)/(r w); for a locked wheel sin(yaw)
  bool locked = false;        ///< w = 0 (s = -1): shear is saturated, forward and lateral give only its direction
  double travel_ratio = 1.0;  ///< v/(r w); meaningless where locked
  /// Speed of the rim in the measure of forward and lateral: 1, and 0 where locked.
  double rim() const { return locked ? 0.0 : 1.0; }
};

/// Kinematics of an operating condition. Throws InputError for |slip| > 1, |yaw| > 90 deg, and for 90 deg of yaw
/// with a slip by the wheel's plane (the speed in that plane is then zero and says nothing of the rim's).
Kinematics kinematics(const OperatingCondition& at);

}  // namespace soilbin::bekker_wong
