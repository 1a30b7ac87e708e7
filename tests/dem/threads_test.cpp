// The same bits for any number of threads, and for a run that goes on from a copy of its state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

/// A bed of 400 grains in a box with a free cuboid that falls in and a paddle that stirs.
Simulation stirred_bed(const ContactLaws& laws, int threads, const std::string& instruction_set = "") {
  Setup setup = test::soft_stone(laws);
  setup.numerics.dt = 2e-5;
  setup.numerics.threads = threads;
  setup.numerics.ledger = true;
  setup.numerics.instruction_set = instruction_set;
  Simulation simulation(setup);
  simulation.set_gravity({0.5, 0, -9.81});
  simulation.add_body(test::box_of_planes({-0.015, -0.015, -0.015}, {0.42, 0.1, 0.2}));
  Random random(5);
  for (int k = 0; k < 400; ++k) {
    const Vec3 at = 0.0205 * Vec3{double(k / 20), double(k % 5), double(k / 5 % 4)};
    simulation.add_grain(at + test::any(random, 0.0002), random.uniform(0.007, 0.01), 0, test::any(random, 1),
                         test::any(random, 20));
  }
  Body paddle = test::mesh_body(box({0.01, 0.08, 0.1}));
  paddle.position = {0.05, 0.04, 0.11};
  paddle.velocity = {1, 0, -0.2};
  paddle.spin = {0, 3, 1};
  simulation.add_body(paddle);
  Body falls = test::mesh_body(box({0.05, 0.04, 0.03}));
  falls.position = {0.25, 0.04, 0.095};
  falls.velocity = {0, 0, -1};
  falls.free_translation = {true, true, true};
  falls.turning = Turning::free;
  falls.inertia = {1e-3, 2e-3, 3e-3};
  falls.weighs = true;
  simulation.add_body(falls);
  return simulation;
}

void expect_same_bits(const ContactLaws& laws, int threads, int steps) {
  Simulation one = stirred_bed(laws, 1), several = stirred_bed(laws, threads);
  one.run(steps);
  several.run(steps);
  EXPECT_GT(one.state().slab_rows.size(), 15u) << "slabs for four threads to share";
  EXPECT_GT(one.contacts().size(), 10u) << test::name_of(laws);
  EXPECT_NE(one.body(1).work, 0) << test::name_of(laws);
  EXPECT_EQ(test::bits(several.state()), test::bits(one.state())) << threads << ' ' << test::name_of(laws);
}

/// Threads that work on so many grains apart from each other.
int threads_on(int grains, int asked) {
  Setup setup = test::soft_stone();
  setup.numerics.threads = asked;
  Simulation simulation(setup);
  for (int k = 0; k < grains; ++k) simulation.add_grain({0.03 * (k % 20), 0.03 * (k / 20), 0}, 0.01, 0);
  simulation.run(1);
  return simulation.threads();
}

TEST(Threads, AreAsManyAsAreAskedForOrAsGrainsKeepBusy) {
  EXPECT_EQ(threads_on(2, 0), 1);
  EXPECT_EQ(threads_on(3999, 0), 1);
  EXPECT_EQ(threads_on(4000, 0), std::min(2, threads_on(16000, 0)));
  EXPECT_EQ(threads_on(2, 3), 3);
}

// A machine that takes `seconds(threads)` for a step and gives the process `share` of a core for each thread.
struct Machine {
  std::function<double(int)> seconds;
  double share;
};

/// Threads kept after some seconds of steps, and how much of the time went into steps of another number.
struct Paced {
  int kept = 0;
  double share_on_trial = 0;
};

Paced pace_on(const Machine& machine, ThreadPace& pace, double duration) {
  double time = 0, on_trial = 0;
  while (time < duration) {
    const int threads = pace.threads();
    const double wall = machine.seconds(threads);
    time += wall;
    if (threads != pace.kept()) on_trial += wall;
    pace.count_step(wall, machine.share * threads * wall);
  }
  return {pace.kept(), on_trial / time};
}

TEST(ThreadPace, GivesUpThreadsThatWaitForCores) {
  const Machine quiet{[](int threads) { return 1e-3 / threads; }, 1.0};
  const Machine busy{[](int threads) { return threads == 1 ? 3e-3 : 8e-3; }, 0.4};
  ThreadPace pace(2);
  EXPECT_EQ(pace_on(busy, pace, 10).kept, 1);
  EXPECT_LT(pace_on(busy, pace, 300).share_on_trial, 0.04);
  EXPECT_EQ(pace_on(quiet, pace, 75).kept, 2) << "the other programs have ended";
  EXPECT_EQ(pace_on(quiet, pace, 300).share_on_trial, 0) << "threads that have their cores are left alone";
}

TEST(ThreadPace, KeepsThreadsThatAreFasterThoughTheyWait) {
  const Machine shared{[](int threads) { return 1e-3 / threads; }, 0.5};
  ThreadPace pace(8);
  const Paced paced = pace_on(shared, pace, 300);
  EXPECT_EQ(paced.kept, 8);
  EXPECT_LT(paced.share_on_trial, 0.04);
}

// The share of the cores that a process gets differs by half from one half second to the next.
TEST(ThreadPace, IsNotMisledByOneGoodHalfSecond) {
  Random random(3);
  double share = 1, until = 0, time = 0;
  const auto seconds = [&](int threads) {
    if (time >= until) share = std::exp(random.uniform(-0.5, 0.5)), until += 0.5;
    const double wall = 1e-3 / threads / share;  // two are twice as fast on average
    time += wall;
    return wall;
  };
  ThreadPace pace(2);
  double with_one = 0, all = 0;
  for (int k = 0; k < 60; ++k) {
    pace_on({seconds, 0.5}, pace, 10);
    ++all, with_one += pace.kept() == 1;
  }
  EXPECT_LT(with_one / all, 0.1);
}

