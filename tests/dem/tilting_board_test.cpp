// The tilting board against closed forms: a layer slides at atan(mu), a lone grain rolls at atan(mu_r).
#include "dem/element_tests/tilting_board.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem {
namespace {

using test::with_threads;

TiltingBoardResult tilt(const ContactPair& on_board, int across, double rate = 4 * degree) {
  GranularSoil soil = test::soft_soil();
  soil.grain_tire = on_board;
  TiltingBoardSettings settings;
  settings.across = across;
  settings.rate = rate;
  settings.laws.rolling = RollingLaw::elastic_plastic;
  return tilting_board(soil, settings, with_threads(1));
}

TEST(TiltingBoard, RefusesWhatCannotBeTilted) {
  TiltingBoardSettings settings;
  settings.across = 0;
  EXPECT_THROW(tilting_board(test::soft_soil(), settings), InputError);
}

/// By how much the board turns on while the sand, that gives way at an angle a, slides by a way s: it is driven by
/// g sin(t rate)/cos(a), so s = g rate t^3/(6 cos a).
double later(double angle, double way, double rate) {
  return rate * std::cbrt(6 * way * std::cos(angle) / (9.81 * rate));
}

TEST(SlowTiltingBoard, SlidesAtTheFrictionAngleWhereRollingIsBlocked) {
  for (const double mu : {0.3, 0.6}) {
    const TiltingBoardResult told = tilt({.restitution = 0.3, .sliding_friction = mu, .rolling_friction = 1}, 5);
    const double lag = later(std::atan(mu), 0.05 * told.mean_diameter, 4 * degree);
    EXPECT_TRUE(told.slid);
    EXPECT_NEAR(told.onset / degree, (std::atan(mu) + lag) / degree, 0.3) << "lag " << lag / degree;
  }
}

TEST(SlowTiltingBoard, ALoneGrainRollsWhereTheCoupleGivesWay) {
  const double mu_r = 0.3;
  const TiltingBoardResult told = tilt({.restitution = 0.3, .sliding_friction = 5, .rolling_friction = mu_r}, 1);
  // It rolls: 7/5 of the mass resists, so the lag is the cube root of that longer.
  const double lag = std::cbrt(7.0 / 5) * later(std::atan(mu_r), 0.05 * told.mean_diameter, 4 * degree);
  EXPECT_TRUE(told.slid);
  EXPECT_NEAR(told.onset / degree, (std::atan(mu_r) + lag) / degree, 0.5) << "lag " << lag / degree;
  // Its way is its turn.
  EXPECT_NEAR(told.curve.back().turn * 0.01 / told.curve.back().slide, 1, 0.3);
}

TEST(SlowTiltingBoard, SaysThatItHeld) {
  GranularSoil soil = test::soft_soil();
  soil.grain_tire = {.restitution = 0.3, .sliding_friction = 5, .rolling_friction = 5};
  TiltingBoardSettings settings;
  settings.across = 2, settings.rate = 20 * degree, settings.steepest = 40 * degree;
  settings.laws.rolling = RollingLaw::elastic_plastic;
  const TiltingBoardResult told = tilting_board(soil, settings, with_threads(1));
  EXPECT_FALSE(told.slid);
  EXPECT_NEAR(told.onset, settings.steepest, 0.01);
}

}  // namespace
}  // namespace soilbin::dem
