// The shape of a soil's grains: spheres, or clumps of a few equal ones whose radius in the soil's file is that of the
// sphere of the same volume. Places are found for balls; a grain lies in its ball, turned at random.
//
//   GrainMaker maker(soil, packing);
//   insert_loosely([&](const Vec3& centre, double ball) { maker.put(simulation, centre, ball); }, region,
//                  maker.balls(), count, packing);
#pragma once

#include <optional>

#include "dem/bed/insertion.hpp"
#include "dem/bed/random.hpp"
#include "dem/engine/clumps.hpp"
#include "scenario/soil.hpp"

namespace soilbin::dem {

/// A grain that has the volume of a ball of radius 1 [m]: two spheres in a row, three in a triangle, four in a
/// tetrahedron, neighbours' centres sphere_spacing radii apart. Nothing for spheres. Throws InputError for a spacing
/// outside 0.1 .. 2.
std::optional<ClumpShape> shape_of(const GranularSoil& soil);

/// How a soil's grains are larger and smaller than the spheres of their volume; 1 for spheres.
struct GrainProportions {
  double ball = 1;    ///< radius of the ball around a grain, over that of the sphere of its volume
  double sphere = 1;  ///< radius of its spheres, over the same
  double solid = 1;   ///< its volume over the sum of its spheres'
};
GrainProportions proportions_of(const GranularSoil& soil);

/// Puts grains of a soil into a simulation. The same seed gives the same turns.
class GrainMaker {
 public:
  GrainMaker(const GranularSoil& soil, std::uint64_t seed);
  /// Radii of the balls around grains [m].
  RadiusRange balls() const;
  /// A grain in a ball of this radius [m].
  void put(Simulation& simulation, const Vec3& centre, double ball);

 private:
  RadiusRange radii_;
  std::optional<ClumpShape> shape_;
  GrainProportions proportions_;
  Random random_;
};

}  // namespace soilbin::dem
