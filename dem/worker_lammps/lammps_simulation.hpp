// The grains of a run in LAMMPS, over MPI, with the engine's own surfaces: what Simulation is for one process.
//
//   LammpsSimulation simulation(MPI_COMM_WORLD, setup, bed.state);   // the same on each process
//   simulation.run(1000);
//   const int wheel = simulation.add_body(body);                     // an index, as in the engine
//   simulation.body(wheel).velocity.x = 0.3;
//
// LAMMPS moves the grains and computes their forces on each other (pair_commands.hpp). Floor, walls and wheel are the
// engine's bodies: contact search, memory and law of grains on surfaces are the engine's functions, called for the
// grains of this process, and each process moves the bodies by the same sum over all. LAMMPS's velocity Verlet and the
// engine's leapfrog are the same scheme: forces see places of the step and velocities of the half step before.
//
// What contacts with surfaces remember lies beside LAMMPS: where LAMMPS sorts its grains anew, a grain that goes to
// another process takes it along. What grains remember of each other is LAMMPS's.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dem/engine/evaluation.hpp"
#include "dem/engine/world.hpp"
#include "dem/rig/soil_flow.hpp"
#include "dem/worker_lammps/lammps.hpp"

namespace soilbin::dem {

class Simulation;

/// A contact with a surface on its way to another process, or to a file.
struct LammpsTravelling {
  int id = 0;  ///< LAMMPS's, of its grain
  SurfaceContact contact{};
};

class LammpsSimulation {
 public:
  /// Begins with grains and bodies of the engine's state, the same on each process of `world`. Grains keep places,
  /// velocities and ids; what their contacts remember is not taken over, so a settled bed must rest anew. Throws
  /// InputError for laws that LAMMPS has not, for held grains, periodic sides and a second material of grains.
  /// `log`: file that gets LAMMPS's own words of the last thousand steps, so that what ends the process is found there.
  LammpsSimulation(MPI_Comm world, Setup setup, const State& begin, std::string log = "");
  /// Goes on from what write_grains and notes() kept, on any number of processes. `begin`: what the run began with;
  /// `added`: the bodies added since, whose surfaces are taken. Velocities go through the disk at whole steps and
  /// LAMMPS computes the forces of the last step anew, so the bits are others than without the stop.
  LammpsSimulation(MPI_Comm world, Setup setup, const State& begin, std::string log, const std::string& grains,
                   const std::string& notes, std::vector<Body> added);
  LammpsSimulation(const LammpsSimulation&) = delete;
  LammpsSimulation& operator=(const LammpsSimulation&) = delete;

  const Setup& setup() const { return setup_; }
  /// Time, step, gravity and bodies; grains stay in LAMMPS.
  const State& state() const { return state_; }
  double time() const { return state_.time; }
  MPI_Comm world() const { return world_; }

  void set_gravity(const Vec3& gravity) { state_.gravity = gravity; }
  /// Throws InputError for a body that makes no sense. Bodies with planes must stay where they are.
  int add_body(Body body);
  Body& body(int index) { return state_.bodies.at(static_cast<std::size_t>(index)); }
  const Body& body(int index) const { return state_.bodies.at(static_cast<std::size_t>(index)); }

  /// Throws RunStopped, on all processes alike: a grain out of the domain, lost or not finite, an overlap too deep.
  void run(std::int64_t steps);

  /// Grains and their contacts as LAMMPS keeps them, in a file; and all else, as a text. All processes call both.
  void write_grains(const std::string& file) const { lammps_.command("write_restart " + file); }
  std::string notes();

  /// Contacts of this process's grains with meshes, as of the last step.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Those that this process holds, now.
  const Grains& own_grains() const;
  double grain_count() const { return static_cast<double>(all_grains_); }

  /// Contacts of grains with each other, over all processes.
  struct PairMeans {
    double contacts = 0;  ///< number
    double overlap = 0;   ///< mean [m]
  };
  PairMeans pair_means() const;
  /// Mean energy of a grain's straight motion over its weight times `diameter` [m], as Unrest::kinetic.
  double kinetic(double diameter) const;
  /// Memory of LAMMPS's arrays, over all processes, a grain [byte].
  double memory_a_grain() const;

 private:
  template <class Notes>
  void keep_in(Notes& notes);
  LammpsSimulation(MPI_Comm world, Setup setup, std::string log, const State& begin);
  void get_ready(Body& body) const;
  std::vector<LammpsTravelling> gathered(const std::vector<LammpsTravelling>& mine) const;
  std::vector<LammpsTravelling> all_contacts() const;
  static void on_forces(void* self, std::int64_t step, int rows, int* ids, double** x, double** force);
  void add_forces(std::int64_t step, int rows, const int* ids, double** x, double** force);
  void write_commands(const State& begin) const;
  void put_in(const Simulation& begin) const;
  double weigh(int rows, double** x, double** force);
  void follow_grains(int rows, const int* ids);
  void take_over(std::vector<LammpsTravelling>& mine, int rows, const int* ids);
  void find_near(int rows);
  void add_pair_forces(int rows, double** x, double** force);
  void add_surface_forces(double** force, bool keeps);
  void press(const NearSurface& near, std::size_t first, int found, std::span<const SurfaceTouch, 8> touches,
             double* force, double* torque);
  void join_loads(int rows);
  void move_bodies();
  void name_lost_grain();
  Motion motion_of(int row) const;
  Spin spin_of(int row) const;
  void fail(const std::string& what);

  MPI_Comm world_;
  int rank_ = 0;
  Setup setup_;
  std::string log_;
  State state_;
  LawTable laws_;
  Lammps lammps_;
  Placed placed_;
  double largest_ = 0;    ///< radius of any grain [m]
  double margin_ = 0;     ///< of the search for surfaces [m]
  std::vector<int> ids_;  ///< LAMMPS's, of the rows at the last step: the engine's plus 1
  std::vector<NearSurface> near_;
  std::vector<SurfaceContact> made_, making_;
  std::vector<LammpsTravelling> arriving_;  ///< of the file that the run goes on from, each on every process
  std::vector<Body> before_;                ///< bodies as the last forces saw them
  std::vector<BodyLoad> loads_;             ///< of this process's grains on each body
  std::vector<Contact> contacts_;
  double travel_ = 0;       ///< bound on what a grain and a body came nearer since the last search [m]
  double body_speed_ = 0;   ///< of the fastest point of any body [m/s]
  std::int64_t done_ = -1;  ///< the last step whose forces were computed
  std::int64_t all_grains_ = 0;
  bool prepared_ = false;
  std::string fault_;    ///< what this process found in this step
  std::string stopped_;  ///< why the run can't go on, the same on all
  mutable Grains own_;
};

// What dem/rig/shares.hpp asks for.
inline const Grains& own_grains(const LammpsSimulation& simulation) { return simulation.own_grains(); }
void join_largest(const LammpsSimulation& simulation, std::span<double> numbers);
void join_sums(const LammpsSimulation& simulation, std::span<double> numbers);
void add_to_flow(const LammpsSimulation& simulation, const Vec3& axle, FlowMeter& flow);

}  // namespace soilbin::dem
