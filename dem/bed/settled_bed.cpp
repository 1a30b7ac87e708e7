#include "dem/bed/settled_bed.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/bed/grain_shape.hpp"
#include "dem/bed/settling.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/grain_sizes.hpp"

namespace soilbin::dem {
namespace {

constexpr double densest = 0.64;         // share of spheres in random packing, without friction
constexpr double densest_clumps = 0.72;  // of others: Donev et al. (2004) find up to 0.735
constexpr double spare = 1.03;           // of grains, so that levelling finds enough
constexpr double loosely = 0.22;         // share of grains where they are put at random, without a lattice
constexpr double most_grading = 4;       // beyond it fine grains begin to fall through coarse ones
constexpr double most_grains = 2e7;      // of one process: 20 GB of memory
constexpr double most_in_lammps = 1e9;   // its ids have 31 bits
constexpr double headroom = 20;          // of the domain, for grains that are thrown [m]

double densest_of(const GranularSoil& soil) { return soil.shape == GrainShape::sphere ? densest : densest_clumps; }

/// Volume of all grains that are put in [m^3].
double volume_of_grains(const BedRecipe& recipe) {
  const auto& [length, width, depth] = recipe.size;
  return spare * densest_of(recipe.soil) * length * width * (depth + recipe.grading.factor * recipe.soil.radius_max);
}

/// The soil's grains everywhere, on a lattice.
void pour_evenly(const BedRecipe& recipe, const GrainSink& put) {
  const int count = static_cast<int>(std::ceil(expected_grains(recipe)));
  const RadiusRange balls = GrainMaker(recipe.soil, 0).balls();
  Region region{{0, 0, 0}, {recipe.size.length, recipe.size.width, 0}};
  while (room_for(region, balls) < count) region.upper.z += balls.largest;
  if (region.upper.z > headroom) throw InputError("the bed is too high to be poured");
  insert_loosely(put, region, balls, count, recipe.packing);
}

/// Grains of each place's own sizes, equally loose everywhere, so that all of the bed comes down by the same share and
/// the zones come to lie where they belong.
void pour_graded(const BedRecipe& recipe, const GrainSink& put) {
  const RadiusRange balls = GrainMaker(recipe.soil, 0).balls();
  const auto& [length, width, depth] = recipe.size;
  const double grains = volume_of_grains(recipe), ball = proportions_of(recipe.soil).ball;
  const double volume = grains * ball * ball * ball, height = volume / (loosely * length * width);
  if (height > headroom) throw InputError("the bed is too high to be poured");
  const double settles = grains / (densest_of(recipe.soil) * length * width) / height;
  const auto scale = [&](const Vec3& at) { return recipe.grading.scale(recipe.size, at.y, settles * at.z); };
  insert_graded(put, {{0, 0, 0}, {length, width, height}}, {balls, scale, recipe.grading.factor, volume},
                recipe.packing);
}

/// The run of a bed that the engine settles: at once, and not kept.
class BedRun {
 public:
  BedRun(Simulation& simulation, const WorkOptions& how) : simulation_(simulation), how_(how) {}
  template <class Part>
  void keep(const std::string&, Part&) {}
  void once(const std::function<void()>& what) { what(); }
  void loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each,
            const std::function<double()>& share) {
    constexpr std::int64_t between_looks = 100;  // steps
    for (std::int64_t taken = 0; goes_on(); ++taken) {
      if (taken % between_looks == 0) {
        if (how_.stop.stop_requested()) throw Stopped();
        if (how_.progress) how_.progress({stage, share(), not_a_number});
      }
      each();
    }
  }
  void step() { simulation_.run(1); }
  Simulation& simulation() { return simulation_; }

 private:
  Simulation& simulation_;
  const WorkOptions& how_;
};

}  // namespace

void refuse_beyond_lammps(const GranularSoil& soil) {
  if (soil.cohesion_law == GrainCohesion::jkr)
    throw InputError(
        "LAMMPS is given grains with linear cohesion or none, not jkr: it lists no pairs that adhere beyond their "
        "contact\n  hint: soilbin's own engine, or cohesion_law: linear");
  if (soil.shape != GrainShape::sphere)
    throw InputError(
        "LAMMPS is given spheres alone, not grains of several\n  hint: soilbin's own engine, or shape: sphere");
}

double steps_a_fall(const GranularSoil& soil, double gravity, double step) {
  return std::sqrt(mean_diameter(soil) / gravity) / step;
}

