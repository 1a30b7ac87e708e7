// The rut behind a wheel and the soil's velocity round it: identities on made beds, then a wheel on grains.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/rig/rut.hpp"
#include "dem/rig/soil_flow.hpp"
#include "dem/rig/step_criteria.hpp"
#include "dem/rig/wheel_run.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

constexpr BedSize made_size{1.0, 0.4, 0.1};

/// Grains in layers on a square lattice that fills the bin; the pitch divides every side.
Grains made_bed() {
  Grains grains;
  std::uint32_t id = 0;
  for (int iz = 0; iz < 5; ++iz)
    for (int iy = 0; iy < 20; ++iy)
      for (int ix = 0; ix < 50; ++ix)
        grains.add({.id = id++,
                    .radius = 0.01,
                    .mass = 1e-3,
                    .position = {0.01 + 0.02 * ix, 0.01 + 0.02 * iy, 0.01 + 0.02 * iz}});
  return grains;
}

const Track made_track{0.2, 0.1, 0.3, 0.5, 0.7};

/// Seen at one point over each column of grains: at its top.
Rut rut_of(const Grains& before, const Grains& after) {
  const double pitch = 0.02;
  return rut_between(bed_surface(before, made_size, 2 * pitch), bed_surface(after, made_size, 2 * pitch), made_track,
                     pitch);
}

TEST(Rut, OfAnUntouchedBedIsNothing) {
  const Grains bed = made_bed();
  const Rut rut = rut_of(bed, bed);
  ASSERT_EQ(rut.y.size(), 20U);
  ASSERT_EQ(rut.x.size(), 50U);
  EXPECT_NEAR(rut.y.front(), -0.19, 1e-12);
  for (const double change : rut.across) EXPECT_EQ(change, 0);
  for (const double change : rut.along) EXPECT_EQ(change, 0);
  EXPECT_EQ(rut.volume, 0);
}

TEST(Rut, OfABedLiftedAsAWholeIsTheLift) {
  const Grains bed = made_bed();
  Grains lifted = bed;
  for (auto& grain : lifted.motion) grain.position.z += 0.003;
  const Rut rut = rut_of(bed, lifted);
  for (const double change : rut.across) EXPECT_NEAR(change, 0.003, 1e-9);
  for (const double change : rut.along) EXPECT_NEAR(change, 0.003, 1e-9);
  EXPECT_NEAR(rut.volume, 0.003 * 1.0 * 0.4, 1e-9);
  EXPECT_EQ(rut.dug, 0);
}

// The top layer of the track is moved to lie beside it: what is dug is heaped, the profile shows both, and nothing
// else.
TEST(Rut, WhatIsDugIsHeaped) {
  const Grains bed = made_bed();
  Grains after = bed;
  for (auto& grain : after.motion)
    if (grain.position.z > 0.085 && std::abs(grain.position.y - 0.2) < 0.045)
      grain.position = grain.position + Vec3{0, 0.1, 0.02};  // onto the layer beside
  const Rut rut = rut_of(bed, after);
  EXPECT_NEAR(rut.volume, 0, 1e-9);
  EXPECT_NEAR(rut.heaped, 0.02 * 1.0 * 0.08, 1e-9);  // four rows
  for (std::size_t k = 0; k < rut.y.size(); ++k) {
    const double y = rut.y[k], moved = std::abs(y) < 0.04 ? -0.02 : std::abs(y - 0.1) < 0.04 ? 0.02 : 0.0;
    EXPECT_NEAR(rut.across[k], moved, 1e-9) << y;
  }
}

TEST(SoilFlow, OfABedAtRestIsZero) {
  FlowMeter meter(0.02, 0.2, 0.2, 0);
  const Grains bed = made_bed();
  for (int k = 0; k < 3; ++k) meter.add(bed, {0.4 + 0.02 * k, 0.2, 0.2});
  const SoilFlow flow = meter.flow();
  ASSERT_EQ(flow.nx, 20);
  ASSERT_EQ(flow.nz, 10);
  int seen = 0;
  for (std::size_t k = 0; k < flow.vx.size(); ++k) {
    if (std::isnan(flow.vx[k])) continue;
    ++seen;
    EXPECT_EQ(flow.vx[k], 0);
    EXPECT_EQ(flow.vz[k], 0);
  }
  EXPECT_EQ(seen, 20 * 5);  // five layers of grains, the upper five rows of cells empty
  // Two rows of grains within the thickness of two cells: one grain in each cell of 0.02 m on either side.
  const double one = 4.0 / 3 * 3.14159265358979 * 1e-6;
  EXPECT_NEAR(flow.solid[0], one / 8e-6, 1e-9);
}

