// Vectors and rotations: what all of dem computes places, forces and spins with.
#pragma once

#include <cmath>

namespace soilbin::dem {

/// A point, direction or axial vector in the frame of the bin, SI. Plain data: it lies in archives as three doubles.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return s * a; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, const Vec3& b) { return a = a - b; }
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared(const Vec3& a) { return dot(a, a); }
inline double length(const Vec3& a) { return std::sqrt(squared(a)); }
/// a/|a|; a must not be zero.
inline Vec3 unit(const Vec3& a) { return a / length(a); }

/// A rotation: a unit quaternion, from the frame of a body to that of the bin.
struct Rotation {
  double w = 1, x = 0, y = 0, z = 0;
  bool operator==(const Rotation&) const = default;

  constexpr Vec3 operator()(const Vec3& a) const {
    const Vec3 q{x, y, z};
    const Vec3 t = 2 * cross(q, a);
    return a + w * t + cross(q, t);
  }
  constexpr Rotation inverse() const { return {w, -x, -y, -z}; }
};

/// A rotation as a matrix, by its columns: for turning many vectors alike.
struct RotationMatrix {
  Vec3 x, y, z;  ///< where the axes are turned to
  constexpr Vec3 operator()(const Vec3& a) const { return a.x * x + a.y * y + a.z * z; }
};

constexpr RotationMatrix matrix_of(const Rotation& q) {
  const double x = 2 * q.x, y = 2 * q.y, z = 2 * q.z;
  return {{1 - y * q.y - z * q.z, x * q.y + z * q.w, x * q.z - y * q.w},
          {x * q.y - z * q.w, 1 - x * q.x - z * q.z, y * q.z + x * q.w},
          {x * q.z + y * q.w, y * q.z - x * q.w, 1 - x * q.x - y * q.y}};
}

constexpr Rotation operator*(const Rotation& a, const Rotation& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// The rotation by |turn| radians about turn's direction; exact for every size.
inline Rotation rotation_by(const Vec3& turn) {
  const double angle = length(turn);
  if (angle == 0) return {};
  const Vec3 q = (std::sin(angle / 2) / angle) * turn;
  return {std::cos(angle / 2), q.x, q.y, q.z};
}

}  // namespace soilbin::dem
