// What grains and surfaces are made of, and what each pair of materials does at a contact. The laws themselves, with
// formulas and sources: docs/theory/dem-laws.md.
//
//   Materials materials;
//   const int sand = materials.add({"sand", 2650, 1e7, 0.25}, {.restitution = 0.4, .sliding_friction = 0.5});
//   const int rubber = materials.add({"rubber", 1200, 5e6, 0.45});  // density [kg/m^3], Young's modulus [Pa], Poisson
//   materials.set(sand, rubber, {.restitution = 0.3, .sliding_friction = 0.7});
#pragma once

#include <string>
#include <vector>

#include "dem/engine/laws/law_constants.hpp"

namespace soilbin::dem {

/// One material. Index in Materials::all is what grains and surfaces carry.
struct Material {
  std::string name;
  double density = 2500;  ///< [kg/m^3], above 0
  double young = 1e7;     ///< Young's modulus [Pa], above 0
  double poisson = 0.25;  ///< Poisson's ratio, in (-1, 0.5]
};

/// What two materials do at a contact, beyond their elastic constants.
struct Interaction {
  double restitution = 0.5;       ///< e, rebound over impact speed of a head-on impact, in [0, 1]
  double sliding_friction = 0.5;  ///< mu, at least 0
  double rolling_friction = 0;    ///< mu_r, at least 0
  double rolling_damping = 0;     ///< eta of elastic_plastic rolling, share of critical, at least 0; a soil's: 0.3
  double rolling_stiffness = 0;   ///< spring_slider: k [N/m]; torsion_spring: k_r [N m/rad]
  double rolling_viscosity = 0;   ///< spring_slider: c [N s/m]
  double cohesion = 0;            ///< linear: energy density k_c [J/m^3]; jkr: work of adhesion w [J/m^2]
  double normal_stiffness = 0;    ///< hooke: k_n [N/m], above 0
  double shear_stiffness = 0;     ///< hooke: k_t [N/m], at least 0
};

/// The laws that act, in the whole run.
struct ContactLaws : LawFlags {
  /// g_t as a share of g_n; negative: Mindlin's own, 2 sqrt(5/6) beta sqrt(k_t m*).
  double tangential_damping = -1;
};

/// All materials of a run, and each pair's interaction.
struct Materials {
  std::vector<Material> all;
  std::vector<Interaction> interactions;  ///< row by row, all.size() squared, symmetric

  /// Adds a material; its interactions with those before and with itself start as `with_all`. Gives its index.
  /// Throws InputError for values out of range.
  int add(Material material, const Interaction& with_all = {});
  /// Sets the interaction of a pair, both ways.
  void set(int a, int b, const Interaction& interaction);
  const Interaction& between(int a, int b) const { return interactions[a * all.size() + b]; }
};

/// A run has at most so many materials, so that a pair of them fits a byte.
inline constexpr std::size_t most_materials = 15;

/// E* of a pair [Pa].
double reduced_young(const Material& a, const Material& b);
/// G* of a pair [Pa].
double reduced_shear(const Material& a, const Material& b);
/// beta, the damping of a contact as a share of critical, that gives restitution e in [0, 1].
double damping_share(double restitution);

/// The factors of a pair of materials. largest_radius: of any R* in the run [m]. Throws InputError where hooke has no
/// stiffness.
LawConstants<double> law_constants(const Materials& materials, const ContactLaws& laws, int a, int b,
                                   double largest_radius);

/// jkr: how far apart two surfaces are when a contact of this R* [m] breaks, -delta_c [m].
double adhesion_reach(const LawConstants<double>& constants, double radius);

}  // namespace soilbin::dem