TEST(SoilFlow, OfARigidTranslationIsUniform) {
  FlowMeter meter(0.03, 0.3, 0.2, 0);
  Grains bed = made_bed();
  for (auto& grain : bed.motion) grain.velocity = {0.7, -0.2, 0.1};
  meter.add(bed, {0.5, 0.2, 0.2});
  const SoilFlow flow = meter.flow();
  int seen = 0;
  for (std::size_t k = 0; k < flow.vx.size(); ++k) {
    if (std::isnan(flow.vx[k])) continue;
    ++seen;
    EXPECT_NEAR(flow.vx[k], 0.7, 1e-14);
    EXPECT_NEAR(flow.vz[k], 0.1, 1e-14);
  }
  EXPECT_GE(seen, 20 * 3);  // cells of 0.03 m over 0.6 m, and over the 0.1 m that five layers fill
}

// The step that soilbin takes by itself is a fifth of the Rayleigh time; both times go with the radius of the smallest
// grain; an impact four times as fast is 4^(1/5) shorter.
TEST(StepCriteria, FollowTheSmallestGrain) {
  BedRecipe recipe = test::small_recipe();
  const StepCriteria one = step_criteria(recipe, {}, 0.5), fast = step_criteria(recipe, {}, 2);
  EXPECT_NEAR(one.step / one.rayleigh, 0.999 * 0.2, 1e-12);
  EXPECT_NEAR(one.hertz / fast.hertz, std::pow(4, 0.2), 1e-12);
  recipe.soil.radius_min /= 2;
  const StepCriteria small = step_criteria(recipe, {}, 0.5);
  EXPECT_NEAR(one.rayleigh / small.rayleigh, 2, 1e-12);
  EXPECT_NEAR(one.hertz / small.hertz, 2, 1e-12);
  recipe.dt = 1e-6;
  EXPECT_EQ(step_criteria(recipe, {}, 0.5).step, 1e-6);

  Tire tire;
  tire.radius = 0.5, tire.lugs.height = 0.02;
  OperatingCondition at;
  at.load = 1, at.slip = 0.2, at.speed = 0.4;
  EXPECT_NEAR(rim_speed(tire, at), 0.52 * 0.4 / (0.5 * 0.8), 1e-12);
}

// A wheel on grains. Below and far ahead of it the soil rests; under it soil goes down and, at positive slip, backward
// somewhere. Grains only change places: the bed's volume changes by what its density does, and no part of a granular
// bed can loosen by more than from its densest (0.64) to its loosest (0.55) packing, over the depth of the bed under
// what was moved.
TEST(SlowRigOutputs, OfAWheelOnGrains) {
  const SettledBed bed = settle_bed(test::small_recipe({0.5, 0.16, 0.08}), test::with_threads(1));
  Tire tire;
  tire.radius = 0.1, tire.width = 0.08;
  Rig rig;
  rig.behind = 0.1, rig.ahead = 0.12;
  rig.lowering = 0.1, rig.resting = 0.02, rig.starting = 0.05;
  OperatingCondition at;
  at.load = 20, at.slip = 0.3, at.speed = 0.3;
  const WheelRun run = run_wheel({bed, tire, bed.recipe.soil.grain_tire, rig}, at, test::with_threads(1));

  const Rut& rut = run.rut;
  EXPECT_NEAR(rut.axle, 0.5 - 0.12, 0.01);
  ASSERT_FALSE(rut.across.empty());
  double in_track = 0;
  int cells = 0;
  for (std::size_t k = 0; k < rut.y.size(); ++k)
    if (std::abs(rut.y[k]) < 0.03) in_track += rut.across[k], ++cells;
  EXPECT_LT(in_track / cells, 0) << "the wheel leaves a rut";
  EXPECT_GT(in_track / cells, -2 * run.result.sinkage.value - bed.recipe.soil.radius_max);
  const double moved = 0.28 * 0.16 * 0.08;
  EXPECT_LT(std::abs(rut.volume), (0.64 / 0.55 - 1) * moved);
  EXPECT_GT(rut.dug, std::abs(rut.volume) / 10);

  const SoilFlow& flow = run.flow;
  double backward = 0, fastest = 0;
  for (std::size_t k = 0; k < flow.vx.size(); ++k) {
    if (std::isnan(flow.vx[k])) continue;
    backward = std::min(backward, flow.vx[k]);
    fastest = std::max(fastest, std::hypot(flow.vx[k], flow.vz[k]));
  }
  const double rim = 0.3 / 0.7;  // r w
  EXPECT_LT(backward, -0.1 * (rim - 0.3));
  EXPECT_LT(fastest, rim);
}

}  // namespace
}  // namespace soilbin::dem
