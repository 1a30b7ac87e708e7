#include "dem/engine/grains.hpp"

#include <algorithm>

namespace soilbin::dem {
namespace {

/// Two points far out, in any box: without a radius nothing touches them.
constexpr double far_away = 1e100;

}  // namespace

double Grains::largest_radius() const {
  double largest = 0;
  for (std::size_t k = 0; k < count(); ++k) largest = std::max(largest, motion[k].radius);
  return largest;
}

void Grains::close() {
  motion.resize(count());
  motion.push_back({{far_away, 0, 0}, 0, {}, 1});
  motion.push_back({{-far_away, 0, 0}, 0, {}, 1});
  spin.resize(count());
  spin.resize(count() + 2);
  load.resize(count());
  load.resize(count() + 2);
}

void Grains::add(const NewGrain& grain) {
  motion.resize(count());
  spin.resize(count());
  load.resize(count());
  motion.push_back({grain.position, grain.radius, grain.velocity, 1 / grain.mass});
  const double inertia = grain.inertia > 0 ? grain.inertia : 0.4 * grain.mass * grain.radius * grain.radius;
  spin.push_back({grain.spin, 1 / inertia});
  load.push_back({});
  id.push_back(grain.id);
  material.push_back(grain.material);
  clump.push_back(grain.clump);
  close();
}

void Grains::move_row(std::uint32_t from, std::uint32_t to) {
  motion[to] = motion[from];
  spin[to] = spin[from];
  load[to] = load[from];
  id[to] = id[from];
  material[to] = material[from];
  clump[to] = clump[from];
}

/// In place, cycle by cycle: a bed of millions need not be copied.
void Grains::reorder(std::span<const std::uint32_t> order) {
  const std::uint32_t spare = idle_first();
  id.resize(count() + 1);
  material.resize(id.size());
  clump.resize(id.size());
  std::vector<bool> done(order.size());
  for (std::uint32_t start = 0; start < order.size(); ++start) {
    if (done[start] || order[start] == start) continue;
    move_row(start, spare);
    std::uint32_t to = start;
    for (; order[to] != start; to = order[to]) {
      move_row(order[to], to);
      done[to] = true;
    }
    move_row(spare, to);
    done[to] = true;
  }
  id.pop_back();
  material.pop_back();
  clump.pop_back();
  close();
}

void Grains::remove(std::span<const std::uint8_t> gone) {
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < count(); ++k)
    if (!gone[k]) move_row(k, kept++);
  id.resize(kept);
  material.resize(kept);
  clump.resize(kept);
  close();
}

}  // namespace soilbin::dem
