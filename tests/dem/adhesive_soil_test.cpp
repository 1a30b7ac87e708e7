// jkr cohesion from a soil's own file: Johnson, Kendall and Roberts 1971, Proc. R. Soc. Lond. A 324:301. w is the work
// of adhesion, the energy that parts a unit of area of contact: 2 gamma of one material with the surface energy gamma.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/bed/bed_store.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/rig/run_inputs.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using test::small_recipe;

constexpr double work = 20;  // [J/m^2]

GranularSoil sticky_soil() {
  return *parse_soil(
              make_source_text("format: soilbin-soil/1\n"
                               "name: sticky\n"
                               "granular:\n"
                               "  radius_min: 8 mm\n"
                               "  radius_max: 12 mm\n"
                               "  grain_density: 2500 kg/m^3\n"
                               "  youngs_modulus: 5 MPa\n"
                               "  poisson_ratio: 0.2\n"
                               "  cohesion_law: jkr\n"
                               "  grain_grain: {restitution: 1, sliding_friction: 0.5, rolling_friction: 0.1,\n"
                               "                work_of_adhesion: 20 J/m^2}\n"
                               "  grain_tire: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}\n",
                               "sticky.yaml"))
              .granular;
}

BedRecipe sticky_recipe() {
  BedRecipe recipe = small_recipe();
  recipe.soil = sticky_soil();
  return recipe;
}

// Two grains of 8 and 12 mm, R* = 4.8 mm, fly apart from where they touch. They are held back by up to
// (3/2) pi w R* = 0.452 N and let go at a gap of (3/4)(pi^2 w^2 R*/E*^2)^(1/3), E* = 2.604 MPa.
TEST(AdhesiveSoil, HoldsTwoGrainsWithThePullOffOfJkr) {
  dem::Setup setup = setup_of(sticky_recipe(), 1);
  EXPECT_EQ(setup.laws.cohesion, CohesionLaw::jkr);
  setup.numerics.dt /= 100;
  Simulation simulation(setup);
  const double overlap = 1e-6, first = 0.008, second = 0.012, r_star = first * second / (first + second);
  const Vec3 at{0.05, 0.05, 0.05};
  simulation.add_grain(at, first, grain_material, {0, 0, -0.2});
  simulation.add_grain(at + Vec3{0, 0, first + second - overlap}, second, grain_material, {0, 0, 0.2});
  double pull = 0, gap = 0;
  simulation.run(1);
  for (int step = 0; step < 100000 && !simulation.contacts().empty(); ++step) {
    for (const Contact& contact : simulation.contacts()) {
      pull = std::max(pull, std::sqrt(squared(contact.force)));
      gap = std::max(gap, -contact.overlap);
    }
    simulation.run(1);
  }
  EXPECT_TRUE(simulation.contacts().empty());
  const double young = 5e6 / (2 * (1 - 0.2 * 0.2));
  const double pull_off = 1.5 * std::numbers::pi * work * r_star;
  const double lets_go = 0.75 * std::cbrt(std::pow(std::numbers::pi * work / young, 2) * r_star);
  EXPECT_NEAR(pull, pull_off, 1e-3 * pull_off);
  EXPECT_NEAR(gap, lets_go, 1e-2 * lets_go);
}

TEST(AdhesiveSoil, IsPartOfTheKeysOfBedsAndRunsAndLeavesOthersAsTheyAre) {
  BedRecipe dry = sticky_recipe(), sticky = dry;
  dry.soil.cohesion_law = GrainCohesion::linear, dry.soil.grain_grain.work_of_adhesion = 0;
  EXPECT_NE(content_key(dry), content_key(sticky));
  EXPECT_THAT(recipe_text(dry), ::testing::Not(::testing::HasSubstr("adhesion")));
  EXPECT_THAT(recipe_text(sticky), ::testing::HasSubstr("\nwork_of_adhesion 20\n"));
  BedRecipe on_tire = sticky;
  on_tire.soil.grain_tire.work_of_adhesion = 1;
  EXPECT_EQ(content_key(on_tire), content_key(sticky));
  const Tire tire = test::small_wheel();
  EXPECT_NE(run_inputs(on_tire, tire, {}), run_inputs(sticky, tire, {}));
}

TEST(AdhesiveSoil, IsNotGivenToLammps) {
  EXPECT_NO_THROW(refuse_beyond_lammps(test::soft_soil()));
  EXPECT_THROW(refuse_beyond_lammps(sticky_soil()), InputError);
}

// By Rumpf grains of d = 20 mm that pull each other with F = (3/2) pi w d/4 = 0.47 N bear a tension of phi Z F/(pi
// d^2), some 1.3 kPa for phi Z = 0.6 * 6: under 1 kPa that is as if dense sand were pressed more than twice as hard.
TEST(SlowAdhesiveSoil, IsStrongerInTheShearBoxAndSettlesLooser) {
  DirectShearSettings box;
  box.length = 9, box.width = 6, box.height = 7, box.travel = 1;
  box.stresses = {1e3};
  GranularSoil dry = sticky_soil();
  dry.grain_grain.restitution = 0.4;
  const GranularSoil sticky = dry;
  dry.cohesion_law = GrainCohesion::linear, dry.grain_grain.work_of_adhesion = 0;
  const auto sheared = [&](const GranularSoil& soil, double settling_friction) {
    box.specimen.settling_friction = settling_friction;
    return direct_shear(soil, box, test::with_threads(1)).runs.front();
  };
  EXPECT_GT(sheared(sticky, 0).peak.value, 1.4 * sheared(dry, 0).peak.value);
  EXPECT_GT(sheared(sticky, 1).void_ratio, sheared(dry, 1).void_ratio + 0.1);
}

}  // namespace
}  // namespace soilbin::dem
