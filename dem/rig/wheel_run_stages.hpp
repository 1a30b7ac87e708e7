// The stages of a wheel's run on a bed, in whatever engine moves the grains: gravity turns, the wheel is put down,
// loaded, started, driven and measured; for later passes it is taken back first. What the rig does and gives:
// docs/theory/soil-bin.md.
//
//   WheelRunStages<StagedRun> ride(on, at, [&] { return staged_run(on, how, checkpoints, inputs); });
//   const WheelRun run = ride.run();
#pragma once

#include <fmt/core.h>

#include "dem/bed/grain_shape.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_result.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

/// The run's stages, from the first step to the last sample.
template <class Run>
class WheelRunStages {
 public:
  template <class Make>
  WheelRunStages(const WheelOnBed& on, const OperatingCondition& at, const Make& make)
      : bed_(on.bed),
        tire_(on.tire),
        at_(at),
        rig_(on.rig),
        motion_(wheel_motion(at, tire_.radius)),
        bin_(on, at, make) {
    bin_.run().keep("ride", *this);
    if (rig_.onlooker.keeper) bin_.run().keep("onlooker", *rig_.onlooker.keeper);
  }

  WheelRun run();

  /// For StagedRun::keep.
  template <class Notes>
  void state(Notes& notes) {
    notes(samples_, flow_, clear_, gone_, moving_);
  }

 private:
  void stages();
  void move(const std::function<Vec3()>& way, double speed);
  void take_back(int pass);
  void start();
  void let_turn();
  void drive();
  bool is_known() const;
  void end_sample();
  Rut rut_behind() const;
  FlowMeter flow_meter() const;
  std::int64_t some_steps(double time) const { return std::max<std::int64_t>(1, bin_.steps_of(time)); }
  /// Way after which the last sample is begun [m].
  double last_begin() const { return bin_.way() - motion_.speed * rig_.sampling; }
  Run& run_in_stages() { return bin_.run(); }
  Body& wheel() { return bin_.wheel(); }

  const SettledBed& bed_;
  const Tire& tire_;
  const OperatingCondition& at_;
  const Rig& rig_;
  WheelMotion motion_;
  WheelInBinOf<Run> bin_;
  std::vector<WheelSample> samples_;  ///< of this pass
  FlowMeter flow_ = flow_meter();
  double gone_ = 0;          ///< way of the axle in the pass before [m]
  double clear_ = 0;         ///< height of the axle at which the wheel touches nothing [m]
  std::int64_t moving_ = 0;  ///< steps of the move that it is in
};

/// Moves the wheel, held, by `way`.
template <class Run>
void WheelRunStages<Run>::move(const std::function<Vec3()>& way, double speed) {
  run_in_stages().once([&] {
    moving_ = some_steps(length(way()) / speed);
    wheel().velocity = 1 / (static_cast<double>(moving_) * bin_.simulation().setup().numerics.dt) * way();
  });
  run_in_stages().steps("going back", moving_, [&](std::int64_t) { bin_.step(); });
  run_in_stages().once([&] { wheel().velocity = {}; });
}

/// Lifts the wheel clear of all grains, takes it back to where it began and puts it over its rut. `pass`: that comes.
template <class Run>
void WheelRunStages<Run>::take_back(int pass) {
  constexpr double lifting = 1, returning = 5;  // [m/s]
  run_in_stages().once([&] {
    const Grains& grains = own_grains(bin_.simulation());
    double top = 0;
    for (std::size_t k = 0; k < grains.count(); ++k)
      top = std::max(top, grains.motion[k].position.z + grains.motion[k].radius);
    top = largest_of_all(bin_.simulation(), top);
    wheel().free_translation = {false, false, false};
    wheel().turning = Turning::prescribed;
    wheel().applied_force = wheel().applied_torque = wheel().spin = {};
    gone_ = bin_.travel();
    clear_ = std::max(top + tire_.radius + tire_.lugs.height + wheel_gap, wheel().position.z);
  });
  move([&] { return Vec3{0, 0, clear_ - wheel().position.z}; }, lifting);
  move([&] { return Vec3{-bin_.travel(), 0, 0}; }, returning);
  if (rig_.patch) run_in_stages().once([&] { bin_.go_back_over_rut(gone_, pass); });
  move([&] { return Vec3{0, 0, bin_.free_height() - wheel().position.z}; }, lifting);
  run_in_stages().once([&] { wheel().free_translation = {false, false, true}; });
}

template <class Run>
void WheelRunStages<Run>::start() {
  const std::int64_t steps = some_steps(rig_.starting);
  run_in_stages().steps("starting", steps, [&](std::int64_t k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(steps);
    wheel().velocity.x = share * motion_.speed;
    wheel().spin = share * motion_.rotation * motion_.axle;
    bin_.step();
  });
  run_in_stages().once([&] {
    if (rig_.drive_torque) let_turn();
    samples_.clear(), flow_ = flow_meter();
  });
}

