#include "dem/bed/settled_bed.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/bed/insertion.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::dem {
namespace {

constexpr double densest = 0.64;          // share of grains in random packing, without friction
constexpr double spare = 1.03;            // of grains, so that levelling finds enough
constexpr double before_levelling = 100;  // so much less rest is asked for, as levelling disturbs it anyway
constexpr double loosely = 0.22;          // share of grains where they are put at random, without a lattice
constexpr double most_grading = 4;        // beyond it fine grains begin to fall through coarse ones
constexpr double most_grains = 2e7;       // 20 GB of memory
constexpr double headroom = 20;           // of the domain, for grains that are thrown [m]

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
  if (!(recipe.settling_friction >= 0 && recipe.settling_friction <= 1))
    throw InputError("settling_friction must lie in 0 .. 1");
  constexpr double least_share = 1e-4;  // of the usual step: beyond it no bed settles in a person's life
  const double usual = longest_step(recipe.soil);
  if (recipe.dt != 0 && !(recipe.dt >= least_share * usual))
    throw InputError(
        fmt::format("a time step of {:.3g} s is too short to get anywhere: these grains usually take {:.3g} s\n"
                    "  hint: {:.3g} s or more",
                    recipe.dt, usual, least_share * usual));
  if (!(recipe.gravity > 0)) throw InputError("a bed settles under gravity: it must be above 0");
  if (const double count = expected_grains(recipe); count > most_grains)
    throw InputError(
        fmt::format("a bed of {:.3g} grains is beyond this program, which takes {:.0e} at most", count, most_grains));
}

/// Of all grains that are put in [m^3].
double volume_of_grains(const BedRecipe& recipe) {
  const auto& [length, width, depth] = recipe.size;
  return spare * densest * length * width * (depth + recipe.grading.factor * recipe.soil.radius_max);
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
  setup.numerics.dt = recipe.dt > 0 ? recipe.dt : longest_step(soil);
  setup.numerics.threads = threads;
  return setup;
}

Body bin_of(const BedSize& size) {
  Body bin;
  bin.name = "bin";
  const auto plane = [&](const Vec3& point, const Vec3& normal) {
    bin.surfaces.push_back({Plane{point, normal}, grain_material});
  };
  plane({0, 0, 0}, {0, 0, 1});
  plane({0, 0, 0}, {1, 0, 0});
  plane({size.length, 0, 0}, {-1, 0, 0});
  plane({0, 0, 0}, {0, 1, 0});
  plane({0, size.width, 0}, {0, -1, 0});
  return bin;
}

std::string number_or_words(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "without bounds";
}

/// Runs until the rest test holds.
void come_to_rest(Simulation& simulation, const RestTest& test, const WorkOptions& how, double done, double share) {
  const double begin = simulation.time();
  constexpr int looking = 16;  // steps that unrest() takes
  const std::int64_t steps =
      std::max<std::int64_t>(0, std::llround(test.every / simulation.setup().numerics.dt) - looking);
  Unrest now;
  while (simulation.time() - begin < test.at_most) {
    if (how.stop.stop_requested()) throw Stopped();
    simulation.run(steps);
    now = unrest(simulation, looking);
    if (now.kinetic < test.kinetic && now.unbalanced < test.unbalanced) return;
    if (how.progress) {
      // Kinetic energy falls by orders of magnitude; how many are left is the
      // share left.
      const double orders = std::clamp(std::log10(now.kinetic / test.kinetic) / 7, 0.0, 1.0);
      how.progress({"settling", done + share * (1 - orders), not_a_number});
    }
  }
  throw RunStopped(fmt::format(
      "the bed did not come to rest in {:.3g} s: kinetic {} (asked "
      "{:.3g}), unbalanced {} "
      "(asked {:.3g})\n  hint: a shorter time step, or a looser test",
      test.at_most, number_or_words(now.kinetic), test.kinetic, number_or_words(now.unbalanced), test.unbalanced));
}

