// Tractive efficiency: the share of the power put into a wheel that comes out as pull along its travel. The one
// definition for every model and for measurements.
//
//   result.tractive_efficiency = tractive_efficiency(result, tire.radius);
//   if (!has_efficiency(result)) fmt::print("{}\n", why_no_efficiency(result));  // reported_efficiency gives NaN then
#pragma once

#include <string>
#include <vector>

#include "scenario/traction_result.hpp"

namespace soilbin {

/// F_DP along the direction of travel [N], whichever frame the result is told in.
double pull_along_travel(const TractionResult& result);

/// The ratio of powers in a steady state,
///
///   TE = F_DP v / (M w + P_g),   P_g = W sin(-alpha) v downhill (alpha < 0), 0 on level ground and uphill,
///
/// F_DP: drawbar pull along travel, v: speed of travel, M: torque, w: rotation, W: load, alpha: longitudinal incline.
/// Power put out is that at the drawbar, after Wong, Theory of Ground Vehicles (drawbar power over the power put in):
/// the force along travel times the speed of travel, whatever frame forces are told in. So climbing counts as a
/// resistance, since F_DP is less the slope's share of the load. Downhill that share pulls: the power that gravity puts
/// in counts as put in (our choice; without it the ratio passes 1). On a cross slope gravity does no work along travel.
///
/// `radius` [m] and the result's slip give v/w. Negative where the wheel is pushed. NaN where nothing is driven (M <=
/// 0, a locked wheel) and where a force that it takes is NaN.
double tractive_efficiency(const TractionResult& result, double radius);

/// Whether the ratio that a result holds is an efficiency: the wheel is driven and pulls along its travel (0 or more),
/// and gives out no more than is put in.
bool has_efficiency(const TractionResult& result);

/// The tractive efficiency [-] as every table, file and binding reports it: NaN unless has_efficiency.
double reported_efficiency(const TractionResult& result);

/// Why a result has no efficiency, for people: "the wheel has to be pushed or braked"; "" where it has one.
std::string why_no_efficiency(const TractionResult& result);

/// The ratio that a result holds with its standard error, from those of forces and torque taken as independent.
Estimate efficiency_with_error(const TractionResult& result);

/// Several results at one condition: all power put out over all power put in.
double mean_efficiency(const std::vector<const TractionResult*>& results);

}  // namespace soilbin
