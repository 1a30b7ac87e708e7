// A run's answer from its samples: the steady part, means with errors, stresses under the wheel, the balance of power.
#pragma once

#include <span>

#include "dem/rig/wheel_run.hpp"

namespace soilbin::dem {

/// Whether samples so far make a steady part whose mean pull has a standard error of Rig::until_error of the load.
bool pull_is_known(std::span<const WheelSample> samples, const Tire& tire, const OperatingCondition& at,
                   const Rig& rig);

/// Finds the steady part of run.samples and fills in everything that follows
/// from it.
void summarise(WheelRun& run, const Tire& tire, const OperatingCondition& at, const Rig& rig);

}  // namespace soilbin::dem
