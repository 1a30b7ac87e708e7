// How fast a vehicle goes and how steep it climbs at a speed, by the torque and the power of its motors.
#pragma once

#include "compare/vehicle/vehicle_answers.hpp"

namespace soilbin::compare {

/// Whether a vehicle declares a power, or a motor with a torque curve.
bool is_limited(const VehicleCase& question);

/// The speed at which a power is used up [m/s]: forces and slips do not depend on speed, so that the power that the
/// wheels take grows as it.
double speed_at_power(double power, const SteadyVehicle& steady);

/// What one drive line's power and motor let a steady state travel at most: as slips and torques do not depend on
/// speed, the largest spin W of the drive line at which
///
///   M <= eta i T(i W)   and   M W <= P,   M W = power into the wheels.
///
/// Effects that read the speed are taken at that of the state. Without an error; for a vehicle without motors of axles.
FastestTravel fastest_of(const VehicleCase& question, const SteadyVehicle& steady);

/// What power and motor give beyond what a steady state takes at its speed, over that: the smallest such share; none
/// where nothing limits it. For a vehicle without motors of axles as far as its motor goes.
struct SpareDrive {
  double share = 0.0;
  TravelLimit limit = TravelLimit::torque;
};
std::optional<SpareDrive> spare_of(const VehicleCase& question, const SteadyVehicle& steady);

/// What of power and motors does not hold a steady state at its speed; none where they do.
std::optional<TravelLimit> not_held_by(const VehicleCase& question, const SteadyVehicle& steady);

/// The fastest travel in a condition: of a drive line by fastest_of, of a motor a wheel by bisection, since a motor at
/// its limit leaves its share to the others. Without an error.
FastestTravel fastest_travel(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                             const VehicleCondition& at);

/// Lays fastest, gradeability and climbs into answers that have all else.
void add_speeds(VehicleAnswers& answers, const Model& model);

}  // namespace soilbin::compare