TEST(ThreadPace, FindsTheBestOfMany) {
  const Machine busy{[](int threads) { return 1e-3 / threads + (threads > 4 ? 2e-4 * threads : 0); }, 0.5};  // 4 cores
  ThreadPace pace(16);
  EXPECT_EQ(pace_on(busy, pace, 60).kept, 4);
}

TEST(Threads, ThatChangeOnTheWayGiveTheSameBits) {
  Simulation one = stirred_bed({}, 1), changing = stirred_bed({}, 1);
  for (const int threads : {1, 3, 2, 4}) {
    Numerics numerics = one.setup().numerics;
    one.set_numerics(numerics), one.run(20);
    numerics.threads = threads;
    changing.set_numerics(numerics), changing.run(20);
  }
  EXPECT_EQ(test::bits(changing.state()), test::bits(one.state()));
}

TEST(SlowThreads, OfTwoGiveTheSameBitsUnderEachLaw) {
  for (const ContactLaws& laws : test::all_laws()) expect_same_bits(laws, 2, 100);
}

TEST(SlowThreads, OfFourGiveTheSameBitsUnderEachLaw) {
  for (const ContactLaws& laws : test::all_laws()) expect_same_bits(laws, 4, 60);
}

TEST(SlowThreads, GiveTheSameBitsInALongRun) {
  for (const int threads : {2, 4})
    expect_same_bits({{NormalLaw::hertz, RollingLaw::elastic_plastic, CohesionLaw::none}, -1}, threads, 1500);
}

TEST(SlowCopy, GoesOnWithTheSameBitsUnderEachLaw) {
  for (const ContactLaws& laws : test::all_laws()) {
    Simulation whole = stirred_bed(laws, 1);
    whole.run(137);
    Simulation copy(whole.setup(), whole.state());
    EXPECT_EQ(test::bits(copy.state()), test::bits(whole.state()));
    whole.run(400);
    copy.run(400);
    EXPECT_EQ(test::bits(copy.state()), test::bits(whole.state())) << test::name_of(laws);
  }
}

TEST(Copy, GoesOnWithTheSameBitsWhateverWasChangedJustBefore) {
  const auto expect_same = [](const char* what, const auto& change) {
    Simulation whole = stirred_bed({}, 1);
    whole.run(137);
    change(whole);
    Simulation copy(whole.setup(), whole.state());
    whole.run(200);
    copy.run(200);
    EXPECT_EQ(test::bits(copy.state()), test::bits(whole.state())) << what;
  };
  expect_same("a grain", [](Simulation& s) { s.add_grain({0.2, 0.03, 0.15}, 0.009, 0, {0, 0, -3}); });
  expect_same("a body", [](Simulation& s) {
    Body small = test::mesh_body(box({0.02, 0.02, 0.02}));
    small.position = {0.3, 0.04, 0.12};
    s.add_body(small);
  });
  expect_same("an interaction", [](Simulation& s) { s.set_interaction(0, 0, {}); });
  expect_same("grains gone",
              [](Simulation& s) { s.remove_grains([](const GrainNow& grain) { return grain.position.x > 0.2; }); });
  expect_same("the largest grain gone", [](Simulation& s) {
    double largest = 0;
    for (const GrainNow& grain : s.grains()) largest = std::max(largest, grain.radius);
    s.remove_grains([&](const GrainNow& grain) { return grain.radius > 0.9 * largest; });
  });
  expect_same("gravity", [](Simulation& s) { s.set_gravity({0, 1, -9}); });
  expect_same("the time step", [](Simulation& s) {
    Numerics finer = s.setup().numerics;
    finer.dt /= 2;
    s.set_numerics(finer);
  });
}

TEST(Copy, OfARunThatHasNotBegunIsThatRun) {
  Simulation whole = stirred_bed({}, 1);
  Simulation copy(whole.setup(), whole.state());
  whole.run(200);
  copy.run(200);
  EXPECT_EQ(test::bits(copy.state()), test::bits(whole.state()));
}

TEST(InstructionSets, GiveTheSameTrajectoryToRounding) {
  // sse4 not to the bit: it has no fused operations.
  for (const std::string_view set : instruction_sets()) {
    Simulation widest = stirred_bed({}, 1), other = stirred_bed({}, 1, std::string(set));
    widest.run(100);
    other.run(100);
    double worst = 0;
    for (GrainId id = 0; id < 400; ++id)
      worst = std::max(worst, length(widest.grain(id).position - other.grain(id).position));
    EXPECT_LT(worst, 1e-13) << set;
  }
}

TEST(InstructionSets, ThatFuseMultiplyAndAddGiveTheSameBitsUnderEachLaw) {
  if (instruction_sets().front() != "avx512") GTEST_SKIP() << "no avx512 here to compare avx2 with";
  const auto after = [](const ContactLaws& laws, const char* set, bool ledger) {
    Simulation bed = stirred_bed(laws, 1, set);
    Numerics numerics = bed.setup().numerics;
    numerics.ledger = ledger;
    bed.set_numerics(numerics);
    bed.run(100);
    return test::bits(bed.state());
  };
  for (const ContactLaws& laws : test::all_laws())
    for (const bool ledger : {false, true})
      EXPECT_EQ(after(laws, "avx2", ledger), after(laws, "avx512", ledger)) << test::name_of(laws) << ' ' << ledger;
}

}  // namespace
}  // namespace soilbin::dem
