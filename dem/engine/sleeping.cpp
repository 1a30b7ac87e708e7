#include "dem/engine/sleeping.hpp"

#include <algorithm>
#include <cmath>

namespace soilbin::dem {
namespace {

bool may_move(const Body& body) {
  const auto& free = body.free_translation;
  return free[0] || free[1] || free[2] || body.turning != Turning::prescribed || body.servo ||
         squared(body.velocity) > 0 || squared(body.spin) > 0;
}

/// Steps after which a slab may sleep.
std::uint32_t calm_enough(const Numerics& n) {
  return n.sleep.speed > 0 ? static_cast<std::uint32_t>(std::ceil(n.sleep.time / n.dt)) : ~0u;
}

}  // namespace

void Sleeping::begin(const State& state) {
  const std::size_t bodies = state.bodies.size();
  asleep_.assign(state.surfaces.size(), 0);
  near_.assign(asleep_.size() * bodies, 0);
  for (std::size_t slab = 0; slab < asleep_.size(); ++slab)
    for (const NearSurface& near : state.surfaces[slab].near) near_[slab * bodies + near.body] = 1;
}

bool Sleeping::choose(const State& state, const Numerics& numerics) {
  if (numerics.sleep.speed == 0) return false;
  const std::size_t slabs = asleep_.size();
  const std::uint32_t enough = calm_enough(numerics);
  std::vector<std::uint8_t> now(slabs);
  std::uint32_t before = state.calm.back();
  for (std::size_t slab = 0; slab < slabs; ++slab) {
    const std::uint32_t here = state.calm[slab], after = state.calm[slab + 1 < slabs ? slab + 1 : 0];
    now[slab] = before >= enough && here >= enough && after >= enough;
    before = here;
  }
  if (now == asleep_) return false;
  asleep_.swap(now);
  return true;
}

bool Sleeping::is_driven(const State& state, int slab) const {
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    if (near_[slab * state.bodies.size() + b] && may_move(state.bodies[b])) return true;
  return false;
}

void Sleeping::count_calm(State& state, const Numerics& numerics, std::span<const SlabSpeed> speeds) const {
  const double limit = numerics.sleep.speed;
  if (limit == 0) return;
  const std::uint32_t enough = calm_enough(numerics);
  for (int slab = 0; slab < static_cast<int>(asleep_.size()); ++slab) {
    std::uint32_t& calm = state.calm[slab];
    const bool slow = speeds[slab].root_mean_square < limit && speeds[slab].fastest < Sleep::lone * limit;
    calm = slow && !is_driven(state, slab) ? std::min(calm + 1, enough) : 0;
  }
}

double Sleeping::share(const State& state) const {
  std::size_t sum = 0;
  for (std::size_t slab = 0; slab < asleep_.size(); ++slab)
    if (asleep_[slab]) sum += state.slab_rows[slab + 1] - state.slab_rows[slab];
  return state.grains.count() == 0 ? 0 : static_cast<double>(sum) / static_cast<double>(state.grains.count());
}

void wake_all(State& state) { std::fill(state.calm.begin(), state.calm.end(), 0u); }

std::vector<std::uint32_t> calm_by_row(const State& s, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> before(order.size()), after(order.size());
  if (!s.slab_rows.empty() && s.slab_rows.back() == order.size() && s.calm.size() + 1 == s.slab_rows.size())
    for (std::size_t slab = 0; slab < s.calm.size(); ++slab)
      std::fill(before.begin() + s.slab_rows[slab], before.begin() + s.slab_rows[slab + 1], s.calm[slab]);
  for (std::size_t row = 0; row < order.size(); ++row) after[row] = before[order[row]];
  return after;
}

void take_calm(State& state, const Numerics& numerics, std::span<const std::uint32_t> by_row) {
  state.calm.assign(state.slab_rows.size() - 1, calm_enough(numerics));
  for (std::size_t slab = 0; slab < state.calm.size(); ++slab)
    for (std::uint32_t row = state.slab_rows[slab]; row < state.slab_rows[slab + 1]; ++row)
      state.calm[slab] = std::min(state.calm[slab], by_row[row]);
}

}  // namespace soilbin::dem
