// What a run of grains is made of: the Setup, which stays as it is given, and the State, which changes and which a
// restart keeps.
//
//   Setup setup;
//   setup.materials.add({"sand", 2650, 1e7, 0.25}, {.restitution = 0.3, .sliding_friction = 0.5});  // kg/m^3, Pa
//   setup.numerics.dt = 1e-5;                                                                       // [s]
//   const Simulation simulation(setup);
//   number_of_grains(simulation.state()), simulation.state().time
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem/engine/clumps.hpp"
#include "dem/engine/domain.hpp"
#include "dem/engine/energy.hpp"
#include "dem/engine/materials.hpp"
#include "dem/engine/pair_list.hpp"
#include "dem/engine/surface_contacts.hpp"
#include "dem/surface/body.hpp"

namespace soilbin::dem {

/// When grains are left out of the work because they rest. A slab of cells that has been calm for `time`, as have both
/// slabs beside it, stands still: its grains keep their places, and what its contacts remember stays, until a slab
/// beside it is no longer calm or gravity, grains, bodies or materials change. Calm is a slab whose grains' speeds have
/// a root mean square below `speed` while none is above `lone` times that: a single grain that rocks keeps nobody
/// awake, one that falls does. Slabs near a body that moves or may move never sleep. Slower creep than that is lost
/// (docs/lab/dem-performance.md has what this does to a wheel).
struct Sleep {
  static constexpr double lone = 10;
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
  /// 0: one a core, but no more than one for each 2000 grains, and fewer while other programs keep the cores busy
  /// (thread_pace.hpp). Give 1 inside a host with threads of its own. At most most_threads(). No number of them changes
  /// a bit.
  int threads = 0;
  std::string instruction_set;  ///< of instruction_sets(); empty: the widest
  bool ledger = false;          ///< counts where the energy goes; a step takes about twice as long
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
  std::vector<std::uint32_t> calm;   ///< of each slab: steps in a row in which it was calm (Sleep), as far as counted
  std::vector<BodyLoad> body_loads;  ///< of each slab on each body, slab by slab; those asleep go on pressing
  std::vector<Vec3> searched_at;     ///< positions at the last search for pairs
  double travel = 0;                 ///< bound on what any grain or body has moved since [m]; infinite: it is due
  std::uint32_t next_id = 0;
  std::vector<GrainId> new_grains;  ///< whose velocity is still at a whole step
  EnergyLosses ledger;
  Clumps clumps;
};

/// How many grains there are; one of several spheres is one.
inline std::size_t number_of_grains(const State& state) {
  return state.grains.count() - state.clumps.members.size() + state.clumps.all.size();
}

/// A run that can't go on: an overlap too deep, a grain lost or not finite. what() names the grain and the time. A
/// grain lost is noticed at a search, so it may be half the skin outside.
class RunStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An overlap deeper than Numerics::deepest_overlap. Who lets people choose that adds how to what() says.
class OverlapTooDeep : public RunStopped {
 public:
  using RunStopped::RunStopped;
};

}  // namespace soilbin::dem
