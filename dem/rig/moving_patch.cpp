#include "dem/rig/moving_patch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// Ids are numbered tile by tile; that of x = 0 is not the first, because the patch begins before it.
constexpr std::int64_t tiles_before = 2;

/// Tiles that a contact spans beside its own: one tile touches its neighbours at most.
constexpr std::int64_t reach_in_tiles = 1;

/// A surface contact as a tile keeps it, by the grain's number in the tile.
TileOnSurface on_surface(const SurfaceContact& made, std::uint32_t grain) {
  const auto& [slide, roll] = made.memory;
  return {.grain = grain,
          .body = made.who.body,
          .surface = made.who.surface,
          .normal = made.normal,
          .memory = {slide.x, slide.y, slide.z, roll.x, roll.y, roll.z}};
}

}  // namespace

Tile tile_of(const Setup& setup, const State& state) {
  const Domain& domain = setup.domain;
  if (!domain.periodic[0] || domain.periodic[1] || domain.periodic[2] || domain.lower.x != 0)
    throw InputError("a tile repeats itself along x alone, from x = 0 on");
  Tile tile{.length = domain.upper.x, .grains = {}, .contacts = {}, .on_surfaces = {}, .clumps = state.clumps};
  std::vector<std::int32_t> wraps;  // tiles that a grain stands on from where it is told
  for (std::size_t k = 0; k < state.grains.count(); ++k) {
    const Motion& grain = state.grains.motion[k];
    Vec3 at = grain.position;
    const double tiles = std::floor(at.x / tile.length);
    at.x -= tiles * tile.length;
    wraps.push_back(static_cast<std::int32_t>(tiles));
    tile.grains.push_back({at, grain.radius, 1 / grain.inverse_mass, state.grains.material[k], state.grains.clump[k]});
  }
  for (Clump& clump : tile.clumps.all) {
    ClumpMotion& motion = clump.motion;
    motion.position.x -= std::floor(motion.position.x / tile.length) * tile.length;
    motion.velocity = motion.spin = {};
    for (const ClumpMember& member : tile.clumps.of(clump)) {
      Vec3& at = tile.grains[member.row].position;
      const Vec3 placed = motion.position + motion.rotation(member.arm);
      wraps[member.row] += static_cast<std::int32_t>(std::nearbyint((at.x - placed.x) / tile.length));
      at = placed;
    }
  }
  const PairList& pairs = state.pairs;
  for (std::size_t pair = 0; pair < pairs.first.size(); ++pair) {
    if (!pairs.touches(pair)) continue;
    const std::uint32_t a = pairs.first[pair], b = pairs.second[pair];
    const double apart = state.grains.motion[a].position.x - state.grains.motion[b].position.x;
    const auto between = static_cast<std::int32_t>(std::nearbyint(apart / tile.length));
    TileContact contact{.first = a, .second = b, .image = between + wraps[b] - wraps[a]};
    for (int what = 0; what < memory_size; ++what) contact.memory[what] = pairs.remembered(pair, what);
    tile.contacts.push_back(contact);
  }
  for (const SurfaceContacts& slab : state.surfaces)
    for (const SurfaceContact& made : slab.made) {
      if (made.triangle >= 0) throw InputError("a tile lies between planes, not meshes");
      tile.on_surfaces.push_back(on_surface(made, made.who.grain));
    }
  return tile;
}

double Tile::largest() const {
  double largest = 0;
  for (const TileGrain& grain : grains) largest = std::max(largest, grain.radius);
  for (const ClumpMember& member : clumps.members)
    largest = std::max(largest, dem::length(member.arm) + grains[member.row].radius);
  return largest;
}

MovingPatch::MovingPatch(Tile tile, const PatchSize& size, KeepsRut keeps)
    : tile_(std::move(tile)), size_(size), keeps_(keeps == KeepsRut::yes) {
  const double largest = tile_.largest();
  if (!(size_.slab >= 2 * largest) || !(size_.slab <= tile_.length))
    throw InputError(
        fmt::format("a patch that advances by {:.4g} m: from the largest grain's diameter, {:.4g} m, to the tile's "
                    "length, {:.4g} m",
                    size_.slab, 2 * largest, tile_.length));
}

