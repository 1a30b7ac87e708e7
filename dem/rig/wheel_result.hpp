// A run's answer from its samples: the steady part, means with errors, stresses under the wheel, the balance of power.
#pragma once

#include "dem/rig/wheel_run.hpp"

namespace soilbin::dem {

/// Finds the steady part of run.samples and fills in everything that follows
/// from it.
void summarise(WheelRun& run, const Tire& tire, const OperatingCondition& at, const Rig& rig);

}  // namespace soilbin::dem
