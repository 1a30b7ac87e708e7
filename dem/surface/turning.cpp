#include "dem/surface/turning.hpp"

#include <cmath>

namespace soilbin::dem {
namespace {

Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 over(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

}  // namespace

Vec3 angular_momentum(const Rotation& rotation, const Vec3& inertia, const Vec3& spin) {
  return rotation(times(inertia, rotation.inverse()(spin)));
}

Vec3 over_inertia(const Rotation& rotation, const Vec3& inertia, const Vec3& momentum) {
  return rotation(over(rotation.inverse()(momentum), inertia));
}

Vec3 spin_rate(const Rotation& rotation, const Vec3& inertia, const Vec3& spin, const Vec3& torque) {
  return over_inertia(rotation, inertia, torque - cross(spin, angular_momentum(rotation, inertia, spin)));
}

/// At the half step the body has turned by half a step's turn more than now, so the spin is found by iteration.
Vec3 spin_after(const Rotation& rotation, const Vec3& inertia, const Vec3& spin, const Vec3& torque, double dt) {
  const Vec3 before = rotation_by(-dt / 2 * spin)(angular_momentum(rotation, inertia, spin));
  const Vec3 momentum = before + dt * torque;
  Vec3 after = spin;
  for (int k = 0; k < 8; ++k) {
    const Vec3 next = over_inertia(rotation, inertia, rotation_by(-dt / 2 * after)(momentum));
    if (next == after) break;
    after = next;
  }
  return after;
}

Rotation turned(const Rotation& rotation, const Vec3& turn) {
  if (turn == Vec3{}) return rotation;
  const Rotation q = rotation_by(turn) * rotation;
  const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}

}  // namespace soilbin::dem
