#include "dem/archive/restart_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/engine/rayleigh_time.hpp"
#include "dem/surface/positive.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// From 0 to `end`, never falling.
bool divides(const std::vector<std::uint32_t>& begins, std::size_t end) {
  return !begins.empty() && begins.front() == 0 && begins.back() == end && std::is_sorted(begins.begin(), begins.end());
}

template <class Rows>
bool below(const Rows& rows, std::size_t limit) {
  return std::all_of(rows.begin(), rows.end(), [&](auto row) { return row < limit; });
}

/// Places and sizes that a run can have; a grain that was lost is not far outside. Velocities may be none: a run that
/// stopped because of them is looked at.
bool grains_are_sound(const Setup& setup, const State& state) {
  const Vec3 side = setup.domain.upper - setup.domain.lower;
  const Domain around{setup.domain.lower - side, setup.domain.upper + side, {}};
  for (std::size_t k = 0; k < state.grains.count(); ++k) {
    const Motion& motion = state.grains.motion[k];
    if (!is_finite(motion.position) || !around.contains(motion.position) || !positive(motion.radius) ||
        !(motion.inverse_mass >= 0 && std::isfinite(motion.inverse_mass)) ||
        !(state.grains.spin[k].inverse_inertia >= 0 && std::isfinite(state.grains.spin[k].inverse_inertia)))
      return false;
  }
  return std::ranges::all_of(state.searched_at, is_finite);
}

/// Steps that get somewhere: a millionth of the usual one does not.
bool step_is_sound(const Setup& setup, const State& state) {
  const double dt = setup.numerics.dt;
  if (!positive(dt) || !std::isfinite(state.time) || state.step < 0 || !is_finite(state.gravity)) return false;
  return state.grains.count() == 0 || dt >= 1e-6 * rayleigh_time(setup.materials, state.grains);
}

/// Ids are places in tables of as many rows.
bool ids_are_sound(const State& state) {
  constexpr std::size_t taken_away = 1'000'000, times_as_many = 64;
  return state.next_id <= taken_away + times_as_many * state.grains.count();
}

bool bodies_fit(const State& state, std::size_t materials) {
  for (const Body& body : state.bodies)
    for (const Surface& surface : body.surfaces)
      if (surface.material < 0 || static_cast<std::size_t>(surface.material) >= materials) return false;
  return true;
}

bool pairs_fit(const State& state, std::size_t materials) {
  const PairList& p = state.pairs;
  const std::size_t rows = state.grains.motion.size(), pairs = p.batches() * batch_size;
  return p.first.size() == pairs && p.second.size() == pairs && p.kind.size() == pairs &&
         p.memory.size() == pairs * memory_size && p.slab_begin.size() == state.slab_rows.size() &&
         (p.slab_begin.empty() || divides(p.slab_begin, p.batches())) && below(p.first, rows) &&
         below(p.second, rows) && below(p.kind, materials * materials);
}

bool leads_somewhere(const NearSurface& who, const State& state) {
  return who.grain < state.grains.count() && who.body < state.bodies.size() &&
         who.surface < state.bodies[who.body].surfaces.size();
}

bool contact_fits(const SurfaceContact& contact, const State& state) {
  if (!leads_somewhere(contact.who, state)) return false;
  const Surface& surface = state.bodies[contact.who.body].surfaces[contact.who.surface];
  const auto* mesh = std::get_if<MeshSurface>(&surface.shape);
  return contact.triangle >= -1 && contact.triangle < (mesh ? mesh->mesh->size() : 0);
}

bool surfaces_fit(const State& state) {
  if (state.surfaces.size() + 1 != std::max<std::size_t>(state.slab_rows.size(), 1)) return false;
  for (const SurfaceContacts& slab : state.surfaces) {
    for (const NearSurface& near : slab.near)
      if (!leads_somewhere(near, state)) return false;
    for (const SurfaceContact& contact : slab.made)
      if (!contact_fits(contact, state)) return false;
  }
  return true;
}

bool clumps_fit(const State& state) {
  const Clumps& clumps = state.clumps;
  const Grains& grains = state.grains;
  if (grains.clump.size() != grains.count()) return false;
  std::size_t spheres = 0;
  for (const std::uint32_t clump : grains.clump) spheres += clump != lone;
  if (spheres != clumps.members.size()) return false;
  std::size_t first = 0;
  for (std::size_t k = 0; k < clumps.all.size(); ++k) {
    const Clump& clump = clumps.all[k];
    if (clump.first != first || clump.count == 0 || clump.count > spheres - first) return false;
    first += clump.count;
    for (const ClumpMember& member : clumps.of(clump))
      if (member.row >= grains.count() || grains.clump[member.row] != k || grains.id[member.row] != member.id)
        return false;
  }
  return first == spheres;
}

/// What is left from before a change is not read again.
bool sleep_fits(const State& state) {
  if (state.travel == std::numeric_limits<double>::infinity()) return true;
  return state.calm.size() == state.surfaces.size() &&
         state.body_loads.size() == state.surfaces.size() * state.bodies.size();
}

}  // namespace

void check_restart(const Setup& setup, const State& state, const std::string& file) {
  const auto require = [&](bool holds, const char* part) {
    if (!holds)
      throw InputError({file, 0, 0}, fmt::format("its {} contradict the rest", part), "",
                       "the file is of another program");
  };
  const std::size_t materials = setup.materials.all.size(), grains = state.grains.count();
  require(materials >= 1 && materials <= most_materials && setup.materials.interactions.size() == materials * materials,
          "materials");
  require(below(state.grains.material, materials) && below(state.grains.id, state.next_id), "grains");
  require(ids_are_sound(state), "numbers of grains");
  require(grains_are_sound(setup, state), "places and sizes of grains");
  require(step_is_sound(setup, state), "time step");
  require(clumps_fit(state), "clumps");
  require(bodies_fit(state, materials), "bodies");
  for (const Body& body : state.bodies) check(body, static_cast<int>(materials));
  // Grains that were added since the last search are in no slab yet.
  const std::size_t searched = state.searched_at.size();
  require(searched <= grains && (state.slab_rows.empty() ? searched == 0 : divides(state.slab_rows, searched)),
          "slabs");
  require(pairs_fit(state, materials), "pairs");
  require(surfaces_fit(state), "contacts with surfaces");
  require(sleep_fits(state), "slabs asleep");
  require(below(state.new_grains, state.next_id), "new grains");
}

}  // namespace soilbin::dem
