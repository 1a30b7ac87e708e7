// How a rigid body turns under a torque: what bodies and clumps of grains share. Inertia is about the principal axes,
// the body's own x, y, z; `rotation` leads from its frame to that of the bin.
//
//   spin = spin_after(rotation, inertia, spin, torque, dt);   // from half step to half step
//   rotation = turned(rotation, dt * spin);
#pragma once

#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

/// I w in the frame of the bin [kg m^2/s].
Vec3 angular_momentum(const Rotation& rotation, const Vec3& inertia, const Vec3& spin);
/// I^-1 T in the frame of the bin: of an angular momentum the spin [rad/s], of a torque the change of spin.
Vec3 over_inertia(const Rotation& rotation, const Vec3& inertia, const Vec3& momentum);
/// How a free body's spin changes at once: I^-1 (T - w x I w) [rad/s^2].
Vec3 spin_rate(const Rotation& rotation, const Vec3& inertia, const Vec3& spin, const Vec3& torque);

/// The spin half a step after `rotation`, from that half a step before and the torque now. The angular momentum is that
/// of before and the torque's, to rounding: without a torque it never changes.
Vec3 spin_after(const Rotation& rotation, const Vec3& inertia, const Vec3& spin, const Vec3& torque, double dt);

/// `rotation`, then by `turn` [rad] in the frame of the bin; of length 1 again.
Rotation turned(const Rotation& rotation, const Vec3& turn);

}  // namespace soilbin::dem