void check_pace(const GranularSoil& soil, double gravity, double step) {
  if (const std::string wrong = soil.sizes.empty() ? "" : wrong_in_sizes(soil); !wrong.empty()) throw InputError(wrong);
  constexpr double most_sizes = 50, least_poisson = -0.9;
  if (soil.radius_max > most_sizes * soil.radius_min)
    throw InputError(fmt::format(
        "the largest grain is {:.3g} times as large as the smallest, and {:.0f} at most make sense\n  hint: "
        "are radius_min and radius_max right, and their units?",
        soil.radius_max / soil.radius_min, most_sizes));
  if (soil.poisson_ratio < least_poisson)
    throw InputError(fmt::format("a Poisson ratio of {} makes grains that do not shear: {} .. 0.5 make sense",
                                 soil.poisson_ratio, least_poisson));
  const double steps = steps_a_fall(soil, gravity, step);
  if (steps >= 1 && steps <= most_steps_a_fall) return;
  throw InputError(fmt::format(
      "with these grains the work {}: a grain needs {:.2g} time steps of {:.2g} s to fall by its own radius, and 1 .. "
      "{:.0e} make sense\n  hint: are youngs_modulus, poisson_ratio, grain_density, radius_min and gravity right, and "
      "their units?",
      steps < 1 ? "means nothing" : "gets nowhere", steps, step, most_steps_a_fall));
}

void check(const BedRecipe& recipe) {
  const auto& [length, width, depth] = recipe.size;
  const Grading& grading = recipe.grading;
  if (!(grading.factor >= 1 && grading.factor <= most_grading))
    throw InputError(fmt::format("a graded bed's coarse grains are 1 .. {} times as large as its fine ones, not {:.4g}",
                                 most_grading, grading.factor));
  const double largest = grading.factor * recipe.soil.radius_max;
  if (!(recipe.soil.radius_min > 0 && largest >= recipe.soil.radius_min && std::isfinite(largest)))
    throw InputError("a bed needs grains: radius_min above 0, radius_max not below it");
  if (!(length >= 4 * largest && width >= 4 * largest && depth >= 4 * largest) ||
      !std::isfinite(length + width + depth))
    throw InputError(
        fmt::format("a bed of {:.4g} x {:.4g} x {:.4g} m is less "
                    "than two grains of {:.4g} m across",
                    length, width, depth, 2 * largest));
  constexpr double shortest_period =
      12;  // in largest radii: four times what a contact reaches, with the search's margin
  if (recipe.periodic && !(length >= shortest_period * largest))
    throw InputError(fmt::format(
        "a bed that repeats itself every {:.4g} m is too short for grains of up to {:.4g} m: {:.4g} m at least\n"
        "  hint: --bed-length {:.4g}m, the wheel's radius or more",
        length, 2 * largest, shortest_period * largest, shortest_period * largest));
  if (recipe.periodic && recipe.settled_by == SettledBy::lammps)
    throw InputError(
        "LAMMPS settles no bed that repeats itself along the track\n  hint: leave out --settled-by lammps");
  if (!(recipe.settling_friction >= 0 && recipe.settling_friction <= 1))
    throw InputError("settling_friction must lie in 0 .. 1");
  constexpr double least_share = 1e-4;  // of the usual step: beyond it no bed settles in a person's life
  const double usual = longest_step(recipe.soil);
  if (recipe.dt != 0 && !(recipe.dt >= least_share * usual))
    throw InputError(
        fmt::format("a time step of {:.3g} s is too short to get anywhere: these grains usually take {:.3g} s\n"
                    "  hint: {:.3g} s or more",
                    recipe.dt, usual, least_share * usual));
  if (recipe.settled_by == SettledBy::lammps) refuse_beyond_lammps(recipe.soil);
  if (!(recipe.gravity > 0)) throw InputError("a bed settles under gravity: it must be above 0");
  check_pace(recipe.soil, recipe.gravity, usual);
  const bool in_lammps = recipe.settled_by == SettledBy::lammps;
  const double count = expected_grains(recipe), most = in_lammps ? most_in_lammps : most_grains;
  if (count > most)
    throw InputError(fmt::format("a bed of {:.3g} grains is more than {} settles: {:.0e} at most{}", count,
                                 in_lammps ? "LAMMPS" : "one process", most,
                                 in_lammps ? "" : "\n  hint: many processes, --engine lammps --settled-by lammps"));
}

Setup setup_of(const BedRecipe& recipe, int threads) {
  Setup setup;
  const GranularSoil& soil = recipe.soil;
  setup.materials.add({"grains", soil.grain_density, soil.youngs_modulus, soil.poisson_ratio},
                      interaction_of(soil.grain_grain));
  setup.laws = with_cohesion_of(soil.grain_grain, recipe.laws);
  const double r = recipe.grading.factor * soil.radius_max;
  setup.domain.lower = {-r, -r, -r};
  setup.domain.upper = {recipe.size.length + r, recipe.size.width + r, headroom};
  if (recipe.periodic) {
    setup.domain.lower.x = 0, setup.domain.upper.x = recipe.size.length;
    setup.domain.periodic[0] = true;
  }
  setup.numerics.dt = recipe.dt > 0 ? recipe.dt : longest_step(soil);
  setup.numerics.threads = threads;
  return setup;
}

