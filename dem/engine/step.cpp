// A step: forces of pairs, forces of surfaces, motion; and in which order slabs take their turn.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/engine/periodic.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

void Simulation::step() {
  if (search_is_due()) search();
  choose_sleepers();
  State& s = state_;
  sweep_ = {s.grains.motion.data(),
            s.grains.spin.data(),
            s.grains.load.data(),
            setup_.numerics.ledger ? taking_.data() : nullptr,
            s.pairs.first.data(),
            s.pairs.second.data(),
            s.pairs.kind.data(),
            s.pairs.memory.data(),
            s.pairs.touching.data(),
            constants_.data(),
            static_cast<int>(setup_.materials.all.size()),
            setup_.laws,
            setup_.numerics.dt,
            {},
            setup_.numerics.deepest_overlap};
  const Periods periods(setup_.domain);
  sweep_.period[0] = periods.length.x;
  sweep_.period[1] = periods.length.y;
  sweep_.period[2] = periods.length.z;
  if (setup_.numerics.ledger && setup_.laws.cohesion == CohesionLaw::jkr) bonds_before_ = s.pairs.touching;
  placed_.place(s.bodies);
  const int blocks = static_cast<int>(blocks_.size()) - 1;
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(dynamic)
    for (int block = 0; block < blocks; ++block) inner_stage(block);
#pragma omp for schedule(dynamic)
    for (int block = 0; block < blocks; ++block) seam_stage(block);
  }
  finish_step();
}

/// Runs of slabs, at least two each and about as many that are awake in each: where they begin, and the end. They
/// depend on the state alone, so that sums come in the same order for any number of threads.
void Simulation::cut_blocks() {
  constexpr int most = 24;
  const int slabs = static_cast<int>(asleep_.size());
  const int awake = slabs - static_cast<int>(std::count(asleep_.begin(), asleep_.end(), 1));
  const int share = std::max(2, (awake + most - 1) / most);
  blocks_.assign(1, 0);
  int found = 0;
  for (int slab = 0; slab + 2 < slabs; ++slab) {
    found += !asleep_[slab];
    if (found < share || slab == blocks_.back()) continue;
    blocks_.push_back(slab + 1);
    found = 0;
  }
  blocks_.push_back(slabs);
}

/// The slabs of a block one after the other, each moved as soon as nothing presses on it any more, so that its rows go
/// through the cache once. What touches a neighbouring block is left.
void Simulation::inner_stage(int block) {
  const int last = blocks_[block + 1] - 1;
  for (int slab = blocks_[block]; slab < last; ++slab) {
    pair_stage(slab);
    if (slab > blocks_[block]) finish_slab(slab);
  }
}

/// The pairs of a block's last slab, with the next block's first one, and the motion of both. No two seams share a
/// slab.
void Simulation::seam_stage(int block) {
  const int last = blocks_[block + 1] - 1, next = (last + 1) % blocks_.back();
  pair_stage(last);
  finish_slab(last);
  if (next != last) finish_slab(next);
}

void Simulation::finish_slab(int slab) {
  if (!asleep_[slab] || searched_now_) surface_stage(slab);
  if (asleep_[slab])
    drop_loads(slab);
  else
    motion_stage(slab);
}

void Simulation::pair_stage(int slab) {
  found_[slab] = {};
  if (asleep_[slab] && asleep_[(slab + 1) % asleep_.size()]) return;
  kernel_(sweep_, state_.pairs.slab_begin[slab], state_.pairs.slab_begin[slab + 1], found_[slab]);
}

void Simulation::surface_stage(int slab) {
  State& s = state_;
  SurfaceContacts& here = s.surfaces[slab];
  std::vector<SurfaceContact>& made = made_[slab];
  made.clear();
  BodyLoad* loads = s.body_loads.data() + slab * s.bodies.size();
  std::fill(loads, loads + s.bodies.size(), BodyLoad{});
  std::array<SurfaceTouch, 8> touches;
  TouchWork work{.slab = slab, .batch = {}, .points = {}, .count = 0};
  std::size_t old = 0;
  for (const NearSurface& near : here.near) {
    const std::size_t begin = old, first = made.size();
    while (old < here.made.size() && here.made[old].who == near) ++old;
    const Motion& grain = s.grains.motion[near.grain];
    const int kind = kind_of(s.grains.material[near.grain], s.bodies[near.body].surfaces[near.surface].material);
    const int found = find_contacts(placed_.at(near), near, grain, {constants_of(kind), adhesion_reach_},
                                    {here.made.data() + begin, old - begin}, made, touches);
    for (int k = 0; k < found; ++k) {
      if (touches[k].overlap > setup_.numerics.deepest_overlap * grain.radius) found_[slab].too_deep = true;
      put(work.batch, work.count, s.bodies[near.body], touches[k], grain, s.grains.spin[near.grain],
          made[first + k].memory);
      work.batch.kind[work.count] = static_cast<std::uint8_t>(kind);
      work.points[work.count++] = touches[k].point;
      if (work.count == batch_size) touch_surfaces(work, {made.data(), first + k + 1});
    }
  }
  if (work.count > 0) touch_surfaces(work, made);
  here.made.swap(made);
}

