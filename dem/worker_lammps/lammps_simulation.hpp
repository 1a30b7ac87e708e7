// The grains of a run in LAMMPS, over MPI, with the engine's own surfaces: what Simulation is for one process.
//
//   LammpsSimulation simulation(MPI_COMM_WORLD, setup, bed.state);   // the first process has the bed
//   simulation.run(1000);
//   const int wheel = simulation.add_body(body);                     // an index, as in the engine
//   simulation.body(wheel).velocity.x = 0.3;
//
// LAMMPS divides the bed among the processes, copies grains to those beside them, lists neighbours, moves the grains
// and writes restarts. Forces are the engine's: its law for pairs of grains, its contact search, memory and law for
// grains on surfaces, its bodies, called for the grains of this process (fix external); each process moves the bodies
// by the same sum over all. LAMMPS's velocity Verlet and the engine's leapfrog are one scheme: forces see places of the
// step and velocities of the half step before. So a run is the engine's but for the order of sums.
//
// LAMMPS's own granular laws are left out (docs/guide/past-one-machine.md): its sds rolling has one stiffness for all
// contacts, and turns its memory round where a pair changes the order in which it is stored.
//
// What contacts remember lies beside LAMMPS: where it sorts its grains anew, a grain that goes to another process takes
// it along.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dem/bed/bed_report.hpp"
#include "dem/engine/pair_touch.hpp"
#include "dem/engine/world.hpp"
#include "dem/rig/soil_flow.hpp"
#include "dem/worker_lammps/lammps.hpp"
#include "dem/worker_lammps/pair_memory.hpp"

namespace soilbin::dem {

/// A contact with a surface on its way to another process, or to a file.
struct LammpsTravelling {
  int id = 0;  ///< LAMMPS's, of its grain
  SurfaceContact contact{};
};

/// Grains that a simulation begins with. Each process keeps those in its part of the box: none ever holds them all.
struct PouredGrains {
  double largest = 0;                          ///< of their radii [m]
  std::function<void(const GrainSink&)> pour;  ///< gives them all to what it is called with, on each process the same
};

class LammpsSimulation {
 public:
  /// Goes on with the engine's state: grains and what contacts remember are those that the first process of `world`
  /// has, bodies each one's own. Throws InputError for jkr, held grains, periodic sides, a second material of grains,
  /// and where some grains alone were added since the last step. `log`: file that gets LAMMPS's own words of the last
  /// thousand steps, so that what ends the process is found there.
  LammpsSimulation(MPI_Comm world, Setup setup, const State& begin, std::string log = "");
  /// Begins with new grains at rest, on bodies.
  LammpsSimulation(MPI_Comm world, Setup setup, const Vec3& gravity, const std::vector<Body>& bodies,
                   const PouredGrains& grains, std::string log = "");
  /// Goes on from what write_grains and notes() kept, on any number of processes, with another setup too. `bodies`: all
  /// there may have been, whose surfaces are taken. Velocities go through the disk at whole steps and LAMMPS computes
  /// the forces of the last step anew, so the bits are others than without the stop.
  LammpsSimulation(MPI_Comm world, Setup setup, std::string log, const std::string& grains, const std::string& notes,
                   std::vector<Body> bodies);
  LammpsSimulation(const LammpsSimulation&) = delete;
  LammpsSimulation& operator=(const LammpsSimulation&) = delete;

  const Setup& setup() const { return setup_; }
  /// Time, step, gravity and bodies; grains stay in LAMMPS.
  const State& state() const { return state_; }
  double time() const { return state_.time; }
  MPI_Comm world() const { return world_; }

  void set_gravity(const Vec3& gravity) { state_.gravity = gravity; }
  /// Sets how the grains' material acts on another, from the next step on.
  void set_interaction(int a, int b, const Interaction& interaction);
  /// Takes away the grains of this process that `gone` holds for. All processes call it.
  void remove_grains(const std::function<bool(const Vec3& centre, double radius)>& gone);
  /// Throws InputError for a body that makes no sense. Bodies with planes must stay where they are.
  int add_body(Body body);
  Body& body(int index) { return state_.bodies.at(static_cast<std::size_t>(index)); }
  const Body& body(int index) const { return state_.bodies.at(static_cast<std::size_t>(index)); }

  /// Throws RunStopped, on all processes alike: a grain out of the domain, lost or not finite, an overlap too deep.
  void run(std::int64_t steps);

  /// Grains, as LAMMPS keeps them, in a file, and their contacts in files of that name and more; and all else, as a
  /// text. All processes call both.
  void write_grains(const std::string& file) const;
  std::string notes();

