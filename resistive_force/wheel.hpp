// The wheel in balance with its load by resistive force theory: at one depth of its axle, over all turns of its lugs,
// the soil carries what presses on it.
//
//   const PushedWheel wheel(tread_elements(tire), tire, condition);
//   const Balance balance = wheel.balance({.xi_n = 8e5, .surface_friction = 0.5});
//   balance.sinkage, balance.forces.pull, balance.by_xi_n.pull  // [m], [N], [N per N/m^3]
#pragma once

#include <array>
#include <vector>

#include "resistive_force/tread_elements.hpp"
#include "scenario/operating_condition.hpp"
#include "scenario/tire.hpp"

namespace soilbin::resistive_force {

/// What the theory knows of a soil.
struct Medium {
  double xi_n = 0.0;              ///< [N/m^3], > 0
  double surface_friction = 0.0;  ///< between soil and wheel [-], >= 0
};

/// Forces of the soil on a wheel, mean over the turns of its lugs: along travel, to its left, out of the ground;
/// moment about the axle that keeps it turning.
struct SoilForces {
  double pull = 0.0, left = 0.0, vertical = 0.0;  ///< [N]
  double torque = 0.0;                            ///< [N m]
};

/// A wheel in balance, and how it changes with the medium while the load stays.
struct Balance {
  double sinkage = 0.0;  ///< depth of the tread base's lowest point below the surface [m]
  SoilForces forces;
  struct Slopes {
    double sinkage = 0.0;
    SoilForces forces;
  };
  Slopes by_xi_n;  ///< derivatives of the balanced wheel
};

/// What a strip across the wheel bears, per area of the tread base below it.
struct StripStress {
  double theta = 0.0;    ///< its middle, from the lowest point, entry positive [rad]
  double normal = 0.0;   ///< into the wheel [Pa]
  double shear = 0.0;    ///< along the tread; positive pushes the wheel forward [Pa]
  double lateral = 0.0;  ///< along the axle, to the left [Pa]
};

/// A wheel that rolls on a plane at one condition. The direction in which each element moves, and so what it meets,
/// does not change with depth; so the depth is found last, and cheaply.
class PushedWheel {
 public:
  /// On a slope the theory's frame turns with the surface, whose depth is then measured square to it, and the stresses
  /// are those of gravity's part in that direction, xi_n cos(alpha) cos(beta_t): our choice, as the published theory
  /// has level ground. That soil gives way more easily downhill is not in
  /// it. An element that slides along itself (of a smooth wheel that spins on the spot or moves along its axle) counts
  /// as it would with a little more way forward; a side without yaw by half, for left and right. Throws InputError for
  /// an impossible condition.
  PushedWheel(const TreadElements& elements, const Tire& tire, const OperatingCondition& at);

  /// The depth at which the soil carries the load that presses on the surface, W cos(alpha) cos(beta_t): the shallowest
  /// one. Throws NoSolution where none down to 0.9 of the radius does.
  Balance balance(const Medium& medium) const;

  /// Forces at a sinkage, balanced or not.
  SoilForces forces(const Medium& medium, double sinkage) const;
  /// The forces at a sinkage by WheelPart.
  std::array<SoilForces, 3> forces_of_parts(const Medium& medium, double sinkage) const;
  /// Mean stresses on strips of equal angle, from exit to entry; none that bears nothing.
  std::vector<StripStress> strips(const Medium& medium, double sinkage, int count = 72) const;

 private:
  /// An element at one turn of the wheel that moves into the soil once it is deep enough.
  struct Contact {
    Vec3 place;   ///< from the middle of the axle, in the frame of travel: x along it, y left, z out of the ground
    Vec3 normal;  ///< response over xi_n and depth, times area
    Vec3 tangential;
    double level = 0.0;  ///< how far it reaches below the tread base's lowest point [m]
    WheelPart part = WheelPart::tread;
  };
  struct Sums;
  std::vector<Vec3> weighed(const Medium& medium) const;
  void add(SoilForces& to, const Vec3& force, const Contact& contact) const;
  Sums sums(const std::vector<Vec3>& by_depth, double sinkage) const;

  std::vector<Contact> contacts_;
  Tire tire_;
  OperatingCondition at_;
  Vec3 axle_;                   ///< to the left
  double gravity_share_ = 1.0;  ///< gravity's part square to the surface [-]
  double turns_ = 1.0;          ///< of the lugs, that forces are the mean of
};

}  // namespace soilbin::resistive_force
