#include "dem/rig/wheel_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "dem/rig/rut.hpp"
#include "dem/rig/soil_flow.hpp"
#include "dem/rig/wheel_result.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

constexpr double gap = 1e-4;  // between wheel and grains at the start [m]

/// The run's stages, from the first step to the last sample.
class Ride {
 public:
  Ride(const SettledBed& bed, const Tire& tire, const ContactPair& tire_contact, const OperatingCondition& at,
       const Rig& rig, const WorkOptions& how)
      : bed_(bed),
        tire_(tire),
        at_(at),
        rig_(rig),
        how_(how),
        motion_(wheel_motion(at, tire.radius)),
        simulation_(setup_for(tire_contact), bed.state) {}

  WheelRun run();

 private:
  Setup setup_for(const ContactPair& tire_contact) const;
  void check_room() const;
  double way() const;
  double tilting() const { return at_.longitudinal_incline != 0 || at_.transverse_incline != 0 ? rig_.tilting : 0; }
  void tilt();
  double free_height() const;
  void put_wheel();
  void move(const Vec3& way, double speed);
  void take_back();
  void lower();
  void start();
  void drive(WheelRun& run);
  Rut rut_behind() const;
  WheelSample sample(double until_travel);
  std::int64_t steps_of(double time) const { return std::llround(time / simulation_.setup().numerics.dt); }
  void step();
  void tell(std::string_view stage);
  Body& wheel() { return simulation_.body(wheel_); }
  double wheel_x() { return wheel().position.x; }

  const SettledBed& bed_;
  const Tire& tire_;
  const OperatingCondition& at_;
  const Rig& rig_;
  const WorkOptions& how_;
  WheelMotion motion_;
  Simulation simulation_;
  int wheel_ = -1;
  double surface_ = 0, begin_x_ = 0;
  SurfaceHeight before_;  // the whole bed's, where the wheel is put down
  std::int64_t steps_ = 0;
  double all_steps_ = 1;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

Setup Ride::setup_for(const ContactPair& tire_contact) const {
  Setup setup = bed_.setup;
  const int tire = setup.materials.add({"tire", 1100, rig_.young, rig_.poisson});
  setup.materials.set(grain_material, tire, interaction_of(tire_contact));
  setup.laws = with_cohesion_of(tire_contact, setup.laws);
  if (rig_.dt > 0) setup.numerics.dt = rig_.dt;
  setup.numerics.skin = rig_.skin * bed_.recipe.soil.radius_max;
  setup.numerics.threads = how_.threads;
  setup.numerics.deepest_overlap = rig_.deepest_overlap;
  setup.numerics.ledger = rig_.ledger;
  const double g = bed_.recipe.gravity, d = bed_.recipe.soil.radius_min + bed_.recipe.soil.radius_max;
  setup.numerics.sleep = {rig_.sleep_speed * std::sqrt(g * d), rig_.sleep_time * std::sqrt(d / g)};
  return setup;
}

void Ride::check_room() const {
  const BedSize& size = bed_.recipe.size;
  if (way() <= 0)
    throw InputError(
        fmt::format("a bed of {:.4g} m leaves the wheel no way: "
                    "{:.4g} m behind and {:.4g} m ahead are kept"
                    "\n  hint: a longer bed",
                    size.length, rig_.behind, rig_.ahead));
  if (size.width < 1.4999 * tire_.width)  // 150 mm is 1.5 times 100 mm, whatever rounding says
    throw InputError(
        fmt::format("a bed {:.4g} m wide is too narrow for a tire "
                    "of {:.4g} m: at least 1.5 times its width",
                    size.width, tire_.width));
}

double Ride::way() const {
  const double room = bed_.recipe.size.length - rig_.behind - rig_.ahead;
  return rig_.travel > 0 ? std::min(rig_.travel, room) : room;
}

void Ride::step() {
  simulation_.run(1);
  ++steps_;
}

void Ride::tell(std::string_view stage) {
  if (how_.stop.stop_requested()) throw Stopped();
  if (!how_.progress) return;
  const double done = std::min(1.0, static_cast<double>(steps_) / all_steps_);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began_;
  how_.progress({stage, done, done > 0 ? spent.count() * (1 - done) / done : std::numeric_limits<double>::quiet_NaN()});
}

/// Turns gravity to the incline and lets the bed come to terms with it.
void Ride::tilt() {
  const std::int64_t steps = steps_of(tilting());
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k % 100 == 0) tell("tilting");
    const double share = std::min(1.0, 1.5 * static_cast<double>(k + 1) / static_cast<double>(steps));
    OperatingCondition part = at_;
    part.longitudinal_incline *= share, part.transverse_incline *= share;
    simulation_.set_gravity(-bed_.recipe.gravity * wheel_motion(part, tire_.radius).up);
    step();
  }
}

