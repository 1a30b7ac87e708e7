#include "dem/bed/insertion.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "dem/bed/random.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// Width of a grain's place, in diameters of the largest.
constexpr double place_width = 1.05;

std::array<int, 3> places(const Region& region, const RadiusRange& radii) {
  const Vec3 side = region.upper - region.lower;
  const double width = place_width * 2 * radii.largest;
  const auto along = [&](double length) { return length < width ? 0 : static_cast<int>(length / width); };
  return {along(side.x), along(side.y), along(side.z)};
}

}  // namespace

int room_for(const Region& region, const RadiusRange& radii) {
  const auto [nx, ny, nz] = places(region, radii);
  return nx * ny * nz;
}

void insert_loosely(Simulation& simulation, const Region& region, const RadiusRange& radii, int material, int count,
                    std::uint64_t seed) {
  if (!(radii.smallest > 0 && radii.largest >= radii.smallest))
    throw InputError("radii must be above 0, the largest not below the smallest");
  const auto [nx, ny, nz] = places(region, radii);
  if (count > nx * ny * nz)
    throw InputError(fmt::format("{} grains don't fit into the region, {} do\n  hint: a higher region, or fewer grains",
                                 count, nx * ny * nz));
  Random random(seed);
  const Vec3 side = region.upper - region.lower;
  const Vec3 width{side.x / nx, side.y / ny, place_width * 2 * radii.largest};
  for (int k = 0; k < count; ++k) {
    const int ix = k % nx, iy = k / nx % ny, iz = k / (nx * ny);
    const double radius = random.uniform(radii.smallest, radii.largest);
    const auto at = [&](double lower, double cell, int index) {
      const double slack = cell / 2 - radius;
      return lower + (index + 0.5) * cell + random.uniform(-slack, slack);
    };
    const double x = at(region.lower.x, width.x, ix), y = at(region.lower.y, width.y, iy);
    simulation.add_grain({x, y, at(region.lower.z, width.z, iz)}, radius, material);
  }
}

}  // namespace soilbin::dem
