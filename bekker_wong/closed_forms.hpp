// Closed forms for a towed rigid wheel that need no force balance (static sinkage, rolling resistance, critical ground
// pressure, by Bekker and Wong), and the source paper's estimate of sinkage. For checks by hand.
//
//   const double z = bekker_static_sinkage(soil, 0.25, 0.15, 1000);  // [m]; radius and width [m], load [N]
//   const double resistance = compaction_resistance(soil, 0.15, z);  // [N]; the same as rolling_resistance(...)
#pragma once

#include <optional>

#include "bekker_wong/contact_patch.hpp"
#include "scenario/soil.hpp"
#include "scenario/tire.hpp"

namespace soilbin::bekker_wong {

/// Length of the contact of a wheel that stands this deep [m]: from the lowest point to where the undisturbed surface
/// meets it, r acos(1 - z/r); of one over its axle a quarter of its circle.
double contact_length(double sinkage, double radius);

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

/// The slope from which on a long slope of soil slides by itself on a plane `depth` [m] below its surface, of soil with
/// this cohesion [Pa], friction angle [rad] and unit weight [N/m^3]: c + w cos(beta)^2 tan(phi) = w sin(beta)
/// cos(beta), w = unit weight times depth (the infinite slope without water, after Taylor 1948). phi where c = 0; none:
/// at no slope below 90 deg.
std::optional<double> infinite_slope_angle(double cohesion, double friction_angle, double unit_weight, double depth);
/// That of a soil with semi_empirical values at a depth of the tire's radius [rad].
std::optional<double> sliding_slope(const Soil& soil, const Tire& tire);

/// The source paper's equations as they stand in it. Of its Eqs. 1 to 4, which are those of the model or of
/// docs/reference/conventions.md, two have a fault: Eq. 1 takes the drawbar pull's integral from 0 on, not from
/// theta_2, so soil behind the axle is left out; Eq. 3 prints '(4i)' for the efficiency's (1 - i).
namespace paper {

/// Eq. 5: z = Bekker's static sinkage + (D/2)(1 - i) theta_m [m]. Faults: the second term, called slip sinkage, falls
/// with slip where measured slip sinkage rises; and it is the arc length that rolls past theta_m, not a depth.
/// `soilbin explain` shows it beside the model's.
double sinkage(const SoilValues& soil, double radius, double width, double load, double slip, double theta_m);

}  // namespace paper
}  // namespace soilbin::bekker_wong
