// What hot loops read and write of a grain, a row each, and what they add up beside it. Plain data.
#pragma once

#include "dem/surface/vec3.hpp"

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
struct alignas(64) LedgerLoad {
  Vec3 dashpot;             ///< of normal dashpots [N]
  Vec3 slide;               ///< tangential [N]
  alignas(64) Vec3 couple;  ///< of rolling resistance [N m]
};

/// Powers that contacts take from the motion, summed [W]; parts as in Losses of the law and in EnergyLosses.
struct LostPower {
  double damping = 0, shear_damping = 0, sliding = 0, into_slide = 0, into_roll = 0;
  LostPower& operator+=(const LostPower& other) {
    damping += other.damping, shear_damping += other.shear_damping, sliding += other.sliding;
    into_slide += other.into_slide, into_roll += other.into_roll;
    return *this;
  }
};

}  // namespace soilbin::dem
