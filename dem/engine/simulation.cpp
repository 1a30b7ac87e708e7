#include "dem/engine/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "dem/engine/periodic.hpp"
#include "dem/engine/positive.hpp"
#include "dem/engine/time_step.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

constexpr int row_of_constants = 16;

void check(const Domain& domain) {
  const Vec3 side = domain.upper - domain.lower;
  if (!(side.x > 0 && side.y > 0 && side.z > 0))
    throw InputError("the domain has no volume: upper must be above lower");
}

}  // namespace

Simulation::Simulation(Setup setup) : setup_(std::move(setup)) {
  if (setup_.materials.all.empty()) throw InputError("a simulation needs a material");
  check(setup_.domain);
  set_numerics(setup_.numerics);
}

Simulation::Simulation(Setup setup, State state) : Simulation(std::move(setup)) {
  state_ = std::move(state);
  if (state_.slab_rows.empty()) return;
  prepare();
  make_room(static_cast<int>(state_.slab_rows.size()) - 1);
}

void Simulation::accounted(const std::function<void()>& change) {
  const double before = setup_.numerics.ledger ? energy().total() : 0;
  change();
  if (setup_.numerics.ledger) state_.ledger.added += energy().total() - before;
}

void Simulation::set_numerics(const Numerics& numerics) {
  if (!positive(numerics.dt)) throw InputError("the time step must be above 0");
  if (numerics.skin < 0 || !positive(numerics.deepest_overlap))
    throw InputError("skin and deepest overlap can't be negative");
  if (state_.step > 0 && numerics.dt != setup_.numerics.dt) shift(false, (setup_.numerics.dt - numerics.dt) / 2);
  setup_.numerics = numerics;
  threads_ = numerics.threads > 0 ? numerics.threads : omp_get_num_procs();
  const std::string_view set =
      numerics.instruction_set.empty() ? instruction_sets().front() : std::string_view(numerics.instruction_set);
  kernel_ = pair_kernel(set);
  touch_kernel_ = touch_kernel(set);
  note_change();
}

void Simulation::set_interaction(int a, int b, const Interaction& interaction) {
  accounted([&] {
    setup_.materials.set(a, b, interaction);
    if (!state_.slab_rows.empty()) fill_constants();
  });
  note_change();
}

void Simulation::set_gravity(const Vec3& gravity) {
  accounted([&] { state_.gravity = gravity; });
  wake_all();
}

GrainId Simulation::add_grain(const Vec3& position, double radius, int material, const Vec3& velocity,
                              const Vec3& spin) {
  if (!positive(radius)) throw InputError("a grain's radius must be above 0");
  if (material < 0 || material >= static_cast<int>(setup_.materials.all.size()))
    throw InputError(fmt::format("there is no material {}", material));
  if (!setup_.domain.contains(position))
    throw InputError(
        fmt::format("a grain at ({:.4g}, {:.4g}, {:.4g}) m is outside the domain", position.x, position.y, position.z));
  const double mass = setup_.materials.all[material].density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  const GrainId id = state_.next_id++;
  state_.grains.add(id, position, velocity, spin, radius, mass, static_cast<std::uint8_t>(material));
  state_.new_grains.push_back(id);
  note_change();
  return id;
}

int Simulation::add_body(Body body) {
  check(body, static_cast<int>(setup_.materials.all.size()));
  accounted([&] { state_.bodies.push_back(std::move(body)); });
  note_change();
  return static_cast<int>(state_.bodies.size()) - 1;
}

void Simulation::check_step() const {
  const Numerics& n = setup_.numerics;
  if (state_.grains.count() == 0 || n.force_step) return;
  const double rayleigh = rayleigh_time(setup_.materials, state_.grains);
  if (n.dt > n.safe_share * rayleigh)
    throw InputError(
        fmt::format("a time step of {:.3g} s is {:.3g} of the Rayleigh time, {:.3g} s; {:.3g} is safe"
                    "\n  hint: at most {:.3g} s, or force_step",
                    n.dt, n.dt / rayleigh, rayleigh, n.safe_share, n.safe_share * rayleigh));
}

void Simulation::fill_constants() {
  const int kinds = static_cast<int>(setup_.materials.all.size());
  const double largest = state_.grains.largest_radius();
  constants_.assign(static_cast<std::size_t>(kinds) * kinds * row_of_constants, 0.0);
  for (int a = 0; a < kinds; ++a)
    for (int b = 0; b < kinds; ++b) {
      const LawConstants<double> c = law_constants(setup_.materials, setup_.laws, a, b, largest);
      static_assert(sizeof(c) == law_constant_count * sizeof(double) && law_constant_count <= row_of_constants);
      std::memcpy(&constants_[static_cast<std::size_t>(a * kinds + b) * row_of_constants], &c, sizeof(c));
    }
}

