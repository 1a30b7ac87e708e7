// A run of the grain engine: grains, bodies and the forces between them, step by step. The laws:
// docs/theory/dem-laws.md; a step's stages: step.hpp.
//
//   Simulation simulation(setup);  // materials, laws, domain, time step: state.hpp
//   simulation.set_gravity({0, 0, -9.81});
//   simulation.add_body(bin);
//   simulation.add_grain({0.1, 0.1, 0.3}, 0.01, 0);  // position and radius [m], material
//   simulation.run(1000);                            // steps of setup.numerics.dt
//   simulation.contacts(), simulation.energy()
#pragma once

#include <functional>

#include "dem/engine/evaluation.hpp"
#include "dem/engine/exchange.hpp"
#include "dem/engine/thread_pace.hpp"
#include "dem/engine/world.hpp"

namespace soilbin::dem {

class Simulation {
 public:
  /// Throws InputError for a setup that makes no sense.
  explicit Simulation(Setup setup);
  /// Goes on from a state, bit by bit as if it had never stopped.
  Simulation(Setup setup, State state);

  const Setup& setup() const { return world_.setup; }
  const State& state() const { return world_.state; }
  double time() const { return world_.state.time; }

  void set_gravity(const Vec3& gravity);
  /// Velocities are those at the present time. Throws InputError for a radius that isn't positive, an unknown material,
  /// or a place outside the domain.
  GrainId add_grain(const Vec3& position, double radius, int material, const Vec3& velocity = {},
                    const Vec3& spin = {});
  /// Adds the spheres of a clump; a velocity and spin are those at the present time. Gives the id of the first sphere,
  /// the others follow. Throws InputError for an unknown material, or where a sphere lies outside the domain.
  GrainId add_clump(const ClumpShape& shape, const ClumpMotion& motion, int material);
  /// Removes grains for which `gone` holds; gives how many. It is asked of each sphere, and a clump goes as a whole.
  /// Contacts of others keep their memory.
  std::size_t remove_grains(const std::function<bool(const GrainNow&)>& gone);
  /// Holds grains for which `which` holds, from now on: they stay where they are, without velocity or spin, and neither
  /// another grain that is held nor a surface presses on them. To a free grain they are of infinite mass. A
  /// clump of which one sphere is meant is held as a whole. Gives how many are newly held. For a rough base: settle a
  /// bed, hold a slice of it, remove the rest.
  std::size_t hold_grains(const std::function<bool(const GrainNow&)>& which);
  /// Lets grains leave, be held, be let go and come in between two steps, with one search for all of it. The ledger
  /// counts the energy that comes and goes. Throws InputError for an id that is taken or unknown, and for a place
  /// outside the domain.
  void exchange(const Exchange& what);
  /// Gives the body's index. Throws InputError for an unknown material or a mass or inertia that isn't positive.
  int add_body(Body body);
  /// To change between steps what drives a body and what it weighs: velocity, spin, servo, what is applied, which
  /// motions are free, mass, inertia, material; the next run() throws InputError where that makes no sense. Its
  /// surfaces stay those that were added, and its place changes through move_body: grains would not feel it at another
  /// one.
  Body& body(int index) { return world_.state.bodies.at(index); }
  const Body& body(int index) const { return world_.state.bodies.at(index); }
  /// Puts a body elsewhere at once; velocity and spin stay as they are. What it has left behind and what it meets feel
  /// that from the next step on, and all grains wake. One put deep into grains stops the run: move it there by its
  /// velocity. Throws InputError for a place that is not finite or a rotation that is not of length 1.
  void move_body(int index, const Vec3& position, const Rotation& rotation);
  void set_numerics(const Numerics& numerics);
  /// Changes the interaction of a pair of materials between steps: settle without friction, then switch it on.
  void set_interaction(int a, int b, const Interaction& interaction);

  /// Throws InputError for a body or a time step that makes no sense, and RunStopped; the state is then that after the
  /// step in which it failed, so it can be looked at.
  void run(std::int64_t steps);

  /// A grain at the present time, whole-step velocities included. By its id; throws std::out_of_range.
  GrainNow grain(GrainId id) const;
  /// All of them, row by row as in state().grains.
  std::vector<GrainNow> grains() const;
  /// All contacts at the present time, in a fixed order; forces as the next step will apply them.
  std::vector<Contact> contacts() const { return contacts_of(world_); }
  /// What is where: kinetic, potential, elastic, and what the ledger has counted. Grains added since the last run are
  /// not yet in it.
  EnergyBalance energy() const { return energy_of(world_); }
  /// How many threads there are for the next run() (Numerics::threads).
  int threads() const { return world_.threads; }
  /// How many of them run() uses: fewer where other programs keep the cores busy and nobody has asked for a number.
  int threads_in_use() const { return pace_.most() == world_.threads ? pace_.kept() : world_.threads; }
  /// Share of the grains that sleep.
  double share_asleep() const { return world_.sleeping.share(world_.state); }

 private:
  void run_at_the_best_pace(std::int64_t steps);

  World world_;
  ThreadPace pace_;
};

}  // namespace soilbin::dem
