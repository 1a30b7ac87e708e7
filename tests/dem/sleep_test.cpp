// Grains at rest are left out of the work: when they sleep, when they wake, and what that changes.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/archive/restart.hpp"
#include "dem/bed/settled_bed.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

constexpr double slow = 0.01, calm_time = 0.01;

/// A channel of some 500 grains, 1 m long: some forty slabs. Settled once for all tests.
const SettledBed& channel() {
  static const SettledBed bed = settle_bed(test::small_recipe({1.0, 0.06, 0.06}), test::with_threads(1));
  return bed;
}

Setup setup_with(double speed, int threads = 1) {
  Setup setup = channel().setup;
  setup.numerics.threads = threads;
  setup.numerics.ledger = true;
  setup.numerics.sleep = {speed, calm_time};
  return setup;
}

Simulation at_rest(double speed = slow) { return Simulation(setup_with(speed), channel().state); }

std::int64_t steps_of(const Simulation& simulation, double time) {
  return std::llround(time / simulation.setup().numerics.dt);
}

/// Held in the sand at one end and drawn along: it ploughs.
Body plough() {
  Body body = test::mesh_body(box({0.02, 0.04, 0.05}));
  body.name = "plough";
  body.position = {0.2, 0.03, 0.06};
  body.velocity = {0.1, 0, 0};
  return body;
}

Simulation ploughed(Setup setup) {
  Simulation simulation(std::move(setup), channel().state);
  simulation.remove_grains(
      [](const GrainNow& grain) { return std::abs(grain.position.x - 0.2) < 0.025 && grain.position.z > 0.025; });
  simulation.add_body(plough());
  return simulation;
}

TEST(Sleep, IsOffUnlessASpeedIsGiven) {
  Simulation simulation = at_rest(0);
  simulation.run(steps_of(simulation, 3 * calm_time));
  EXPECT_EQ(simulation.share_asleep(), 0);
}

TEST(Sleep, ComesAfterTheCalmTimeAndHoldsGrainsExactlyStill) {
  Simulation simulation = at_rest();
  const std::int64_t calm_steps = steps_of(simulation, calm_time);
  simulation.run(calm_steps);
  EXPECT_EQ(simulation.share_asleep(), 0);
  simulation.run(2);
  EXPECT_EQ(simulation.share_asleep(), 1);
  const auto before = simulation.state().grains.motion;
  simulation.run(300);
  const auto& after = simulation.state().grains.motion;
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k)
    EXPECT_TRUE(after[k].position == before[k].position && after[k].velocity == Vec3{}) << k;
}

// A grain that rocks among many at rest keeps nobody awake, one that falls does, and so do many that creep.
TEST(Sleep, CountsTheMeanSpeedOfASlabAndALoneGrainTenTimesLess) {
  State state;
  state.surfaces.resize(4);
  state.calm.assign(4, 0);
  Numerics numerics;
  numerics.dt = 0.01;
  numerics.sleep = {1, 0.03};
  Sleeping sleeping;
  sleeping.begin(state);
  const std::vector<SlabSpeed> speeds = {{9.9, 0.5}, {10.1, 0.5}, {1.2, 1.01}, {0.9, 0.9}};
  for (int k = 0; k < 5; ++k) sleeping.count_calm(state, numerics, speeds);
  EXPECT_EQ(state.calm, (std::vector<std::uint32_t>{3, 0, 0, 3})) << "as many steps as the time holds, no more";
}

TEST(Sleep, LeavesTheWeightOnTheFloor) {
  Simulation simulation = at_rest();
  simulation.run(steps_of(simulation, 2 * calm_time));
  ASSERT_EQ(simulation.share_asleep(), 1);
  double weight = 0;
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k)
    weight += 9.81 / simulation.state().grains.motion[k].inverse_mass;
  EXPECT_NEAR(-simulation.body(bin_body).force.z, weight, 0.01 * weight);
}

TEST(Sleep, EndsForAllWhenGravityOrWhatIsThereChanges) {
  const auto awake_after = [](const auto& change) {
    Simulation simulation = at_rest();
    simulation.run(steps_of(simulation, 2 * calm_time));
    EXPECT_EQ(simulation.share_asleep(), 1);
    change(simulation);
    simulation.run(1);
    EXPECT_EQ(simulation.share_asleep(), 0);
  };
  awake_after([](Simulation& s) { s.set_gravity({0.1, 0, -9.81}); });
  awake_after([](Simulation& s) { s.add_grain({0.5, 0.03, 0.2}, 0.01, grain_material); });
  awake_after([](Simulation& s) {
    Body high = plough();
    high.position.z = 0.2;
    s.add_body(high);
  });
  awake_after([](Simulation& s) { s.move_body(bin_body, s.body(bin_body).position, {}); });
  awake_after([](Simulation& s) { s.set_interaction(0, 0, {.restitution = 0.4, .sliding_friction = 0.1}); });
  awake_after([](Simulation& s) { s.remove_grains([](const GrainNow& g) { return g.position.x > 0.95; }); });
}

TEST(Sleep, NeverComesNearABodyThatMayMove) {
  Simulation simulation = at_rest();
  Body plate = test::mesh_body(box({0.05, 0.05, 0.01}));
  plate.position = {0.5, 0.03, 0.082};
  plate.mass = 0.2;
  plate.weighs = true;
  plate.free_translation = {false, false, true};
  simulation.add_body(plate);
  simulation.run(steps_of(simulation, 0.6));
  EXPECT_GT(simulation.share_asleep(), 0.6);
  EXPECT_LT(simulation.share_asleep(), 1);
  EXPECT_NEAR(simulation.body(1).force.z, 0.2 * 9.81, 0.05) << "it rests on grains that feel it";
}

