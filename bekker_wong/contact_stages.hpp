// The base model's stages: each fills its arrays of the contact patch from those before it
// (docs/reference/conventions.md).
#pragma once

#include <span>

#include "bekker_wong/contact_patch.hpp"
#include "bekker_wong/kinematics.hpp"

namespace soilbin::bekker_wong {

/// Most that theta_m may be of theta_1.
inline constexpr double max_stress_share = 0.98;

/// theta_m = (c1 + c2 |s|) theta_1, held below max_stress_share theta_1 and not behind the exit; theta_2 = 0.
ContactAngles base_angles(double theta_1, const SoilValues& soil, const Kinematics& motion);

/// How quadrature nodes are laid over the contact.
struct NodeLayout {
  int per_segment = 16;         ///< a multiple of 4, 8 .. 64
  int crowding = 4;             ///< nodes crowd toward singular ends as t^crowding, 3 or 4
  bool crowd_at_crest = false;  ///< also behind theta_m: where a short front leaves the shear curve's rise to the rear
};

/// The layout that gives the stress integrals to 2e-9 of their scale: more nodes for a hard shear curve (much shear
/// displacement over K), for braking, and for the z^n of a small n. Found by measurement (docs/lab/performance.md).
NodeLayout node_layout(const SoilValues& soil, const Outline& outline, const Kinematics& motion,
                       const ContactAngles& angles);

/// A layout with half the nodes: good to about 1e-4, for the first steps of a search.
NodeLayout coarse(const NodeLayout& layout);

/// Lays nodes over [theta_2, theta_1], split at theta_m and, for a braked wheel, where the shear displacement changes
/// sign; crowded toward the ends where the pressure law's z^n is singular (theta_1, theta_2).
void fill_geometry(ContactPatch& patch, const ContactAngles& angles, const Outline& outline, const Kinematics& motion,
                   const NodeLayout& layout);
/// Lays nodes at theta_1 - since_entry [rad], which grow from the entry to the exit; the arcs are lengths a radian [m].
void fill_geometry(ContactPatch& patch, const ContactAngles& angles, const Outline& outline,
                   std::span<const double> since_entry);

/// sigma = (k_c/b + k_phi) depth^n (Bekker 1969; Wong and Reece 1967).
void fill_pressure(ContactPatch& patch, const SoilValues& soil, const Outline& outline);

/// j_x = R [(theta_1 - theta) - v_x/(r w) (sin theta_1 - sin theta)], j_y = R v_y/(r w) (theta_1 - theta), with R the
/// shear radius; covers driven and braked wheels alike (Wong and Reece 1967; Ishigami 2007 for j_y).
void fill_displacement(ContactPatch& patch, const Outline& outline, const Kinematics& motion);

/// strength = c + sigma tan(phi), modulus = K.
void fill_strength(ContactPatch& patch, const SoilValues& soil);

/// |j| at the nodes into `j`, and the share of the strength that it mobilises, 1 - exp(-|j|/K) (Janosi and Hanamoto
/// 1961); 1 for a locked wheel.
void fill_mobilised(ContactPatch& patch, ContactPatch::Array& j, const Kinematics& motion);

/// tau = strength * mobilised along (j_x, j_y); j: |j| at the nodes.
void fill_shear(ContactPatch& patch, const ContactPatch::Array& j);

}  // namespace soilbin::bekker_wong
