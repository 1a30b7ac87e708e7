// Putting grains where there are none: no two of them overlap, and the same seed gives the same grains.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dem/bed/random.hpp"
#include "dem/engine/simulation.hpp"
#include "scenario/soil.hpp"

namespace soilbin::dem {

/// Radii uniform between two bounds [m], 0 < smallest <= largest; or those of two fractions and more, smallest first.
struct RadiusRange {
  double smallest, largest;
  std::vector<GrainFraction> fractions{};

  /// The radius of a grain taken at random [m]: of fractions by their numbers, which go as share/radius^3.
  double drawn(Random& random) const;
};

/// A cuboid that grains are put into, whole.
struct Region {
  Vec3 lower, upper;  ///< [m]
};

/// Gets each grain that is put in: its centre and radius [m].
using GrainSink = std::function<void(const Vec3& centre, double radius)>;

/// Fills a region from below with `count` grains on a lattice a little wider than the largest grain, each pushed about
/// at random within its place, in random order of radii. Clears no grains that are there already: choose a free region.
/// Throws InputError where so many don't fit, with the number that does.
void insert_loosely(const GrainSink& put, const Region& region, const RadiusRange& radii, int count,
                    std::uint64_t seed);
inline void insert_loosely(Simulation& simulation, const Region& region, const RadiusRange& radii, int material,
                           int count, std::uint64_t seed) {
  insert_loosely([&](const Vec3& centre, double radius) { simulation.add_grain(centre, radius, material); }, region,
                 radii, count, seed);
}

/// Grains whose size depends on their place.
struct GradedGrains {
  RadiusRange radii;                         ///< before they are scaled
  std::function<double(const Vec3&)> scale;  ///< of the radii, at a grain's centre, 1 .. largest_scale
  double largest_scale = 1;
  double volume = 0;  ///< of all grains [m^3]
};

/// Fills a region at random with graded grains, equally loose everywhere, whatever their sizes; radii over scale are
/// uniform as without grading. Fractions go in one after the other, the largest first, since it would find no place
/// among fine grains; each with its share of the volume, to a grain. For a share of a quarter of the region and less.
/// Clears no grains that are there already. Throws InputError where they don't find room.
void insert_graded(const GrainSink& put, const Region& region, const GradedGrains& grains, std::uint64_t seed);

/// How many grains insert_loosely can put into a region.
int room_for(const Region& region, const RadiusRange& radii);

}  // namespace soilbin::dem