TEST(Sleep, EndsWhereAGrainFallsOnTheBed) {
  Simulation simulation = at_rest();
  simulation.run(steps_of(simulation, 2 * calm_time));
  const GrainId stone = simulation.add_grain({0.5, 0.03, 0.12}, 0.012, grain_material, {0, 0, -1});
  std::vector<Vec3> before(simulation.state().next_id);
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k)
    before[simulation.state().grains.id[k]] = simulation.state().grains.motion[k].position;
  simulation.run(steps_of(simulation, 0.25));
  EXPECT_LT(simulation.grain(stone).position.z, 0.1);
  double farthest = 0;
  for (std::size_t k = 0; k < simulation.state().grains.count(); ++k)
    if (simulation.state().grains.id[k] != stone)
      farthest = std::max(
          farthest, length(simulation.state().grains.motion[k].position - before[simulation.state().grains.id[k]]));
  EXPECT_GT(farthest, 1e-4) << "grains under it gave way";
  EXPECT_GT(simulation.share_asleep(), 0.3) << "those far from it sleep again";
}

TEST(SlowSleep, DoesNotChangeWhatAPloughFeelsBeyondRounding) {
  // Far grains move slower than the limit and are held: the plough's force over 0.1 s is that of the full run as long
  // as what they would have moved can't come back to it.
  Simulation full = ploughed(setup_with(0)), sleeping = ploughed(setup_with(slow));
  double work_full = 0, asleep = 0;
  const int looks = 20;
  for (int k = 0; k < looks; ++k) {
    full.run(steps_of(full, 0.005));
    sleeping.run(steps_of(sleeping, 0.005));
    asleep += sleeping.share_asleep() / looks;
  }
  work_full = full.body(1).work;
  EXPECT_GT(asleep, 0.3);
  EXPECT_GT(work_full, 0);
  EXPECT_NEAR(sleeping.body(1).work, work_full, 0.02 * work_full);
}

TEST(SlowSleep, AddsNothingToWhatTheLedgerMisses) {
  const auto missed = [](double speed, double& losses) {
    Simulation simulation = ploughed(setup_with(speed));
    simulation.run(1);
    const double before = simulation.energy().total();
    simulation.run(steps_of(simulation, 0.1));
    const EnergyBalance after = simulation.energy();
    losses = after.ledger.damping + after.ledger.into_slide + after.ledger.into_roll;
    return after.total() - before;
  };
  double losses = 0, losses_slower = 0, losses_full = 0;
  const double sleeping = missed(slow, losses), slower = missed(slow / 4, losses_slower), full = missed(0, losses_full);
  EXPECT_LT(losses, losses_slower) << "slow creep of those asleep is left out: less of it below a lower limit";
  EXPECT_LT(losses_slower, losses_full);
  EXPECT_NEAR(losses_slower, losses_full, 0.02 * losses_full);
  EXPECT_NEAR(sleeping, full, 0.002 * losses_full);
  EXPECT_NEAR(slower, full, 0.002 * losses_full);
}

TEST(SlowSleep, LeavesNoLoadsBehindThatWouldKickGrainsAwake) {
  Simulation simulation = ploughed(setup_with(slow));
  simulation.run(steps_of(simulation, 2 * calm_time));
  for (int k = 0; k < 10; ++k) {  // with searches, after which those asleep press on the floor anew
    simulation.run(steps_of(simulation, 0.01));
    ASSERT_GT(simulation.share_asleep(), 0.5);
    for (const Load& load : simulation.state().grains.load) EXPECT_TRUE(load.force == Vec3{} && load.torque == Vec3{});
  }
  std::vector<GrainId> stood;
  const Grains& grains = simulation.state().grains;
  for (std::size_t row = 0; row < grains.count(); ++row)
    if (grains.motion[row].velocity == Vec3{}) stood.push_back(grains.id[row]);
  simulation.set_gravity(simulation.state().gravity);  // wakes all
  simulation.run(1);
  ASSERT_EQ(simulation.share_asleep(), 0);
  for (const GrainId id : stood) EXPECT_LT(length(simulation.grain(id).velocity), slow);
}

TEST(SlowSleep, HasTheSameBitsForSeveralThreadsAndAcrossARestart) {
  test::Folder folder;
  Simulation one = ploughed(setup_with(slow, 1)), two = ploughed(setup_with(slow, 2)),
             four = ploughed(setup_with(slow, 4));
  const std::int64_t steps = steps_of(one, 0.03);
  for (Simulation* simulation : {&one, &two, &four}) simulation->run(steps);
  ASSERT_GT(one.share_asleep(), 0.1);
  EXPECT_EQ(test::bits(two.state()), test::bits(one.state()));
  EXPECT_EQ(test::bits(four.state()), test::bits(one.state()));
  write_restart(folder / "run.h5", one.setup(), one.state(), {});
  Restart again = read_restart(folder / "run.h5");
  Simulation resumed(again.setup, std::move(again.state));
  one.run(steps);
  resumed.run(steps);
  EXPECT_EQ(test::bits(resumed.state()), test::bits(one.state()));
}

}  // namespace
}  // namespace soilbin::dem
