// What a granular medium does to a small plane element that is pushed through it: three-dimensional resistive force
// theory (3D-RFT) of Agarwal, Goldman and Kamrin (2023), "Mechanistic framework for reduced-order models in soft
// materials: application to three-dimensional granular intrusion", PNAS 120(4) e2214017120.
//
//   const Response down = response({0, 0, -1}, {0, 0, -1}, {0, 0, 1});  // a level plate pushed down
//   xi_n * depth * -dot(down.normal, {0, 0, -1})                        // its pressure [Pa]: 0.875 xi_n depth
#pragma once

#include "dem/surface/vec3.hpp"

namespace soilbin::resistive_force {

using dem::Vec3;

/// Traction on an element, over xi_n and depth [-].
struct Response {
  Vec3 normal;      ///< along the element's normal, into the body
  Vec3 tangential;  ///< in the element's plane, against the motion; before friction of the surface bounds it
};

/// The fits f_1, f_2, f_3 in their three invariants (Agarwal 2023, supporting information).
struct ResponseFits {
  double f1 = 0.0, f2 = 0.0, f3 = 0.0;
};
/// x1 = sin(gamma): how far the motion points down; x2 = cos(beta): how level the element lies; x3: how squarely it is
/// pushed. Each -1 .. 1.
ResponseFits response_fits(double x1, double x2, double x3);

/// The response to an element with outward unit normal n that moves along the unit vector v; `up`, a unit vector, is
/// against gravity. Zero where the element moves away from the medium (n . v < 0).
///
/// In the paper's frame of angles (beta, gamma, psi) alpha_r = f1 sin(beta) cos(psi) + f2 cos(gamma), alpha_theta = f1
/// sin(beta) sin(psi), alpha_z = -f1 cos(beta) - f2 sin(gamma) - f3. With m the one of n and -n that points down this
/// is alpha = f1 m + f2 v - f3 up, x1 = -v . up, x2 = -m . up, x3 = m . v: no angles, no special directions
/// (response_test.cpp holds it against the angles). The paper's fits are not the same to both sides of a vertical
/// element, where m changes sign: up to a tenth of a level plate's response. One within 1e-9 of vertical counts as
/// facing up.
Response response(const Vec3& n, const Vec3& v, const Vec3& up);

/// Traction over xi_n and depth, with the surface's friction coefficient: the tangential part bounded by
/// surface_friction |normal|.
Vec3 traction(const Response& response, double surface_friction);

/// The response to a level plate that is pushed straight down [-]: its pressure is this times xi_n and depth.
double plate_response();

/// xi_n of a dry sand from its bulk density [kg/m^3], the tangent of its angle of internal friction and gravity
/// [m/s^2]: rho g (894 mu^3 - 386 mu^2 + 89 mu) [N/m^3] (Agarwal 2023).
double estimated_xi_n(double bulk_density, double internal_friction, double gravity);

}  // namespace soilbin::resistive_force
