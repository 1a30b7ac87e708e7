// The rows that hot loops read and write; plain data.
#pragma once

#include "dem/engine/vec3.hpp"

namespace soilbin::dem {

/// What every contact of a grain reads. 64 bytes.
struct alignas(64) Motion {
  Vec3 position;            ///< [m]
  double radius = 0;        ///< [m]
  Vec3 velocity;            ///< at the half step before the position's time [m/s]
  double inverse_mass = 0;  ///< [1/kg]; 0: nothing moves it
  bool held() const { return inverse_mass == 0; }
};

/// The rest of what contacts read. 32 bytes.
struct alignas(32) Spin {
  Vec3 rate;                   ///< at the half step [rad/s]
  double inverse_inertia = 0;  ///< [1/(kg m^2)]
};

/// What contacts add up. 64 bytes.
struct alignas(64) Load {
  Vec3 force;   ///< [N]
  Vec3 torque;  ///< about the centre [N m]
};

/// The part of a Load that takes energy out of the motion, or keeps it in tangential and rolling springs; added up
/// where the ledger is kept. 128 bytes, two rows of eight doubles.
struct alignas(64) Taking {
  Vec3 dashpot;             ///< of normal dashpots [N]
  Vec3 slide;               ///< tangential [N]
  alignas(64) Vec3 couple;  ///< of rolling resistance [N m]
};

}  // namespace soilbin::dem
