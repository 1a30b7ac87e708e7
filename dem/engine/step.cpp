#include "dem/engine/step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/engine/evaluation.hpp"

namespace soilbin::dem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Grains that fall asleep lose the little motion that they had.
void choose_sleepers(World& world) {
  if (!world.sleeping.choose(world.state, world.setup.numerics)) return;
  cut_blocks(world);
  with_energy_counted(world, [&] {
    State& s = world.state;
    for (int slab = 0; slab < world.slabs(); ++slab) {
      if (!world.sleeping[slab]) continue;
      for (std::uint32_t k = s.slab_rows[slab]; k < s.slab_rows[slab + 1]; ++k)
        s.grains.motion[k].velocity = s.grains.spin[k].rate = {};
      world.speeds[slab] = {};
    }
    still_sleeping_clumps(world);
  });
}

/// Where the kernels find what they work on, and where the surfaces are now.
void set_up_sweep(World& world) {
  State& s = world.state;
  const Setup& setup = world.setup;
  const Periods periods(setup.domain);
  world.sweep = {.motion = s.grains.motion.data(),
                 .spin = s.grains.spin.data(),
                 .load = s.grains.load.data(),
                 .ledger_loads = world.ledger.rows(),
                 .first = s.pairs.first.data(),
                 .second = s.pairs.second.data(),
                 .kind = s.pairs.kind.data(),
                 .memory = s.pairs.memory.data(),
                 .touching = s.pairs.touching.data(),
                 .constants = world.laws.rows(),
                 .kinds = world.laws.materials(),
                 .laws = setup.laws,
                 .dt = setup.numerics.dt,
                 .period = {periods.length.x, periods.length.y, periods.length.z},
                 .deepest = setup.numerics.deepest_overlap};
  world.ledger.begin_step(setup, s);
  world.placed.place(s.bodies);
}

/// Clears the loads that neighbours awake, and surfaces after a search, put on a sleeping slab.
void clear_sleeping_loads(World& world, int slab) {
  if (world.sleeping.next_sleeps(slab) && world.sleeping.previous_sleeps(slab) && !world.searched_now) return;
  const std::uint32_t first = world.state.slab_rows[slab], last = world.state.slab_rows[slab + 1];
  std::fill(world.state.grains.load.begin() + first, world.state.grains.load.begin() + last, Load{});
  world.ledger.clear(first, last);
}

/// A slab that no more pairs press on.
void finish_slab(World& world, int slab) {
  const bool asleep = world.sleeping[slab];
  if (!asleep || world.searched_now) surface_forces(world, slab);
  if (asleep)
    clear_sleeping_loads(world, slab);
  else
    move_grains(world, slab);
}

/// The slabs of a block one after the other, each moved as soon as nothing presses on it any more, so that its rows go
/// through the cache once. What touches a neighbouring block is left.
void move_inner_slabs(World& world, int block) {
  const int first = world.blocks[block], last = world.blocks[block + 1] - 1;
  for (int slab = first; slab < last; ++slab) {
    pair_forces(world, slab);
    if (slab > first) finish_slab(world, slab);
  }
}

/// The pairs of a block's last slab, with the next block's first one, and the motion of both. No two seams share a
/// slab.
void move_seam(World& world, int block) {
  const int last = world.blocks[block + 1] - 1, next = (last + 1) % world.blocks.back();
  pair_forces(world, last);
  finish_slab(world, last);
  if (next != last) finish_slab(world, next);
}

/// Forces of pairs, forces of surfaces and motion of grains, in blocks of slabs at once.
void work_on_slabs(World& world) {
  const int blocks = static_cast<int>(world.blocks.size()) - 1;
#pragma omp parallel num_threads(world.threads)
  {
#pragma omp for schedule(dynamic)
    for (int block = 0; block < blocks; ++block) move_inner_slabs(world, block);
#pragma omp for schedule(dynamic)
    for (int block = 0; block < blocks; ++block) move_seam(world, block);
  }
}

void load_bodies(State& s) {
  for (Body& body : s.bodies) body.force = body.torque = {};
  for (auto load = s.body_loads.begin(); load != s.body_loads.end();)
    for (Body& body : s.bodies) {
      body.force += load->force;
      body.torque += load++->torque;
    }
}

/// Gives a bound on the speed of their points [m/s]; infinite where one is not finite.
double move_bodies(World& world) {
  const double dt = world.setup.numerics.dt;
  const Extents& to = world.extents;
  double fastest = 0;
  for (std::size_t b = 0; b < world.state.bodies.size(); ++b) {
    Body& body = world.state.bodies[b];
    advance(body, world.state.gravity, dt);
    const double reach = to.reach(b, body.position, world.margins.motion);
    const double speed = length(body.velocity) + length(body.spin) * reach;
    body.travel += dt * speed;
    fastest = speed < 1e15 ? std::max(fastest, speed) : infinity;
  }
  return fastest;
}

[[noreturn]] void stop_for_motion(const State& s) {
  for (std::size_t k = 0; k < s.grains.count(); ++k)
    if (!(squared(s.grains.motion[k].velocity) < 1e30))
      throw RunStopped(fmt::format("the motion of grain {} is not finite, time {:.6g} s\n  hint: shorten the time step",
                                   s.grains.id[k], s.time));
  throw RunStopped(fmt::format("the motion of a body is not finite, time {:.6g} s", s.time));
}