void Simulation::prepare() {
  fill_constants();
  const double largest = state_.grains.largest_radius();
  const int kinds = static_cast<int>(setup_.materials.all.size());
  reach_ = setup_.numerics.skin > 0 ? setup_.numerics.skin : 0.1 * largest;
  adhesion_reach_ = 0;
  if (setup_.laws.cohesion == CohesionLaw::jkr)
    for (int kind = 0; kind < kinds * kinds; ++kind)
      adhesion_reach_ = std::max(adhesion_reach_, adhesion_reach(constants_of(kind), largest));
  give_grids(largest + reach_ + adhesion_reach_);
  check_step();
}

/// Each mesh has an index that finds all triangles a grain can touch before the next search.
void Simulation::give_grids(double reach) {
  if (reach <= 0) return;  // there are no grains
  for (Body& body : state_.bodies)
    for (Surface& surface : body.surfaces)
      if (auto* mesh = std::get_if<MeshSurface>(&surface.shape); mesh && (!mesh->grid || mesh->grid->reach() < reach))
        mesh->grid = std::make_shared<TriangleGrid>(*mesh->mesh, reach);
}

void Simulation::note_change() {
  state_.travel = std::numeric_limits<double>::infinity();
  wake_all();
}

/// Brings in what was added or changed since the last step.
void Simulation::settle_changes() {
  if (state_.travel < std::numeric_limits<double>::infinity()) return;
  accounted([&] {
    prepare();
    search();
    half_step_back();
  });
}

void Simulation::run(std::int64_t steps) {
  settle_changes();
  for (std::int64_t k = 0; k < steps; ++k) step();
}

void Simulation::step() {
  if (search_is_due()) search();
  choose_sleepers();
  const int slabs = static_cast<int>(state_.slab_rows.size()) - 1;
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
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(dynamic)
    for (int slab = 0; slab < slabs; slab += 2) pair_stage(slab);
#pragma omp for schedule(dynamic)
    for (int slab = 1; slab < slabs; slab += 2) pair_stage(slab);
#pragma omp for schedule(dynamic)
    for (int slab = 0; slab < slabs; ++slab) {
      if (!asleep_[slab] || searched_now_) surface_stage(slab);
      if (asleep_[slab])
        drop_loads(slab);
      else
        motion_stage(slab);
    }
  }
  finish_step();
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

int Simulation::kind_of(int a, int b) const { return a * static_cast<int>(setup_.materials.all.size()) + b; }

const LawConstants<double>& Simulation::constants_of(int kind) const {
  return *reinterpret_cast<const LawConstants<double>*>(&constants_[static_cast<std::size_t>(kind) * row_of_constants]);
}

void Simulation::stop_for_loss(std::size_t row) const {
  const Vec3& at = state_.grains.motion[row].position;
  throw RunStopped(
      fmt::format("grain {} left the domain at ({:.4g}, {:.4g}, {:.4g}) m, time {:.6g} s"
                  "\n  hint: close the bin, or remove grains that leave it",
                  state_.grains.id[row], at.x, at.y, at.z, state_.time));
}

void Simulation::stop_for_motion() const {
  for (std::size_t k = 0; k < state_.grains.count(); ++k)
    if (!(squared(state_.grains.motion[k].velocity) < 1e30))
      throw RunStopped(fmt::format("the motion of grain {} is not finite, time {:.6g} s\n  hint: shorten the time step",
                                   state_.grains.id[k], state_.time));
  throw RunStopped(fmt::format("the motion of a body is not finite, time {:.6g} s", state_.time));
}

void Simulation::stop_for_overlap() const {
  std::vector<double> radii(state_.next_id);  // by id
  for (std::size_t k = 0; k < state_.grains.count(); ++k) radii[state_.grains.id[k]] = state_.grains.motion[k].radius;
  for (const Contact& contact : contacts()) {
    double radius = radii[contact.first];
    if (contact.second >= 0) radius = std::min(radius, radii[contact.second]);
    if (contact.overlap < 0.99 * setup_.numerics.deepest_overlap * radius) continue;
    throw RunStopped(
        fmt::format("grain {} overlaps {} {} by {:.3g} of the smaller radius, more than {:.3g}, time {:.6g} s"
                    "\n  hint: a softer landing, stiffer grains, or a larger deepest_overlap",
                    contact.first, contact.second >= 0 ? "grain" : "body",
                    contact.second >= 0 ? contact.second : -1 - contact.second, contact.overlap / radius,
                    setup_.numerics.deepest_overlap, state_.time));
  }
  throw RunStopped(fmt::format("an overlap deeper than {:.3g} of a radius, time {:.6g} s",
                               setup_.numerics.deepest_overlap, state_.time));
}

}  // namespace soilbin::dem
