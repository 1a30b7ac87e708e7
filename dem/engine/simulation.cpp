#include "dem/engine/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <limits>
#include <unordered_map>

#include "dem/engine/rayleigh_time.hpp"
#include "dem/engine/step.hpp"
#include "dem/surface/mass_properties.hpp"
#include "dem/surface/positive.hpp"
#include "dem/surface/seams.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

constexpr double search_is_due_now = std::numeric_limits<double>::infinity();
constexpr std::size_t grains_a_thread = 2000;  // docs/lab/dem-performance.md, 'Threads and few grains'

void check(const Domain& domain) {
  const Vec3 side = domain.upper - domain.lower;
  if (!(side.x > 0 && side.y > 0 && side.z > 0))
    throw InputError("the domain has no volume: upper must be above lower");
}

void check(const Numerics& numerics) {
  const auto above_0 = [](double value, const char* field, const char* what) {
    if (!positive(value))
      throw InputError(fmt::format("{}: {} must be above 0 and finite, not {}", field, what, value));
  };
  const auto not_negative = [](double value, const char* field, const char* what) {
    if (!(value >= 0 && std::isfinite(value)))
      throw InputError(fmt::format("{}: {} must be 0 or more and finite, not {}", field, what, value));
  };
  above_0(numerics.dt, "dt", "the time step");
  not_negative(numerics.skin, "skin", "the margin of the search");
  above_0(numerics.deepest_overlap, "deepest_overlap", "the share of the smaller radius");
  above_0(numerics.safe_share, "safe_share", "the share of the Rayleigh time");
  not_negative(numerics.sleep.speed, "sleep.speed", "the speed");
  not_negative(numerics.sleep.time, "sleep.time", "the time");
  if (numerics.threads < 0 || numerics.threads > most_threads())
    throw InputError(fmt::format("threads: 0 .. {}, not {}", most_threads(), numerics.threads));
}

void check(const ContactLaws& laws) {
  if (laws.cohesion == CohesionLaw::jkr && laws.normal != NormalLaw::hertz)
    throw InputError(
        "jkr cohesion needs the normal law hertz"
        "\n  hint: linear cohesion goes with hooke");
  if (!std::isfinite(laws.tangential_damping))
    throw InputError(
        fmt::format("tangential_damping: a share of the normal damping, or negative for Mindlin's own, not {}",
                    laws.tangential_damping));
}

void check_bodies(const World& world) {
  for (const Body& body : world.state.bodies) check(body, static_cast<int>(world.setup.materials.all.size()));
}

void check_step(const Setup& setup, const Grains& grains) {
  const Numerics& n = setup.numerics;
  if (grains.count() == 0 || n.force_step) return;
  const double rayleigh = rayleigh_time(setup.materials, grains);
  if (n.dt > n.safe_share * rayleigh)
    throw InputError(
        fmt::format("a time step of {:.3g} s is {:.3g} of the Rayleigh time, {:.3g} s; {:.3g} is safe"
                    "\n  hint: at most {:.3g} s, or force_step",
                    n.dt, n.dt / rayleigh, rayleigh, n.safe_share, n.safe_share * rayleigh));
}

std::string outside(const Vec3& at) {
  return fmt::format("a grain at ({:.4g}, {:.4g}, {:.4g}) m is outside the domain", at.x, at.y, at.z);
}

/// Each mesh has an index that finds all triangles a grain can touch before the next search.
void give_grids(std::vector<Body>& bodies, double reach) {
  if (reach <= 0) return;  // there are no grains
  for (Body& body : bodies)
    for (Surface& surface : body.surfaces)
      if (auto* mesh = std::get_if<MeshSurface>(&surface.shape); mesh && (!mesh->grid || mesh->grid->reach() < reach))
        mesh->grid = std::make_shared<TriangleGrid>(*mesh->mesh, reach);
}

/// OpenMP's threads stay with the process that began them: in a child made by fork() a parallel part would wait for
/// them without end. There one thread does the work; no number of them changes a bit.
class ThreadsOfThisProcess {
 public:
  int at_most(int threads) {
    if (threads > 1 && !begun_.exchange(true)) pthread_atfork(nullptr, nullptr, [] { left_behind_ = true; });
    return left_behind_ ? 1 : threads;
  }

