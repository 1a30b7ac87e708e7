// The energy ledger: what is there, plus what left, less what came, is zero but for the error of the time step.
//
// Work is counted at the mean of the velocities half a step before and after a force: exactly what the motion gets.
// What is left is of second order in dt, but for half a step's loss: what is there is told at t, what left up to t -
// dt/2. That is of first order and doesn't add up. Tests state how far the ledger is off and what half the step does to
// it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

using test::soft_stone;

using std::numbers::pi;

constexpr double r = 0.01, density = 2500;
const double stone_mass = density * 4 / 3 * pi * r * r * r;

Setup counted(const ContactLaws& laws, double dt, const Interaction& interaction = test::every_law()) {
  Setup setup = soft_stone(laws, interaction);
  setup.numerics.ledger = true;
  setup.numerics.dt = dt;
  return setup;
}

/// How far the ledger is open after `time`, as a share of the energy that came in.
double open_after(Simulation& simulation, double time) {
  const auto steps = std::lround(time / simulation.setup().numerics.dt);
  double worst = 0;
  for (int part = 0; part < 20; ++part) {
    simulation.run(steps / 20);
    worst = std::max(worst, std::abs(simulation.energy().total()));
  }
  return worst / simulation.energy().ledger.added;
}

/// Two grains that meet: head on for no `offset` [m] and no spin.
double open_after_impact(const ContactLaws& laws, double dt, double offset, double spin, double restitution) {
  Interaction contact = test::every_law();
  contact.restitution = restitution;
  Simulation simulation(counted(laws, dt, contact));
  simulation.add_grain({0, 0, 0}, r, 0, {1, 0, 0}, {0, spin, 0});
  simulation.add_grain({2 * r + 1e-4, offset, 0}, r, 0, {-1, 0, 0}, {0, 0, spin});
  return open_after(simulation, 6e-3);
}

TEST(EnergyLosses, IsZeroAtTheStart) {
  Simulation simulation(counted({}, 1e-5));
  test::add(simulation, test::cloud(27, 3, 1));
  EXPECT_EQ(simulation.energy().total(), 0);
  simulation.run(0);
  EXPECT_NEAR(simulation.energy().total(), 0, 1e-15);
  double kinetic = 0;
  for (const test::Grain& g : test::cloud(27, 3, 1)) {
    const double m = density * 4 / 3 * pi * g.radius * g.radius * g.radius;
    kinetic += 0.5 * m * (squared(g.velocity) + 0.4 * g.radius * g.radius * squared(g.spin));
  }
  EXPECT_NEAR(simulation.energy().ledger.added, kinetic, 1e-12 * kinetic);
}

TEST(EnergyLosses, OfAnElasticImpactClosesToSecondOrder) {
  // Nothing is lost, so nothing is counted half a step early.
  const double coarse = open_after_impact({}, 1e-5, 0, 0, 1), fine = open_after_impact({}, 5e-6, 0, 0, 1);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 3);
}

TEST(SlowLedger, ClosesInImpactsUnderEachLaw) {
  for (const ContactLaws& laws : test::all_laws())
    for (const double offset : {0.0, 0.5 * r, 1.2 * r}) {
      const double spin = offset > 0 ? 80 : 0;
      const double coarse = open_after_impact(laws, 4e-6, offset, spin, 0.6);
      const double fine = open_after_impact(laws, 2e-6, offset, spin, 0.6);
      EXPECT_LT(coarse, 3e-3) << test::name_of(laws) << ", offset " << offset;
      EXPECT_LT(fine, 0.6 * coarse) << test::name_of(laws) << ", offset " << offset;
    }
}

/// How far it is open when both have parted, as a share of the energy that came in.
double open_when_over(const ContactLaws& laws, double dt) {
  Simulation simulation(counted(laws, dt));
  simulation.add_grain({0, 0, 0}, r, 0, {1, 0, 0}, {0, 80, 0});
  simulation.add_grain({2 * r + 1e-4, 0.5 * r, 0}, r, 0, {-1, 0, 0}, {0, 0, 80});
  simulation.run(std::lround(8e-3 / dt));
  EXPECT_TRUE(simulation.contacts().empty()) << test::name_of(laws);
  return std::abs(simulation.energy().total()) / simulation.energy().ledger.added;
}

