// The paper's friction test: sand laid on a board of the tire's material, which is tilted until the sand begins to
// slide (Zhou, Gao, Li, Hu: 200 x 200 x 2 mm on rubber, 31.47 deg).
//
//   const TiltingBoardResult board = tilting_board(grains, {.across = 16, .rate = 0.035});  // grains, [rad/s]
//   board.slid, board.onset                                                                 // angle [rad]
//
// A layer of 2 mm is one grain of the real sand (mean 2.16 mm) high and some 93 grains wide. The substitute keeps the
// first and gives up the second: one layer of scaled grains, `across` of them along each side. Gravity turns, the board
// does not.
#pragma once

#include <vector>

#include "dem/element_tests/specimen.hpp"

namespace soilbin::dem {

struct TiltingBoardSettings {
  int across = 16;            ///< grains along each side of the square
  double layers = 1;          ///< height of the layer, in mean diameters; above 1 more are laid on the first
  std::uint64_t packing = 1;  ///< seed
  double rate = 0.0349066;    ///< of the tilt [rad/s]: 2 deg/s
  double onset = 0.05;        ///< mean slide down the board at which the sand counts as beginning to slide, in mean
                              ///< diameters, beyond what it had crept at half the angle
  double gone = 1;            ///< mean slide at which the test ends, in mean diameters
  double steepest = 1.2;      ///< the test is given up there [rad]
  double dt = 0;              ///< [s]; 0: longest_step
  ContactLaws laws = BedRecipe{}.laws;
};

struct TiltSample {
  double angle = 0;  ///< [rad]
  double slide = 0;  ///< mean way of the grains down the board [m]
  double turn = 0;   ///< mean angle by which they have rolled, as slide over radius would be [rad]
};

struct TiltingBoardResult {
  std::vector<TiltSample> curve;
  double onset = 0;   ///< angle at which it began to slide [rad]
  double gone = 0;    ///< angle at which the mean slide passed `gone` [rad]
  bool slid = false;  ///< false: it held up to the steepest angle, and both angles are that
  int grains = 0;
  double mean_diameter = 0;   ///< [m]
  std::uint64_t packing = 0;  ///< seed
};

/// A single layer's closed forms: with rolling blocked (rolling friction far above sliding friction) it slides at
/// atan(mu); a lone grain rolls at atan(mu_r) where that is less. Throws InputError, RunStopped, Stopped.
TiltingBoardResult tilting_board(const GranularSoil& soil, const TiltingBoardSettings& settings = {},
                                 const WorkOptions& how = {});

}  // namespace soilbin::dem
