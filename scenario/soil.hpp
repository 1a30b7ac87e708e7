// A soil: the values that the analytic model needs (pressure, sinkage, shear), its grains for the discrete element
// model, its resistive force, what a cone penetrometer finds in it; at least one of them.
//
//   Soil soil{.name = "dry sand"};
//   soil.semi_empirical = SemiEmpiricalSoil{.exponent = {1.1, 0}, .k_c = {990, 0}, .k_phi = {1.528e6, 0},
//                                           .cohesion = {1040, 100}, .friction_angle = {0.49, 0.02},  // [Pa], [rad]
//                                           .shear_modulus = {0.025, 0.003}};  // [m]; value, standard deviation
//   bulk_density(*soil.semi_empirical)  // 1500 kg/m^3, presumed since none is declared
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/unit.hpp"

namespace soilbin {

/// Values of the Bekker / Wong-Reece model, each with its standard deviation (0: taken as exact). Their ranges:
/// soil_parameters.hpp.
/// Pressure under a plate of smaller width b at depth z: p = (k_c/b + k_phi) z^n.
struct SemiEmpiricalSoil {
  Estimate exponent;                ///< n [-]
  Estimate k_c;                     ///< cohesive modulus [N/m^(n+1)]
  Estimate k_phi;                   ///< frictional modulus [N/m^(n+2)]
  Estimate cohesion;                ///< c [Pa]
  Estimate friction_angle;          ///< phi [rad]
  Estimate shear_modulus;           ///< Janosi's shear deformation modulus K [m]
  Estimate stress_angle_c1;         ///< c1 [-]: theta_m = (c1 + c2 |s|) theta_1
  Estimate stress_angle_c2;         ///< c2 [-]
  std::optional<double> density;    ///< bulk density [kg/m^3]; absent: bulk_density() presumes one
  std::optional<double> gravity{};  ///< that pulls on it [m/s^2]; absent: Earth's
  /// Sinkage about which n was fitted [m]: an error of n leaves the pressure there as it is, and k_c and k_phi follow
  /// it (move_value in soil_parameters.hpp); their own errors are those at the declared n. Absent: 1 m, so that n, k_c
  /// and k_phi err apart.
  std::optional<double> reference_sinkage{};
  /// For a source that gives no standard deviations: the share of each value but n that its file assumes
  /// in their place, >= 0. (k_c and k_phi belong to one n: at this n their shares stand for the stiffness.)
  std::optional<double> assumed_sd{};
  std::map<std::string, std::string> sources{};  ///< where single numbers come from, by key: "k_c"
};

/// c1 and c2 of a file that leaves them out, because no plate and no shear ring measures them. Both cover what Wong and
/// Reece (1967) and Ishigami et al. (2007) found on sands, 0.18 to 0.43 and 0.15 to 0.32; the choice is ours.
inline constexpr Estimate usual_stress_angle_c1{0.30, 0.15}, usual_stress_angle_c2{0.25, 0.15};
/// Its source then.
inline constexpr const char* usual_stress_angle_source = "not declared: a usual value with a wide standard deviation";

/// The source of a value that was typed.
inline constexpr const char* command_line_source = "given on the command line";

/// Whether a value was typed, by its name.
inline bool is_from_command_line(const SemiEmpiricalSoil& soil, const char* name) {
  const auto source = soil.sources.find(name);
  return source != soil.sources.end() && source->second == command_line_source;
}

/// The bulk density presumed for a soil that declares none: some sand's [kg/m^3].
inline constexpr double presumed_bulk_density = 1500.0;

/// What effects that weigh soil read [kg/m^3].
inline double bulk_density(const SemiEmpiricalSoil& soil) { return soil.density.value_or(presumed_bulk_density); }

/// Contact of two materials in the discrete element model.
struct ContactPair {
  double restitution = 0.5;       ///< [-], 0 .. 1
  double sliding_friction = 0.5;  ///< [-], >= 0
  double rolling_friction = 0.1;  ///< [-], >= 0
  double rolling_damping = 0.3;   ///< share of critical, 0 .. 1; read by elastic_plastic alone. 0.3: chosen
  double cohesion = 0.0;         ///< energy density of linear cohesion [J/m^3], >= 0; 0: none (docs/theory/dem-laws.md)
  double rolling_stiffness = 0;  ///< [N m/rad], >= 0; read by torsion_spring alone
  double work_of_adhesion = 0;   ///< w of jkr cohesion [J/m^2], >= 0; 0: none. Pull-off: (3/2) pi w R*
};

/// How grains resist rolling (docs/theory/dem-laws.md).
enum class RollingResistance { elastic_plastic, directional, directional_with_twist, torsion_spring };

/// How grains resist twisting, spin about the normal of their contact (docs/theory/dem-laws.md).
enum class TwistingResistance { none, marshall };

/// How grains pull each other together (docs/theory/dem-laws.md): over the contact's area by an energy density, or as
/// Johnson, Kendall and Roberts by a work of adhesion.
enum class GrainCohesion { linear, jkr };

/// What a grain is made of: a sphere, or a few equal ones joined for good, in a row, a triangle, a tetrahedron.
enum class GrainShape { sphere, two_spheres, three_spheres, four_spheres };

constexpr int spheres_of(GrainShape shape) { return static_cast<int>(shape) + 1; }

/// Grains of one size among others: what one sieve of an analysis retains.
struct GrainFraction {
  double radius = 0.0;  ///< [m]; of a sieve fraction half the geometric mean of its two openings
  double share = 0.0;   ///< of the mass of all grains, 0 .. 1
};

/// A soil as grains, for the discrete element model.
struct GranularSoil {
  double radius_min = 0.0;          ///< [m] radii are uniform between radius_min and radius_max, or those of `sizes`
  double radius_max = 0.0;          ///< [m]; of a grain of several spheres, that of the sphere of its volume
  double grain_density = 0.0;       ///< [kg/m^3]
  std::optional<double> gravity{};  ///< that pulls on the grains [m/s^2]; absent: Earth's
  double youngs_modulus = 0.0;      ///< [Pa]
  double poisson_ratio = 0.25;      ///< [-], -1 .. 0.5
  RollingResistance rolling_resistance = RollingResistance::elastic_plastic;
  TwistingResistance twisting_resistance = TwistingResistance::none;
  GrainCohesion cohesion_law = GrainCohesion::linear;  ///< jkr goes with a work_of_adhesion, linear with none
  GrainShape shape = GrainShape::sphere;
  std::vector<GrainFraction> sizes{};  ///< smallest first (grain_sizes.hpp); none: uniform radii
  double sphere_spacing = 1;           ///< between the centres of a grain's spheres, in their radii [-], 0.1 .. 2
  ContactPair grain_grain;
  ContactPair grain_tire;
  std::map<std::string, std::string> sources{};  ///< where single numbers come from, by key: "grain_tire.restitution"
};

/// Mean diameter of a soil's grains [m]: of uniform radii by number, of `sizes` by mass.
double mean_diameter(const GranularSoil& soil);

/// A soil as resistive force theory knows it: resistive_force/response.hpp.
struct ResistiveForceSoil {
  Estimate xi_n;              ///< stress on an element per depth, over the theory's response [N/m^3], > 0
  Estimate surface_friction;  ///< between soil and wheel [-], >= 0
  std::map<std::string, std::string> sources{};  ///< where single numbers come from, by key: "xi_n"
};

/// A soil, by what each model needs of it. It is fine-grained or sand: of cone_index and cone_index_gradient it has one
/// at most.
struct Soil {
  std::string name;
  std::optional<SemiEmpiricalSoil> semi_empirical;
  std::optional<GranularSoil> granular;
  std::optional<ResistiveForceSoil> resistive_force{};
  /// Fine-grained soil's mean resistance to a cone of 30 deg over its base, to a depth of some 150 mm [Pa], > 0.
  std::optional<Estimate> cone_index{};
  /// Growth of the cone index of sand with depth [Pa/m], > 0.
  std::optional<Estimate> cone_index_gradient{};
  std::optional<double> moisture;                ///< water content by mass [-]
  std::vector<SemiEmpiricalSoil> beds{};         ///< measured at several densities, loosest first (beds.hpp)
  std::optional<double> bed_density{};           ///< of the bed between them that semi_empirical is of [kg/m^3]
  std::string source{};                          ///< where the soil as a whole is described
  std::map<std::string, std::string> sources{};  ///< where single numbers beside the two sections come from
};

/// The soil's grains, for who can't do without them. Throws InputError where it has none.
inline const GranularSoil& grains_of(const Soil& soil) {
  if (!soil.granular)
    throw InputError("soil '" + soil.name +
                     "' has no grains: the model dem and virtual tests need its section 'granular'\n  hint: 'soilbin "
                     "list soils' says which have it");
  return *soil.granular;
}

/// The gravity that pulls on soil and wheel [m/s^2].
double gravity_of(const auto& soil) { return soil.gravity.value_or(standard_gravity); }
inline double gravity_of(const Soil& soil) {
  if (soil.semi_empirical) return gravity_of(*soil.semi_empirical);
  return soil.granular ? gravity_of(*soil.granular) : standard_gravity;
}

/// n [-], which the units of some values hang on; 1 for a soil without semi-empirical values.
inline double exponent_of(const Soil& soil) { return soil.semi_empirical ? soil.semi_empirical->exponent.value : 1.0; }

}  // namespace soilbin