TEST(EnergyLosses, ClosesToSecondOrderOnceAnImpactIsOver) {
  for (const ContactLaws& laws : test::all_laws()) {
    const double coarse = open_when_over(laws, 4e-6);
    EXPECT_LT(coarse, 5e-6) << test::name_of(laws);
    // These begin or end with a jump, whose place within the step is chance.
    if (laws.normal == NormalLaw::hooke || laws.cohesion == CohesionLaw::jkr) continue;
    EXPECT_LT(open_when_over(laws, 2e-6), 0.3 * coarse) << test::name_of(laws);
  }
}

// Three walls press on a grain that comes to rest. Each couple may stop its whole spin in a step, so all three together
// turn it round again and again.
TEST(EnergyLosses, ClosesWhereCouplesTurnASpinRound) {
  Interaction contact = test::every_law();
  contact.rolling_friction = 0.3;
  Simulation simulation(counted({{NormalLaw::hertz, RollingLaw::directional, CohesionLaw::none}, -1}, 2e-5, contact));
  simulation.set_gravity({-5, -6, -7});
  simulation.add_body(test::box_of_planes({0, 0, 0}, {1, 1, 1}));
  simulation.add_grain({r, r, r}, r, 0, {}, {30, -20, 10});
  simulation.run(2000);
  const double came = simulation.energy().ledger.added, before = simulation.energy().total();
  ASSERT_EQ(simulation.contacts().size(), 3u);
  int turned = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 spin = simulation.state().grains.spin[0].rate;
    simulation.run(1);
    turned += dot(spin, simulation.state().grains.spin[0].rate) < 0;
  }
  EXPECT_GT(turned, 900);
  simulation.run(9000);
  EXPECT_NEAR(simulation.energy().total(), before, 1e-6 * came);
}

TEST(EnergyLosses, TellsWhatAnAdhesiveContactKeepsWhenItBreaks) {
  // 7.09 (w^5 R^4/E*^2)^(1/3), Thornton and Ning 1998, Powder Technology 99:154, of an else elastic impact.
  Interaction contact = test::every_law();
  contact.restitution = 1;
  contact.cohesion = 2;
  Simulation simulation(counted({{NormalLaw::hertz, RollingLaw::none, CohesionLaw::jkr}, -1}, 1e-6, contact));
  simulation.add_grain({0, 0, 0}, r, 0, {0.2, 0, 0});
  simulation.add_grain({2 * r + 1e-5, 0, 0}, r, 0, {-0.2, 0, 0});
  simulation.run(8000);
  ASSERT_TRUE(simulation.contacts().empty()) << "it has stuck";
  const double young = 5e6 / (2 * (1 - 0.25 * 0.25)), radius = r / 2;
  const double expected = 7.09 * std::cbrt(std::pow(contact.cohesion, 5) * std::pow(radius, 4) / (young * young));
  const EnergyBalance now = simulation.energy();
  EXPECT_NEAR(now.ledger.adhesion, expected, 1e-3 * expected);
  EXPECT_NEAR(now.kinetic, stone_mass * 0.04 - expected, 1e-3 * stone_mass * 0.04);
}

TEST(EnergyLosses, TellsWhatAHeadOnImpactLoses) {
  Simulation simulation(counted({}, 1e-6));
  simulation.add_grain({0, 0, 0}, r, 0, {1, 0, 0});
  simulation.add_grain({2 * r + 1e-4, 0, 0}, r, 0, {-1, 0, 0});
  simulation.run(3000);
  const EnergyBalance now = simulation.energy();
  const double before = 2 * 0.5 * stone_mass, e = 0.6;
  EXPECT_NEAR(now.kinetic, e * e * before, 2e-3 * before);
  EXPECT_NEAR(now.ledger.damping, (1 - e * e) * before, 2e-3 * before);
  EXPECT_NEAR(now.ledger.sliding, 0, 1e-30);
  EXPECT_EQ(now.elastic, 0);
}

double open_cloud(const ContactLaws& laws, double dt) {
  Simulation simulation(counted(laws, dt));
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.06, 0.06, 0.06}));
  test::add(simulation, test::cloud(27, 3, 1));
  return open_after(simulation, 0.04);
}

