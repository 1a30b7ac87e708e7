// Clumps: grains of several spheres joined for good. Mass properties and motion by closed forms, the same bits whoever
// computes, and clumps as a soil's grains.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/archive/restart.hpp"
#include "dem/bed/grain_shape.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using test::soft_stone;

constexpr double gravity_here = 9.81;

// Mass properties.

/// Two unit spheres s apart: volumes of revolution, each cut off halfway.
MassProperties two_unit_spheres(double s) {
  const double h = s / 2;
  const auto x_to = [](double x, int n) { return std::pow(x, n) / n; };
  const auto within = [&](int n) { return x_to(1, n) - x_to(-h, n); };  // Int x^(n-1) from -h to 1
  MassProperties out;
  out.volume = 2 * pi * (within(1) - within(3));
  const double radius4 = within(1) - 2 * within(3) + within(5);  // Int (1 - x^2)^2
  const double apart2 = (within(3) - within(5)) + 2 * h * (within(2) - within(4)) + h * h * (within(1) - within(3));
  out.xx = pi * radius4;
  out.yy = out.zz = pi / 2 * radius4 + 2 * pi * apart2;
  return out;
}

TEST(MassOfSpheres, OfTwoIsTheClosedForm) {
  for (const double s : {0.3, 1.0, 1.7, 2.5}) {
    const std::vector<Sphere> spheres{{{1, 2, 3}, 1}, {{1 + s, 2, 3}, 1}};
    const MassProperties p = mass_properties(spheres), exact = two_unit_spheres(std::min(s, 2.0));
    const double moved = s > 2 ? 2 * (s * s / 4 - 1) * (4 * pi / 3) : 0;  // Steiner, of two that don't touch
    EXPECT_NEAR(p.volume, exact.volume, 1e-8) << s;
    EXPECT_NEAR(p.centroid.x, 1 + s / 2, 1e-8);
    EXPECT_NEAR(p.xx, exact.xx, 1e-8);
    EXPECT_NEAR(p.yy, exact.yy + moved, 1e-8);
    EXPECT_NEAR(p.zz, exact.zz + moved, 1e-8);
    for (const double mixed : {p.xy, p.yz, p.zx}) EXPECT_NEAR(mixed, 0, 1e-8);
  }
}

TEST(MassOfSpheres, OfOneInsideAnotherIsThatOfTheOuter) {
  const std::vector<Sphere> spheres{{{0, 0, 0}, 1}, {{0.2, 0.1, 0}, 0.5}};
  const MassProperties p = mass_properties(spheres);
  EXPECT_NEAR(p.volume, 4 * pi / 3, 1e-9);
  EXPECT_NEAR(p.xx, 8 * pi / 15, 1e-9);
}

TEST(MassOfSpheres, OfThreeIsWhatRandomPointsFind) {
  const std::vector<Sphere> spheres{{{0, 0, 0}, 1}, {{0.8, 0.1, 0}, 0.7}, {{0.3, 0.9, 0.2}, 0.8}};
  const MassProperties p = mass_properties(spheres);
  Random random(3);
  const int points = 400000;
  double inside = 0, xx = 0, xy = 0;
  for (int k = 0; k < points; ++k) {
    const Vec3 at = test::any(random, 2);
    bool hit = false;
    for (const Sphere& sphere : spheres) hit |= squared(at - sphere.centre) < sphere.radius * sphere.radius;
    if (!hit) continue;
    const Vec3 from = at - p.centroid;
    inside += 1, xx += from.y * from.y + from.z * from.z, xy -= from.x * from.y;
  }
  const double of_point = 64.0 / points;
  EXPECT_NEAR(p.volume, inside * of_point, 4 * of_point * std::sqrt(inside));
  EXPECT_NEAR(p.xx, xx * of_point, 0.02 * p.xx);
  EXPECT_NEAR(p.xy, xy * of_point, 0.02 * p.xx);
}

TEST(MassOfSpheres, TurnsWithThem) {
  const std::vector<Sphere> spheres{{{0, 0, 0}, 1}, {{0.8, 0.1, 0}, 0.7}, {{0.3, 0.9, 0.2}, 0.8}};
  const Rotation turn = rotation_by({0.3, -1.2, 0.7});
  std::vector<Sphere> turned_spheres = spheres;
  for (Sphere& sphere : turned_spheres) sphere.centre = turn(sphere.centre) + Vec3{1, 2, 3};
  const ClumpShape a = clump_shape(spheres), b = clump_shape(turned_spheres);
  EXPECT_NEAR(a.volume, b.volume, 2e-6);
  EXPECT_LT(length(a.inertia - b.inertia), 5e-6);
  EXPECT_LT(a.inertia.x, a.inertia.y);
  EXPECT_NEAR(a.reach(), b.reach(), 1e-6);
}