template <class Run>
void WheelRunStages<Run>::let_turn() {
  wheel().turning = Turning::about_axis;
  wheel().applied_torque = *rig_.drive_torque * motion_.axle;
}

template <class Run>
FlowMeter WheelRunStages<Run>::flow_meter() const {
  const GranularSoil& soil = bed_.recipe.soil;
  const double depth = bed_.recipe.size.depth, rim = outer_radius(tire_);
  return FlowMeter(mean_diameter(soil), 2 * rim, rim + depth, 0, proportions_of(soil).solid);
}

/// Whether the pull is known to the error that a run without an end is to have; looked at now and then.
template <class Run>
bool WheelRunStages<Run>::is_known() const {
  constexpr std::size_t between_looks = 20;  // samples
  if (!rig_.patch || rig_.travel > 0 || samples_.empty() || samples_.size() % between_looks != 0) return false;
  return bin_.travel() >= shortest_way_on_patch * outer_radius(tire_) && pull_is_known(samples_, tire_, at_, rig_);
}

/// Samples until the bed ends, or until the pull is known; over the second half of the way also what the soil does
/// round the wheel.
template <class Run>
void WheelRunStages<Run>::drive() {
  run_in_stages().loop(
      "driving", [&] { return bin_.is_sampling() || (bin_.travel() < last_begin() && !is_known()); },
      [&] {
        if (!bin_.is_sampling()) bin_.begin_sample(some_steps(rig_.sampling));
        bin_.step();
        if (bin_.is_full()) end_sample();
      });
}

template <class Run>
void WheelRunStages<Run>::end_sample() {
  const double travel = bin_.sample().travel;
  WheelSample& out = samples_.emplace_back(bin_.end_sample());
  const auto& simulation = bin_.simulation();
  const std::vector<Contact> contacts = simulation.contacts();
  out.tread =
      tread_of_all(simulation, tread_forces(contacts, bin_.wheel_index(), wheel().position, motion_, stress_sectors));
  out.ledger = simulation.state().ledger;
  if (out.sinkage > tire_.radius)
    throw NoSolution(
        fmt::format("the wheel dug itself in to its axle after {:.3g} of {:.3g} m", out.travel, bin_.way()));
  if (travel > last_begin() / 2) add_to_flow(simulation, wheel().position, flow_);
}

/// Behind the wheel, from where it had gone half its way, or its radius if that is more, to where it lets go.
template <class Run>
Rut WheelRunStages<Run>::rut_behind() const {
  const double rim = outer_radius(tire_), x = bin_.wheel().position.x;
  double from = bin_.begin() + std::max((x - bin_.begin()) / 2, tire_.radius);
  if (bin_.has_left(from)) from = bin_.patch()->rear();
  const Track track{bed_.recipe.size.width / 2, tire_.width, from, x - rim, x};
  return rut_between(bin_.before(), bin_.surface_now(), track, bed_.recipe.soil.radius_max);
}

template <class Run>
void WheelRunStages<Run>::stages() {
  bin_.tilt();
  bin_.open_patch();
  bin_.put_wheel();
  for (int pass = 1; pass <= at_.pass; ++pass) {
    if (pass > 1) take_back(pass);
    bin_.lower({0, 0, motion_.load.z});
    start();
    drive();
  }
  if (samples_.empty()) throw InputError("the bed ends before the wheel is up to its speed\n  hint: a longer bed");
}

template <class Run>
WheelRun WheelRunStages<Run>::run() {
  const double way = bin_.way();
  const double before = rig_.lowering + rig_.resting + rig_.starting;
  const double driven = (way - motion_.speed * rig_.starting / 2) / motion_.speed;
  run_in_stages().plan(static_cast<double>(bin_.steps_of(bin_.tilting() + at_.pass * (before + driven))));
  run_in_stages().through([&] { stages(); });
  WheelRun run;
  run.samples = std::move(samples_);
  run.flow = flow_.flow();
  run.surface = bin_.surface();
  run.earlier = run_in_stages().earlier();
  run.bed = {bed_.report.void_ratio, bed_.report.bulk_density, bed_.report.coordination};
  run.rut = rut_behind();
  summarise(run, tire_, at_, rig_);
  if (bin_.patch()) run.patch = {bin_.patch()->grains(), bin_.patch()->disturbed(), bin_.patch()->thrown()};
  if (rig_.ledger && law::is_directional(bin_.simulation().setup().laws.rolling))
    run.power.losses.shear_damping = run.power.losses.sliding = std::nan("");  // EnergyLosses: trembling, not energy
  return run;
}

}  // namespace soilbin::dem
