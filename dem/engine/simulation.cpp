#include "dem/engine/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numbers>

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

int most_threads() {
  constexpr int enough = 256;  // beyond the cores more of them only wait, and the system has no room for very many
  return std::max(enough, omp_get_num_procs());
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
  if (numerics.threads < 0 || numerics.threads > most_threads())
    throw InputError(fmt::format("threads: 0 (one a core) .. {}, not {}", most_threads(), numerics.threads));
  if (state_.step > 0 && numerics.dt != setup_.numerics.dt) shift(false, (setup_.numerics.dt - numerics.dt) / 2);
  setup_.numerics = numerics;
  threads_ = numerics.threads > 0 ? numerics.threads : omp_get_num_procs();
  const std::string_view set =
      numerics.instruction_set.empty() ? instruction_sets().front() : std::string_view(numerics.instruction_set);
  kernel_ = pair_kernel(set);
  touch_kernel_ = touch_kernel(set);
  near_kernel_ = near_kernel(set);
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
  reach_ = setup_.numerics.skin > 0 ? setup_.numerics.skin : 0.2 * largest;
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
