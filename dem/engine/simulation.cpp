#include "dem/engine/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "dem/engine/time_step.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

constexpr int row_of_constants = 16;

Vec3 vec3(const Triple<double>& a) { return {a.x, a.y, a.z}; }

void note_losses(const Losses<double>& losses, PairFindings& found) {
  const double all[] = {losses.damping, losses.shear_damping, losses.sliding, losses.into_slide, losses.into_roll};
  for (int k = 0; k < 5; ++k) found.losses[k] += all[k];
}

bool positive(double a) { return a > 0 && std::isfinite(a); }

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
  dirty_ = state_.slab_rows.empty();
  if (!dirty_) prepare();
}

void Simulation::set_numerics(const Numerics& numerics) {
  if (!positive(numerics.dt)) throw InputError("the time step must be above 0");
  if (numerics.skin < 0 || !positive(numerics.deepest_overlap))
    throw InputError("skin and deepest overlap can't be negative");
  setup_.numerics = numerics;
  threads_ = numerics.threads > 0 ? numerics.threads : omp_get_num_procs();
  kernel_ = pair_kernel(numerics.instruction_set.empty() ? instruction_sets().front() : numerics.instruction_set);
  dirty_ = true;
}

void Simulation::set_interaction(int a, int b, const Interaction& interaction) {
  setup_.materials.set(a, b, interaction);
  dirty_ = true;
}

GrainId Simulation::add_grain(const Vec3& position, double radius, int material, const Vec3& velocity,
                              const Vec3& spin) {
  if (!positive(radius)) throw InputError("a grain's radius must be above 0");
  if (material < 0 || material >= static_cast<int>(setup_.materials.all.size()))
    throw InputError(fmt::format("there is no material {}", material));
  const Vec3 &low = setup_.domain.lower, &high = setup_.domain.upper;
  if (!(position.x >= low.x && position.y >= low.y && position.z >= low.z && position.x <= high.x &&
        position.y <= high.y && position.z <= high.z))
    throw InputError(
        fmt::format("a grain at ({:.4g}, {:.4g}, {:.4g}) m is outside the domain", position.x, position.y, position.z));
  const double mass = setup_.materials.all[material].density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  const GrainId id = state_.next_id++;
  state_.grains.add(id, position, velocity, spin, radius, mass, static_cast<std::uint8_t>(material));
  state_.new_grains.push_back(id);
  dirty_ = true;
  return id;
}

int Simulation::add_body(Body body) {
  if (!positive(body.mass) || !positive(body.inertia.x) || !positive(body.inertia.y) || !positive(body.inertia.z))
    throw InputError(fmt::format("body {}: mass and inertia must be above 0", body.name));
  for (const Surface& surface : body.surfaces)
    if (surface.material < 0 || surface.material >= static_cast<int>(setup_.materials.all.size()))
      throw InputError(fmt::format("body {}: there is no material {}", body.name, surface.material));
  state_.bodies.push_back(std::move(body));
  dirty_ = true;
  return static_cast<int>(state_.bodies.size()) - 1;
}

std::size_t Simulation::remove_grains(const std::function<bool(const GrainNow&)>& gone) {
  std::vector<std::uint8_t> marked(state_.grains.count());
  for (std::size_t k = 0; k < marked.size(); ++k) {
    const Motion& grain = state_.grains.motion[k];
    marked[k] = gone({grain.position, grain.velocity, state_.grains.spin[k].rate, grain.radius});
  }
  const auto count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
  if (count > 0) {
    if (dirty_) prepare();
    search(marked);
  }
  return count;
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

void Simulation::prepare() {
  const int kinds = static_cast<int>(setup_.materials.all.size());
  double largest = 0;
  for (std::size_t k = 0; k < state_.grains.count(); ++k) largest = std::max(largest, state_.grains.motion[k].radius);
  constants_.assign(static_cast<std::size_t>(kinds) * kinds * row_of_constants, 0.0);
  for (int a = 0; a < kinds; ++a)
    for (int b = 0; b < kinds; ++b) {
      const LawConstants<double> c = law_constants(setup_.materials, setup_.laws, a, b, largest);
      static_assert(sizeof(c) == law_constant_count * sizeof(double) && law_constant_count <= row_of_constants);
      std::memcpy(&constants_[static_cast<std::size_t>(a * kinds + b) * row_of_constants], &c, sizeof(c));
    }
  reach_ = setup_.numerics.skin > 0 ? setup_.numerics.skin : 0.1 * largest;
  adhesion_reach_ = 0;
  if (setup_.laws.cohesion == CohesionLaw::jkr)
    for (int kind = 0; kind < kinds * kinds; ++kind)
      adhesion_reach_ =
          std::max(adhesion_reach_, adhesion_reach(constants_between(kind / kinds, kind % kinds), largest));
  give_grids(largest + reach_ + adhesion_reach_);
  check_step();
  dirty_ = false;
}

/// Each mesh has an index that finds all triangles a grain can touch before the next search.
void Simulation::give_grids(double reach) {
  for (Body& body : state_.bodies)
    for (Surface& surface : body.surfaces)
      if (auto* mesh = std::get_if<MeshSurface>(&surface.shape); mesh && (!mesh->grid || mesh->grid->reach() < reach))
        mesh->grid = std::make_shared<TriangleGrid>(*mesh->mesh, reach);
}

void Simulation::run(std::int64_t steps) {
  if (dirty_) {
    prepare();
    search();
    half_step_back();
  }
  for (std::int64_t k = 0; k < steps; ++k) step();
}

void Simulation::step() {
  if (search_is_due()) search();
  const int slabs = static_cast<int>(state_.slab_rows.size()) - 1;
  State& s = state_;
  sweep_ = {s.grains.motion.data(),
            s.grains.spin.data(),
            s.grains.load.data(),
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
            setup_.numerics.deepest_overlap,
            setup_.numerics.ledger};
  const Periods periods(setup_.domain);
  sweep_.period[0] = periods.length.x;
  sweep_.period[1] = periods.length.y;
  sweep_.period[2] = periods.length.z;
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(dynamic)
    for (int slab = 0; slab < slabs; slab += 2) pair_stage(slab);
#pragma omp for schedule(dynamic)
    for (int slab = 1; slab < slabs; slab += 2) pair_stage(slab);
#pragma omp for schedule(dynamic)
    for (int slab = 0; slab < slabs; ++slab) {
      surface_stage(slab);
      motion_stage(slab);
    }
  }
  finish_step();
}

