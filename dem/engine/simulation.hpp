// Grains, bodies and what they do to each other, step by step. The laws: docs/dem-laws.md.
//
// A step (step.cpp) reads as its stages: search for pairs where due; slab by slab forces of pairs, forces of surfaces,
// motion of grains; motion of bodies. The same setup and state give the same bits for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem/engine/body.hpp"
#include "dem/engine/domain.hpp"
#include "dem/engine/energy.hpp"
#include "dem/engine/kernels/pair_kernel.hpp"
#include "dem/engine/materials.hpp"
#include "dem/engine/pair_list.hpp"
#include "dem/engine/surface_contacts.hpp"

namespace soilbin::dem {

/// When grains are left out of the work because they rest. A slab of cells whose grains, and those of both slabs beside
/// it, have all been slower than `speed` for `time` stands still: its grains keep their places, and what its contacts
/// remember stays, until a grain beside it is faster again or gravity, grains, bodies or materials change. Slabs near a
/// body that moves or may move never sleep. So no grain is held that was faster than `speed`, but creep slower than
/// that is lost (docs/dem-performance.md has what this does to a wheel).
struct Sleep {
  double speed = 0;    ///< [m/s]; 0: no grain ever sleeps
  double time = 0.05;  ///< [s]
};

/// How it is computed. Results depend on skin and instruction set by rounding alone.
struct Numerics {
  double dt = 1e-5;              ///< [s]
  double skin = 0;               ///< margin of the search for pairs [m]; 0: a fifth of the largest radius
  double deepest_overlap = 0.3;  ///< of the smaller radius; deeper stops the run
  double safe_share = 0.2;       ///< of the Rayleigh time; a longer step is refused
  bool force_step = false;       ///< takes a longer one all the same
  int threads = 0;               ///< 0: one a core; at most most_threads()
  std::string instruction_set;   ///< of instruction_sets(); empty: the widest
  bool ledger = false;           ///< counts where the energy goes; a step takes about twice as long
  Sleep sleep;
};

/// 256, or the machine's cores where there are more.
int most_threads();

/// What doesn't change during a run.
struct Setup {
  Materials materials;
  ContactLaws laws;
  Domain domain;
  Numerics numerics;
};

/// All that changes; what an archive keeps.
struct State {
  std::int64_t step = 0;
  double time = 0;  ///< of positions [s]
  Vec3 gravity;     ///< [m/s^2]
  Grains grains;
  std::vector<Body> bodies;
  PairList pairs;
  std::vector<std::uint32_t> slab_rows;   ///< first row of each slab, and the end
  std::vector<SurfaceContacts> surfaces;  ///< a slab each
  std::vector<std::uint32_t> calm;   ///< of each slab: steps in a row in which no grain was fast, as far as counted
  std::vector<BodyLoad> body_loads;  ///< of each slab on each body, slab by slab; those asleep go on pressing
  std::vector<Vec3> searched_at;     ///< positions at the last search for pairs
  double travel = 0;                 ///< bound on what any grain or body has moved since [m]; infinite: it is due
  std::uint32_t next_id = 0;
  std::vector<GrainId> new_grains;  ///< whose velocity is still at a whole step
  Ledger ledger;
};

/// A run that can't go on: an overlap too deep, a grain lost or not finite. what() names the grain and the time. A
/// grain lost is noticed at a search, so it may be half the skin outside.
class RunStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A contact as it is now.
struct Contact {
  GrainId first;
  std::int64_t second;    ///< id of a grain; or -1 - index of a body
  std::int32_t triangle;  ///< of the body's mesh, -1 for none
  Vec3 point, normal;     ///< normal toward `first`
  double overlap;         ///< [m]
  Vec3 force, couple;     ///< on `first` [N], [N m]
  double pressing;        ///< F_N [N]
};

/// Motion of a grain at a whole step.
struct GrainNow {
  Vec3 position, velocity, spin;
  double radius;
};

class Simulation {
 public:
  /// Throws InputError for a setup that makes no sense.
  explicit Simulation(Setup setup);
  /// Goes on from a state, bit by bit as if it had never stopped.
  Simulation(Setup setup, State state);

  const Setup& setup() const { return setup_; }
  const State& state() const { return state_; }
  double time() const { return state_.time; }

  void set_gravity(const Vec3& gravity);
  /// Velocities are those at the present time. Throws InputError for a radius that isn't positive, an unknown material,
  /// or a place outside the domain.
  GrainId add_grain(const Vec3& position, double radius, int material, const Vec3& velocity = {},
                    const Vec3& spin = {});
  /// Removes grains for which `gone` holds; gives how many. Contacts of others keep their memory.
  std::size_t remove_grains(const std::function<bool(const GrainNow&)>& gone);
  /// Holds grains for which `which` holds, from now on: they stay where they are, without velocity or spin, and neither
  /// another grain that is held nor a surface presses on them. To a free grain they are of infinite mass. Gives how
  /// many are newly held. For a rough base: settle a bed, hold a slice of it, remove the rest.
  std::size_t hold_grains(const std::function<bool(const GrainNow&)>& which);
  /// Gives the body's index. Throws InputError for an unknown material or a mass or inertia that isn't positive.
  int add_body(Body body);
  /// To change what drives it between steps.
  Body& body(int index) { return state_.bodies.at(index); }
  const Body& body(int index) const { return state_.bodies.at(index); }
  void set_numerics(const Numerics& numerics);
  /// Changes the interaction of a pair of materials between steps: settle without friction, then switch it on.
  void set_interaction(int a, int b, const Interaction& interaction);

