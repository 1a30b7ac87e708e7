// The base model's stages: each fills its arrays of the contact patch from those before it (docs/conventions.md).
#pragma once

#include "bekker_wong/contact_patch.hpp"
#include "bekker_wong/kinematics.hpp"

namespace soilbin::bekker_wong {

/// theta_m = (c1 + c2 |s|) theta_1, held below 0.98 theta_1 and not behind the exit; theta_2 = 0.
ContactAngles base_angles(double theta_1, const SoilValues& soil, const Kinematics& motion);

/// Nodes a segment that give the stress integrals to 1e-9: more for a hard shear curve (small K/r) and for braking.
int nodes_per_segment(const SoilValues& soil, const Outline& outline, const Kinematics& motion);

/// Lays nodes over [theta_2, theta_1], split at theta_m and, for a braked wheel, where the shear displacement changes
/// sign; crowded toward the ends where the pressure law's z^n is singular (theta_1, theta_2).
void fill_geometry(ContactPatch& patch, const ContactAngles& angles, const Outline& outline, const Kinematics& motion,
                   int nodes);

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
