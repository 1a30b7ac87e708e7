#include "dem/engine/energy_ledger.hpp"

#include <algorithm>

#include "dem/engine/world.hpp"

namespace soilbin::dem {
namespace {

/// What a contact of jkr had stored when it broke [J]: it is stretched to its utmost then.
double bond_energy(const World& world, int kind, double radius) {
  Touch<double> touch{};
  touch.overlap = -adhesion_reach(world.laws[kind], radius);
  touch.radius = radius;
  return stored_energy(world.setup.laws, world.laws[kind], touch, {}).normal;
}

double broken_between_grains(const World& world, const std::vector<std::uint8_t>& before) {
  const State& s = world.state;
  double sum = 0;
  for (std::size_t pair = 0; pair < s.pairs.first.size(); ++pair) {
    if (!(before[pair / batch_size] >> (pair % batch_size) & 1) || s.pairs.touches(pair)) continue;
    const std::uint32_t i = s.pairs.first[pair], j = s.pairs.second[pair];
    const double a = s.grains.motion[i].radius, b = s.grains.motion[j].radius;
    sum += bond_energy(world, world.kind(i, j), a * b / (a + b));
  }
  return sum;
}

/// Adds to `sum`, contact by contact.
void add_broken_on_surfaces(const World& world, double& sum) {
  const State& s = world.state;
  for (std::size_t slab = 0; slab < s.surfaces.size(); ++slab) {
    if (world.sleeping[static_cast<int>(slab)]) continue;
    const std::vector<SurfaceContact>&old = world.surfaces_before[slab], &now = s.surfaces[slab].made;
    std::size_t in_old = 0, in_now = 0;
    for (const NearSurface& near : s.surfaces[slab].near) {
      int gone = 0;
      for (; in_old < old.size() && old[in_old].who == near; ++in_old) ++gone;
      for (; in_now < now.size() && now[in_now].who == near; ++in_now) --gone;
      for (; gone > 0; --gone) sum += bond_energy(world, world.kind(near), s.grains.motion[near.grain].radius);
    }
  }
}

}  // namespace

void EnergyLedger::begin(const Setup& setup, const State& state) {
  loads_.assign(setup.numerics.ledger ? state.grains.motion.size() : 0, {});
}

void EnergyLedger::begin_step(const Setup& setup, const State& state) {
  if (setup.numerics.ledger && setup.laws.cohesion == CohesionLaw::jkr) bonds_before_ = state.pairs.touching;
}

void EnergyLedger::count_kick(std::size_t row, const Load& load, const Kick& half, LostPower& lost) {
  LedgerLoad& loads = loads_[row];
  const double rolled = dot(loads.couple, half.spin);
  lost.damping -= dot(loads.dashpot, half.velocity);
  lost.into_slide -= dot(loads.slide, half.velocity) + dot(load.torque, half.spin) - rolled;
  lost.into_roll -= rolled;
  loads = {};
}

void EnergyLedger::clear(std::size_t first, std::size_t last) {
  if (!loads_.empty()) std::fill(loads_.begin() + first, loads_.begin() + last, LedgerLoad{});
}

void EnergyLedger::end_step(World& world) const {
  if (!world.setup.numerics.ledger) return;
  EnergyLosses& ledger = world.state.ledger;
  for (const PairFindings& found : world.found) ledger.add(found.lost, world.setup.numerics.dt);
  if (world.setup.laws.cohesion != CohesionLaw::jkr) return;
  double broken = broken_between_grains(world, bonds_before_);
  add_broken_on_surfaces(world, broken);
  ledger.adhesion += broken;
}

void with_energy_counted(World& world, const std::function<void()>& change) {
  const bool counts = world.setup.numerics.ledger;
  const double before = counts ? energy_of(world).total() : 0;
  change();
  if (counts) world.state.ledger.added += energy_of(world).total() - before;
}

}  // namespace soilbin::dem
