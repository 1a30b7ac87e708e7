// A bed of grains in a box, come to rest under gravity: what every run in the soil bin starts from.
//
//   const SettledBed bed = settle_bed({.soil = grains, .size = {.length = 2.5, .width = 0.8, .depth = 0.3}});  // [m]
//   bed.report.void_ratio, bed.report.bulk_density  // [-], [kg/m^3]
#pragma once

#include <cstdint>
#include <filesystem>

#include "dem/bed/bed_report.hpp"
#include "dem/bed/work_options.hpp"
#include "dem/engine/rayleigh_time.hpp"
#include "dem/engine/simulation.hpp"
#include "scenario/soil.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

/// When a bed counts as being at rest: both at once. Before it is levelled, a hundred times as much is let pass.
struct RestTest {
  double kinetic = 1e-6;     ///< Unrest::kinetic below this
  double unbalanced = 0.03;  ///< Unrest::unbalanced below this
  double every = 0.02;       ///< looked at so often [s]
  double at_most = 10;       ///< [s], then the bed is given up
};

/// Where grains may be coarser: below and beside a zone of the soil's own grains that runs along the bed's middle line.
/// Away from it sizes grow evenly over a transition, so that no fine grains stand on grains whose pores let them
/// through.
struct Grading {
  double factor = 1;      ///< largest size of a grain over the soil's own, 1 .. 4; 1: the soil's grains everywhere
  double half_width = 0;  ///< of the fine zone, from the middle line [m]
  double depth = 0;       ///< of the fine zone under the surface [m]
  double transition = 0;  ///< from the fine zone to where the factor is reached [m]

  /// By what the soil's sizes are multiplied, in a bed of this size.
  double scale(const BedSize& bed, double y, double z) const;
  /// Number of grains over that of a bed of the soil's own, about.
  double share_of_grains(const BedSize& bed) const;
};

/// The fine zone for a tire. Its contact is taken as l = 0.4 r long (that of a sinkage of 8 % of the radius). Fine
/// grains reach l and the height of a lug below the surface, and l/4 to both sides of the tire; the transition is a
/// diameter of the coarse grains.
Grading grading_for(const Tire& tire, const GranularSoil& soil, double factor);

/// The engine that settles a bed: this program's own, or LAMMPS (dem/worker_lammps). Both take the same stages
/// (settling.hpp) with the same grains; the bits differ.
enum class SettledBy { soilbin, lammps };

/// Gravity on grains of this soil [m/s^2]; where it declares none, the 9.81 of every recorded bed.
inline double gravity_on(const GranularSoil& soil) { return soil.gravity.value_or(9.81); }

/// All that a bed follows from. The tire's contact with the soil is not read.
struct BedRecipe {
  GranularSoil soil;
  BedSize size;
  std::uint64_t packing = 1;  ///< seed of the random places and radii
  Grading grading;
  double settling_friction = 1;  ///< share of sliding and rolling friction while grains fall; less makes a denser bed
  double gravity = 9.81;         ///< [m/s^2]
  double dt = 0;                 ///< [s]; 0: longest_step
  ContactLaws laws;
  RestTest rest;
  SettledBy settled_by = SettledBy::soilbin;
  bool periodic = false;  ///< along x: no end walls, and the bed repeats itself without a seam (rig/moving_patch.hpp)
};

/// Where the bed's body stands in State::bodies: floor and four walls, planes of the grains' own material.
inline constexpr int bin_body = 0;
/// Materials of a bed: that of the grains; a run adds others behind it.
inline constexpr int grain_material = 0;

struct SettledBed {
  BedRecipe recipe;
  Setup setup;  ///< of one material, the grains'
  State state;
  BedReport report;
  std::filesystem::path grains_in{};  ///< folder of the grains that LAMMPS settled, of which `state` has none
};

/// The engine's law for a soil's rolling resistance.
RollingLaw rolling_law(RollingResistance resistance);
/// The laws that a soil names; cohesion is switched on by with_cohesion_of.
LawFlags laws_of(const GranularSoil& soil);

/// What grains do to each other, and to tire, of a soil.
Interaction interaction_of(const ContactPair& pair);
/// The laws with the law of this pair's cohesion switched on, where it has a work of adhesion (jkr) or an energy
/// density (linear), and no law of cohesion was chosen.
ContactLaws with_cohesion_of(const ContactPair& pair, ContactLaws laws);

/// The longest step for grains of this soil that the engine's check lets pass [s].
inline double longest_step(const GranularSoil& soil) {
  const Material grains{"grains", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio};
  const double sphere = soil.radius_min / std::cbrt(spheres_of(soil.shape));  // or larger, where spheres overlap
  return 0.999 * Numerics{}.safe_share * rayleigh_time(grains, sphere);
}

/// Steps in which a grain of the mean size falls by its own radius: 450 for the paper's grains, 2e5 for quartz
/// sand of 0.1 mm radius. Beyond `most_steps_a_fall` no bed settles in a person's life.
double steps_a_fall(const GranularSoil& soil, double gravity, double step);
inline constexpr double most_steps_a_fall = 1e6;

/// Throws InputError for grains and a step [s] with which the work gets nowhere, or whose step is longer than that
/// fall; for a largest grain of more than 50 times the smallest, and for a Poisson ratio below -0.9.
void check_pace(const GranularSoil& soil, double gravity, double step);

/// Throws InputError for grains that LAMMPS is not given: those of several spheres, and those with jkr cohesion, which
/// adhere beyond the contact that LAMMPS lists.
void refuse_beyond_lammps(const GranularSoil& soil);

/// How many grains are put into a bed, about.
double expected_grains(const BedRecipe& recipe);

/// Throws InputError for a recipe that makes no sense, or of more grains than who settles it takes.
void check(const BedRecipe& recipe);
/// Numerics and the grains' material, with the whole friction.
Setup setup_of(const BedRecipe& recipe, int threads);
/// Floor and walls; of a periodic bed without those at its ends.
Body bin_of(const BedSize& size, bool periodic = false);
/// Gives the balls around all grains of the recipe, where they begin to fall, to `put`; spheres fill theirs. A graded
/// bed takes 32 bytes a grain meanwhile.
void pour(const BedRecipe& recipe, const GrainSink& put);

/// Puts grains in loosely, lets them fall, takes away what stands above the depth so that the surface seen from above
/// is on average there, and lets the rest settle again. The same recipe gives the same bed, for any number of threads.
/// Throws InputError for sizes that make no sense, RunStopped where no rest is found, Stopped.
SettledBed settle_bed(const BedRecipe& recipe, const WorkOptions& how = {});

}  // namespace soilbin::dem