 private:
  std::atomic<bool> begun_ = false;
  inline static std::atomic<bool> left_behind_ = false;
};
ThreadsOfThisProcess threads_of_this_process;

/// Threads that wait for each other cost more than they save where each has few grains.
int threads_for(const Numerics& numerics, std::size_t grains) {
  if (numerics.threads > 0) return numerics.threads;
  return static_cast<int>(std::clamp<std::size_t>(grains / grains_a_thread, 1, omp_get_num_procs()));
}

/// Seconds from some start on: of the clock, and of all threads of the process together.
struct Clocks {
  double wall, processor;
};

Clocks clocks_now() {
  const auto seconds = [](clockid_t of) {
    timespec now{};
    clock_gettime(of, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  return {seconds(CLOCK_MONOTONIC), seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

/// What follows from the setup, once the grains are there.
void prepare(World& world) {
  fit_to_largest_grain(world);
  world.threads = threads_of_this_process.at_most(threads_for(world.setup.numerics, world.state.grains.count()));
  give_grids(world.state.bodies, world.state.grains.largest_radius() + world.margins.both());
  check_step(world.setup, world.state.grains);
}

/// The next step searches and wakes all.
void note_change(State& state) {
  state.travel = search_is_due_now;
  wake_all(state);
}

/// Velocities of the grains that are new, or of the others, become those of `time` later [s].
void shift(World& world, bool new_ones, double time) {
  State& s = world.state;
  const std::vector<Load> loads = loads_of(world);
  const std::vector<Kick> kicks = kicks_of(world, loads, time);
  for (Clump& clump : s.clumps.all) {
    if (is_new(world, s.clumps.row_of(clump)) != new_ones || s.clumps.held(clump, s.grains)) continue;
    const Acceleration change = acceleration(clump, load_of(s.clumps, clump, loads), s.gravity);
    clump.motion.velocity += time * change.velocity;
    clump.motion.spin += time * change.spin;
  }
  for (std::size_t k = 0; k < kicks.size(); ++k) {
    if (is_new(world, k) != new_ones) continue;
    s.grains.motion[k].velocity += kicks[k].velocity;
    s.grains.spin[k].rate += kicks[k].spin;
  }
}

std::vector<Kick> half_step_kicks(const World& world) {
  return kicks_of(world, loads_of(world), world.setup.numerics.dt / 2);
}

/// Velocities of new grains are those of a whole step; all others live at half steps.
void half_step_back(World& world) {
  if (world.state.new_grains.empty()) return;
  shift(world, true, -world.setup.numerics.dt / 2);
  world.state.new_grains.clear();
}

/// It stays where it is from now on.
void hold(Grains& grains, std::size_t row) {
  grains.motion[row].velocity = grains.spin[row].rate = {};
  grains.motion[row].inverse_mass = grains.spin[row].inverse_inertia = 0;
}

/// Brings in what was added or changed since the last step.
void settle_changes(World& world) {
  check_bodies(world);  // anybody may have changed them
  world.threads = threads_of_this_process.at_most(world.threads);
  if (world.state.travel < search_is_due_now) return;
  with_energy_counted(world, [&] {
    prepare(world);
    search(world);
    half_step_back(world);
  });
}

}  // namespace

void LawTable::fill(const Materials& materials, const ContactLaws& laws, double largest_radius) {
  materials_ = static_cast<int>(materials.all.size());
  rows_.clear();
  for (int a = 0; a < materials_; ++a)
    for (int b = 0; b < materials_; ++b) rows_.push_back({law_constants(materials, laws, a, b, largest_radius)});
}

int most_threads() {
  constexpr int enough = 256;  // beyond the cores more of them only wait, and the system has no room for very many
  return std::max(enough, omp_get_num_procs());
}

Simulation::Simulation(Setup setup) {
  world_.setup = std::move(setup);
  if (world_.setup.materials.all.empty()) throw InputError("a simulation needs a material");
  check(world_.setup.domain);
  check(world_.setup.laws);
  set_numerics(world_.setup.numerics);
}

Simulation::Simulation(Setup setup, State state) : Simulation(std::move(setup)) {
  world_.state = std::move(state);
  if (world_.state.slab_rows.empty()) return;
  prepare(world_);
  make_room(world_);
}

void Simulation::set_numerics(const Numerics& numerics) {
  check(numerics);
  Numerics& ours = world_.setup.numerics;
  if (world_.state.step > 0 && numerics.dt != ours.dt) shift(world_, false, (ours.dt - numerics.dt) / 2);
  ours = numerics;
  const std::string_view set =
      numerics.instruction_set.empty() ? instruction_sets().front() : std::string_view(numerics.instruction_set);
  world_.kernels = kernels_for(set);
  note_change(world_.state);
}

void Simulation::set_interaction(int a, int b, const Interaction& interaction) {
  with_energy_counted(world_, [&] {
    Setup& setup = world_.setup;
    setup.materials.set(a, b, interaction);
    if (!world_.state.slab_rows.empty())
      world_.laws.fill(setup.materials, setup.laws, world_.state.grains.largest_radius());
  });
  note_change(world_.state);
}

void Simulation::set_gravity(const Vec3& gravity) {
  with_energy_counted(world_, [&] { world_.state.gravity = gravity; });
  wake_all(world_.state);
}

GrainId Simulation::add_grain(const Vec3& position, double radius, int material, const Vec3& velocity,
                              const Vec3& spin) {
  State& state = world_.state;
  const Materials& materials = world_.setup.materials;
  if (!positive(radius)) throw InputError("a grain's radius must be above 0");
  if (material < 0 || material >= static_cast<int>(materials.all.size()))
    throw InputError(fmt::format("there is no material {}", material));
  if (!world_.setup.domain.contains(position)) throw InputError(outside(position));
  const double mass = sphere_mass(materials.all[material].density, radius);
  const GrainId id = state.next_id++;
  state.grains.add({id, radius, mass, static_cast<std::uint8_t>(material), position, velocity, spin});
  state.new_grains.push_back(id);
  note_change(state);
  return id;
}

GrainId Simulation::add_clump(const ClumpShape& shape, const ClumpMotion& motion, int material) {
  State& s = world_.state;
  const Materials& materials = world_.setup.materials;
  if (material < 0 || material >= static_cast<int>(materials.all.size()))
    throw InputError(fmt::format("there is no material {}", material));
  for (const Sphere& sphere : shape.spheres) {
    const Vec3 at = motion.position + motion.rotation(sphere.centre);
    if (!world_.setup.domain.contains(at)) throw InputError(outside(at));
  }
  const double density = materials.all[static_cast<std::size_t>(material)].density;
  const auto number = static_cast<std::uint32_t>(s.clumps.all.size());
  const GrainId first = s.next_id;
  s.clumps.all.push_back({.mass = density * shape.volume,
                          .inertia = density * shape.inertia,
                          .motion = motion,
                          .first = static_cast<std::uint32_t>(s.clumps.members.size()),
                          .count = static_cast<std::uint32_t>(shape.spheres.size())});
  const Clump& clump = s.clumps.all.back();
  for (const Sphere& sphere : shape.spheres) {
    const Vec3 arm = motion.rotation(sphere.centre);
    s.clumps.members.push_back({s.next_id, sphere.centre, static_cast<std::uint32_t>(s.grains.count())});
    s.new_grains.push_back(s.next_id);
    s.grains.add({.id = s.next_id++,
                  .radius = sphere.radius,
                  .mass = clump.mass,
                  .material = static_cast<std::uint8_t>(material),
                  .position = motion.position + arm,
                  .velocity = motion.velocity + cross(motion.spin, arm),
                  .spin = motion.spin,
                  .clump = number,
                  .inertia = mean_inertia(clump)});
  }
  note_change(s);
  return first;
}

int Simulation::add_body(Body body) {
  State& state = world_.state;
  check(body, static_cast<int>(world_.setup.materials.all.size()));
  check_seams(body);
  with_energy_counted(world_, [&] { state.bodies.push_back(std::move(body)); });
  note_change(state);
  return static_cast<int>(state.bodies.size()) - 1;
}

void Simulation::move_body(int index, const Vec3& position, const Rotation& rotation) {
  State& s = world_.state;
  Body& body = s.bodies.at(index);
  Body moved = body;
  moved.position = position, moved.rotation = rotation;
  check(moved, static_cast<int>(world_.setup.materials.all.size()));
  wake_all(s);
  with_energy_counted(world_, [&] {
    if (s.travel == search_is_due_now) {
      body = std::move(moved);
      return;
    }
    const Rotation turn = rotation * body.rotation.inverse();
    const double chord = 2 * length(Vec3{turn.x, turn.y, turn.z});  // that a point at distance 1 moves along
    const double reach = world_.extents.reach(index, position, world_.margins.motion);
    const double jump = length(position - body.position) + chord * reach;
    body = std::move(moved);
    body.travel += jump;
    s.travel += jump;
    if (search_is_due(world_)) search(world_);
  });
}

std::size_t Simulation::remove_grains(const std::function<bool(const GrainNow&)>& gone) {
  settle_changes(world_);
  std::vector<std::uint8_t> marked;
  for (const GrainNow& grain : grains()) marked.push_back(gone(grain));
  world_.state.clumps.join(marked);
  const auto count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
  if (count == 0) return 0;
  wake_all(world_.state);
  with_energy_counted(world_, [&] { search(world_, marked); });
  return count;
}

std::size_t Simulation::hold_grains(const std::function<bool(const GrainNow&)>& which) {
  settle_changes(world_);
  Grains& all = world_.state.grains;
  std::vector<std::uint8_t> marked;
  const std::vector<GrainNow> now = grains();
  for (std::size_t row = 0; row < now.size(); ++row) marked.push_back(!all.motion[row].held() && which(now[row]));
  world_.state.clumps.join(marked);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < now.size(); ++row)
    if (marked[row]) rows.push_back(row);
  if (rows.empty()) return 0;
  wake_all(world_.state);
  with_energy_counted(world_, [&] {
    for (const std::size_t row : rows) hold(all, row);
    search(world_);
  });
  return rows.size();
}

namespace {

/// Rows by id; throws where an id is not there.
class RowsById {
 public:
  explicit RowsById(const Grains& grains) {
    for (std::uint32_t row = 0; row < grains.count(); ++row) rows_.emplace(grains.id[row], row);
  }
  void add(GrainId id, std::uint32_t row) {
    if (!rows_.emplace(id, row).second) throw InputError(fmt::format("there is a grain {} already", id));
  }
  std::uint32_t operator[](GrainId id) const {
    const auto found = rows_.find(id);
    if (found == rows_.end()) throw InputError(fmt::format("there is no grain {}", id));
    return found->second;
  }

 private:
  std::unordered_map<GrainId, std::uint32_t> rows_;
};

/// Appends clumps whose spheres have rows.
void append(Clumps& to, const Clumps& clumps, const RowsById& rows) {
  const auto first = static_cast<std::uint32_t>(to.members.size());
  for (Clump clump : clumps.all) {
    clump.first += first;
    to.all.push_back(clump);
  }
  for (const ClumpMember& member : clumps.members) to.members.push_back({member.id, member.arm, rows[member.id]});
}

/// Appends contacts that have been made to a list that the next search takes them from.
void append_made(PairList& pairs, const std::vector<BroughtContact>& contacts, const RowsById& rows,
                 const Grains& grains) {
  std::size_t at = pairs.first.size();
  const std::size_t batches = pairs.batches() + (contacts.size() + batch_size - 1) / batch_size;
  pairs.first.resize(batches * batch_size, grains.idle_first());
  pairs.second.resize(batches * batch_size, grains.idle_second());
  pairs.kind.resize(batches * batch_size);
  pairs.memory.resize(batches * batch_size * memory_size);
  pairs.touching.resize(batches);
  for (const BroughtContact& contact : contacts) {
    pairs.first[at] = rows[contact.first], pairs.second[at] = rows[contact.second];
    pairs.touching[at / batch_size] |= static_cast<std::uint8_t>(1u << (at % batch_size));
    for (int what = 0; what < memory_size; ++what) pairs.remembered(at, what) = contact.memory[what];
    ++at;
  }
}

}  // namespace

void Simulation::exchange(const Exchange& what) {
  State& s = world_.state;
  settle_changes(world_);
  for (const NewGrain& grain : what.enters)
    if (!world_.setup.domain.contains(grain.position)) throw InputError(outside(grain.position));
  with_energy_counted(world_, [&] {
    Grains& all = s.grains;
    RowsById rows(all);
    std::vector<std::uint8_t> gone(all.count());
    const auto leaves = [&](std::size_t row, const Motion& at) { return what.leaves && what.leaves(all.id[row], at); };
    const auto stays = [&](std::size_t row, const Motion& at) {
      return !at.held() && what.stays && what.stays(all.id[row], at);
    };
    for (std::size_t row = 0; row < all.count(); ++row) {
      if (all.clump[row] != lone) continue;
      gone[row] = leaves(row, all.motion[row]);
      if (!gone[row] && stays(row, all.motion[row])) hold(all, row);
    }
    for (Clump& clump : s.clumps.all) {
      const std::uint32_t row = s.clumps.row_of(clump);
      Motion centre = all.motion[row];
      centre.position = clump.motion.position, centre.velocity = clump.motion.velocity;
      const bool goes = leaves(row, centre), held = !goes && stays(row, centre);
      if (held) clump.motion.velocity = clump.motion.spin = {};
      for (const ClumpMember& member : s.clumps.of(clump)) {
        gone[member.row] = goes;
        if (held) hold(all, member.row);
      }
    }
    for (const LetGo& let_go : what.let_go) {
      const std::uint32_t row = rows[let_go.grain];
      const double radius = all.motion[row].radius;
      all.motion[row].inverse_mass = 1 / let_go.mass;
      const bool free_clump = all.clump[row] != lone && let_go.mass < held_mass;
      all.spin[row].inverse_inertia =
          1 / (free_clump ? mean_inertia(s.clumps.all[all.clump[row]]) : 0.4 * let_go.mass * radius * radius);
    }
    const auto clumps_before = static_cast<std::uint32_t>(s.clumps.all.size());
    for (NewGrain grain : what.enters) {
      rows.add(grain.id, static_cast<std::uint32_t>(all.count()));
      if (grain.clump != lone) grain.clump += clumps_before;
      all.add(grain);
      s.next_id = std::max(s.next_id, grain.id + 1);
    }
    append(s.clumps, what.clumps, rows);
    gone.resize(all.count());
    append_made(s.pairs, what.contacts, rows, all);
    if (s.surfaces.empty()) s.surfaces.resize(1);
    for (const BroughtOnSurface& brought : what.on_surfaces) {
      s.surfaces.front().made.push_back(brought.contact);
      s.surfaces.front().made.back().who.grain = rows[brought.grain];
    }
    wake_all(s);
    prepare(world_);
    search(world_, gone);
  });
}

void Simulation::run(std::int64_t steps) {
  settle_changes(world_);
  if (world_.setup.numerics.threads == 0 && world_.threads > 1)
    run_at_the_best_pace(steps);
  else
    for (std::int64_t k = 0; k < steps; ++k) step(world_);
}

void Simulation::run_at_the_best_pace(std::int64_t steps) {
  const int most = threads_for(world_.setup.numerics, world_.state.grains.count());
  if (pace_.most() != most) pace_ = ThreadPace(most);
  Clocks before = clocks_now();
  for (std::int64_t k = 0; k < steps; ++k) {
    world_.threads = pace_.threads();
    step(world_);
    const Clocks now = clocks_now();
    pace_.count_step(now.wall - before.wall, now.processor - before.processor);
    before = now;
  }
  world_.threads = most;
}

GrainNow Simulation::grain(GrainId id) const {
  const std::vector<GrainId>& ids = world_.state.grains.id;
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end()) throw std::out_of_range("there is no grain " + std::to_string(id));
  const std::size_t row = found - ids.begin();
  return motion_at(world_, row, is_new(world_, row) ? Kick{} : half_step_kicks(world_)[row]);
}

std::vector<GrainNow> Simulation::grains() const {
  const std::vector<Kick> kicks = half_step_kicks(world_);
  std::vector<GrainNow> out;
  for (std::size_t row = 0; row < kicks.size(); ++row) out.push_back(motion_at(world_, row, kicks[row]));
  return out;
}

}  // namespace soilbin::dem
