#include "dem/rig/wheel_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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
  Ride(const SettledBed& bed, const Tire& tire, const ContactPair& tire_contact, const OperatingCondition& at,
       const Rig& rig, const WorkOptions& how)
      : bed_(bed),
        tire_(tire),
        at_(at),
        rig_(rig),
        motion_(wheel_motion(at, tire.radius)),
        bin_(bed, tire, tire_contact, at, rig, how) {}

  WheelRun run();

 private:
  void move(const Vec3& way, double speed);
  void take_back();
  void start();
  void drive(WheelRun& run);
  Rut rut_behind() const;
  WheelSample sample();
  Body& wheel() { return bin_.wheel(); }

  const SettledBed& bed_;
  const Tire& tire_;
  const OperatingCondition& at_;
  const Rig& rig_;
  WheelMotion motion_;
  WheelInBin bin_;
};

/// Moves the wheel, held, by `way`.
void Ride::move(const Vec3& way, double speed) {
  const std::int64_t steps = std::max<std::int64_t>(1, bin_.steps_of(length(way) / speed));
  wheel().velocity = 1 / (static_cast<double>(steps) * bin_.simulation().setup().numerics.dt) * way;
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k % 100 == 0) bin_.tell("going back");
    bin_.step();
  }
  wheel().velocity = {};
}

/// Lifts the wheel clear of all grains, takes it back to where it began and puts it over its rut.
void Ride::take_back() {
  constexpr double lifting = 1, returning = 5;  // [m/s]
  const Grains& grains = bin_.simulation().state().grains;
  double top = 0;
  for (std::size_t k = 0; k < grains.count(); ++k)
    top = std::max(top, grains.motion[k].position.z + grains.motion[k].radius);
  wheel().free_translation = {false, false, false};
  wheel().turning = Turning::prescribed;
  wheel().applied_force = wheel().applied_torque = wheel().spin = {};
  const double clear = std::max(top + tire_.radius + tire_.lugs.height + wheel_gap, wheel().position.z);
  move({0, 0, clear - wheel().position.z}, lifting);
  move({-bin_.travel(), 0, 0}, returning);
  move({0, 0, bin_.free_height() - wheel().position.z}, lifting);
  wheel().free_translation = {false, false, true};
}

void Ride::start() {
  const std::int64_t steps = std::max<std::int64_t>(1, bin_.steps_of(rig_.starting));
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k % 100 == 0) bin_.tell("starting");
    const double share = static_cast<double>(k + 1) / static_cast<double>(steps);
    wheel().velocity.x = share * motion_.speed;
    wheel().spin = share * motion_.rotation * motion_.axle;
    bin_.step();
  }
  if (!rig_.drive_torque) return;
  wheel().turning = Turning::about_axis;
  wheel().applied_torque = *rig_.drive_torque * motion_.axle;
}

WheelSample Ride::sample() {
  WheelSample out = bin_.sample(std::max<std::int64_t>(1, bin_.steps_of(rig_.sampling)), [&] {
    bin_.step();
    return true;
  });
  const Simulation& simulation = bin_.simulation();
  out.tread = tread_forces(simulation.contacts(), bin_.wheel_index(), wheel().position, motion_, rig_.sectors);
  out.ledger = simulation.state().ledger;
  if (out.sinkage > tire_.radius)
    throw NoSolution(
        fmt::format("the wheel dug itself in to its axle after {:.3g} of {:.3g} m", out.travel, bin_.way()));
  return out;
}

/// Samples until the bed ends; over the second half of the way also what the soil does round the wheel.
void Ride::drive(WheelRun& run) {
  const GranularSoil& soil = bed_.recipe.soil;
  const double depth = bed_.recipe.size.depth, rim = tire_.radius + tire_.lugs.height;
  FlowMeter meter(soil.radius_min + soil.radius_max, 2 * rim, rim + depth, 0);
  const double until = bin_.way() - motion_.speed * rig_.sampling;
  for (double travel = bin_.travel(); travel < until; travel = bin_.travel()) {
    bin_.tell("driving");
    bin_.show();
    run.samples.push_back(sample());
    if (travel > until / 2) meter.add(bin_.simulation().state().grains, wheel().position);
  }
  run.flow = meter.flow();
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

WheelRun Ride::run() {
  bin_.check_room();
  const double before = rig_.lowering + rig_.resting + rig_.starting;
  const double driven = (bin_.way() - motion_.speed * rig_.starting / 2) / motion_.speed;
  bin_.plan(static_cast<double>(bin_.steps_of(bin_.tilting() + at_.pass * (before + driven))));
  bin_.tilt();
  bin_.put_wheel();
  WheelRun run;
  for (int pass = 1; pass <= at_.pass; ++pass) {
    if (pass > 1) take_back();
    bin_.lower({0, 0, motion_.load.z});
    start();
    run = {};
    drive(run);
  }
  run.surface = bin_.surface();
  if (run.samples.empty())
    throw InputError(
        "the bed ends before the wheel is up to its speed\n  "
        "hint: a longer bed");
  run.rut = rut_behind();
  summarise(run, tire_, at_, rig_);
  return run;
}

}  // namespace

WheelRun run_wheel(const SettledBed& bed, const Tire& tire, const ContactPair& tire_contact,
                   const OperatingCondition& at, const Rig& rig, const WorkOptions& how) {
  return Ride(bed, tire, tire_contact, at, rig, how).run();
}

}  // namespace soilbin::dem
