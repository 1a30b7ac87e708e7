#include "dem/rig/wheel_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dem/rig/run_inputs.hpp"
#include "dem/rig/rut.hpp"
#include "dem/rig/soil_flow.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_result.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// The run's stages, from the first step to the last sample.
class Ride {
 public:
  Ride(const WheelOnBed& on, const OperatingCondition& at, const WorkOptions& how, const Checkpoints& checkpoints)
      : bed_(on.bed),
        tire_(on.tire),
        at_(at),
        rig_(on.rig),
        motion_(wheel_motion(at, tire_.radius)),
        bin_(on, at, how, checkpoints, inputs_text(bed_.recipe, tire_, on.contact, rig_, at)) {
    bin_.run().keep("ride", *this);
    if (rig_.onlooker.keeper) bin_.run().keep("onlooker", *rig_.onlooker.keeper);
  }

  WheelRun run();

  /// For StagedRun::keep.
  template <class Notes>
  void state(Notes& notes) {
    notes(samples_, flow_, clear_, moving_);
  }

 private:
  void stages();
  void move(const std::function<Vec3()>& way, double speed);
  void take_back();
  void start();
  void let_turn();
  void drive();
  void end_sample();
  Rut rut_behind() const;
  FlowMeter flow_meter() const;
  std::int64_t some_steps(double time) const { return std::max<std::int64_t>(1, bin_.steps_of(time)); }
  /// Way after which the last sample is begun [m].
  double last_begin() const { return bin_.way() - motion_.speed * rig_.sampling; }
  StagedRun& run_in_stages() { return bin_.run(); }
  Body& wheel() { return bin_.wheel(); }

  const SettledBed& bed_;
  const Tire& tire_;
  const OperatingCondition& at_;
  const Rig& rig_;
  WheelMotion motion_;
  WheelInBin bin_;
  std::vector<WheelSample> samples_;  ///< of this pass
  FlowMeter flow_ = flow_meter();
  double clear_ = 0;         ///< height of the axle at which the wheel touches nothing [m]
  std::int64_t moving_ = 0;  ///< steps of the move that it is in
};

/// Moves the wheel, held, by `way`.
void Ride::move(const std::function<Vec3()>& way, double speed) {
  run_in_stages().once([&] {
    moving_ = some_steps(length(way()) / speed);
    wheel().velocity = 1 / (static_cast<double>(moving_) * bin_.simulation().setup().numerics.dt) * way();
  });
  run_in_stages().steps("going back", moving_, [&](std::int64_t) { bin_.step(); });
  run_in_stages().once([&] { wheel().velocity = {}; });
}

/// Lifts the wheel clear of all grains, takes it back to where it began and puts it over its rut.
void Ride::take_back() {
  constexpr double lifting = 1, returning = 5;  // [m/s]
  run_in_stages().once([&] {
    const Grains& grains = bin_.simulation().state().grains;
    double top = 0;
    for (std::size_t k = 0; k < grains.count(); ++k)
      top = std::max(top, grains.motion[k].position.z + grains.motion[k].radius);
    wheel().free_translation = {false, false, false};
    wheel().turning = Turning::prescribed;
    wheel().applied_force = wheel().applied_torque = wheel().spin = {};
    clear_ = std::max(top + tire_.radius + tire_.lugs.height + wheel_gap, wheel().position.z);
  });
  move([&] { return Vec3{0, 0, clear_ - wheel().position.z}; }, lifting);
  move([&] { return Vec3{-bin_.travel(), 0, 0}; }, returning);
  move([&] { return Vec3{0, 0, bin_.free_height() - wheel().position.z}; }, lifting);
  run_in_stages().once([&] { wheel().free_translation = {false, false, true}; });
}

void Ride::start() {
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

void Ride::let_turn() {
  wheel().turning = Turning::about_axis;
  wheel().applied_torque = *rig_.drive_torque * motion_.axle;
}

FlowMeter Ride::flow_meter() const {
  const GranularSoil& soil = bed_.recipe.soil;
  const double depth = bed_.recipe.size.depth, rim = tire_.radius + tire_.lugs.height;
  return FlowMeter(mean_diameter(soil), 2 * rim, rim + depth, 0);
}

/// Samples until the bed ends; over the second half of the way also what the soil does round the wheel.
void Ride::drive() {
  run_in_stages().loop(
      "driving", [&] { return bin_.is_sampling() || bin_.travel() < last_begin(); },
      [&] {
        if (!bin_.is_sampling()) bin_.begin_sample(some_steps(rig_.sampling));
        bin_.step();
        if (bin_.is_full()) end_sample();
      });
}

void Ride::end_sample() {
  const double travel = bin_.sample().travel;
  WheelSample& out = samples_.emplace_back(bin_.end_sample());
  const Simulation& simulation = bin_.simulation();
  out.tread = tread_forces(simulation.contacts(), bin_.wheel_index(), wheel().position, motion_, rig_.sectors);
  out.ledger = simulation.state().ledger;
  if (out.sinkage > tire_.radius)
    throw NoSolution(
        fmt::format("the wheel dug itself in to its axle after {:.3g} of {:.3g} m", out.travel, bin_.way()));
  if (travel > last_begin() / 2) flow_.add(simulation.state().grains, wheel().position);
}

/// Behind the wheel, from where it had gone half its way, or its radius if that is more, to where it lets go.
Rut Ride::rut_behind() const {
  const double rim = tire_.radius + tire_.lugs.height, x = bin_.wheel().position.x;
  const double begun = std::max((x - bin_.begin()) / 2, tire_.radius);
  const Track track{bed_.recipe.size.width / 2, tire_.width, bin_.begin() + begun, x - rim, x};
  const GranularSoil& soil = bed_.recipe.soil;
  const SurfaceHeight after = bed_surface(bin_.simulation().state().grains, bed_.recipe.size, soil.radius_min);
  return rut_between(bin_.before(), after, track, soil.radius_max);
}

void Ride::stages() {
  bin_.tilt();
  bin_.put_wheel();
  for (int pass = 1; pass <= at_.pass; ++pass) {
    if (pass > 1) take_back();
    bin_.lower({0, 0, motion_.load.z});
    start();
    drive();
  }
  if (samples_.empty())
    throw InputError(
        "the bed ends before the wheel is up to its speed\n  "
        "hint: a longer bed");
}

WheelRun Ride::run() {
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
  if (rig_.ledger && law::is_directional(bin_.simulation().setup().laws.rolling))
    run.power.losses.shear_damping = run.power.losses.sliding = std::nan("");  // Ledger: trembling, not energy
  return run;
}

}  // namespace

WheelRun run_wheel(const WheelOnBed& on, const OperatingCondition& at, const WorkOptions& how,
                   const Checkpoints& checkpoints) {
  return Ride(on, at, how, checkpoints).run();
}

}  // namespace soilbin::dem
