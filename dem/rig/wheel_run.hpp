// A wheel driven over a settled bed at a given slip or torque: lowered gently, set going, and measured until the bed
// ends. What the rig does and gives: docs/theory/soil-bin.md.
//
//   const WheelRun run = run_wheel({bed, tire, grains.grain_tire}, {.load = 8000, .slip = 0.2});  // [N], [-]
//   run.result.drawbar_pull.value, run.steady  // mean over the steady part [N]; whether there is one
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dem/archive/checkpoints.hpp"
#include "dem/bed/settled_bed.hpp"
#include "dem/rig/tread_stress.hpp"
#include "dem/rig/wheel_motion.hpp"
#include "dem/rig/wheel_outcome.hpp"
#include "dem/surface/shapes.hpp"
#include "scenario/operating_condition.hpp"
#include "scenario/tire.hpp"
#include "scenario/traction_result.hpp"

namespace soilbin::dem {

/// What an onlooker has seen so far, as bytes: to be found again where a run goes on.
struct OnlookerKeeper {
  std::function<std::string()> seen;
  std::function<void(const std::string&)> remember;

  /// For StagedRun::keep.
  template <class Notes>
  void state(Notes& notes) {
    std::string bytes = Notes::reads ? "" : seen();
    notes(bytes);
    if constexpr (Notes::reads) remember(bytes);
  }
};

/// Sees the grains and the wheel each time the axle has gone on by `every`, and at the start; changes nothing.
struct Onlooker {
  double every = 0.02;  ///< [m]
  std::function<void(const Simulation& simulation, int wheel, double surface)> look;
  std::shared_ptr<OnlookerKeeper> keeper;  ///< absent: a run that is gone on with is seen from there on
};

inline constexpr int stress_sectors = 180;      ///< of the rim
inline constexpr double tire_young = 1e9;       ///< of the tire, which is rigid beside the sand [Pa]
inline constexpr double tire_poisson = 0.3;     ///< of the tire
inline constexpr double most_steady_drift = 3;  ///< SteadyPart::drift of a steady run
inline constexpr double sleep_time = 0.8;       ///< in sqrt(d/g), d the mean diameter of the grains

/// How the wheel is held, driven and read (rig_settings.hpp lists the members).
struct Rig {
  double mass = 0;        ///< that heaves with the wheel [kg]; 0: the load's, a dead weight
  double tilting = 0.3;   ///< time in which gravity turns, where the bed is inclined [s]
  double lowering = 0.5;  ///< time in which the load comes on, evenly [s]
  double resting = 0.2;   ///< time under the whole load before the start [s]
  double starting = 0.2;  ///< time in which speed and rotation come on, evenly [s]
  double behind = 0.35;   ///< of the axle to the rear end of the bin, at the start [m]
  double ahead = 0.5;     ///< of the axle to the front end, when the run ends [m]
  double travel = 0;      ///< of the axle [m]; 0: as far as the bin lets it
  /// Only the soil from `behind` to `ahead` of the axle is simulated, and goes along with it (moving_patch.hpp); the
  /// bed is periodic.
  bool patch = false;
  /// On a patch without `travel` the wheel goes on until the run is steady and the standard error of its mean pull is
  /// this share of the load; longest_way_on_patch at most.
  double until_error = 0.01;
  double sampling = 0.01;  ///< a sample's time [s]; forces are means over all its steps
  double inertia = 0;      ///< about the axle, where the rotation is free [kg m^2]; 0: mass r^2/2
  TireMeshing meshing;
  double dt = 0;                 ///< [s]; 0: the bed's
  double skin = 0.25;            ///< margin of the search for pairs, in largest radii
  double deepest_overlap = 0.5;  ///< of the smaller radius; chains of grains under a wheel are pressed hard
  /// Slabs of grains far from the wheel sleep (Sleep) whose speeds had a root mean square below this share of sqrt(g d)
  /// for sleep_time, d the mean diameter; 0: none does. The paper's wheel on grains of 40 mm then pulls within
  /// its errors of what it pulls with all awake (docs/lab/dem-performance.md).
  double sleep_speed = 0.003;
  bool ledger = false;  ///< tells where the power goes; a step takes about twice as long
  /// A torque held instead of the rotation [N m]; the rotation is then free and starts at that of the condition's slip.
  /// 0 rolls freely.
  std::optional<double> drive_torque;
  Onlooker onlooker;  ///< for replays
};

/// A wheel, the bed that it runs on, and how it is held there. Bed and tire must outlive the run.
struct WheelOnBed {
  const SettledBed& bed;
  const Tire& tire;
  ContactPair contact;  ///< of tire and grains
  Rig rig{};
};

/// Means over the steps of one sampling time. Force and moment are the soil's on the wheel, in the frame of the bin.
struct WheelSample {
  double time = 0;       ///< at its end [s]
  double travel = 0;     ///< of the axle since the wheel was put down, at its end [m]
  Vec3 force, moment;    ///< moment about the wheel's centre [N], [N m]
  double sinkage = 0;    ///< [m]
  double speed = 0;      ///< along x [m/s]
  double heave = 0;      ///< velocity along z [m/s]
  double rotation = 0;   ///< about the axle [rad/s]
  double into_soil = 0;  ///< power that the wheel gives the grains [W]
  TreadForces tread;     ///< at its end
  EnergyLosses ledger;   ///< at its end, since the bed was poured; filled with Rig::ledger
};

/// What a moving patch held and did in a run.
struct PatchReport {
  double grains = 0;        ///< in it at once; 0: the bed stood still
  double disturbed = 0;     ///< how far the soil at the front had moved when it was let go, largest mean of a slab [m]
  std::int64_t thrown = 0;  ///< grains that were thrown over its front end
};

/// What a run tells.
struct WheelRun {
  TractionResult result;
  PowerBalance power;
  std::vector<WheelSample> samples;  ///< from the start of the motion on
  std::size_t steady_from = 0;       ///< first sample that counts
  bool steady = false;               ///< whether the stated test holds
  double drift = 0;                  ///< SteadyPart::drift of pull, torque and sinkage
  double surface = 0;                ///< height of the undisturbed surface [m]
  Vec3 moment;                       ///< mean, about the wheel's centre [N m]
  BedDensity bed{};
  PatchReport patch{};
  Rut rut;
  SoilFlow flow;
  double earlier = 0;  ///< on the clock on the wall, before the run was gone on with [s]
};

/// Runs it. The start-up is cut off at the latest end_of_start_up of pull,
/// torque and sinkage; the rest is steady where neither its halves differ,
/// nor a trend is in it, nor its last fifth differs, by more than most_steady_drift
/// standard errors (SteadyPart). For pass n > 1 the wheel first goes n - 1 times over
/// the same stretch at the same condition, each time lifted clear, taken back
/// and lowered onto its rut; the last pass is told, its sinkage from the
/// undisturbed surface. Throws InputError for a bed too short or narrow, RunStopped where a grain or the wheel is lost,
/// NoSolution where the wheel digs itself in to the axle, Stopped. On a moving patch a later pass goes over the rut
/// that the patch has kept (MovingPatch::back_over_its_rut), and ends with it at the latest. With a path in
/// `checkpoints` the run is kept now and then, at its end too, and goes on from there: with the same bits, where all
/// arguments but how and checkpoints are the same; InputError where they aren't.
WheelRun run_wheel(const WheelOnBed& on, const OperatingCondition& at, const WorkOptions& how = {},
                   const Checkpoints& checkpoints = {});

}  // namespace soilbin::dem