TEST(SlowLedger, ClosesInABoxUnderEachLaw) {
  for (const ContactLaws& laws : test::all_laws()) {
    const double coarse = open_cloud(laws, 1e-5), fine = open_cloud(laws, 5e-6);
    EXPECT_LT(coarse, 1e-3) << test::name_of(laws);
    EXPECT_LT(fine, 0.6 * coarse) << test::name_of(laws);
  }
}

TEST(EnergyLosses, IsTheSameByEveryInstructionSet) {
  std::vector<EnergyLosses> told;
  for (const std::string_view set : instruction_sets()) {
    auto setup = counted({{NormalLaw::hertz, RollingLaw::directional, CohesionLaw::none}, -1}, 1e-5);
    setup.numerics.instruction_set = set;
    Simulation simulation(setup);
    simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.06, 0.06, 0.06}));
    test::add(simulation, test::cloud(27, 3, 1));
    simulation.run(600);
    told.push_back(simulation.energy().ledger);
    EXPECT_GT(told.back().into_roll, 1e-4 * told.back().added) << set;
    for (double EnergyLosses::*row : {&EnergyLosses::damping, &EnergyLosses::into_slide, &EnergyLosses::into_roll})
      EXPECT_NEAR(told.back().*row, told.front().*row, 1e-8 * told.front().added) << set;
  }
}

/// Grains fall into a box and come to rest.
double open_column(double dt) {
  Simulation simulation(counted({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1}, dt));
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.06, 0.06, 1}));
  test::add(simulation, test::cloud(90, 3, 0.1));
  // Share of what they fall by, about half the height of the column.
  simulation.run(0);
  const double before = simulation.energy().potential;
  simulation.run(std::lround(0.6 / dt));
  const EnergyBalance now = simulation.energy();
  EXPECT_LT(now.kinetic, 1e-4 * (before - now.potential)) << "it has not settled";
  return std::abs(now.total()) / (before - now.potential);
}

TEST(SlowLedger, ClosesInAColumnThatSettles) {
  const double coarse = open_column(2e-5), fine = open_column(1e-5);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.6 * coarse);
}

/// A paddle sweeps through a layer of grains; as a share of the work it does.
double open_paddle(RollingLaw rolling, double dt) {
  auto setup = counted({{NormalLaw::hertz, rolling, CohesionLaw::none}, -1}, dt);
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.2, 0.06, 1}));
  test::add(simulation, test::cloud(45, 3, 0.1));
  Body paddle = test::mesh_body(box({0.01, 0.06, 0.05}));
  paddle.position = {0.19, 0.02, 0.02};
  paddle.velocity = {-0.5, 0, 0};
  paddle.spin = {0, 2, 0};
  const int index = simulation.add_body(paddle);
  simulation.run(std::lround(0.26 / dt));
  const double work = simulation.body(index).work;
  EXPECT_GT(work, 0.005);
  EXPECT_DOUBLE_EQ(simulation.body(index).driven_work, work) << "all its motion is driven";
  EXPECT_NEAR(simulation.energy().work_of_drives, work, 1e-15);
  return std::abs(simulation.energy().total()) / work;
}

// Falls as the step does; in the mean of two steps, as each run takes its own way through the grains.
TEST(SlowLedger, ClosesWithADrivenBody) {
  for (const RollingLaw rolling : {RollingLaw::elastic_plastic, RollingLaw::directional}) {
    const double coarse = (open_paddle(rolling, 8e-5) + open_paddle(rolling, 4e-5)) / 2;
    const double fine = (open_paddle(rolling, 1e-5) + open_paddle(rolling, 5e-6)) / 2;
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, 0.2 * coarse) << "an eighth of the step";
  }
}

