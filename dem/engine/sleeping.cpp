// Slabs that sleep: what is left out while nothing moves there, and when it is taken up again (Sleep in
// simulation.hpp).
#include <algorithm>
#include <cmath>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {
namespace {

bool may_move(const Body& body) {
  const auto& free = body.free_translation;
  return free[0] || free[1] || free[2] || body.turning != Turning::prescribed || body.servo ||
         squared(body.velocity) > 0 || squared(body.spin) > 0;
}

}  // namespace

void Simulation::wake_all() { std::fill(state_.calm.begin(), state_.calm.end(), 0u); }

std::uint32_t Simulation::calm_enough() const {
  const Numerics& n = setup_.numerics;
  return n.sleep.speed > 0 ? static_cast<std::uint32_t>(std::ceil(n.sleep.time / n.dt)) : ~0u;
}

/// A slab sleeps where it and both its neighbours have been calm for long enough.
bool Simulation::may_sleep(int slab) const {
  const int slabs = static_cast<int>(state_.calm.size());
  for (int k = slab - 1; k <= slab + 1; ++k)
    if (state_.calm[(k + slabs) % slabs] < calm_enough()) return false;
  return true;
}

/// Whether grains of the slab are near a body that moves or may move.
bool Simulation::is_driven(int slab) const {
  for (std::size_t b = 0; b < state_.bodies.size(); ++b)
    if (near_[slab * state_.bodies.size() + b] && may_move(state_.bodies[b])) return true;
  return false;
}

/// How calm the slab of each grain was, for the rows of an order that sorts them anew. Nobody is calm after a change.
std::vector<std::uint32_t> Simulation::calm_by_row(std::span<const std::uint32_t> order) const {
  const State& s = state_;
  std::vector<std::uint32_t> before(order.size()), after(order.size());
  if (!s.slab_rows.empty() && s.slab_rows.back() == order.size() && s.calm.size() + 1 == s.slab_rows.size())
    for (std::size_t slab = 0; slab < s.calm.size(); ++slab)
      std::fill(before.begin() + s.slab_rows[slab], before.begin() + s.slab_rows[slab + 1], s.calm[slab]);
  for (std::size_t row = 0; row < order.size(); ++row) after[row] = before[order[row]];
  return after;
}

void Simulation::choose_sleepers() {
  if (setup_.numerics.sleep.speed == 0) return;
  const int slabs = static_cast<int>(asleep_.size());
  std::vector<std::uint8_t> now(slabs);
  for (int slab = 0; slab < slabs; ++slab) now[slab] = may_sleep(slab);
  if (now == asleep_) return;
  asleep_.swap(now);
  cut_blocks();
  accounted([&] {
    for (int slab = 0; slab < slabs; ++slab)
      if (asleep_[slab]) stop_grains(slab);
  });
}

void Simulation::stop_grains(int slab) {
  for (std::uint32_t k = state_.slab_rows[slab]; k < state_.slab_rows[slab + 1]; ++k) {
    state_.grains.motion[k].velocity = {};
    state_.grains.spin[k].rate = {};
  }
  fastest_[slab] = 0;
}

/// What neighbours that are awake, and surfaces after a search, press on a slab asleep is let go.
void Simulation::drop_loads(int slab) {
  const int slabs = static_cast<int>(asleep_.size());
  if (asleep_[(slab + 1) % slabs] && asleep_[(slab + slabs - 1) % slabs] && !searched_now_) return;
  Load* loads = state_.grains.load.data();
  std::fill(loads + state_.slab_rows[slab], loads + state_.slab_rows[slab + 1], Load{});
  if (!setup_.numerics.ledger) return;
  std::fill(taking_.begin() + state_.slab_rows[slab], taking_.begin() + state_.slab_rows[slab + 1], Taking{});
}

void Simulation::count_calm() {
  const double limit = setup_.numerics.sleep.speed;
  if (limit == 0) return;
  for (int slab = 0; slab < static_cast<int>(asleep_.size()); ++slab) {
    std::uint32_t& calm = state_.calm[slab];
    calm = fastest_[slab] < limit && !is_driven(slab) ? std::min(calm + 1, calm_enough()) : 0;
  }
}

double Simulation::share_asleep() const {
  std::size_t sum = 0;
  for (std::size_t slab = 0; slab < asleep_.size(); ++slab)
    if (asleep_[slab]) sum += state_.slab_rows[slab + 1] - state_.slab_rows[slab];
  return state_.grains.count() == 0 ? 0 : static_cast<double>(sum) / static_cast<double>(state_.grains.count());
}

}  // namespace soilbin::dem
