// How the time step of a run compares with the two times that bound it: the Rayleigh time, and how long an impact
// lasts.
#pragma once

#include "dem/bed/settled_bed.hpp"
#include "dem/rig/wheel_run.hpp"

namespace soilbin::dem {

/// Both times are those of the smallest grain of the soil, the shortest there are.
struct StepCriteria {
  double step = 0;      ///< that the run takes [s]
  double rayleigh = 0;  ///< rayleigh_time [s]
  double speed = 0;     ///< of the impact below: that of the rim, the fastest thing that meets a grain [m/s]
  double hertz = 0;     ///< hertz_time of two grains at that speed [s]
};

/// The rig's step, else the bed's, else longest_step [s].
double step_of(const BedRecipe& recipe, const Rig& rig);

StepCriteria step_criteria(const BedRecipe& recipe, const Rig& rig, double rim_speed);

/// Speed of the lugs' tops at a condition [m/s]. Throws what wheel_motion throws.
double rim_speed(const Tire& tire, const OperatingCondition& at);

}  // namespace soilbin::dem
