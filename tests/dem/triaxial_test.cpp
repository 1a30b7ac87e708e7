// The triaxial cell against what must hold of it: the stress that is asked for, the balance of work.
#include "dem/element_tests/triaxial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenario/errors.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using test::with_threads;

/// Some 250 grains.
TriaxialSettings small_cell() {
  TriaxialSettings settings;
  settings.side = 5, settings.height = 8;
  settings.stresses = {5e3};
  settings.strain = 0.15;
  return settings;
}

TEST(Triaxial, RefusesWhatCannotBePressed) {
  const GranularSoil soil = test::soft_soil();
  TriaxialSettings settings = small_cell();
  settings.stresses = {0};
  EXPECT_THROW(triaxial(soil, settings), InputError);
  settings = small_cell(), settings.side = 3;
  EXPECT_THROW(triaxial(soil, settings), InputError);
}

class SlowTriaxial : public ::testing::Test {
 protected:
  static TriaxialRun run(const TriaxialSettings& settings) {
    static BedStore beds;
    return triaxial(test::soft_soil(), settings, with_threads(1), &beds).runs.front();
  }
  /// The larger |mean over asked - 1| of the two sides, by the curve alone.
  static double off(const TriaxialRun& run) {
    double x = 0, y = 0;
    for (const TriaxialSample& sample : run.curve) x += sample.lateral_x, y += sample.lateral_y;
    const double asked = run.stress * static_cast<double>(run.curve.size());
    return std::max(std::abs(x / asked - 1), std::abs(y / asked - 1));
  }
};

// While the sides give way, at the usual rate and at three times that: a servo alone was 2 to 18 % above.
TEST_F(SlowTriaxial, HoldsTheConfiningStressTo1Percent) {
  TriaxialSettings settings = small_cell();
  settings.ledger = true;
  const TriaxialRun usual = run(settings);
  EXPECT_LT(usual.confining_error, 0.01);
  EXPECT_LT(off(usual), 0.01);
  EXPECT_LT(usual.confining.error, 0.01);
  EXPECT_NEAR(usual.work_of_stress / usual.work, 1, 1e-3);
  EXPECT_LT(std::abs(usual.energy_error), 1e-3);
}

// A rate at which the sides cannot follow: strength is that of the stress that was measured, and the error is told.
TEST_F(SlowTriaxial, TellsWhereTheStressIsNotHeld) {
  TriaxialSettings settings = small_cell();
  settings.inertial = 0.05;
  const TriaxialRun fast = run(settings);
  EXPECT_GE(fast.confining_error, off(fast));
  EXPECT_GE(fast.confining_error, fast.confining.error);
  EXPECT_GT(fast.confining_error, 0.01);
}

}  // namespace
}  // namespace soilbin::dem