GrainId MovingPatch::id(std::int64_t image, std::uint32_t grain) const {
  const std::int64_t id = (image + tiles_before) * static_cast<std::int64_t>(tile_.grains.size()) + grain;
  if (id < 0 || id >= static_cast<std::int64_t>(~GrainId{0}))
    throw RunStopped("the way is too long for grains to be numbered: shorten it");
  return static_cast<GrainId>(id);
}

Vec3 MovingPatch::home(GrainId id) const {
  const std::size_t count = tile_.grains.size();
  return tile_.place(static_cast<std::int64_t>(id / count) - tiles_before, static_cast<std::uint32_t>(id % count));
}

double MovingPatch::grains() const {
  return static_cast<double>(tile_.grains.size()) * (front() - rear() + 2 * size_.slab) / tile_.length;
}

namespace {

/// Copies of the tile's grains with from <= x < to, sphere by sphere: visit(image, grain).
template <class Visit>
void visit_between(const Tile& tile, double from, double to, const Visit& visit) {
  const auto tile_at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / tile.length)); };
  for (std::int64_t image = tile_at(from) - 1; image <= tile_at(to); ++image)
    for (std::uint32_t grain = 0; grain < tile.grains.size(); ++grain) {
      const double x = tile.x_of(image, grain);
      if (x >= from && x < to) visit(image, grain);
    }
}

}  // namespace

/// Brings contacts of the copies with from <= x < to for whose ends `wanted` holds, and contacts with surfaces of
/// grains for which it holds twice.
void MovingPatch::bring_contacts(double from, double to, Exchange& change,
                                 const std::function<bool(double first, double second)>& wanted) const {
  const auto between = [&](double x) { return x >= from && x < to; };
  const auto tile_at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / tile_.length)); };
  for (std::int64_t image = tile_at(from) - reach_in_tiles; image <= tile_at(to) + reach_in_tiles; ++image) {
    for (const TileContact& contact : tile_.contacts) {
      const double first = tile_.x_of(image, contact.first), second = tile_.x_of(image + contact.image, contact.second);
      if (between(first) && between(second) && wanted(first, second))
        change.contacts.push_back(
            {id(image, contact.first), id(image + contact.image, contact.second), contact.memory});
    }
    for (const TileOnSurface& contact : tile_.on_surfaces) {
      const double x = tile_.x_of(image, contact.grain);
      if (!between(x) || !wanted(x, x)) continue;
      const auto& m = contact.memory;
      change.on_surfaces.push_back({id(image, contact.grain),
                                    {.who = {0, contact.body, contact.surface},
                                     .triangle = -1,
                                     .normal = contact.normal,
                                     .memory = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}}}});
    }
  }
}

/// Copies with from <= x < to come in; those with free_from <= x < free_to are free, the others held.
void MovingPatch::bring_grains(double from, double to, double free_from, double free_to, Exchange& change) const {
  visit_between(tile_, from, to, [&](std::int64_t image, std::uint32_t k) {
    const double x = tile_.x_of(image, k);
    const auto bring = [&](std::uint32_t number, std::uint32_t clump) {
      const TileGrain& grain = tile_.grains[number];
      const double mass = x >= free_from && x < free_to ? grain.mass : held_mass;
      change.enters.push_back(
          {.id = id(image, number),
           .radius = grain.radius,
           .mass = mass,
           .material = static_cast<std::uint8_t>(grain.material),
           .position = tile_.place(image, number),
           .clump = clump,
           .inertia = clump == lone || mass == held_mass ? 0 : mean_inertia(change.clumps.all[clump])});
    };
    const std::uint32_t clump = tile_.grains[k].clump;
    if (clump == lone) return bring(k, lone);
    const Clump& whole = tile_.clumps.all[clump];
    if (tile_.clumps.row_of(whole) != k) return;  // all its spheres come with the first
    bring_clump(image, whole, change);
    for (const ClumpMember& member : tile_.clumps.of(whole))
      bring(member.row, static_cast<std::uint32_t>(change.clumps.all.size() - 1));
  });
}

