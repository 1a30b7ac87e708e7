// How fast trajectories converge as the step is halved: to second order where nothing depends on velocity, to first
// order where dashpots act, for a force at t is made from velocities at t - dt/2.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

struct Throw {
  double restitution;
  Vec3 velocity, spin;
  NormalLaw law;
};

/// A grain that comes within `gap` of one at rest at t = 0, as it is at `time`.
GrainNow thrown(const Throw& how, double dt, double time, double gap = 0) {
  Interaction contact = test::every_law();
  contact.restitution = how.restitution;
  Setup setup = test::soft_stone({{how.law, RollingLaw::none, CohesionLaw::none}, -1}, contact);
  setup.numerics.dt = dt;
  Simulation simulation(setup);
  simulation.add_grain({0, 0, 0}, 0.01, 0, how.velocity, how.spin);
  simulation.add_grain({0.02 + gap, 0, 0}, 0.01, 0);
  simulation.run(std::lround(time / dt));
  return simulation.grain(0);
}

/// log2 of |f(h) - f(h/2)| over |f(h/2) - f(h/4)|, of a member of GrainNow after a millisecond, in mid-impact.
double order(const Throw& how, Vec3 GrainNow::*what) {
  const double h = 5e-6, time = 1e-3;
  const Vec3 a = thrown(how, h, time).*what, b = thrown(how, h / 2, time).*what, c = thrown(how, h / 4, time).*what;
  return std::log2(length(a - b) / length(b - c));
}

TEST(Convergence, IsOfSecondOrderWhereNothingDependsOnVelocity) {
  const Throw head_on[] = {{1, {1, 0, 0}, {}, NormalLaw::hertz}, {1, {1, 0, 0}, {}, NormalLaw::hooke}};
  for (const Throw& how : head_on) {
    EXPECT_NEAR(order(how, &GrainNow::position), 2, 0.05);
    EXPECT_NEAR(order(how, &GrainNow::velocity), 2, 0.05);
  }
  const Throw sticks{1, {1, 0.6, 0}, {0, 0, 30}, NormalLaw::hertz};
  EXPECT_NEAR(order(sticks, &GrainNow::position), 2, 0.05);
  EXPECT_NEAR(order(sticks, &GrainNow::velocity), 2, 0.05);
  EXPECT_NEAR(order(sticks, &GrainNow::spin), 2, 0.05);
}

TEST(Convergence, IsOfFirstOrderWithDashpots) {
  for (const NormalLaw law : {NormalLaw::hertz, NormalLaw::hooke}) {
    const Throw how{0.5, {1, 0.6, 0}, {0, 0, 30}, law};
    EXPECT_NEAR(order(how, &GrainNow::velocity), 1, 0.05);
    EXPECT_NEAR(order(how, &GrainNow::spin), 1, 0.05);
  }
}

/// How far the rebound of a head-on impact is off e, on average over where in a step it begins.
double error_of_restitution(double e, double dt) {
  double sum = 0;
  for (int k = 0; k < 64; ++k)
    sum += thrown({e, {1, 0, 0}, {}, NormalLaw::hertz}, dt, 8e-3, 1e-5 + k / 64.0 * dt).velocity.x - (1 - e) / 2;
  return std::abs(sum / 64);
}

TEST(Convergence, OfTheRestitutionIsOfFirstOrder) {
  for (const double e : {0.3, 0.7}) {
    const double coarse = error_of_restitution(e, 2e-5), fine = error_of_restitution(e, 1e-5);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1) << e;
    EXPECT_LT(fine, 5e-3) << "a step of 1/300 of the impact";
  }
}

}  // namespace
}  // namespace soilbin::dem
