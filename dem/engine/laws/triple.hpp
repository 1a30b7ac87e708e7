// Three numbers of any kind: doubles or packs. The scalar functions that packs have too stand here, so that a law can
// be written once. Everything is inlined: see contact_law.hpp.
#pragma once

namespace soilbin::dem {

[[gnu::always_inline]] inline double sqrt(double a) { return __builtin_sqrt(a); }
[[gnu::always_inline]] inline double min(double a, double b) { return a < b ? a : b; }
[[gnu::always_inline]] inline double max(double a, double b) { return a > b ? a : b; }
[[gnu::always_inline]] inline double select(bool yes, double a, double b) { return yes ? a : b; }

template <class Real>
struct Triple {
  Real x, y, z;

  [[gnu::always_inline]] friend Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend Triple operator-(const Triple& a) { return {-a.x, -a.y, -a.z}; }
  [[gnu::always_inline]] friend Triple operator*(const Real& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  [[gnu::always_inline]] friend Triple operator*(const Triple& a, const Real& s) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class Real>
[[gnu::always_inline]] inline Real dot(const Triple<Real>& a, const Triple<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
[[gnu::always_inline]] inline Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Mask, class Real>
[[gnu::always_inline]] inline Triple<Real> select(const Mask& yes, const Triple<Real>& a, const Triple<Real>& b) {
  return {select(yes, a.x, b.x), select(yes, a.y, b.y), select(yes, a.z, b.z)};
}

}  // namespace soilbin::dem