void MovingPatch::bring_clump(std::int64_t image, const Clump& clump, Exchange& change) const {
  Clump comes = clump;
  comes.motion.position.x += static_cast<double>(image) * tile_.length;
  comes.first = static_cast<std::uint32_t>(change.clumps.members.size());
  change.clumps.all.push_back(comes);
  for (const ClumpMember& member : tile_.clumps.of(clump))
    change.clumps.members.push_back({id(image, member.row), member.arm, 0});
}

Simulation MovingPatch::open(Setup setup, const State& tile, double way) const {
  // Grains that are thrown over an end fly no farther than this, and leave at the next advance.
  const double room = 2 * size_.slab + size_.behind + size_.ahead;
  setup.domain.periodic[0] = false;
  setup.domain.lower.x = -room, setup.domain.upper.x = front() + way + room;
  State begin;
  begin.step = tile.step, begin.time = tile.time, begin.gravity = tile.gravity, begin.bodies = tile.bodies;
  Simulation simulation(std::move(setup), std::move(begin));
  Exchange change;
  const double from = rear() - size_.slab, to = front() + size_.slab;
  bring_grains(from, to, rear(), front(), change);
  const auto is_free = [&](double x) { return x >= rear() && x < front(); };
  bring_contacts(from, to, change, [&](double first, double second) { return is_free(first) || is_free(second); });
  simulation.exchange(change);
  return simulation;
}

void MovingPatch::follow(Simulation& simulation, double axle) {
  while (axle >= size_.behind + static_cast<double>(advances_ + 1) * size_.slab) advance(simulation);
}

void MovingPatch::note_disturbance(const Simulation& simulation, double from, double to) {
  double sum = 0, count = 0;
  const Grains& grains = simulation.state().grains;
  for (std::size_t row = 0; row < grains.count(); ++row) {
    const Vec3 settled = home(grains.id[row]);
    if (grains.motion[row].held() || settled.x < from || settled.x >= to) continue;
    sum += length(grains.motion[row].position - settled), count += 1;
  }
  if (count > 0) disturbed_ = std::max(disturbed_, sum / count);
}

void MovingPatch::advance(Simulation& simulation) {
  const double old_rear = rear(), held_from = front(), enters_from = front(advances_ + 1);
  const double enters_to = front(advances_ + 2), new_rear = static_cast<double>(advances_ + 1) * size_.slab;
  note_disturbance(simulation, held_from - size_.slab, held_from);
  if (keeps_) write_down(simulation, old_rear - size_.slab, new_rear);
  Exchange change;
  const double largest = tile_.largest();
  change.leaves = [&](GrainId, const Motion& grain) {
    if (grain.position.x < old_rear) return true;
    if (grain.held() || grain.position.x < enters_from - 2 * largest) return false;
    ++thrown_;
    return true;
  };
  change.stays = [&](GrainId, const Motion& grain) { return grain.position.x < new_rear; };
  visit_between(tile_, held_from, enters_from, [&](std::int64_t image, std::uint32_t grain) {
    change.let_go.push_back({id(image, grain), tile_.grains[grain].mass});
  });
  bring_grains(enters_from, enters_to, enters_to, enters_to, change);
  const auto is_let_go = [&](double x) { return x >= held_from && x < enters_from; };
  bring_contacts(held_from, enters_to, change,
                 [&](double first, double second) { return is_let_go(first) || is_let_go(second); });
  simulation.exchange(change);
  ++advances_;
}

