// Volume, centroid and moments of inertia of the body that a closed mesh bounds, or that spheres fill together; volume
// and mass of a sphere.
#pragma once

#include <numbers>
#include <span>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// At unit density. The tensor is I = Int (|x|^2 1 - x x^T) dV about the centroid, so xy = -Int x y dV.
struct MassProperties {
  double volume = 0;                                      ///< [m^3]
  Vec3 centroid;                                          ///< [m]
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  ///< [m^5]
};

/// The sum over the tetrahedra from the box's centre o to each triangle, with a, b, c its corners from o,
/// s = a + b + c and D = a . (b x c), six times the tetrahedron's signed volume:
///   Int dV = D/6,  Int x dV = D s/24,  Int x_i x_j dV = D (s_i s_j + a_i a_j + b_i b_j + c_i c_j)/120.
/// Throws std::logic_error where the mesh is not closed.
MassProperties mass_properties(const TriangleMesh& mesh);

struct Sphere {
  Vec3 centre;        ///< [m]
  double radius = 0;  ///< [m]
};

/// Mass properties of the union of spheres: an overlap counts once. By the divergence theorem over the part of each
/// sphere that no other hides, n its normal,
///   Int dV = Int x.n dA/3,  Int x dV = Int x (x.n) dA/4,  Int x_i x_j dV = Int x_i x_j (x.n) dA/5,
/// in Gauss quadrature, latitude by latitude: to 1e-9 for two spheres, 1e-6 where three overlap. Throws InputError
/// where a radius isn't above 0, or two spheres are the same.
MassProperties mass_properties(std::span<const Sphere> spheres);

/// The principal moments about the centroid at unit density [m^5], and the rotation from the principal axes to the
/// frame in which the properties were taken: none where that has them already.
struct PrincipalAxes {
  Vec3 inertia;
  Rotation rotation;
};
PrincipalAxes principal_axes(const MassProperties& properties);

/// Volume [m^3] of a sphere of this radius [m], and its mass [kg] with a density [kg/m^3].
constexpr double sphere_volume(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }
constexpr double sphere_mass(double density, double radius) {
  return density * 4 / 3 * std::numbers::pi * radius * radius * radius;
}

}  // namespace soilbin::dem
