#include "dem/surface/turning.hpp"

#include <cmath>

namespace soilbin::dem {
namespace {

Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 over(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

/// `a` turned by |turn| radians about turn's direction, by Rodrigues' formula. Turns of a step are small: their sine
/// and cosine are the first terms of the series, to rounding.
Vec3 turned_by(const Vec3& turn, const Vec3& a) {
  const double t = squared(turn);
  double sine = 1 - t * (1 / 6.0 - t * (1 / 120.0 - t * (1 / 5040.0)));        // sin(angle)/angle
  double cosine = 0.5 - t * (1 / 24.0 - t * (1 / 720.0 - t * (1 / 40320.0)));  // (1 - cos(angle))/angle^2
  if (t > 1e-3) {
    const double angle = std::sqrt(t);
    sine = std::sin(angle) / angle;
    cosine = (1 - std::cos(angle)) / t;
  }
  const Vec3 across = cross(turn, a);
  return a + sine * across + cosine * cross(turn, across);
}

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

/// In the body's frame of now. At the half step the body has turned by half a step's turn more, so the spin is found by
/// iteration; its turn about its own axis leaves the spin itself as it is.
Vec3 spin_after(const Rotation& rotation, const Vec3& inertia, const Vec3& spin, const Vec3& torque, double dt) {
  const Rotation back = rotation.inverse();
  const double half = -dt / 2;
  const Vec3 old = back(spin);
  const Vec3 momentum = turned_by(half * old, times(inertia, old)) + dt * back(torque);
  const Vec3 inverse{1 / inertia.x, 1 / inertia.y, 1 / inertia.z};
  Vec3 now = times(inverse, momentum);
  for (int k = 0; k < 32; ++k) {
    const Vec3 next = times(inverse, turned_by(half * now, momentum));
    const double change = squared(next - now);
    now = next;
    if (half * half * change <= 1e-32) break;  // the next turn would leave a share of half |now| of that change
  }
  return rotation(now);
}

Rotation turned(const Rotation& rotation, const Vec3& turn) {
  if (turn == Vec3{}) return rotation;
  const Rotation q = rotation_by(turn) * rotation;
  const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}

}  // namespace soilbin::dem
