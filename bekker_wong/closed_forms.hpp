// Answers on the back of an envelope: closed forms that need no balance, and the source paper's own equations.
#pragma once

#include "bekker_wong/contact_patch.hpp"

namespace soilbin::bekker_wong {

/// Bekker's static sinkage of a towed rigid wheel [m], z = [3 W/((3 - n) b k sqrt(D))]^(2/(2n + 1)) with
/// k = k_c/b + k_phi and D = 2r (Bekker 1956; Wong, Theory of Ground Vehicles). For n < 3; load [N] >= 0.
double bekker_static_sinkage(const SoilValues& soil, double radius, double width, double load);

/// Compaction resistance of a rut of depth z [N], R_c = b k z^(n+1)/(n + 1) (Bekker 1956).
double compaction_resistance(const SoilValues& soil, double width, double sinkage);

/// Bekker's rolling resistance of a towed rigid wheel [N]: compaction_resistance at bekker_static_sinkage.
double rolling_resistance(const SoilValues& soil, double radius, double width, double load);

/// Wong's critical ground pressure [Pa]: the soil's pressure under the rigid wheel at Bekker's static sinkage,
/// p_gcr = k^(1/(2n+1)) [3 W/((3 - n) b sqrt(D))]^(2n/(2n+1)) = k z^n. A pneumatic tire whose inflation plus carcass
/// pressure exceeds it rolls as if rigid (Wong, Theory of Ground Vehicles, ch. 2).
double critical_ground_pressure(const SoilValues& soil, double radius, double width, double load);

/// The source paper's equations as they stand in it, with their faults named. None is used by the model.
namespace paper {

/// Eq. 1: drawbar pull [N] with the integral from 0 to theta_1. Fault: the contact starts at theta_2, so soil behind
/// the axle is left out; equal to the base model's only where theta_2 = 0. shear and normal: tau, sigma [Pa] of theta.
double drawbar_pull(double (*shear)(double), double (*normal)(double), double radius, double width, double theta_1);

/// Eq. 2: axle torque [N m] = driving couple less the ground's friction couple.
double axle_torque(double driving_couple, double friction_couple);

/// Eq. 3, TE = F_DP r/M (1 - i). Printed as '(4i)', a misprint: (1 - i) is what the definition gives.
double tractive_efficiency(double drawbar_pull, double torque, double radius, double slip);

/// Eq. 4: slip i = 1 - v/(w0 r).
double slip(double speed, double spin, double radius);

/// Eq. 5: z = Bekker's static sinkage + (D/2)(1 - i) theta_m [m]. Faults: the second term, called slip sinkage, falls
/// with slip where measured slip sinkage rises; and it is the arc length that rolls past theta_m, not a depth.
double sinkage(const SoilValues& soil, double radius, double width, double load, double slip, double theta_m);

}  // namespace paper
}  // namespace soilbin::bekker_wong
