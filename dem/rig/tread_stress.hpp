// Stresses under a wheel against the angle from the vertical, from the contacts of grains with it.
#pragma once

#include <vector>

#include "dem/engine/simulation.hpp"
#include "dem/rig/wheel_motion.hpp"
#include "scenario/tire.hpp"
#include "scenario/traction_result.hpp"

namespace soilbin::dem {

/// Forces of the grains on a wheel, sorted by where they act: sector k of n is
/// between angles -pi + 2 pi k/n and the next, from the downward normal of the
/// bin, entry side positive. Contacts on lugs and sidewalls count where they
/// are.
struct TreadForces {
  std::vector<Vec3> sectors;  ///< pressing inward, forward along the rim, to the left [N]
  double thrust = 0;          ///< along the wheel's heading, of forces along the rim [N]
  double resistance = 0;      ///< along the heading, of forces toward the axle [N]
  double side = 0;            ///< along the axle [N]

  TreadForces& operator+=(const TreadForces& other);
};

/// Sorts the contacts that a body, a wheel, has with grains now.
TreadForces tread_forces(const std::vector<Contact>& contacts, int body, const Vec3& centre, const WheelMotion& motion,
                         int sectors);

/// Mean stresses over the tread base, forces over radius x angle x width, for
/// the sectors between the first and the last that bears at least a hundredth
/// of the largest.
std::vector<StressSample> tread_stress(const TreadForces& sum, double count, const Tire& tire);

}  // namespace soilbin::dem
