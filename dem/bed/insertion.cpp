#include "dem/bed/insertion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "dem/surface/mass_properties.hpp"
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

double RadiusRange::drawn(Random& random) const {
  if (fractions.empty()) return random.uniform(smallest, largest);
  double all = 0;
  const auto number = [](const GrainFraction& of) { return of.share / (of.radius * of.radius * of.radius); };
  for (const GrainFraction& fraction : fractions) all += number(fraction);
  double left = random.uniform(0, all);
  for (const GrainFraction& fraction : fractions)
    if ((left -= number(fraction)) < 0) return fraction.radius;
  return fractions.back().radius;
}

int room_for(const Region& region, const RadiusRange& radii) {
  const auto [nx, ny, nz] = places(region, radii);
  return nx * ny * nz;
}

void insert_loosely(const GrainSink& put, const Region& region, const RadiusRange& radii, int count,
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
    const double radius = radii.drawn(random);
    const auto at = [&](double lower, double cell, int index) {
      const double slack = cell / 2 - radius;
      return lower + (index + 0.5) * cell + random.uniform(-slack, slack);
    };
    const double x = at(region.lower.x, width.x, ix), y = at(region.lower.y, width.y, iy);
    put({x, y, at(region.lower.z, width.z, iz)}, radius);
  }
}

void insert_graded(const GrainSink& put, const Region& region, const GradedGrains& grains, std::uint64_t seed) {
  const Vec3 side = region.upper - region.lower;
  const double cell =
      2 * grains.largest_scale * grains.radii.largest;  // two grains that overlap lie in neighbouring ones
  const auto count = [&](double length) { return std::max(1, static_cast<int>(length / cell)); };
  const std::array<int, 3> cells{count(side.x), count(side.y), count(side.z)};
  const auto cell_along = [](double at, double length, int n) {
    return std::clamp(static_cast<int>(at / length * n), 0, n - 1);
  };
  struct Ball {
    Vec3 at;
    double radius;
  };
  std::vector<std::vector<Ball>> in(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]);
  const auto in_cell = [&](int x, int y, int z) -> std::vector<Ball>& {
    return in[(static_cast<std::size_t>(z) * cells[1] + y) * cells[0] + x];
  };
  Random random(seed);
  double placed = 0, until = 0;
  int refused = 0;
  constexpr int most_refused = 100000;  // in a row
  const std::vector<GrainFraction>& fractions = grains.radii.fractions;
  double shares = 0;
  for (const GrainFraction& fraction : fractions) shares += fraction.share;
  std::size_t to_come = fractions.size();
  const auto drawn = [&] {
    if (fractions.empty()) return grains.radii.drawn(random);
    while (placed >= until && to_come > 0) until += grains.volume * fractions[--to_come].share / shares;
    return fractions[to_come].radius;
  };
  // Kept until it has found its place: drawn anew at each try, small ones would find more places than large ones.
  double unscaled = drawn();
  while (placed < grains.volume) {
    if (++refused > most_refused) throw InputError("grains of this volume don't fit into the region");
    const double x = random.uniform(0, side.x), y = random.uniform(0, side.y);
    const Vec3 at{x, y, random.uniform(0, side.z)};
    const double larger = grains.scale(region.lower + at), keep = random.uniform(0, 1);
    const double radius = larger * unscaled;
    // As many tries a volume of a grain everywhere: then all sizes come to the same share.
    if (keep > 1 / (larger * larger * larger)) continue;
    if (x < radius || y < radius || at.z < radius || x > side.x - radius || y > side.y - radius) continue;
    if (at.z > side.z - radius) continue;
    const int cx = cell_along(x, side.x, cells[0]), cy = cell_along(y, side.y, cells[1]);
    const int cz = cell_along(at.z, side.z, cells[2]);
    bool free = true;
    for (int k = std::max(0, cz - 1); k <= std::min(cz + 1, cells[2] - 1); ++k)
      for (int j = std::max(0, cy - 1); j <= std::min(cy + 1, cells[1] - 1); ++j)
        for (int i = std::max(0, cx - 1); i <= std::min(cx + 1, cells[0] - 1); ++i)
          for (const Ball& other : in_cell(i, j, k))
            free &= squared(other.at - at) >= (other.radius + radius) * (other.radius + radius);
    if (!free) continue;
    in_cell(cx, cy, cz).push_back({at, radius});
    put(region.lower + at, radius);
    placed += sphere_volume(radius);
    refused = 0, unscaled = drawn();
  }
}

}  // namespace soilbin::dem
