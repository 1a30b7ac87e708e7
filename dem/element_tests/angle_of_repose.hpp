// The angle of repose: a cylinder of grains on a floor is lifted, and the slope of the heap that remains is measured.
//
//   const AngleOfReposeResult heap = angle_of_repose(grains, {.radius = 6, .height = 12});  // mean diameters
//   heap.angle.value, heap.angle.std_error                                                  // [rad]
#pragma once

#include <vector>

#include "dem/element_tests/specimen.hpp"

namespace soilbin::dem {

/// Below so many mean diameters of height a heap's slope comes out too small
/// (docs/lab/element-tests.md#size-of-a-heap).
inline constexpr double lowest_heap = 6;

struct AngleOfReposeSettings {
  std::uint64_t packing = 1;      ///< seed
  double radius = 6;              ///< of the cylinder, in mean diameters
  double height = 12;             ///< of the grains in it, about, in mean diameters
  double lowest = 0;              ///< heap that is wanted, in mean diameters (heaps_of_repose)
  double lift = 0.1;              ///< speed of the cylinder over sqrt(g d)
  double floor_friction = 1;      ///< sliding and rolling friction of floor and cylinder, share of the grains' own
  double from = 0.15, to = 0.85;  ///< part of the heap's height over which the slope is fitted
  int sectors = 8;                ///< each gives an angle; their scatter is the error
  double dt = 0;                  ///< [s]; 0: longest_step
  ContactLaws laws = BedRecipe{}.laws;
  RestTest rest{1e-5, 0.3, 0.05, 20};  ///< of the heap, after the cylinder is off it
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
  double settling_time = 0;   ///< from the start of the lift until rest [s]
  double mean_diameter = 0;   ///< [m]
  std::uint64_t packing = 0;  ///< seed
};

/// Throws InputError, RunStopped where no rest is found, Stopped.
AngleOfReposeResult angle_of_repose(const GranularSoil& soil, const AngleOfReposeSettings& settings = {},
                                    const WorkOptions& how = {});

/// The most grains that heaps_of_repose takes to reach a height.
inline constexpr int most_heap_grains = 20000;

/// Heaps of the seeds settings.packing, +1, ... Where the first one is lower than `settings.lowest`, it is poured again
/// from a cylinder that is larger all round, until it is high enough, would take more than most_heap_grains, or is
/// stopped because its grains, which fall deeper, overlap too much; the others get the last cylinder that stood. Throws
/// as angle_of_repose.
std::vector<AngleOfReposeResult> heaps_of_repose(const GranularSoil& soil, AngleOfReposeSettings settings, int packings,
                                                 const WorkOptions& how = {});

}  // namespace soilbin::dem
