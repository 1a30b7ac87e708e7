// How a vehicle stands on its wheels: the tilt that their sinkages give it, moments of forces on it, and the loads of
// its axles. Steady and in time.
#pragma once

#include <vector>

#include "compare/vehicle/vehicle.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::compare {

/// The plane a + b x + c y through the wheels' sinkages, by least squares; b and c are 0 where nothing tells them.
struct SinkagePlane {
  double along = 0.0, across = 0.0;
};

SinkagePlane plane_through(const std::vector<VehiclePoint>& points);

/// A point of the vehicle in axes along the ground, when it is tilted [rad].
VehiclePoint tilted(const VehiclePoint& p, double nose_down, double left_down);

/// Sums of forces along the vehicle and of their moments about a point.
struct Wrench {
  double pitch = 0.0, roll = 0.0, yaw = 0.0;  ///< nose down, right side down, nose to the left [N m]

  void add(const VehiclePoint& at, const GroundForce& along, double up) {
    pitch += at.z * along.forward - at.x * up;
    roll += at.y * up - at.z * along.left;
    yaw += at.x * along.left - at.y * along.forward;
  }
};

/// What carries a vehicle that is alike on both sides: an axle with its wheels.
struct CarryingAxle {
  double stiffness = 1.0;  ///< of its wheels together, in any unit
  double spring = 0.0;     ///< x of its spring on the frame [m]
  double place = 0.0;      ///< x of its axle along the ground, when the vehicle is tilted [m]
};

/// Loads of axles normal to the ground [N], none negative: a rigid frame on springs, k_i (a + b x_i), which carries
/// `normal` [N] and balances the moment `pitch` [N m] of all else about x = 0, nose down: Sum N_i place_i = pitch. An
/// axle that would pull is off the ground. One axle is held level as in a rig; where one is left of several, it carries
/// all, and the vehicle tips over.
std::vector<double> axle_loads(const std::vector<CarryingAxle>& axles, double normal, double pitch);

}  // namespace soilbin::compare