/// The lowest place of the axle over the start where no grain is within the rim that the lugs reach [m].
double Ride::free_height() const {
  const double rim = tire_.radius + tire_.lugs.height, y = bed_.recipe.size.width / 2;
  double z = 0;
  for (std::size_t k = 0; k < simulation_.state().grains.count(); ++k) {
    const Vec3 from = simulation_.state().grains.motion[k].position - Vec3{rig_.behind, y, 0};
    const double x = dot(from, motion_.heading), apart = rim + simulation_.state().grains.motion[k].radius + gap;
    if (std::abs(dot(from, motion_.axle)) > tire_.width || std::abs(x) >= apart) continue;
    z = std::max(z, from.z + std::sqrt(apart * apart - x * x));
  }
  return z;
}

void Ride::put_wheel() {
  const Grains& grains = simulation_.state().grains;
  const double y = bed_.recipe.size.width / 2, radius = bed_.recipe.soil.radius_min;
  const Footprint track{rig_.behind, rig_.behind + way(), y - tire_.width / 2, y + tire_.width / 2};
  surface_ = surface_height(grains, track, radius / 4).mean();
  before_ = bed_surface(grains, bed_.recipe.size, radius);

  Body body;
  body.name = "wheel";
  body.surfaces.push_back({MeshSurface{std::make_shared<TriangleMesh>(tire_surface(tire_, rig_.meshing)), nullptr},
                           static_cast<int>(simulation_.setup().materials.all.size()) - 1});
  body.mass = rig_.mass > 0 ? rig_.mass : at_.load / bed_.recipe.gravity;
  const double inertia = rig_.inertia > 0 ? rig_.inertia : body.mass * tire_.radius * tire_.radius / 2;
  body.inertia = {inertia, inertia, inertia};
  body.free_translation = {false, false, true};
  body.axis = motion_.axle;
  body.rotation = rotation_by({0, 0, at_.yaw});
  body.position = {rig_.behind, y, free_height()};
  begin_x_ = rig_.behind;
  wheel_ = simulation_.add_body(body);
}

/// Moves the wheel, held, by `way`.
void Ride::move(const Vec3& way, double speed) {
  const std::int64_t steps = std::max<std::int64_t>(1, steps_of(length(way) / speed));
  wheel().velocity = 1 / (static_cast<double>(steps) * simulation_.setup().numerics.dt) * way;
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k % 100 == 0) tell("going back");
    step();
  }
  wheel().velocity = {};
}

/// Lifts the wheel clear of all grains, takes it back to where it began and puts it over its rut.
void Ride::take_back() {
  constexpr double lifting = 1, returning = 5;  // [m/s]
  const Grains& grains = simulation_.state().grains;
  double top = 0;
  for (std::size_t k = 0; k < grains.count(); ++k)
    top = std::max(top, grains.motion[k].position.z + grains.motion[k].radius);
  wheel().free_translation = {false, false, false};
  wheel().turning = Turning::prescribed;
  wheel().applied_force = wheel().applied_torque = wheel().spin = {};
  const double clear = std::max(top + tire_.radius + tire_.lugs.height + gap, wheel().position.z);
  move({0, 0, clear - wheel().position.z}, lifting);
  move({begin_x_ - wheel_x(), 0, 0}, returning);
  move({0, 0, free_height() - wheel().position.z}, lifting);
  wheel().free_translation = {false, false, true};
}

