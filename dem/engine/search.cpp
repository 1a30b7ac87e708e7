// Simulation's search for pairs and for grains near surfaces: when it is due, and what is carried over.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dem/engine/cells.hpp"
#include "dem/engine/periodic.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {
namespace {

double wrapped(double at, double lower, double length) {
  return length > 0 ? at - length * std::floor((at - lower) / length) : at;
}

/// Contacts with surfaces by grain id, in order.
using KeptOnSurfaces = std::vector<std::pair<GrainId, SurfaceContact>>;

/// Those of all slabs, to hand them out again once grains are sorted.
KeptOnSurfaces by_id(const std::vector<SurfaceContacts>& surfaces, const Grains& grains) {
  KeptOnSurfaces all;
  for (const SurfaceContacts& slab : surfaces)
    for (const SurfaceContact& contact : slab.made) all.emplace_back(grains.id[contact.who.grain], contact);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return all;
}

/// Gives the grains that are near a surface their contacts back.
void hand_out(const KeptOnSurfaces& kept, const Grains& grains, SurfaceContacts& slab) {
  std::uint32_t before = ~0u;
  for (const NearSurface& near : slab.near) {
    const std::uint32_t row = near.grain;
    if (row == std::exchange(before, row)) continue;
    const auto [begin, end] = std::equal_range(kept.begin(), kept.end(), std::pair(grains.id[row], SurfaceContact{}),
                                               [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto it = begin; it != end; ++it) {
      slab.made.push_back(it->second);
      slab.made.back().who.grain = row;
    }
  }
}

/// Of each row before some were gone and the rest sorted: the row now, or that it is gone.
std::vector<std::uint32_t> new_rows(std::span<const std::uint32_t> order, std::span<const std::uint8_t> gone,
                                    std::size_t before) {
  std::vector<std::uint32_t> of_kept(order.size());
  for (std::uint32_t row = 0; row < order.size(); ++row) of_kept[order[row]] = row;
  if (gone.empty()) return of_kept;
  std::vector<std::uint32_t> all(before, KeptContacts::gone);
  for (std::size_t k = 0, kept = 0; k < before; ++k)
    if (!gone[k]) all[k] = of_kept[kept++];
  return all;
}

}  // namespace

bool Simulation::search_is_due() {
  State& s = state_;
  if (s.travel < reach_ / 2) return false;
  // The bound is reached; now see how far each has really come.
  double farthest = 0;
  for (std::size_t k = 0; k < s.grains.count(); ++k)
    farthest = std::max(farthest, squared(s.grains.motion[k].position - s.searched_at[k]));
  farthest = std::sqrt(farthest);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) farthest = std::max(farthest, s.bodies[b].travel);
  s.travel = farthest;
  // Less than a hundredth of the margin left would be checked at each step.
  return farthest > 0.49 * reach_;
}

void Simulation::search(std::span<const std::uint8_t> gone) {
  State& s = state_;
  const Periods periods(setup_.domain);
  for (std::size_t k = 0; k < s.grains.count(); ++k) {
    Vec3& at = s.grains.motion[k].position;
    const Vec3 from = at;
    at.x = wrapped(at.x, setup_.domain.lower.x, periods.length.x);
    at.y = wrapped(at.y, setup_.domain.lower.y, periods.length.y);
    at.z = wrapped(at.z, setup_.domain.lower.z, periods.length.z);
    if (setup_.numerics.ledger && !s.grains.motion[k].held())
      s.ledger.added += dot(s.gravity, from - at) / s.grains.motion[k].inverse_mass;
    if ((gone.empty() || !gone[k]) && !setup_.domain.contains(at)) stop_for_loss(k);
  }
  const KeptOnSurfaces kept_on_surfaces = by_id(s.surfaces, s.grains);

  const std::size_t rows_before = s.grains.count();
  if (!gone.empty()) s.grains.remove(gone);
  Cells cells(setup_.domain, {s.grains.motion.data(), s.grains.count()},
              std::max(2 * s.grains.largest_radius() + reach_ + adhesion_reach_, 1e-12));
  const std::vector<std::uint32_t> order = cells.order(s.grains), calm = calm_by_row(order);
  kept_.take(s.pairs, new_rows(order, gone, rows_before), order.size());
  s.grains.reorder(order);
  cells.index(s.grains);
  find_pairs(cells, s.grains, setup_.domain, kept_,
             {.kernel = near_kernel_,
              .skin = reach_ + adhesion_reach_,
              .holds_apart = setup_.laws.cohesion == CohesionLaw::jkr,
              .materials = static_cast<int>(setup_.materials.all.size()),
              .threads = threads_},
             s.pairs);

  const int slabs = cells.slab_count();
  s.slab_rows.assign(1, 0);
  for (int slab = 0; slab < slabs; ++slab) s.slab_rows.push_back(cells.slab(slab)[1]);
  s.surfaces.assign(slabs, {});
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (int slab = 0; slab < slabs; ++slab) {
    SurfaceContacts& here = s.surfaces[slab];
    here.near = find_near(s.bodies, s.grains, s.slab_rows[slab], s.slab_rows[slab + 1], reach_ + adhesion_reach_);
    hand_out(kept_on_surfaces, s.grains, here);
  }
  s.calm.assign(slabs, calm_enough());
  for (int slab = 0; slab < slabs; ++slab)
    for (std::uint32_t row = s.slab_rows[slab]; row < s.slab_rows[slab + 1]; ++row)
      s.calm[slab] = std::min(s.calm[slab], calm[row]);
  s.body_loads.assign(slabs * s.bodies.size(), {});
  searched_now_ = true;
  s.searched_at.resize(s.grains.count());
  for (std::size_t k = 0; k < s.grains.count(); ++k) s.searched_at[k] = s.grains.motion[k].position;
  for (Body& body : s.bodies) body.travel = 0;
  s.travel = 0;
  make_room(slabs);
}

void Simulation::make_room(int slabs) {
  found_.assign(slabs, {});
  fastest_.assign(slabs, 0.0);
  made_.resize(slabs);
  if (setup_.numerics.ledger) taking_.assign(state_.grains.motion.size(), {});
  asleep_.assign(slabs, 0);
  cut_blocks();
  near_.assign(slabs * state_.bodies.size(), 0);
  for (int slab = 0; slab < slabs; ++slab)
    for (const NearSurface& near : state_.surfaces[slab].near) near_[slab * state_.bodies.size() + near.body] = 1;
  extents_.clear();
  Vec3 low{1e300, 1e300, 1e300}, high = -low;
  for (const Vec3& at : state_.searched_at) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  middle_ = state_.searched_at.empty() ? Vec3{} : 0.5 * (low + high);
  around_middle_ = state_.searched_at.empty() ? 0 : length(high - low) / 2;
  for (const Body& body : state_.bodies) extents_.push_back(extent(body));
}

}  // namespace soilbin::dem