  /// Contacts of this process's grains with meshes, as of the last step.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// The grains that this process holds, now.
  Grains own_grains() const;
  /// Centre and radius of each, and of the copies of others' grains that lie next to them.
  void see_grains(const GrainSink& visit) const;
  /// This process's part of the bin: each place is in one.
  Region part() const;
  double grain_count() const { return static_cast<double>(all_grains_); }

  /// Contacts of grains with each other, over all processes.
  struct PairMeans {
    double contacts = 0;  ///< number
    double overlap = 0;   ///< mean [m]
  };
  PairMeans pair_means() const;
  /// Each contact of a grain of this process with another grain, for that grain: its row in own_grains().
  void see_contacts(const std::function<void(std::size_t row)>& visit) const;
  /// Where the grains are and how they move, kept in LAMMPS from now on; and what adds up to their unrest since, over
  /// all processes.
  void watch();
  UnrestSums end_watch(double time);
  /// Memory of LAMMPS's arrays and of contacts of pairs, over all processes, a grain [byte].
  double memory_a_grain() const;

 private:
  template <class Notes>
  void keep_in(Notes& notes);
  LammpsSimulation(MPI_Comm world, Setup setup, std::string log);
  void know_grains();
  void get_ready(Body& body) const;
  std::vector<LammpsTravelling> all_contacts() const;
  static void on_forces(void* self, std::int64_t step, int rows, int* ids, double** x, double** force);
  void add_forces(std::int64_t step, int rows, const int* ids, double** x, double** force);
  void write_commands() const;
  void make_box() const;
  void put_in(std::span<const NewGrain> part) const;
  void take_contacts(const State& begin);
  void take_pairs(const std::vector<PairContact>& contacts);
  void note_who_is_here();
  bool is_here(int id) const { return here_[static_cast<std::size_t>(id)]; }
  void read_pairs(const std::string& grains);
  double weigh(int rows, double** x, double** force);
  void follow_grains(int rows, const int* ids);
  void take_over(std::vector<LammpsTravelling>& mine, int rows, const int* ids);
  void find_near(int rows);
  void follow_pairs(const std::vector<bool>& were_here);
  void kick(int rows, double** force) const;
  void add_pair_forces(int rows, double** force, bool keeps);
  Load press_pair(int i, const GrainMotion& first, int j, const Vec3& between, bool keeps, Load& load);
  void add_surface_forces(double** force, bool keeps);
  void press(const GrainOnSurface& on, std::size_t first, std::span<const SurfaceTouch> touches, double* force);
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
  Lammps::Rows now_{};  ///< of this step
  Placed placed_;
  double largest_ = 0;    ///< radius of any grain [m]
  double margin_ = 0;     ///< of the search for surfaces [m]
  std::vector<int> ids_;  ///< LAMMPS's, of the rows at the last step: the engine's plus 1
  std::vector<NearSurface> near_;
  std::vector<SurfaceContact> made_, making_;
  PairMemory pairs_;
  std::vector<bool> here_;  ///< by LAMMPS's id: whether the grain is this process's, at the last listing
  std::vector<LammpsTravelling> arriving_;  ///< of what the run begins with or goes on from
  std::vector<Region> writers_;             ///< parts of the processes that wrote the files that it goes on from
  std::vector<Body> before_;                ///< bodies as the last forces saw them
  std::vector<BodyLoad> loads_;             ///< of this process's grains on each body
  std::vector<Contact> contacts_;
  double travel_ = 0;       ///< bound on what a grain and a body came nearer since the last search [m]
  double body_speed_ = 0;   ///< of the fastest point of any body [m/s]
  std::int64_t done_ = -1;  ///< the last step whose forces were computed
  std::int64_t all_grains_ = 0;
  std::int64_t next_id_ = 0;                 ///< all are less
  double pressing_ = 0, contacts_made_ = 0;  ///< sizes of the forces of this process's contacts [N], and their number
  bool prepared_ = false;
  bool at_half_steps_ = false;  ///< velocities given to LAMMPS are those of the half step before
  std::string fault_;           ///< what this process found in this step
  std::string stopped_;         ///< why the run can't go on, the same on all
};

// What dem/rig/process_sums.hpp asks for.
inline Grains own_grains(const LammpsSimulation& simulation) { return simulation.own_grains(); }
void join_largest(const LammpsSimulation& simulation, std::span<double> numbers);
void join_sums(const LammpsSimulation& simulation, std::span<double> numbers);
void add_to_flow(const LammpsSimulation& simulation, const Vec3& axle, FlowMeter& flow);

}  // namespace soilbin::dem