  /// Throws RunStopped; the state is then that after the step in which it failed, so it can be looked at.
  void run(std::int64_t steps);

  /// A grain at the present time, whole-step velocities included. By its id; throws std::out_of_range.
  GrainNow grain(GrainId id) const;
  /// All of them, row by row as in state().grains.
  std::vector<GrainNow> grains() const;
  /// All contacts at the present time, in a fixed order; forces as the next step will apply them.
  std::vector<Contact> contacts() const;
  /// What is where: kinetic, potential, elastic, and what the ledger has counted. Grains added since the last run are
  /// not yet in it.
  EnergyBalance energy() const;
  /// Share of the grains that sleep.
  double share_asleep() const;

 private:
  /// Contacts with surfaces on their way through the law, of one slab.
  struct TouchWork {
    int slab;
    TouchBatch batch;
    std::array<Vec3, batch_size> points;
    int count;
  };

  void check_step() const;
  void fill_constants();
  void prepare();
  void give_grids(double reach);
  void search(std::span<const std::uint8_t> gone = {});
  void make_room(int slabs);
  bool search_is_due();
  void note_change();
  /// Makes a change, and counts the energy that it brings in.
  void accounted(const std::function<void()>& change);
  void settle_changes();
  bool is_new(std::size_t row) const;
  GrainNow motion_at(std::size_t row, const Load& load) const;
  /// What a load and gravity change in a grain's motion within `time` [s].
  struct Kick {
    Vec3 velocity, spin;
  };
  Kick kick(std::size_t row, const Load& load, double time) const;
  void half_step_back();
  void shift(bool new_ones, double time);
  double broken_bonds() const;
  void step();
  void wake_all();
  std::uint32_t calm_enough() const;
  std::vector<std::uint32_t> calm_by_row(std::span<const std::uint32_t> order) const;
  bool may_sleep(int slab) const;
  bool is_driven(int slab) const;
  void choose_sleepers();
  void stop_grains(int slab);
  void drop_loads(int slab);
  void count_calm();
  void cut_blocks();
  void inner_stage(int block);
  void seam_stage(int block);
  void finish_slab(int slab);
  void pair_stage(int slab);
  void surface_stage(int slab);
  void touch_surfaces(TouchWork& work, std::span<SurfaceContact> made);
  void motion_stage(int slab);
  void count_kick(int slab, std::uint32_t row);
  void finish_step();
  int kind_of(int material, int other) const;
  const LawConstants<double>& constants_of(int kind) const;
  /// Forces as the next step will find them, contact by contact.
  template <class Visit>
  void for_each_contact(const Visit& visit) const;
  std::vector<Load> loads() const;
  std::size_t row_of(GrainId id) const;
  [[noreturn]] void stop_for_overlap() const;
  [[noreturn]] void stop_for_loss(std::size_t row) const;
  [[noreturn]] void stop_for_motion() const;

  Setup setup_;
  State state_;
  // Derived from the setup and the state.
  AlignedVector<double> constants_;
  PairKernel kernel_ = nullptr;
  TouchKernel touch_kernel_ = nullptr;
  NearKernel near_kernel_ = nullptr;
  Placed placed_;
  KeptContacts kept_;  ///< room for it
  PairSweep sweep_{};
  int threads_ = 1;
  double reach_ = 0;                        ///< margin of the search for motion [m]
  double adhesion_reach_ = 0;               ///< jkr: how far apart a contact still holds [m]
  std::vector<Taking> taking_;              ///< a row each of grains, where the ledger is kept; empty between steps
  std::vector<std::uint8_t> bonds_before_;  ///< pairs.touching before the step, where the ledger counts adhesion
  bool searched_now_ = false;               ///< in this step
  std::vector<std::uint8_t> near_;          ///< whether slab k has grains near body b, at k*bodies + b
  // Of a step, a slab each.
  std::vector<std::uint8_t> asleep_;
  std::vector<int> blocks_;  ///< first slab of each block, and the end
  std::vector<PairFindings> found_;
  std::vector<double> fastest_;
  std::vector<std::vector<SurfaceContact>> made_;
  std::vector<double> extents_;  ///< of bodies
  /// A ball round all grains at the last search, for the planes of bodies that turn.
  Vec3 middle_;
  double around_middle_ = 0;
};

}  // namespace soilbin::dem