[[noreturn]] void stop_for_overlap(const World& world) {
  const State& s = world.state;
  const double deepest = world.setup.numerics.deepest_overlap;
  std::vector<double> radii(s.next_id);  // by id
  for (std::size_t k = 0; k < s.grains.count(); ++k) radii[s.grains.id[k]] = s.grains.motion[k].radius;
  const std::vector<Contact> contacts = contacts_of(world);
  const auto share = [&](const Contact& contact) {
    const double radius =
        contact.second >= 0 ? std::min(radii[contact.first], radii[contact.second]) : radii[contact.first];
    return contact.overlap / radius;
  };
  const auto worst = std::ranges::max_element(contacts, {}, share);
  const std::string most = fmt::format("{:.3g}", deepest), hint =
                                                               "\n  hint: stiffer grains, less load or stress, less "
                                                               "cohesion, or a softer landing";
  if (worst == contacts.end() || share(*worst) < 0.99 * deepest)
    throw OverlapTooDeep(fmt::format("an overlap deeper than {} of a radius, time {:.6g} s{}", most, s.time, hint));
  const std::string overlap = fmt::format("{:.3g}", share(*worst));
  const bool of_grains = worst->second >= 0, shown = share(*worst) > deepest && overlap != most;
  throw OverlapTooDeep(
      fmt::format("grain {} overlaps {} {} by {} of the smaller radius{}, time {:.6g} s{}", worst->first,
                  of_grains ? "grain" : "body", of_grains ? worst->second : -1 - worst->second,
                  shown ? overlap : "more than " + most, shown ? ", more than " + most : "", s.time, hint));
}

}  // namespace

void step(World& world) {
  State& s = world.state;
  const double dt = world.setup.numerics.dt;
  if (search_is_due(world)) search(world);
  choose_sleepers(world);
  set_up_sweep(world);
  work_on_slabs(world);
  double fastest = move_clumps(world);
  load_bodies(s);
  world.ledger.end_step(world);
  world.sleeping.count_calm(s, world.setup.numerics, world.speeds);
  world.searched_now = false;
  fastest = std::max(fastest, move_bodies(world));
  for (const SlabSpeed& speed : world.speeds) fastest = std::max(fastest, speed.fastest);
  ++s.step;
  s.time += dt;
  s.travel += dt * fastest;
  const auto too_deep = [](const PairFindings& found) { return found.too_deep; };
  if (std::any_of(world.found.begin(), world.found.end(), too_deep)) stop_for_overlap(world);
  if (!std::isfinite(fastest)) stop_for_motion(s);
}

/// Runs of slabs, at least two each and about as many that are awake in each. They depend on the state alone, so that
/// sums come in the same order for any number of threads.
void cut_blocks(World& world) {
  constexpr int most = 24;
  const int slabs = world.slabs();
  int awake = 0, found = 0;
  for (int slab = 0; slab < slabs; ++slab) awake += !world.sleeping[slab];
  const int share = std::max(2, (awake + most - 1) / most);
  world.blocks.assign(1, 0);
  for (int slab = 0; slab + 2 < slabs; ++slab) {
    found += !world.sleeping[slab];
    if (found < share || slab == world.blocks.back()) continue;
    world.blocks.push_back(slab + 1);
    found = 0;
  }
  world.blocks.push_back(slabs);
}

void pair_forces(World& world, int slab) {
  world.found[slab] = {};
  if (world.sleeping[slab] && world.sleeping.next_sleeps(slab)) return;
  const std::vector<std::uint32_t>& begin = world.state.pairs.slab_begin;
  world.kernels.pairs(world.sweep, begin[slab], begin[slab + 1], world.found[slab]);
}

void move_grains(World& world, int slab) {
  State& s = world.state;
  Motion* motion = s.grains.motion.data();
  Spin* spins = s.grains.spin.data();
  Load* loads = s.grains.load.data();
  const double dt = world.setup.numerics.dt;
  const bool counted = world.setup.numerics.ledger, clumps = !s.clumps.all.empty();
  double fastest = 0, sum = 0;
  bool finite = true;
  for (std::uint32_t k = s.slab_rows[slab]; k < s.slab_rows[slab + 1]; ++k) {
    Motion& grain = motion[k];
    Spin& spin = spins[k];
    Load& load = loads[k];
    if (clumps && s.grains.clump[k] != lone) {
      sum += squared(grain.velocity);  // of the step before: its clump moves when all slabs are done
      fastest = std::max(fastest, squared(grain.velocity));
      continue;
    }
    if (counted) world.ledger.count_kick(k, load, kick_of(world, k, load, dt / 2), world.found[slab].lost);
    const double share = dt * grain.inverse_mass;
    grain.velocity += share * load.force + (grain.held() ? 0.0 : dt) * s.gravity;
    grain.position += dt * grain.velocity;
    spin.rate += (dt * spin.inverse_inertia) * load.torque;
    load = {};
    const double speed2 = squared(grain.velocity);
    fastest = std::max(fastest, speed2);
    sum += speed2;
    finite &= speed2 < 1e30;
  }
  const std::uint32_t count = s.slab_rows[slab + 1] - s.slab_rows[slab];
  world.speeds[slab] = {finite ? std::sqrt(fastest) : infinity, count > 0 ? std::sqrt(sum / count) : 0.0};
}

}  // namespace soilbin::dem