/// Takes away grains above a height chosen such that the surface seen from
/// above comes to `depth` on average.
/// radius: mean, of fine grains; coarse: of coarse ones [m].
void level(Simulation& simulation, const BedSize& size, double radius, double coarse) {
  const Footprint over{radius, size.length - radius, radius, size.width - radius};
  const Grains& grains = simulation.state().grains;
  const auto mean_below = [&](double cut) {
    Grains kept;
    for (std::size_t k = 0; k < grains.count(); ++k) {
      const Motion& grain = grains.motion[k];
      if (grain.position.z + grain.radius <= cut) kept.add({.radius = grain.radius, .position = grain.position});
    }
    return surface_height(kept, over, radius / 4).mean();
  };
  double low = size.depth - 2 * coarse, high = size.depth + 4 * coarse;
  if (mean_below(high) < size.depth)
    throw RunStopped(fmt::format("the settled grains fill the bin only to {} m", number_or_words(mean_below(high))));
  for (int turn = 0; turn < 12; ++turn) {
    const double middle = (low + high) / 2;
    (mean_below(middle) < size.depth ? low : high) = middle;
  }
  simulation.remove_grains([&](const GrainNow& grain) { return grain.position.z + grain.radius > high; });
}

/// The soil's grains everywhere, on a lattice.
void pour(Simulation& simulation, const BedRecipe& recipe) {
  const GranularSoil& soil = recipe.soil;
  const int count = static_cast<int>(std::ceil(expected_grains(recipe)));
  const RadiusRange radii{soil.radius_min, soil.radius_max};
  Region region{{0, 0, 0}, {recipe.size.length, recipe.size.width, 0}};
  while (room_for(region, radii) < count) region.upper.z += soil.radius_max;
  if (region.upper.z > headroom) throw InputError("the bed is too high to be poured");
  insert_loosely(simulation, region, radii, grain_material, count, recipe.packing);
}

/// Grains of each place's own sizes, equally loose everywhere, so that all of the bed comes down by the same share and
/// the zones come to lie where they belong.
void pour_graded(Simulation& simulation, const BedRecipe& recipe) {
  const GranularSoil& soil = recipe.soil;
  const auto& [length, width, depth] = recipe.size;
  const double volume = volume_of_grains(recipe), height = volume / (loosely * length * width);
  if (height > headroom) throw InputError("the bed is too high to be poured");
  const double settles = volume / (densest * length * width) / height;
  const auto scale = [&](const Vec3& at) { return recipe.grading.scale(recipe.size, at.y, settles * at.z); };
  insert_graded(simulation, {{0, 0, 0}, {length, width, height}},
                {{soil.radius_min, soil.radius_max}, scale, recipe.grading.factor, volume}, grain_material,
                recipe.packing);
}

Interaction with_friction(Interaction interaction, double share) {
  interaction.sliding_friction *= share;
  interaction.rolling_friction *= share;
  return interaction;
}

}  // namespace

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
  return {factor, tire.width / 2 + contact / 4, contact / 2, factor * mean_diameter(soil)};
}

double expected_grains(const BedRecipe& recipe) {
  const double a = recipe.soil.radius_min, b = recipe.soil.radius_max;
  const double mean_cube = (a + b) * (a * a + b * b) / 4;  // of a uniform radius
  return volume_of_grains(recipe) / (4.0 / 3 * std::numbers::pi * mean_cube) *
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
  out.cohesion = pair.cohesion;
  out.rolling_stiffness = pair.rolling_stiffness;
  return out;
}

ContactLaws with_cohesion_of(const ContactPair& pair, ContactLaws laws) {
  if (pair.cohesion > 0 && laws.cohesion == CohesionLaw::none) laws.cohesion = CohesionLaw::linear;
  return laws;
}

SettledBed settle_bed(const BedRecipe& recipe, const WorkOptions& how) {
  check(recipe);
  const GranularSoil& soil = recipe.soil;
  Simulation simulation(setup_of(recipe, how.threads));
  simulation.set_gravity({0, 0, -recipe.gravity});
  simulation.add_body(bin_of(recipe.size));
  if (recipe.grading.factor > 1)
    pour_graded(simulation, recipe);
  else
    pour(simulation, recipe);

  const Interaction full = interaction_of(soil.grain_grain);
  simulation.set_interaction(grain_material, grain_material, with_friction(full, recipe.settling_friction));
  RestTest poured = recipe.rest;
  poured.kinetic *= before_levelling, poured.unbalanced *= before_levelling;
  come_to_rest(simulation, poured, how, 0.0, 0.8);
  simulation.set_interaction(grain_material, grain_material, full);
  const double radius = mean_diameter(soil) / 2;
  level(simulation, recipe.size, radius, recipe.grading.factor * radius);
  come_to_rest(simulation, recipe.rest, how, 0.8, 0.2);

  SettledBed bed{.recipe = recipe, .setup = simulation.setup(), .state = simulation.state(), .report = {}};
  bed.report = report_on(Simulation(bed.setup, bed.state), recipe.size);
  bed.report.settling_time = simulation.time();
  return bed;
}

}  // namespace soilbin::dem
