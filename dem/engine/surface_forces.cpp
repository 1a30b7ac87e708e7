// The stage that presses grains on surfaces: geometry contact by contact, the law in batches.
#include <algorithm>
#include <array>

#include "dem/engine/step.hpp"

namespace soilbin::dem {
namespace {

/// Contacts of one slab on their way through the law.
struct TouchWork {
  TouchBatch batch{};
  std::array<SurfaceTouch, batch_size> touches;
  int count = 0;

  void add(const Touch<double>& touch, const Memory<double>& memory, const Motion& grain, const Spin& spin);
};

void put_column(const Triple<double>& a, double (*columns)[8], int k) {
  columns[0][k] = a.x, columns[1][k] = a.y, columns[2][k] = a.z;
}

void TouchWork::add(const Touch<double>& touch, const Memory<double>& memory, const Motion& grain, const Spin& spin) {
  put_column(touch.normal, batch.normal, count);
  put_column(touch.velocity, batch.velocity, count);
  put_column(touch.rotation, batch.rotation, count);
  put_column(touch.before, batch.before, count);
  put_column(memory.slide, batch.memory, count);
  put_column(memory.roll, batch.memory + 3, count);
  batch.overlap[count] = touch.overlap;
  batch.turning[count] = touch.turning;
  batch.radius[count] = touch.radius;
  batch.inverse_mass[count] = grain.inverse_mass;
  batch.inverse_inertia[count] = spin.inverse_inertia;
}

Vec3 column_of(const double (*columns)[8], int k) { return {columns[0][k], columns[1][k], columns[2][k]}; }

/// Adds what contact k of a batch does to the loads of its grain and of its body.
void add_touch(World& world, int slab, const TouchWork& work, int k, SurfaceContact& contact) {
  State& s = world.state;
  const TouchBatch& batch = work.batch;
  const Vec3 force = column_of(batch.force, k), couple = column_of(batch.couple, k);
  const Vec3 slide = column_of(batch.memory, k), roll = column_of(batch.memory + 3, k);
  contact.memory = {triple(slide), triple(roll)};
  const NearSurface& who = contact.who;
  if (world.sweep.ledger_loads) {
    LedgerLoad& loads = world.sweep.ledger_loads[who.grain];
    loads.dashpot += column_of(batch.dashpot, k);
    loads.slide += column_of(batch.slide, k);
    loads.couple += couple;
  }
  add_loads(work.touches[k], batch.radius[k], force, couple, s.bodies[who.body].position, s.grains.load[who.grain],
            s.body_loads[slab * s.bodies.size() + who.body]);
}

/// The law for a batch: the last work.count contacts of `made`.
void press_batch(World& world, int slab, TouchWork& work, std::span<SurfaceContact> made) {
  TouchBatch& batch = work.batch;
  batch.lost = {};
  std::fill(batch.kind + work.count, batch.kind + batch_size, batch.kind[0]);
  world.kernels.touches(
      {world.laws.rows(), world.setup.laws, world.setup.numerics.dt, world.sweep.ledger_loads != nullptr}, batch,
      work.count);
  SurfaceContact* contact = made.data() + made.size() - work.count;
  for (int k = 0; k < work.count; ++k) add_touch(world, slab, work, k, contact[k]);
  world.found[slab].lost += batch.lost;
  work.count = 0;
}

}  // namespace

void surface_forces(World& world, int slab) {
  State& s = world.state;
  SurfaceContacts& here = s.surfaces[slab];
  std::vector<SurfaceContact>& made = world.surfaces_before[slab];
  made.clear();
  BodyLoad* loads = s.body_loads.data() + slab * s.bodies.size();
  std::fill(loads, loads + s.bodies.size(), BodyLoad{});
  if (here.near.empty()) return;
  const double deepest = world.setup.numerics.deepest_overlap, adhesion = world.margins.adhesion;
  std::array<SurfaceTouch, 8> touches;
  TouchWork work;
  std::size_t old = 0;
  for (const NearSurface& near : here.near) {
    const std::size_t begin = old, first = made.size();
    while (old < here.made.size() && here.made[old].who == near) ++old;
    const Motion& grain = s.grains.motion[near.grain];
    const Spin& spin = s.grains.spin[near.grain];
    const int kind = world.kind(near);
    const GrainOnSurface at{.who = near,
                            .grain = grain,
                            .surface = world.placed.at(near),
                            .constants = world.laws[kind],
                            .adhesion_reach = adhesion,
                            .before = {here.made.data() + begin, old - begin}};
    const int found = find_contacts(at, made, touches);
    for (int k = 0; k < found; ++k) {
      if (touches[k].overlap > deepest * grain.radius) world.found[slab].too_deep = true;
      work.add(touch_of(s.bodies[near.body], touches[k], grain, spin), made[first + k].memory, grain, spin);
      work.batch.kind[work.count] = static_cast<std::uint8_t>(kind);
      work.touches[work.count++] = touches[k];
      if (work.count == batch_size) press_batch(world, slab, work, {made.data(), first + k + 1});
    }
  }
  if (work.count > 0) press_batch(world, slab, work, made);
  here.made.swap(made);
}

}  // namespace soilbin::dem
