// In a vacuum, grains keep their momentum and their angular momentum under each law, to rounding.
#include <gtest/gtest.h>

#include "tests/dem/worlds.hpp"

namespace soilbin::dem {
namespace {

struct Momentum {
  Vec3 linear, angular;
  double size = 0, turn = 0;  ///< sums of the magnitudes, which rounding is a share of
};

/// At the half steps, where leapfrog keeps both exactly: x(t) x v(t + dt/2) is x(t + dt) x v(t + dt/2).
Momentum momentum(const State& state) {
  Momentum sum;
  for (std::size_t k = 0; k < state.grains.count(); ++k) {
    const Motion& grain = state.grains.motion[k];
    const Spin& spin = state.grains.spin[k];
    const Vec3 linear = grain.velocity / grain.inverse_mass;
    const Vec3 angular = cross(grain.position, linear) + spin.rate / spin.inverse_inertia;
    sum.linear += linear;
    sum.angular += angular;
    sum.size += length(linear);
    sum.turn += length(angular);
  }
  return sum;
}

class MomentumUnder : public testing::TestWithParam<ContactLaws> {};

TEST_P(MomentumUnder, IsKept) {
  Simulation simulation(test::soft_stone(GetParam()));
  test::add(simulation, test::cloud(64, 4, 1.0));
  simulation.run(0);
  const Momentum before = momentum(simulation.state());
  std::size_t touching = 0;
  for (int part = 0; part < 100; ++part) {
    simulation.run(10);
    touching += simulation.contacts().size();
  }
  const Momentum after = momentum(simulation.state());
  EXPECT_GT(touching, 200u) << "nothing touches, so nothing is tried";
  EXPECT_LT(length(after.linear - before.linear), 1e-13 * before.size);
  EXPECT_LT(length(after.angular - before.angular), 1e-13 * before.turn);
}

INSTANTIATE_TEST_SUITE_P(Laws, MomentumUnder, testing::ValuesIn(test::all_laws()), [](const auto& of) {
  std::string name = test::name_of(of.param);
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
});

}  // namespace
}  // namespace soilbin::dem