/// The law for a batch: the last work.count contacts of `made`.
void Simulation::touch_surfaces(TouchWork& work, std::span<SurfaceContact> made) {
  State& s = state_;
  TouchBatch& batch = work.batch;
  const TouchSweep sweep{constants_.data(), setup_.laws, setup_.numerics.dt, setup_.numerics.ledger};
  std::fill(batch.losses, batch.losses + 5, 0.0);
  std::fill(batch.kind + work.count, batch.kind + batch_size, batch.kind[0]);
  touch_kernel_(sweep, batch, work.count);
  const auto column = [](const double(*columns)[8], int k) {
    return Vec3{columns[0][k], columns[1][k], columns[2][k]};
  };
  SurfaceContact* contact = made.data() + made.size() - work.count;
  for (int k = 0; k < work.count; ++k, ++contact) {
    const Vec3 force = column(batch.force, k), couple = column(batch.couple, k);
    const Vec3 slide = column(batch.memory, k), roll = column(batch.memory + 3, k);
    contact->memory = {{slide.x, slide.y, slide.z}, {roll.x, roll.y, roll.z}};
    const NearSurface& who = contact->who;
    if (sweep.ledger) {
      Taking& taking = taking_[who.grain];
      taking.dashpot += column(batch.dashpot, k);
      taking.slide += column(batch.slide, k);
      taking.couple += couple;
    }
    Load& load = s.grains.load[who.grain];
    load.force += force;
    load.torque += couple - (batch.radius[k] - batch.overlap[k] / 2) * cross(contact->normal, force);
    BodyLoad& on_body = s.body_loads[work.slab * s.bodies.size() + who.body];
    on_body.force -= force;
    on_body.torque -= couple + cross(work.points[k] - s.bodies[who.body].position, force);
  }
  for (int k = 0; k < 5; ++k) found_[work.slab].losses[k] += batch.losses[k];
  work.count = 0;
}

void Simulation::motion_stage(int slab) {
  State& s = state_;
  const double dt = setup_.numerics.dt;
  double fastest = 0;
  bool finite = true;
  for (std::uint32_t k = s.slab_rows[slab]; k < s.slab_rows[slab + 1]; ++k) {
    Motion& grain = s.grains.motion[k];
    Spin& spin = s.grains.spin[k];
    Load& load = s.grains.load[k];
    if (setup_.numerics.ledger) count_kick(slab, k);
    const double share = dt * grain.inverse_mass;
    grain.velocity += share * load.force + (grain.held() ? 0.0 : dt) * s.gravity;
    grain.position += dt * grain.velocity;
    spin.rate += (dt * spin.inverse_inertia) * load.torque;
    load = {};
    const double speed2 = squared(grain.velocity);
    fastest = std::max(fastest, speed2);
    finite &= speed2 < 1e30;
  }
  fastest_[slab] = finite ? std::sqrt(fastest) : std::numeric_limits<double>::infinity();
}

void Simulation::finish_step() {
  State& s = state_;
  const int slabs = static_cast<int>(s.slab_rows.size()) - 1;
  const double dt = setup_.numerics.dt;
  double fastest = 0;
  bool too_deep = false;
  for (Body& body : s.bodies) body.force = body.torque = {};
  for (int slab = 0; slab < slabs; ++slab) {
    fastest = std::max(fastest, fastest_[slab]);
    too_deep |= found_[slab].too_deep;
    for (std::size_t b = 0; b < s.bodies.size(); ++b) {
      s.bodies[b].force += s.body_loads[slab * s.bodies.size() + b].force;
      s.bodies[b].torque += s.body_loads[slab * s.bodies.size() + b].torque;
    }
    if (setup_.numerics.ledger) s.ledger.add(found_[slab].losses, dt);
  }
  if (setup_.numerics.ledger) s.ledger.adhesion += broken_bonds();
  count_calm();
  searched_now_ = false;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    Body& body = s.bodies[b];
    advance(body, s.gravity, dt);
    const double arm = extents_[b] < 0 ? length(body.position - middle_) + around_middle_ + reach_ : extents_[b];
    const double speed = length(body.velocity) + length(body.spin) * arm;
    body.travel += dt * speed;
    fastest = speed < 1e15 ? std::max(fastest, speed) : std::numeric_limits<double>::infinity();
  }
  ++s.step;
  s.time += dt;
  s.travel += dt * fastest;
  if (too_deep) stop_for_overlap();
  if (!std::isfinite(fastest)) stop_for_motion();
}

}  // namespace soilbin::dem