Body bin_of(const BedSize& size, bool periodic) {
  Body bin;
  bin.name = "bin";
  const auto plane = [&](const Vec3& point, const Vec3& normal) {
    bin.surfaces.push_back({Plane{point, normal}, grain_material});
  };
  plane({0, 0, 0}, {0, 0, 1});
  if (!periodic) {
    plane({0, 0, 0}, {1, 0, 0});
    plane({size.length, 0, 0}, {-1, 0, 0});
  }
  plane({0, 0, 0}, {0, 1, 0});
  plane({0, size.width, 0}, {0, -1, 0});
  return bin;
}

void pour(const BedRecipe& recipe, const GrainSink& put) {
  const bool graded = recipe.grading.factor > 1 || recipe.soil.sizes.size() > 1;
  graded ? pour_graded(recipe, put) : pour_evenly(recipe, put);
}

double Grading::scale(const BedSize& bed, double y, double z) const {
  if (factor == 1) return 1;
  const double aside = std::max(0.0, std::abs(y - bed.width / 2) - half_width);
  const double below = std::max(0.0, bed.depth - depth - z);
  return 1 + (factor - 1) * std::min(1.0, std::max(aside, below) / transition);
}

double Grading::share_of_grains(const BedSize& bed) const {
  if (factor == 1) return 1;
  constexpr int points = 100;  // along both sides of the bed's cross-section
  double share = 0;
  for (int k = 0; k < points * points; ++k) {
    const double y = (k % points + 0.5) / points * bed.width, z = (k / points + 0.5) / points * bed.depth;
    share += std::pow(scale(bed, y, z), -3) / (points * points);
  }
  return share;
}

Grading grading_for(const Tire& tire, const GranularSoil& soil, double factor) {
  if (factor == 1) return {};
  const double contact = 0.4 * tire.radius;
  return {factor, tire.width / 2 + contact / 4, contact + tire.lugs.height, factor * mean_diameter(soil)};
}

double expected_grains(const BedRecipe& recipe) {
  return volume_of_grains(recipe) / (4.0 / 3 * std::numbers::pi * mean_cube(recipe.soil)) *
         recipe.grading.share_of_grains(recipe.size);
}

RollingLaw rolling_law(RollingResistance resistance) {
  switch (resistance) {
    case RollingResistance::elastic_plastic:
      return RollingLaw::elastic_plastic;
    case RollingResistance::torsion_spring:
      return RollingLaw::torsion_spring;
    case RollingResistance::directional:
      return RollingLaw::directional;
    case RollingResistance::directional_with_twist:
      return RollingLaw::directional_with_twist;
  }
  return RollingLaw::elastic_plastic;
}

LawFlags laws_of(const GranularSoil& soil) {
  const bool twists = soil.twisting_resistance == TwistingResistance::marshall;
  return {.rolling = rolling_law(soil.rolling_resistance),
          .twisting = twists ? TwistingLaw::marshall : TwistingLaw::none};
}

Interaction interaction_of(const ContactPair& pair) {
  Interaction out;
  out.restitution = pair.restitution;
  out.sliding_friction = pair.sliding_friction;
  out.rolling_friction = pair.rolling_friction;
  out.rolling_damping = pair.rolling_damping;
  out.cohesion = pair.work_of_adhesion > 0 ? pair.work_of_adhesion : pair.cohesion;
  out.rolling_stiffness = pair.rolling_stiffness;
  return out;
}

ContactLaws with_cohesion_of(const ContactPair& pair, ContactLaws laws) {
  if (laws.cohesion != CohesionLaw::none) return laws;
  if (pair.work_of_adhesion > 0)
    laws.cohesion = CohesionLaw::jkr;
  else if (pair.cohesion > 0)
    laws.cohesion = CohesionLaw::linear;
  return laws;
}

double mean_height(const Simulation& simulation, const Footprint& over, double spacing, double cut) {
  SurfaceHeight surface = bare_floor(over, spacing);
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k) {
    const Motion& grain = simulation.state().grains.motion[k];
    if (grain.position.z + grain.radius <= cut) raise(surface, grain.position, grain.radius);
  }
  return surface.mean();
}

void remove_above(Simulation& simulation, double cut) {
  simulation.remove_grains([&](const GrainNow& grain) { return grain.position.z + grain.radius > cut; });
}

SettledBed settle_bed(const BedRecipe& recipe, const WorkOptions& how) {
  check(recipe);
  Simulation simulation(setup_of(recipe, how.threads));
  simulation.set_gravity({0, 0, -recipe.gravity});
  simulation.add_body(bin_of(recipe.size, recipe.periodic));
  GrainMaker maker(recipe.soil, recipe.packing);
  pour(recipe, [&](const Vec3& centre, double ball) { maker.put(simulation, centre, ball); });
  BedRun run(simulation, how);
  Settling<BedRun>(recipe, run).settle();

  SettledBed bed{.recipe = recipe, .setup = simulation.setup(), .state = simulation.state(), .report = {}};
  bed.report = report_on(Simulation(bed.setup, bed.state), recipe.size);
  bed.report.settling_time = simulation.time();
  return bed;
}

}  // namespace soilbin::dem