/// Adds to the rut who lies at from <= x < to and isn't in it yet, and the contacts that these have among each other
/// and with those that are. Contacts of two grains that are held are needed nowhere.
void MovingPatch::write_down(const Simulation& simulation, double from, double to) {
  const State& state = simulation.state();
  const Grains& grains = state.grains;
  std::unordered_map<GrainId, std::uint32_t> in_rut;
  for (std::uint32_t k = 0; k < in_rut_.size(); ++k) in_rut.emplace(in_rut_[k], k);
  constexpr auto nowhere = ~std::uint32_t{0};
  std::vector<std::uint32_t> place_of(grains.count(), nowhere);  // in the rut, of each row
  const auto known = static_cast<std::uint32_t>(in_rut_.size());
  for (std::size_t row = 0; row < grains.count(); ++row) {
    const GrainId id = grains.id[row];
    if (const auto there = in_rut.find(id); there != in_rut.end()) {
      place_of[row] = there->second;
      continue;
    }
    const Vec3& at = grains.motion[row].position;
    const std::uint32_t clump = grains.clump[row];
    const double x = clump == lone ? at.x : state.clumps.all[clump].motion.position.x;
    if (x < from || x >= to) continue;
    const TileGrain& was = tile_.grains[id % tile_.grains.size()];
    place_of[row] = static_cast<std::uint32_t>(rut_.grains.size());
    rut_.grains.push_back({at, was.radius, was.mass, was.material, lone});
    in_rut_.push_back(id);
  }
  for (Clump clump : state.clumps.all) {
    const auto spheres = state.clumps.of(clump);
    const std::uint32_t first = place_of[spheres.front().row];
    if (first == nowhere || first < known) continue;
    clump.first = static_cast<std::uint32_t>(rut_.clumps.members.size());
    for (const ClumpMember& sphere : spheres) {
      const std::uint32_t grain = place_of[sphere.row];
      rut_.grains[grain].clump = static_cast<std::uint32_t>(rut_.clumps.all.size());
      rut_.clumps.members.push_back({sphere.id, sphere.arm, grain});
    }
    clump.motion.velocity = clump.motion.spin = {};
    rut_.clumps.all.push_back(clump);
  }
  const PairList& pairs = state.pairs;
  for (std::size_t pair = 0; pair < pairs.first.size(); ++pair) {
    if (!pairs.touches(pair)) continue;
    const std::uint32_t a = place_of[pairs.first[pair]], b = place_of[pairs.second[pair]];
    if (a == nowhere || b == nowhere || (a < known && b < known)) continue;
    TileContact contact{.first = a, .second = b};
    for (int what = 0; what < memory_size; ++what) contact.memory[what] = pairs.remembered(pair, what);
    rut_.contacts.push_back(contact);
  }
  for (const SurfaceContacts& slab : state.surfaces)
    for (const SurfaceContact& made : slab.made) {
      const std::uint32_t grain = place_of[made.who.grain];
      if (made.triangle >= 0 || grain == nowhere || grain < known) continue;  // a wheel, or who was there before
      rut_.on_surfaces.push_back(on_surface(made, grain));
    }
}

Simulation MovingPatch::back_over_its_rut(const Simulation& simulation, double way, KeepsRut keeps) {
  const double end = front() + size_.slab;
  write_down(simulation, rear() - size_.slab, end);
  rut_.length = 2 * (end + size_.slab);  // it does not repeat itself: its images lie beyond what is looked at
  if (undisturbed_.grains.empty()) undisturbed_ = std::move(tile_);
  tile_ = std::exchange(rut_, {});
  in_rut_.clear();
  advances_ = 0;
  keeps_ = keeps == KeepsRut::yes;
  return open(simulation.setup(), simulation.state(), way);
}

SurfaceHeight MovingPatch::undisturbed(const Footprint& over, double spacing) const {
  SurfaceHeight out = bare_floor(over, spacing);
  const Tile& tile = undisturbed_.grains.empty() ? tile_ : undisturbed_;
  const double largest = tile.largest();
  visit_between(tile, over.x_lower - largest, over.x_upper + largest,
                [&](std::int64_t image, std::uint32_t k) { raise(out, tile.place(image, k), tile.grains[k].radius); });
  return out;
}

}  // namespace soilbin::dem
