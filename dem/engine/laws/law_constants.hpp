// The choice of contact laws, and their constants for a pair of materials: the factors by which the laws' formulas
// multiply, worked out before the steps. Symbols: docs/theory/dem-laws.md.
#pragma once

#include <cstdint>

namespace soilbin::dem {

enum class NormalLaw : std::uint8_t { hertz, hooke };
/// The values stand in keys of beds and in records, so they stay what they are.
enum class RollingLaw : std::uint8_t {
  none,
  directional_with_twist,
  elastic_plastic,
  spring_slider,
  torsion_spring,
  directional
};
enum class TwistingLaw : std::uint8_t { none, marshall };
enum class CohesionLaw : std::uint8_t { none, linear, jkr };

/// The laws that act, in the whole run: asked once a batch, never once a contact.
struct LawFlags {
  NormalLaw normal = NormalLaw::hertz;
  RollingLaw rolling = RollingLaw::elastic_plastic;
  CohesionLaw cohesion = CohesionLaw::none;
  TwistingLaw twisting = TwistingLaw::none;
};

/// Constants of a pair of materials (double), or of a pack of contacts. Kernels read them in the order that stands here
/// (kernels/pack_constants.hpp).
template <class Real>
struct LawConstants {
  Real normal;            ///< hertz: (4/3) E*; hooke: k_n
  Real damping;           ///< g_n/sqrt(m* a); hooke: g_n/sqrt(m*)
  Real shear;             ///< k_t/a = 8 G*; hooke: k_t
  Real shear_damping;     ///< g_t as g_n
  Real sliding;           ///< mu
  Real rolling;           ///< mu_r
  Real roll_stiffness;    ///< k, or torsion_spring's k_r
  Real roll_damping;      ///< eta, or spring_slider's c
  Real cohesion;          ///< linear: pi k_c
  Real adhesion_force;    ///< jkr: sqrt(8 pi w E*)
  Real adhesion_overlap;  ///< jkr: sqrt(2 pi w/E*)
  Real adhesion_start;    ///< jkr: above the cube root of adhesion_overlap R* for every contact
  Real pull_off;          ///< jkr: 2 F_po/R* = 3 pi w
};

}  // namespace soilbin::dem
