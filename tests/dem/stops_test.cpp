// What stops a run, what is refused, and what a change in mid-run leaves alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "dem/engine/rayleigh_time.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

using test::soft_stone;
using testing::AllOf;
using testing::HasSubstr;

constexpr double ball_radius = 0.01;

/// What an exception of this kind says.
template <class Exception, class Act>
std::string message(const Act& act) {
  try {
    act();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

Simulation with_floor(const Setup& setup) {
  Simulation simulation(setup);
  Body floor;
  floor.surfaces.push_back({Plane{}, 0});
  simulation.add_body(floor);
  return simulation;
}

TEST(Stops, AtAnOverlapTooDeep) {
  auto setup = soft_stone();
  setup.numerics.deepest_overlap = 0.1;
  Simulation two(setup);
  two.add_grain({0, 0, 0}, ball_radius, 0, {20, 0, 0});
  two.add_grain({0.0205, 0, 0}, ball_radius, 0);
  EXPECT_THAT(
      message<RunStopped>([&] { two.run(1000); }),
      testing::AllOf(HasSubstr("grain 0 overlaps grain 1 by 0.128 of the smaller radius, more than 0.1, time 9e-05 s"),
                     HasSubstr("hint: stiffer grains"), testing::Not(HasSubstr("deepest_overlap"))))
      << "not all who step grains let people choose the limit";
  EXPECT_EQ(two.state().step, 9);

  Simulation floor = with_floor(setup);
  floor.add_grain({0, 0, 0.0105}, ball_radius, 0, {0, 0, -20});
  EXPECT_THAT(message<RunStopped>([&] { floor.run(1000); }), HasSubstr("grain 0 overlaps body 0"));
}

TEST(Stops, WhereAGrainLeavesTheDomain) {
  auto setup = soft_stone();
  setup.domain = {{-1, -1, -1}, {1, 1, 1}};
  Simulation simulation(setup);
  simulation.add_grain({0, 0, 0}, ball_radius, 0);
  simulation.add_grain({0.9, 0, 0}, ball_radius, 0, {10, 0, 0});
  EXPECT_THAT(message<RunStopped>([&] { simulation.run(2000); }),
              AllOf(HasSubstr("grain 1 left the domain at (1"), HasSubstr("time 0.01")));
}

TEST(Stops, AtWhatIsNotFinite) {
  Simulation simulation(soft_stone());
  simulation.add_grain({0, 0, 0}, ball_radius, 0);
  simulation.add_grain({0.1, 0, 0}, ball_radius, 0, {not_a_number, 0, 0});
  EXPECT_THAT(message<RunStopped>([&] { simulation.run(10); }),
              AllOf(HasSubstr("motion of grain 1 is not finite"), HasSubstr("time 1e-05")));

  Simulation with_body = with_floor(soft_stone());
  with_body.add_grain({0, 0, 1}, ball_radius, 0);
  with_body.run(3);
  with_body.body(0).turning = Turning::free;
  with_body.body(0).applied_torque = {not_a_number, 0, 0};
  EXPECT_THAT(message<RunStopped>([&] { with_body.run(10); }), HasSubstr("motion of a body is not finite"));
}

TEST(TimeStep, IsRefusedBeyondTheSafeShare) {
  // T_R = pi r sqrt(rho/G)/(0.1631 nu + 0.8766), G = E/(2(1 + nu)) = 5e6/2.5.
  const double rayleigh = 3.14159265 * ball_radius * std::sqrt(2500 / 2e6) / (0.1631 * 0.25 + 0.8766);
  auto setup = soft_stone();
  const auto run = [&](double dt, bool force) {
    setup.numerics.dt = dt;
    setup.numerics.force_step = force;
    Simulation simulation(setup);
    simulation.add_grain({0, 0, 0}, ball_radius, 0);
    simulation.run(1);
    EXPECT_NEAR(rayleigh_time(simulation.setup().materials, simulation.state().grains), rayleigh, 1e-6 * rayleigh);
  };
  EXPECT_NO_THROW(run(0.199 * rayleigh, false));
  EXPECT_NO_THROW(run(0.5 * rayleigh, true));
  EXPECT_THAT(message<InputError>([&] { run(0.25 * rayleigh, false); }),
              AllOf(HasSubstr("0.25 of the Rayleigh time"), HasSubstr("at most 0.000242 s, or force_step")));
}

TEST(Setups, ThatMakeNoSenseAreRefused) {
  EXPECT_THAT(message<InputError>([] { Simulation({}); }), HasSubstr("needs a material"));
  auto flat = soft_stone();
  flat.domain.upper.z = flat.domain.lower.z;
  EXPECT_THAT(message<InputError>([&] { Simulation{flat}; }), HasSubstr("no volume"));
  auto still = soft_stone();
  still.numerics.dt = 0;
  EXPECT_THAT(message<InputError>([&] { Simulation{still}; }), HasSubstr("time step must be above 0"));
  auto other = soft_stone();
  other.numerics.instruction_set = "mmx";
  EXPECT_THAT(message<InputError>([&] { Simulation{other}; }), HasSubstr("no instruction set 'mmx'"));
  auto small = soft_stone();
  small.domain = {{0, 0, 0}, {0.05, 1, 1}, {true, false, false}};
  Simulation narrow(small);
  narrow.add_grain({0.02, 0.5, 0.5}, ball_radius, 0);
  EXPECT_THAT(message<InputError>([&] { narrow.run(1); }), HasSubstr("periodic side of 0.05 m is shorter"));
  auto no_spring = soft_stone();
  no_spring.laws.normal = NormalLaw::hooke;
  no_spring.materials.set(0, 0, {});
  Simulation hooke(no_spring);
  hooke.add_grain({}, ball_radius, 0);
  EXPECT_THAT(message<InputError>([&] { hooke.run(1); }), HasSubstr("stone on stone has no normal stiffness"));
}

TEST(Setups, ANumberThatMakesNoSenseIsRefusedByItsName) {
  const double infinite = std::numeric_limits<double>::infinity();
  const auto refused = [](const auto& spoil) {
    auto setup = soft_stone();
    spoil(setup.numerics);
    return message<InputError>([&] { Simulation{setup}; });
  };
  EXPECT_THAT(refused([](Numerics& n) { n.dt = not_a_number; }), HasSubstr("dt: the time step must be above 0"));
  EXPECT_THAT(refused([](Numerics& n) { n.safe_share = not_a_number; }), HasSubstr("safe_share: "));
  EXPECT_THAT(refused([](Numerics& n) { n.skin = not_a_number; }), HasSubstr("skin: "));
  EXPECT_THAT(refused([&](Numerics& n) { n.skin = infinite; }), HasSubstr("skin: "));
  EXPECT_THAT(refused([](Numerics& n) { n.deepest_overlap = 0; }), HasSubstr("deepest_overlap: "));
  EXPECT_THAT(refused([](Numerics& n) { n.sleep.speed = -1; }), HasSubstr("sleep.speed: "));
  EXPECT_THAT(refused([](Numerics& n) { n.sleep.time = not_a_number; }), HasSubstr("sleep.time: "));
  EXPECT_THAT(refused([](Numerics& n) { n.threads = -1; }), HasSubstr("threads: "));
  Simulation simulation(soft_stone());
  Numerics later = simulation.setup().numerics;
  later.safe_share = -1;
  EXPECT_THAT(message<InputError>([&] { simulation.set_numerics(later); }), HasSubstr("safe_share: "));
}

TEST(Setups, LawsThatMakeNoSenseAreRefused) {
  auto both = soft_stone({{NormalLaw::hooke, RollingLaw::none, CohesionLaw::jkr}, -1});
  EXPECT_THAT(message<InputError>([&] { Simulation{both}; }), HasSubstr("jkr cohesion needs the normal law hertz"));
  auto damping = soft_stone({{}, not_a_number});
  EXPECT_THAT(message<InputError>([&] { Simulation{damping}; }), HasSubstr("tangential_damping: "));
}

TEST(Setups, AnInteractionThatMakesNoSenseIsRefusedByWhatIsWrong) {
  const auto refused = [](const Interaction& interaction) {
    Materials materials;
    return message<InputError>([&] { materials.add({"stone", 2500, 5e6, 0.25}, interaction); });
  };
  EXPECT_THAT(refused({.restitution = 1.1}), HasSubstr("material stone: the restitution must lie in [0, 1]"));
  EXPECT_THAT(refused({.sliding_friction = -1}), HasSubstr("the sliding friction must be 0 or more"));
  EXPECT_THAT(refused({.rolling_friction = -1}), HasSubstr("rolling friction"));
  EXPECT_THAT(refused({.rolling_damping = not_a_number}), HasSubstr("rolling damping"));
  EXPECT_THAT(refused({.rolling_stiffness = -1}), HasSubstr("rolling stiffness"));
  EXPECT_THAT(refused({.rolling_viscosity = -1}), HasSubstr("rolling viscosity"));
  EXPECT_THAT(refused({.cohesion = -1}), HasSubstr("cohesion"));
  EXPECT_THAT(refused({.normal_stiffness = -1}), HasSubstr("normal stiffness"));
  EXPECT_THAT(refused({.shear_stiffness = -1}), HasSubstr("shear stiffness must be 0 or more and finite, not -1"));
}

TEST(Setups, GrainsThatMakeNoSenseAreRefused) {
  auto setup = soft_stone();
  setup.domain = {{-1, -1, -1}, {1, 1, 1}};
  Simulation simulation(setup);
  EXPECT_THAT(message<InputError>([&] { simulation.add_grain({}, 0, 0); }), HasSubstr("radius must be above 0"));
  EXPECT_THAT(message<InputError>([&] { simulation.add_grain({}, ball_radius, 1); }), HasSubstr("no material 1"));
  EXPECT_THAT(message<InputError>([&] {
                simulation.add_grain({2, 0, 0}, ball_radius, 0);
              }),
              HasSubstr("outside the domain"));
  EXPECT_THAT(message<InputError>([&] {
                simulation.add_grain({not_a_number, 0, 0}, ball_radius, 0);
              }),
              HasSubstr("outside the domain"));
  EXPECT_EQ(simulation.state().grains.count(), 0u);
}

TEST(Setups, BodiesThatMakeNoSenseAreRefused) {
  Simulation simulation(soft_stone());
  const auto refused = [&](const auto& spoil) {
    Body body = test::mesh_body(box({1, 1, 1}));
    body.name = "plate";
    spoil(body);
    return message<InputError>([&] { simulation.add_body(body); });
  };
  EXPECT_THAT(refused([](Body& b) { b.mass = 0; }), HasSubstr("body plate: mass and inertia"));
  EXPECT_THAT(refused([](Body& b) { b.inertia.y = not_a_number; }), HasSubstr("mass and inertia"));
  EXPECT_THAT(refused([](Body& b) { b.surfaces[0].material = 3; }), HasSubstr("there is no material 3"));
  EXPECT_THAT(refused([](Body& b) {
                b.surfaces[0].shape = Plane{{}, {0, 0, 2}};
              }),
              HasSubstr("normal must have length"));
  EXPECT_THAT(refused([](Body& b) { b.surfaces[0].shape = MeshSurface{}; }), HasSubstr("has no mesh"));
  EXPECT_THAT(refused([](Body& b) { b.rotation.w = 2; }), HasSubstr("rotation must have length 1"));
  EXPECT_THAT(refused([](Body& b) { b.turning = Turning::about_axis, b.axis = {}; }), HasSubstr("axis must"));
  EXPECT_THAT(refused([](Body& b) { b.servo = Servo{.direction = {0, 0, 3}}; }), HasSubstr("direction must"));
  EXPECT_THAT(refused([](Body& b) { b.servo.emplace(), b.free_translation[2] = true; }), HasSubstr("where it is free"));
  EXPECT_TRUE(simulation.state().bodies.empty());
}

TEST(MidRun, ABodyThatMakesNoSenseIsRefused) {
  const auto refused = [](const auto& act) {
    Simulation simulation = with_floor(soft_stone());
    simulation.add_grain({0, 0, 0.0099}, ball_radius, 0);
    simulation.run(1);
    return message<InputError>([&] {
      act(simulation);
      simulation.run(1);
    });
  };
  EXPECT_THAT(refused([](Simulation& s) { s.body(0).mass = -1; }), HasSubstr("mass and inertia must be above 0"));
  EXPECT_THAT(refused([](Simulation& s) { s.body(0).surfaces[0].material = 7; }), HasSubstr("there is no material 7"));
  EXPECT_THAT(refused([](Simulation& s) { s.body(0).position.x = not_a_number; }),
              HasSubstr("position must be finite"));

  Simulation simulation = with_floor(soft_stone());
  EXPECT_THAT(message<InputError>([&] {
                simulation.move_body(0, {0, 0, not_a_number}, {});
              }),
              HasSubstr("position must be finite"));
  EXPECT_THAT(message<InputError>([&] {
                simulation.move_body(0, {}, {2, 0, 0, 0});
              }),
              HasSubstr("rotation must have length 1"));
  EXPECT_THROW(simulation.move_body(1, {}, {}), std::out_of_range);
  EXPECT_EQ(simulation.body(0).position, Vec3{}) << "it stays where it is";
}

TEST(Setups, ABodyNeedsNoGrains) {
  Simulation simulation(soft_stone());
  Body body = test::mesh_body(box({1, 1, 1}));
  body.velocity = {1, 0, 0};
  simulation.add_body(body);
  simulation.run(100);
  EXPECT_NEAR(simulation.body(0).position.x, 1e-3, 1e-15);
  simulation.add_grain({0.6, 0, 0}, ball_radius, 0);
  simulation.run(10000);
  EXPECT_GT(simulation.grain(0).velocity.x, 0.9) << "pushed along";
}

/// A pair pressed together and slid, so that springs are wound up, and a third grain far away.
Simulation pressed() {
  auto setup = soft_stone({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1});
  Simulation simulation = with_floor(setup);
  simulation.set_gravity({2, 0, -9.81});
  simulation.add_grain({0, 0, 0.0099}, ball_radius, 0);
  simulation.add_grain({0.0199, 0, 0.0099}, ball_radius, 0, {-0.05, 0.05, 0}, {3, 1, 0});
  simulation.add_grain({0.5, 0, 0.5}, ball_radius, 0);
  simulation.run(100);
  return simulation;
}

void expect_same_pair(const Simulation& a, const Simulation& b) {
  for (const GrainId id : {0u, 1u}) {
    EXPECT_LT(length(a.grain(id).position - b.grain(id).position), 1e-15);
    EXPECT_LT(length(a.grain(id).velocity - b.grain(id).velocity), 1e-13);
    EXPECT_LT(length(a.grain(id).spin - b.grain(id).spin), 1e-11);
  }
}

TEST(MidRun, RemovalAndInsertionLeaveOtherContactsAlone) {
  Simulation left_alone = pressed(), removed = pressed(), added = pressed();
  ASSERT_GE(left_alone.contacts().size(), 3u) << "the pair touches, and the floor";
  EXPECT_EQ(removed.remove_grains([](const GrainNow& grain) { return grain.position.z > 0.3; }), 1u);
  EXPECT_EQ(removed.state().grains.count(), 2u);
  EXPECT_THROW(removed.grain(2), std::out_of_range);
  added.add_grain({-0.5, 0, 0.5}, ball_radius, 0);
  Body far = test::mesh_body(box({0.1, 0.1, 0.1}));
  far.position = {-1, -1, 0};
  added.add_body(far);
  for (Simulation* each : {&left_alone, &removed, &added}) each->run(300);
  expect_same_pair(left_alone, removed);
  expect_same_pair(left_alone, added);
}

TEST(MidRun, GrainsAddedTogetherTouchNobodyBeforeTheyAreThere) {
  // Their rows are those that filled up the list of pairs before.
  Simulation simulation = pressed();
  const std::size_t before = simulation.contacts().size();
  simulation.add_grain({1, 0, 1}, ball_radius, 0);
  simulation.add_grain({1.015, 0, 1}, ball_radius, 0);
  EXPECT_EQ(simulation.contacts().size(), before);
  simulation.run(0);
  EXPECT_EQ(simulation.contacts().size(), before + 1);
}

TEST(MidRun, ANewGrainThatIsRemovedOthersStartAsUsual) {
  // A grain thrown up: v(t) = v0 - g t, whole steps; a removal before the first step must not spoil that.
  Simulation simulation(soft_stone());
  simulation.set_gravity({0, 0, -10});
  simulation.add_grain({0, 0, 0}, ball_radius, 0, {0, 0, 1});
  simulation.add_grain({1, 0, 0}, ball_radius, 0);
  simulation.remove_grains([](const GrainNow& grain) { return grain.position.x > 0.5; });
  EXPECT_NEAR(simulation.grain(0).velocity.z, 1, 1e-15);
  simulation.run(1000);
  EXPECT_NEAR(simulation.grain(0).velocity.z, 1 - 10 * 0.01, 1e-13);
  EXPECT_NEAR(simulation.grain(0).position.z, 0.01 - 5 * 0.0001, 1e-13);
}

TEST(MidRun, ANewTimeStepKeepsTheClockAndTheParabola) {
  Simulation simulation(soft_stone());
  simulation.set_gravity({0, 0, -10});
  simulation.add_grain({0, 0, 0}, ball_radius, 0, {0, 0, 1});
  simulation.run(1000);
  Numerics finer = simulation.setup().numerics;
  finer.dt = 2e-6;
  simulation.set_numerics(finer);
  simulation.run(5000);
  EXPECT_NEAR(simulation.time(), 0.02, 1e-13);
  EXPECT_NEAR(simulation.grain(0).velocity.z, 1 - 10 * 0.02, 1e-12);
  EXPECT_NEAR(simulation.grain(0).position.z, 0.02 - 5 * 0.0004, 1e-12);
}

}  // namespace
}  // namespace soilbin::dem