TEST(MassOfSpheres, RefusesWhatMakesNoSense) {
  EXPECT_THROW(clump_shape({}), InputError);
  EXPECT_THROW(clump_shape({{{0, 0, 0}, 0}}), InputError);
  EXPECT_THROW(clump_shape({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}}), InputError);
}

// Motion.

/// Two spheres a radius apart.
ClumpShape rod(double r) { return clump_shape({{{-r / 2, 0, 0}, r}, {{r / 2, 0, 0}, r}}); }

Setup smooth(double dt, double restitution = 1) {
  dem::Setup setup = soft_stone({}, {.restitution = restitution, .sliding_friction = 0, .rolling_friction = 0});
  setup.numerics.dt = dt;
  return setup;
}

/// The axis of a free symmetric body goes round its angular momentum at L/I_t, whatever it spins about its own.
TEST(Clump, PrecessesAsASymmetricBody) {
  const ClumpShape shape = rod(0.01);
  const auto error_at = [&](double dt) {
    Simulation simulation(smooth(dt));
    const Vec3 spin{200, 60, 0};
    simulation.add_clump(shape, {.position = {0, 0, 0}, .spin = spin}, 0);
    const double mass = 2500, along = mass * shape.inertia.x, across = mass * shape.inertia.y;
    const Vec3 momentum{along * spin.x, across * spin.y, 0};
    const double time = 0.02;
    simulation.run(std::lround(time / dt));
    const Vec3 axis = rotation_by(time / across * momentum)({1, 0, 0});
    return length(simulation.state().clumps.all[0].motion.rotation({1, 0, 0}) - axis);
  };
  const double coarse = error_at(1e-4), fine = error_at(5e-5);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.2);  // second order
}

TEST(Clump, KeepsItsFormAndItsMomentum) {
  dem::Setup setup = soft_stone();
  setup.domain = {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, {true, true, true}};
  Simulation simulation(setup);
  const ClumpShape shape = rod(0.01);
  simulation.add_clump(shape, {.position = {-0.02, 0.001, 0}, .velocity = {1, 0, 0}, .spin = {0, 30, 100}}, 0);
  simulation.add_clump(shape, {.position = {0.02, -0.002, 0}, .velocity = {-1, 0.2, 0}, .spin = {0, 0, -50}}, 0);
  simulation.add_grain({0, 0.03, 0}, 0.009, 0, {0, -0.5, 0.1});
  const auto momentum = [&] {
    Vec3 sum = simulation.state().grains.motion[0].velocity - simulation.state().grains.motion[0].velocity;
    for (const Clump& clump : simulation.state().clumps.all) sum += clump.mass * clump.motion.velocity;
    const Grains& grains = simulation.state().grains;
    for (std::size_t k = 0; k < grains.count(); ++k)
      if (grains.clump[k] == lone) sum += grains.motion[k].velocity / grains.motion[k].inverse_mass;
    return sum;
  };
  const Vec3 before = momentum();
  bool touched = false;
  for (int k = 0; k < 400; ++k) {
    simulation.run(20);
    touched |= !simulation.contacts().empty();
    const Grains& grains = simulation.state().grains;
    const Clumps& clumps = simulation.state().clumps;
    for (const Clump& clump : clumps.all) {
      const auto spheres = clumps.of(clump);
      const Periods periods(simulation.setup().domain);
      const Vec3 apart =
          periods.shortest(grains.motion[spheres[0].row].position - grains.motion[spheres[1].row].position);
      EXPECT_NEAR(length(apart), 0.01, 1e-14);
    }
  }
  EXPECT_TRUE(touched);
  EXPECT_LT(length(momentum() - before), 1e-12 * 0.03);
}

/// One sphere as a clump is that sphere.
TEST(Clump, OfOneSphereIsThatSphere) {
  const auto run = [](bool clump) {
    Simulation simulation(soft_stone());
    Body floor;
    floor.surfaces = {{Plane{}, 0}};
    simulation.add_body(floor);
    simulation.set_gravity({1, 0, -gravity_here});
    simulation.add_grain({0, 0, 0.0099}, 0.01, 0);
    if (clump)
      simulation.add_clump(clump_shape({{{0, 0, 0}, 0.008}}),
                           {.position = {0.004, 0.001, 0.03}, .velocity = {0.1, 0, -0.5}, .spin = {5, 0, 2}}, 0);
    else
      simulation.add_grain({0.004, 0.001, 0.03}, 0.008, 0, {0.1, 0, -0.5}, {5, 0, 2});
    simulation.run(5000);
    return simulation.grain(1);
  };
  const GrainNow sphere = run(false), clump = run(true);
  EXPECT_LT(length(sphere.position - clump.position), 1e-9);
  EXPECT_LT(length(sphere.velocity - clump.velocity), 1e-7);
  EXPECT_LT(length(sphere.spin - clump.spin), 1e-4);
}

