// Putting grains where there are none: no two of them overlap, and the same seed gives the same grains.
#pragma once

#include <cstdint>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// Radii uniform between two bounds [m], 0 < smallest <= largest.
struct RadiusRange {
  double smallest, largest;
};

/// A cuboid that grains are put into, whole.
struct Region {
  Vec3 lower, upper;  ///< [m]
};

/// Fills a region from below with `count` grains on a lattice a little wider than the largest grain, each pushed about
/// at random within its place, in random order of radii. Clears no grains that are there already: choose a free region.
/// Throws InputError where so many don't fit, with the number that does.
void insert_loosely(Simulation& simulation, const Region& region, const RadiusRange& radii, int material, int count,
                    std::uint64_t seed);

/// How many grains insert_loosely can put into a region.
int room_for(const Region& region, const RadiusRange& radii);

}  // namespace soilbin::dem
