// The stage that searches for pairs and for grains near surfaces: when it is due, and what is carried over.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dem/engine/cells.hpp"
#include "dem/engine/step.hpp"

namespace soilbin::dem {
namespace {

double wrapped(double at, double lower, double length) {
  return length > 0 ? at - length * std::floor((at - lower) / length) : at;
}

/// Contacts with surfaces by grain id, in order.
using KeptOnSurfaces = std::vector<std::pair<GrainId, SurfaceContact>>;

/// What all slabs keep, to hand it out again once grains are sorted.
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

/// For each row before some were gone and the rest sorted: the row now, or that it is gone.
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

/// A grain that is not in the domain any more.
[[noreturn]] void stop_for_loss(const State& s, std::size_t row) {
  const Vec3& at = s.grains.motion[row].position;
  throw RunStopped(
      fmt::format("grain {} left the domain at ({:.4g}, {:.4g}, {:.4g}) m, time {:.6g} s"
                  "\n  hint: close the bin, or remove grains that leave it",
                  s.grains.id[row], at.x, at.y, at.z, s.time));
}

/// Brings grains that have crossed a periodic side in by the other one. Those that are `gone` may be anywhere.
void wrap_grains(World& world, std::span<const std::uint8_t> gone) {
  State& s = world.state;
  const Domain& domain = world.setup.domain;
  const Periods periods(domain);
  for (std::size_t k = 0; k < s.grains.count(); ++k) {
    Vec3& at = s.grains.motion[k].position;
    const Vec3 from = at;
    at.x = wrapped(at.x, domain.lower.x, periods.length.x);
    at.y = wrapped(at.y, domain.lower.y, periods.length.y);
    at.z = wrapped(at.z, domain.lower.z, periods.length.z);
    if (world.setup.numerics.ledger && !s.grains.motion[k].held() && s.grains.clump[k] == lone)
      s.ledger.added += dot(s.gravity, from - at) / s.grains.motion[k].inverse_mass;
    if ((gone.empty() || !gone[k]) && !domain.contains(at)) stop_for_loss(s, k);
  }
  for (Clump& clump : s.clumps.all) {
    Vec3& at = clump.motion.position;
    const Vec3 from = at;
    at = {wrapped(at.x, domain.lower.x, periods.length.x), wrapped(at.y, domain.lower.y, periods.length.y),
          wrapped(at.z, domain.lower.z, periods.length.z)};
    if (world.setup.numerics.ledger && !s.clumps.held(clump, s.grains))
      s.ledger.added += clump.mass * dot(s.gravity, from - at);
  }
}

Extents extents_of(const State& s) {
  Extents out;
  for (const Body& body : s.bodies) out.bodies.push_back(extent(body));
  if (s.searched_at.empty()) return out;
  Vec3 low{1e300, 1e300, 1e300}, high = -low;
  for (const Vec3& at : s.searched_at) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  out.middle = 0.5 * (low + high);
  out.around_middle = length(high - low) / 2;
  return out;
}

Margins margins_of(const World& world, double largest) {
  const Setup& setup = world.setup;
  Margins margins;
  margins.motion = setup.numerics.skin > 0 ? setup.numerics.skin : 0.2 * largest;
  if (setup.laws.cohesion == CohesionLaw::jkr)
    for (int kind = 0; kind < world.laws.kind(world.laws.materials(), 0); ++kind)
      margins.adhesion = std::max(margins.adhesion, adhesion_reach(world.laws[kind], largest));
  return margins;
}

}  // namespace

void fit_to_largest_grain(World& world) {
  const double largest = world.state.grains.largest_radius();
  world.laws.fill(world.setup.materials, world.setup.laws, largest);
  world.margins = margins_of(world, largest);
}

bool search_is_due(World& world) {
  State& s = world.state;
  const double margin = world.margins.motion;
  if (s.travel < margin / 2) return false;
  // The bound is reached; now see how far each has really come.
  double farthest = 0;
  for (std::size_t k = 0; k < s.grains.count(); ++k)
    farthest = std::max(farthest, squared(s.grains.motion[k].position - s.searched_at[k]));
  farthest = std::sqrt(farthest);
  for (const Body& body : s.bodies) farthest = std::max(farthest, body.travel);
  s.travel = farthest;
  // Less than a hundredth of the margin left would be checked at each step.
  return farthest > 0.49 * margin;
}

void search(World& world, std::span<const std::uint8_t> gone) {
  State& s = world.state;
  const Setup& setup = world.setup;
  wrap_grains(world, gone);
  const KeptOnSurfaces kept_on_surfaces = by_id(s.surfaces, s.grains);
  const std::size_t rows_before = s.grains.count();
  if (!gone.empty()) {
    s.clumps.remove(gone, s.grains);
    s.grains.remove(gone);
    fit_to_largest_grain(world);  // as in a run that goes on from here
  }
  const double reach = world.margins.both();
  Cells cells(setup.domain, {s.grains.motion.data(), s.grains.count()},
              std::max(2 * s.grains.largest_radius() + world.margins.motion + world.margins.adhesion, 1e-12));
  const std::vector<std::uint32_t> order = cells.order(s.grains), calm = calm_by_row(s, order);
  world.kept.take(s.pairs, new_rows(order, gone, rows_before), order.size());
  s.grains.reorder(order);
  s.clumps.find_rows(s.grains);
  cells.index(s.grains);
  find_pairs(cells, s.grains, setup.domain, world.kept,
             {.kernel = world.kernels.near,
              .skin = reach,
              .holds_apart = setup.laws.cohesion == CohesionLaw::jkr,
              .materials = world.laws.materials(),
              .threads = world.threads},
             s.pairs);

  const int slabs = cells.slab_count();
  s.slab_rows.assign(1, 0);
  for (int slab = 0; slab < slabs; ++slab) s.slab_rows.push_back(cells.slab(slab)[1]);
  s.surfaces.assign(slabs, {});
#pragma omp parallel for schedule(dynamic) num_threads(world.threads)
  for (int slab = 0; slab < slabs; ++slab) {
    SurfaceContacts& here = s.surfaces[slab];
    here.near = find_near(s.bodies, s.grains, s.slab_rows[slab], s.slab_rows[slab + 1], reach);
    hand_out(kept_on_surfaces, s.grains, here);
  }
  take_calm(s, setup.numerics, calm);
  s.body_loads.assign(slabs * s.bodies.size(), {});
  s.searched_at.resize(s.grains.count());
  for (std::size_t k = 0; k < s.grains.count(); ++k) s.searched_at[k] = s.grains.motion[k].position;
  for (Body& body : s.bodies) body.travel = 0;
  s.travel = 0;
  world.searched_now = true;
  make_room(world);
}

void make_room(World& world) {
  const int slabs = world.slabs();
  world.found.assign(slabs, {});
  world.speeds.assign(slabs, {});
  world.surfaces_before.resize(slabs);
  world.ledger.begin(world.setup, world.state);
  world.sleeping.begin(world.state);
  cut_blocks(world);
  world.extents = extents_of(world.state);
}

}  // namespace soilbin::dem
