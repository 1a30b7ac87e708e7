// The angle of repose: a cylinder of grains on a floor is lifted, the heap's slope is measured.
#pragma once

#include <vector>

#include "dem/element_tests/specimen.hpp"

namespace soilbin::dem {

struct AngleOfReposeSettings {
  SpecimenSettings specimen;
  double radius = 6;              ///< of the cylinder, in mean diameters
  double height = 18;             ///< of the grains in it, in mean diameters
  double lift = 1;                ///< speed of the cylinder, in mean diameters times sqrt(g/d) / 10: see lift_speed
  double gravity = 9.81;          ///< [m/s^2]
  double floor_friction = 1;      ///< sliding and rolling friction of the floor, share of the grains' own
  double from = 0.15, to = 0.85;  ///< part of the heap's height over which the slope is fitted
  int sectors = 8;                ///< each gives an angle; their scatter is the error
  RestTest rest{1e-6, 0.05, 0.05, 20};
};

struct HeapProfile {
  double radius = 0, height = 0;  ///< [m]
};

struct AngleOfReposeResult {
  Estimate angle;                    ///< [rad]
  std::vector<double> by_sector;     ///< [rad]
  std::vector<HeapProfile> profile;  ///< mean over all directions
  double height = 0;                 ///< of the heap [m]
  double base = 0;                   ///< its radius where the fitted line meets the floor [m]
  double lift_speed = 0;             ///< [m/s]
  int grains = 0;
  double settling_time = 0;  ///< from the start of the lift until rest [s]
  double mean_diameter = 0;  ///< [m]
};

/// Throws InputError, RunStopped where no rest is found, Stopped.
AngleOfReposeResult angle_of_repose(const GranularSoil& soil, const AngleOfReposeSettings& settings = {},
                                    const WorkOptions& how = {});

}  // namespace soilbin::dem
