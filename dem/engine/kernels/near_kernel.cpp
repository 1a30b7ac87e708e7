// Compiled once for each instruction set (dem/CMakeLists.txt), each in a namespace of its own.
#include "dem/engine/kernels/grain_rows.hpp"
#include "dem/engine/kernels/kernels.hpp"
#include "dem/engine/kernels/pack.hpp"

namespace soilbin::dem::HWY_NAMESPACE {
namespace {

HWY_INLINE Pack squared_nearest(Pack d, double period) {
  const Pack nearest = nearest_image(d, period);
  return nearest * nearest;
}

HWY_INLINE void put(unsigned found, std::uint32_t from, std::uint32_t* rows, int& count) {
  for (; found != 0; found &= found - 1) rows[count++] = from + static_cast<std::uint32_t>(__builtin_ctz(found));
}

}  // namespace

void find_near_rows(const NearSweep& sweep, std::uint32_t row, const RowRun* run, int runs, NearRows& out) {
  const Motion& own = sweep.motion[row];
  const Pack x(own.position.x), y(own.position.y), z(own.position.z), radius(own.radius), skin(sweep.skin);
  for (const RowRun* end = run + runs; run != end; ++run)
    for (std::uint32_t from = run->first; from < run->last; from += lanes) {
      const std::uint32_t last = run->last - 1;
      const FourPacks other =
          columns([&](std::uint32_t k) { return &sweep.motion[from + k < last ? from + k : last].position.x; });
      const Pack distance2 = squared_nearest(x - other.a, sweep.period[0]) +
                             squared_nearest(y - other.b, sweep.period[1]) +
                             squared_nearest(z - other.c, sweep.period[2]);
      const Pack sum = radius + other.d, reach = sum + skin;
      const unsigned there = run->last - from < lanes ? (1u << (run->last - from)) - 1 : (1u << lanes) - 1;
      const unsigned near = bits(distance2 < reach * reach) & there;
      if (near == 0) continue;
      const unsigned touching = bits(distance2 < sum * sum) & near;
      put(touching, from, out.touching, out.touching_count);
      put(near & ~touching, from, out.near, out.near_count);
    }
}

}  // namespace soilbin::dem::HWY_NAMESPACE