// Energy, bits, bookkeeping.

/// Rods, triangles, tetrahedra and spheres that fall into a box, 65 for each metre of a layer.
Simulation mixture(const ContactLaws& laws, int threads, bool ledger = false, double sleep = 0, double dt = 1e-5,
                   double length = 0.4) {
  dem::Setup setup = soft_stone(laws);
  setup.numerics.threads = threads, setup.numerics.ledger = ledger, setup.numerics.dt = dt;
  setup.numerics.sleep = {sleep, 0.002};
  Simulation simulation(setup);
  simulation.add_body(test::box_of_planes({0, 0, 0}, {length, 0.08, 1}));
  simulation.set_gravity({0, 0, -gravity_here});
  GranularSoil soil = test::soft_soil();
  soil.radius_min = 0.007, soil.radius_max = 0.009;
  int layer = 0;
  for (const GrainShape shape :
       {GrainShape::two_spheres, GrainShape::sphere, GrainShape::three_spheres, GrainShape::four_spheres}) {
    soil.shape = shape;
    GrainMaker maker(soil, 5);
    insert_loosely([&](const Vec3& centre, double ball) { maker.put(simulation, centre, ball); },
                   {{0, 0, 0.035 * layer}, {length, 0.08, 0.035 * (layer + 1)}}, maker.balls(),
                   static_cast<int>(std::lround(65 * length)), 9);
    ++layer;
  }
  return simulation;
}

TEST(Clumps, TakeTheSameBitsForAnyNumberOfThreads) {
  for (const double sleep : {0.0, 0.05}) {
    Simulation fallen = mixture({}, 1, false, sleep);
    fallen.run(4000);
    const auto gone_on = [&](int threads) {
      dem::Setup setup = fallen.setup();
      setup.numerics.threads = threads;
      Simulation simulation(std::move(setup), fallen.state());
      simulation.run(800);
      return test::bits(simulation.state());
    };
    const auto one = gone_on(1);
    for (const int threads : {2, 3}) EXPECT_EQ(gone_on(threads), one) << threads;
  }
}

TEST(Clumps, GoOnFromARestartWithTheSameBits) {
  Simulation whole = mixture({}, 1, true);
  whole.run(1500);
  const test::Folder folder;
  write_restart(folder / "run.h5", whole.setup(), whole.state());
  Restart restart = read_restart(folder / "run.h5");
  Simulation again(std::move(restart.setup), std::move(restart.state));
  whole.run(1500), again.run(1500);
  EXPECT_EQ(test::bits(again.state()), test::bits(whole.state()));
  for (std::size_t k = 0; k < whole.state().clumps.all.size(); ++k)
    EXPECT_EQ(again.state().clumps.all[k].motion.rotation, whole.state().clumps.all[k].motion.rotation);
}

TEST(Clumps, CloseTheBalanceOfEnergy) {
  const auto left = [](double dt) {
    Simulation simulation = mixture({}, 1, true, 0, dt, 0.1);
    simulation.run(0);
    const double before = simulation.energy().total();
    simulation.run(std::lround(0.12 / dt));
    const EnergyBalance after = simulation.energy();
    EXPECT_GT(after.ledger.damping, 0);
    EXPECT_GT(after.ledger.into_slide, 0);
    return std::abs(after.total() - before) / (after.ledger.damping + after.ledger.into_slide);
  };
  const double coarse = left(1e-5);
  EXPECT_LT(coarse, 5e-4);
  EXPECT_LT(left(2.5e-6), 0.5 * coarse + 1e-5);
}