void Ride::lower() {
  const std::int64_t ramp = steps_of(rig_.lowering), steps = ramp + steps_of(rig_.resting);
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k % 100 == 0) tell("lowering");
    const double share = k < ramp ? static_cast<double>(k + 1) / static_cast<double>(ramp) : 1.0;
    wheel().applied_force = {0, 0, share * motion_.load.z};
    step();
  }
}

void Ride::start() {
  const std::int64_t steps = std::max<std::int64_t>(1, steps_of(rig_.starting));
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k % 100 == 0) tell("starting");
    const double share = static_cast<double>(k + 1) / static_cast<double>(steps);
    wheel().velocity.x = share * motion_.speed;
    wheel().spin = share * motion_.rotation * motion_.axle;
    step();
  }
  if (!rig_.drive_torque) return;
  wheel().turning = Turning::about_axis;
  wheel().applied_torque = *rig_.drive_torque * motion_.axle;
}

WheelSample Ride::sample(double until_travel) {
  const std::int64_t steps = std::max<std::int64_t>(1, steps_of(rig_.sampling));
  const double each = 1 / static_cast<double>(steps), work = wheel().work, before = simulation_.time();
  WheelSample out;
  for (std::int64_t k = 0; k < steps; ++k) {
    step();
    const Body& now = wheel();
    out.force += each * now.force;
    out.moment += each * now.torque;
    out.sinkage += each * (surface_ - (now.position.z - tire_.radius));
    out.speed += each * now.velocity.x;
    out.heave += each * now.velocity.z;
    out.rotation += each * dot(now.spin, motion_.axle);
  }
  out.time = simulation_.time();
  out.travel = wheel().position.x - begin_x_;
  out.into_soil = (wheel().work - work) / (out.time - before);
  out.tread = tread_forces(simulation_.contacts(), wheel_, wheel().position, motion_, rig_.sectors);
  out.ledger = simulation_.state().ledger;
  if (out.sinkage > tire_.radius)
    throw NoSolution(
        fmt::format("the wheel dug itself in to its axle after {:.3g} of {:.3g} m", out.travel, until_travel));
  return out;
}

/// Samples until the bed ends; over the second half of the way also what the soil does round the wheel.
void Ride::drive(WheelRun& run) {
  const GranularSoil& soil = bed_.recipe.soil;
  const double depth = bed_.recipe.size.depth, rim = tire_.radius + tire_.lugs.height;
  FlowMeter meter(soil.radius_min + soil.radius_max, 2 * rim, rim + depth, 0);
  const double until = way() - motion_.speed * rig_.sampling;
  double next_look = begin_x_;
  for (double travel = wheel_x() - begin_x_; travel < until; travel = wheel_x() - begin_x_) {
    tell("driving");
    if (rig_.onlooker.look && wheel_x() >= next_look) {
      rig_.onlooker.look(simulation_, wheel_, surface_);
      next_look += rig_.onlooker.every;
    }
    run.samples.push_back(sample(way()));
    if (travel > until / 2) meter.add(simulation_.state().grains, wheel().position);
  }
  run.flow = meter.flow();
}

/// Behind the wheel, from where it had gone half its way, or its radius if that is more, to where it lets go.
Rut Ride::rut_behind() const {
  const double rim = tire_.radius + tire_.lugs.height, x = simulation_.body(wheel_).position.x;
  const double begun = std::max((x - begin_x_) / 2, tire_.radius);
  const Track track{bed_.recipe.size.width / 2, tire_.width, begin_x_ + begun, x - rim, x};
  const GranularSoil& soil = bed_.recipe.soil;
  const SurfaceHeight after = bed_surface(simulation_.state().grains, bed_.recipe.size, soil.radius_min);
  return rut_between(before_, after, track, soil.radius_max);
}

WheelRun Ride::run() {
  check_room();
  const double before = rig_.lowering + rig_.resting + rig_.starting;
  const double driven = (way() - motion_.speed * rig_.starting / 2) / motion_.speed;
  all_steps_ = static_cast<double>(steps_of(tilting() + at_.pass * (before + driven)));
  tilt();
  put_wheel();
  WheelRun run;
  for (int pass = 1; pass <= at_.pass; ++pass) {
    if (pass > 1) take_back();
    lower();
    start();
    run = {};
    drive(run);
  }
  run.surface = surface_;
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