// What tangential springs, dashpots and sliders take together is what springs hold, dashpots lose and sliders lose.
TEST(SlowLedger, PartsOfSlidingAddUpUnderTheDefaultLaw) {
  Simulation simulation(counted({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1}, 1e-5));
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.2, 0.06, 1}));
  test::add(simulation, test::cloud(45, 3, 0.1));
  Body paddle = test::mesh_body(box({0.01, 0.06, 0.05}));
  paddle.position = {0.19, 0.02, 0.02};
  paddle.velocity = {-0.5, 0, 0};
  simulation.add_body(paddle);
  simulation.run(26000);
  const EnergyBalance now = simulation.energy();
  EXPECT_GT(now.ledger.into_slide, 1e-3);
  EXPECT_NEAR(now.ledger.shear_damping + now.ledger.sliding + now.tangential, now.ledger.into_slide,
              0.03 * now.ledger.into_slide);
}

/// A heavy box falls on a layer of grains, turns as it likes and is pushed; as a share of what it and the grains fall
/// by.
double open_free_box(double dt) {
  auto setup = counted({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1}, dt);
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.06, 0.06, 1}));
  test::add(simulation, test::cloud(18, 3, 0.1));
  Body body = test::mesh_body(box({0.05, 0.04, 0.03}));
  body.position = {0.0225, 0.0225, 0.08};
  body.rotation = rotation_by({0.3, 0.2, 0.1});
  body.mass = 0.15;
  body.inertia = body.mass / 12 * Vec3{25e-4, 34e-4, 41e-4};
  body.free_translation = {true, true, true};
  body.turning = Turning::free;
  body.weighs = true;
  body.applied_force = {0.1, 0, 0};
  body.applied_torque = {0, 0, 0.001};
  const int index = simulation.add_body(body);
  simulation.run(std::lround(0.2 / dt));
  EXPECT_GT(length(simulation.body(index).force), 0.1) << "it has not landed";
  return std::abs(simulation.energy().total()) / (0.15 * 9.81 * (0.08 - simulation.body(index).position.z));
}

TEST(SlowLedger, ClosesWithAFreeBody) {
  const double coarse = open_free_box(2e-5), fine = open_free_box(1e-5);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(EnergyLosses, CountsWhatIsChangedBetweenSteps) {
  Simulation simulation(counted({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1}, 1e-5));
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.06, 0.06, 1}));
  test::add(simulation, test::cloud(36, 3, 0.5));
  simulation.run(3000);
  const double open = simulation.energy().total();
  const auto unchanged = [&] { return std::abs(simulation.energy().total() - open) < 1e-12; };
  EXPECT_GT(simulation.contacts().size(), 5u);
  simulation.set_gravity({1, 2, -5});
  EXPECT_TRUE(unchanged()) << "gravity";
  simulation.add_grain({0.02, 0.02, 0.5}, r, 0, {1, 0, 0});
  EXPECT_TRUE(unchanged()) << "grain, not yet";
  simulation.run(0);
  EXPECT_TRUE(unchanged()) << "grain";
  EXPECT_GT(simulation.remove_grains([](const GrainNow& g) { return g.position.x < 0.03; }), 10u);
  EXPECT_TRUE(unchanged()) << "grains gone";
  Interaction other = test::every_law();
  other.sliding_friction = 0;
  simulation.set_interaction(0, 0, other);
  simulation.run(0);
  EXPECT_TRUE(unchanged()) << "friction";
  Body body = test::mesh_body(box({0.02, 0.02, 0.02}));
  body.free_translation = {true, true, true};
  body.weighs = true;
  body.position = {0.02, 0.02, 0.8};
  body.velocity = {3, 0, 0};
  simulation.add_body(body);
  EXPECT_TRUE(unchanged()) << "body";
}

TEST(EnergyLosses, CountsTheFallThroughAPeriodicBox) {
  // It falls n boxes deep; each time it comes in again at the top, with the potential energy of one box more.
  auto setup = counted({}, 1e-4);
  setup.domain = {{0, 0, 0}, {0.2, 0.2, 0.2}, {true, true, true}};
  setup.numerics.force_step = true;
  Simulation simulation(setup);
  simulation.set_gravity({0, 0, -9.81});
  simulation.add_grain({0.1, 0.1, 0.1}, r, 0);
  simulation.run(5000);
  EXPECT_NEAR(simulation.energy().kinetic, 0.5 * stone_mass * 4.905 * 4.905, 1e-9);
  EXPECT_NEAR(simulation.energy().total(), 0, 1e-9);
}

}  // namespace
}  // namespace soilbin::dem
