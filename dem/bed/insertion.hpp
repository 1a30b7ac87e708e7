// Putting grains where there are none: no two of them overlap, and the same seed gives the same grains.
#pragma once

#include <cstdint>
#include <functional>

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

/// Fills a region at random with grains of the radii times `scale` at their centre, 1 .. most: as many as have this
/// volume [m^3], equally loose everywhere, whatever their sizes. For a share of a quarter of the region and less.
/// Clears no grains that are there already. Throws InputError where they don't find room.
void insert_graded(Simulation& simulation, const Region& region, const RadiusRange& radii, double most,
                   const std::function<double(const Vec3&)>& scale, int material, double volume, std::uint64_t seed);

/// How many grains insert_loosely can put into a region.
int room_for(const Region& region, const RadiusRange& radii);

}  // namespace soilbin::dem
