// A settled bed with a rough tool put over it.
#pragma once

#include "dem/element_tests/bevameter_tests.hpp"

namespace soilbin::dem {

/// Throws InputError for a bed that is too small for its tool.
void check_bed(const TestBed& bed);

/// The bed for a tool of this diameter [m].
std::shared_ptr<const SettledBed> bed_for_tool(const GranularSoil& soil, const TestBed& bed, double tool,
                                               const WorkOptions& how, BedStore* beds);

/// A simulation that goes on from the bed, with a wall material as rough as the grains behind theirs.
Simulation simulation_on(const SettledBed& bed, const WorkOptions& how);

/// Mean height of the bed's surface seen from above, away from the walls [m].
double surface_of(const SettledBed& bed);

/// Height of the highest grain within `radius` of the bed's middle [m].
double highest_within(const SettledBed& bed, double radius);

}  // namespace soilbin::dem