void Simulation::pair_stage(int slab) {
  found_[slab] = {};
  kernel_(sweep_, state_.pairs.slab_begin[slab], state_.pairs.slab_begin[slab + 1], found_[slab]);
}

void Simulation::surface_stage(int slab) {
  State& s = state_;
  SurfaceContacts& here = s.surfaces[slab];
  std::vector<SurfaceContact>& made = made_[slab];
  made.clear();
  BodyLoad* loads = &body_loads_[slab * s.bodies.size()];
  std::fill(loads, loads + s.bodies.size(), BodyLoad{});
  std::size_t old = 0;
  for (const NearSurface& near : here.near) {
    const std::size_t old_begin = old;
    while (old < here.made.size() && here.made[old].who == near) ++old;
    touch_surface(slab, near, {here.made.data() + old_begin, old - old_begin}, made, loads[near.body]);
  }
  here.made.swap(made);
}

void Simulation::touch_surface(int slab, const NearSurface& near, std::span<const SurfaceContact> before,
                               std::vector<SurfaceContact>& made, BodyLoad& on_body) {
  State& s = state_;
  const Body& body = s.bodies[near.body];
  const Surface& surface = body.surfaces[near.surface];
  const Motion& grain = s.grains.motion[near.grain];
  const LawConstants<double>& constants = constants_between(s.grains.material[near.grain], surface.material);
  std::array<SurfaceTouch, 8> touches;
  const std::size_t begin = made.size();
  const int count = find_contacts(body, near, grain, {setup_.laws, constants, adhesion_reach_}, before, made, touches);
  for (int k = 0; k < count; ++k) {
    const Touch<double> touch = touch_of(body, touches[k], grain, s.grains.spin[near.grain]);
    if (touch.overlap > setup_.numerics.deepest_overlap * grain.radius) found_[slab].too_deep = true;
    Losses<double> losses;
    const Response<double> does = contact_response(setup_.laws, constants, touch, made[begin + k].memory,
                                                   setup_.numerics.dt, setup_.numerics.ledger ? &losses : nullptr);
    if (setup_.numerics.ledger) note_losses(losses, found_[slab]);
    const Vec3 force = vec3(does.force), couple = vec3(does.couple);
    Load& load = s.grains.load[near.grain];
    load.force += force;
    load.torque += couple - (grain.radius - touch.overlap / 2) * cross(touches[k].normal, force);
    on_body.force -= force;
    on_body.torque -= couple + cross(touches[k].point - body.position, force);
  }
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
    const double share = dt * grain.inverse_mass;
    grain.velocity += share * load.force + (grain.inverse_mass > 0 ? dt : 0.0) * s.gravity;
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
      s.bodies[b].force += body_loads_[slab * s.bodies.size() + b].force;
      s.bodies[b].torque += body_loads_[slab * s.bodies.size() + b].torque;
    }
    if (setup_.numerics.ledger) s.ledger.add(found_[slab].losses, dt);
  }
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    Body& body = s.bodies[b];
    advance(body, s.gravity, dt);
    const double speed = length(body.velocity) + length(body.spin) * extents_[b];
    body.travel += dt * speed;
    fastest = std::max(fastest, speed);
  }
  ++s.step;
  s.time = static_cast<double>(s.step) * dt;
  s.travel += dt * fastest;
  if (too_deep) stop_for_overlap();
  if (!std::isfinite(fastest)) stop_for_motion();
}

const LawConstants<double>& Simulation::constants_between(int a, int b) const {
  const std::size_t kind = a * setup_.materials.all.size() + b;
  return *reinterpret_cast<const LawConstants<double>*>(&constants_[kind * row_of_constants]);
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
  for (const Contact& contact : contacts()) {
    double radius = grain(contact.first).radius;
    if (contact.second >= 0) radius = std::min(radius, grain(static_cast<GrainId>(contact.second)).radius);
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
