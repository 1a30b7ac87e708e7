// Grains that are held: a rough base that nothing moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

constexpr double grain_radius = 0.01;

bool all(const GrainNow&) { return true; }

/// 27 grains held close to each other, on a plane that they overlap, and 64 that fall on them.
Simulation rough_base(Setup setup) {
  Simulation simulation(std::move(setup));
  Body floor;
  floor.surfaces.push_back({Plane{}, 0});
  simulation.add_body(floor);
  for (int k = 0; k < 27; ++k)
    simulation.add_grain({0.019 * (k % 3), 0.019 * (k / 3 % 3), 0.009 + 0.019 * (k / 9)}, grain_radius, 0, {1, 2, 3},
                         {4, 5, 6});
  simulation.hold_grains(all);
  for (test::Grain grain : test::cloud(64, 4, 1)) {
    grain.position.z += 0.08;
    test::add(simulation, {grain});
  }
  simulation.set_gravity({0, 0, -9.81});
  return simulation;
}

TEST(HeldGrain, ThrowsABallBackLikeAnythingOfInfiniteMass) {
  dem::Setup setup = test::soft_stone({{.normal = NormalLaw::hooke}}, {.restitution = 0.6, .normal_stiffness = 2e4});
  setup.numerics.dt = 1e-7;
  Simulation simulation(setup);
  simulation.add_grain({}, grain_radius, 0);
  EXPECT_EQ(simulation.hold_grains(all), 1u);
  const GrainId ball = simulation.add_grain({2 * grain_radius, 0, 0}, grain_radius, 0, {-1, 0, 0});
  // Of mass m alone: pi sqrt(m/k (1 - beta^2)) = 2.25e-3 s long for m = 0.01047 kg, and e of its speed afterwards.
  simulation.run(25000);
  EXPECT_NEAR(simulation.grain(ball).velocity.x, 0.6, 1e-3);
  EXPECT_EQ(simulation.grain(0).position, Vec3{});
  EXPECT_EQ(simulation.grain(0).velocity, Vec3{});
}

TEST(HeldGrain, StaysWhereItIsUnderGravityAndBlows) {
  Simulation simulation = rough_base(test::soft_stone());
  const GrainNow before = simulation.grain(13);
  simulation.run(5000);
  EXPECT_EQ(simulation.grain(13).position, before.position);
  EXPECT_EQ(length(simulation.grain(13).velocity) + length(simulation.grain(13).spin), 0);
}

TEST(HeldGrain, FeelsNeitherItsLikeNorSurfaces) {
  Simulation simulation = rough_base(test::soft_stone());
  for (const Contact& contact : simulation.contacts())
    EXPECT_GE(std::max<std::int64_t>(contact.first, contact.second), 27) << "two of the base";
  simulation.run(1);
  EXPECT_EQ(length(simulation.body(0).force), 0) << "the base presses on the floor";
}

TEST(HeldGrain, HoldingTwiceHoldsNobodyAnew) {
  Simulation simulation = rough_base(test::soft_stone());
  EXPECT_EQ(simulation.hold_grains([](const GrainNow& grain) { return grain.position.z < 0.05; }), 0u);
  EXPECT_EQ(simulation.hold_grains(all), 64u);
}

TEST(HeldGrain, EnergyThatHoldingTakesIsAccountedFor) {
  for (const ContactLaws& laws : test::all_laws()) {
    dem::Setup setup = test::soft_stone(laws);
    setup.numerics.ledger = true;
    Simulation simulation = rough_base(setup);
    simulation.run(2000);
    const double scale = simulation.energy().kinetic;
    EXPECT_LT(std::abs(simulation.energy().total()), 3e-3 * scale) << test::name_of(laws);
    const double open = simulation.energy().total();
    simulation.hold_grains([](const GrainNow& grain) { return grain.position.x < 0.02; });
    EXPECT_NEAR(simulation.energy().total(), open, 1e-12 * scale) << test::name_of(laws);
  }
}

TEST(HeldGrain, SameBitsForThreadsAndAfterAStop) {
  dem::Setup setup = test::soft_stone();
  setup.domain = {{-0.1, -0.1, -0.1}, {0.2, 0.2, 0.5}, {true, true, false}};
  Simulation one = rough_base(setup), three = rough_base(setup);
  Numerics numerics = setup.numerics;
  numerics.threads = 3;
  three.set_numerics(numerics);
  one.run(1500);
  Simulation resumed(setup, one.state());
  for (Simulation* each : {&one, &resumed}) each->run(1500);
  three.run(3000);
  EXPECT_EQ(test::bits(one.state()), test::bits(resumed.state()));
  EXPECT_EQ(test::bits(one.state()), test::bits(three.state()));
}

}  // namespace
}  // namespace soilbin::dem