TEST(Clumps, AreTakenAwayAndHeldAsAWhole) {
  Simulation simulation = mixture({}, 1);
  simulation.run(2000);
  const State& s = simulation.state();
  const std::size_t clumps = s.clumps.all.size(), spheres = s.grains.count();
  // Of one sphere of the third clump.
  const GrainId first = s.clumps.members[s.clumps.all[2].first].id;
  const std::uint32_t of_third = s.clumps.all[2].count;
  const Vec3 at = simulation.grain(first).position;
  EXPECT_EQ(simulation.remove_grains([&](const GrainNow& grain) { return grain.position == at; }), of_third);
  EXPECT_EQ(s.clumps.all.size(), clumps - 1);
  EXPECT_EQ(s.grains.count(), spheres - of_third);
  const Vec3 there = simulation.grain(s.clumps.members.front().id).position;
  const std::size_t held = simulation.hold_grains([&](const GrainNow& grain) { return grain.position == there; });
  EXPECT_EQ(held, s.clumps.all.front().count);
  const Vec3 before = s.clumps.all.front().motion.position;
  simulation.run(2000);
  EXPECT_EQ(s.clumps.all.front().motion.position, before);
  EXPECT_GT(length(s.clumps.all.back().motion.velocity), 0);
}

TEST(Clumps, FallAsleep) {
  Simulation simulation = mixture({}, 1, false, 0.05);
  simulation.run(60000);
  EXPECT_GT(simulation.share_asleep(), 0.3);
  const State& s = simulation.state();
  for (const Clump& clump : s.clumps.all) EXPECT_GT(clump.motion.position.z, 0.003);
}

// As a soil's grains.

TEST(GrainsOfSeveralSpheres, HaveTheVolumeOfTheirRadius) {
  GranularSoil soil = test::soft_soil();
  for (const GrainShape shape : {GrainShape::two_spheres, GrainShape::three_spheres, GrainShape::four_spheres}) {
    soil.shape = shape;
    for (const double spacing : {0.5, 1.0, 2.0}) {
      soil.sphere_spacing = spacing;
      EXPECT_NEAR(shape_of(soil)->volume, 4 * pi / 3, 1e-5);
      const GrainProportions are = proportions_of(soil);
      EXPECT_GT(are.ball, 1);
      EXPECT_LT(are.sphere, 1);
      EXPECT_NEAR(are.solid, spacing == 2 ? 1 : are.solid, 1e-6);
      EXPECT_LT(are.solid, 1 + 1e-6);
    }
  }
  soil.sphere_spacing = 2.5;
  EXPECT_THROW(shape_of(soil), InputError);
}

BedRecipe bed_of_rods() {
  BedRecipe recipe = test::small_recipe({0.3, 0.12, 0.08});
  recipe.soil.shape = GrainShape::two_spheres;
  return recipe;
}

TEST(SlowGrainsOfSeveralSpheres, MakeABedThatAStoreKeeps) {
  const BedRecipe recipe = bed_of_rods();
  EXPECT_NE(recipe_text(recipe), recipe_text(test::small_recipe(recipe.size)));
  const SettledBed bed = settle_bed(recipe, test::with_threads(1));
  EXPECT_NEAR(bed.report.height, recipe.size.depth, 0.1 * recipe.size.depth);
  EXPECT_EQ(bed.report.grains, bed.state.clumps.all.size());
  EXPECT_EQ(2 * bed.report.grains, bed.state.grains.count());
  EXPECT_GT(bed.report.coordination, 3);
  for (const StressAtDepth& here : bed.report.stress) EXPECT_NEAR(here.stress, here.weight, 0.3 * here.weight + 20);
  const test::Folder folder;
  const SettledBed kept = *BedStore(folder.path()).bed(recipe, test::with_threads(1));
  const SettledBed again = *BedStore(folder.path()).bed(recipe, test::with_threads(2));
  EXPECT_EQ(test::bits(kept.state), test::bits(again.state));
}

TEST(GrainsOfSeveralSpheres, AreNotGivenToLammps) {
  BedRecipe recipe = bed_of_rods();
  recipe.settled_by = SettledBy::lammps;
  EXPECT_THROW(check(recipe), InputError);
}

/// Without a law of rolling spheres are weak; the same contacts between rods carry more.
TEST(SlowGrainsOfSeveralSpheres, ShearAtAHigherStressThanSpheres) {
  const auto strength = [](GrainShape shape) {
    GranularSoil soil = test::soft_soil();
    soil.shape = shape;
    soil.youngs_modulus = 2e7;
    soil.grain_grain.rolling_friction = 0, soil.grain_grain.sliding_friction = 0.5;
    DirectShearSettings settings;
    settings.specimen.laws.rolling = RollingLaw::none, settings.stresses = {10e3};
    settings.length = 20, settings.width = 6, settings.travel = 2;
    const DirectShearResult result = direct_shear(soil, settings, test::with_threads(1));
    return result.runs.front().peak.value;
  };
  const double spheres = strength(GrainShape::sphere), rods = strength(GrainShape::two_spheres);
  EXPECT_GT(rods, 1.1 * spheres);
}

}  // namespace
}  // namespace soilbin::dem
