// A settled bed with a tool put over it, and what presses the tool in.
#pragma once

#include "dem/element_tests/bevameter_tests.hpp"

namespace soilbin::dem {

/// Throws InputError for a bed that is too small for its tool.
void check_bed(const TestBed& bed);

/// The bed for a tool of this diameter [m].
std::shared_ptr<const SettledBed> bed_for_tool(const GranularSoil& soil, const TestBed& bed, double tool,
                                               const WorkOptions& how, BedStore* beds);

/// A simulation that goes on from the bed, with a wall material behind that of the grains that rubs on them with this
/// share of their own friction.
Simulation simulation_on(const SettledBed& bed, const WorkOptions& how, double share_of_friction = 1);

/// Mean height of the bed's surface seen from above, away from the walls [m].
double surface_of(const SettledBed& bed);

/// Height of the highest grain within `radius` of the bed's middle [m].
double highest_within(const SettledBed& bed, double radius);

/// A tool over the middle of a bed, and how it goes down.
struct Pressing {
  Body tool;            ///< where it starts
  double base = 0;      ///< of what its sinkage counts by, above the place of the tool [m]
  double diameter = 0;  ///< of the circle over whose area its pressure is [m]
  double surface = 0;   ///< of the bed, from which its sinkage counts (surface_of) [m]
  double way = 0;       ///< down [m]
  double speed = 0;     ///< [m/s]
  int samples = 0;
};

PlateRun press(const SettledBed& bed, Simulation simulation, const Pressing& pressing, SteppedWork& work);

}  // namespace soilbin::dem
