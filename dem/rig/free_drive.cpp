#include "dem/rig/free_drive.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "dem/rig/drive_parts.hpp"
#include "dem/rig/run_inputs.hpp"
#include "dem/rig/steady_drive.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "scenario/drive_motor.hpp"
#include "scenario/drive_way.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// Load and angles of a place as the bin takes them.
OperatingCondition condition_at(const Place& place, double load) {
  OperatingCondition at;
  at.load = load;
  at.longitudinal_incline = place.longitudinal_incline, at.transverse_incline = place.transverse_incline;
  at.yaw = place.yaw;
  return at;
}

/// The rig takes mass and inertia from the drive.
WheelOnBed with_masses_of(const Drive& drive, WheelOnBed on) {
  const double gravity = gravity_of(on.bed.recipe.soil);
  on.rig.mass = mass_of(drive, gravity), on.rig.inertia = inertia_of(drive, on.tire.radius, gravity);
  return on;
}

/// A drive from the first step to its end.
class FreeDrive {
 public:
  FreeDrive(const WheelOnBed& on, const Drive& drive, int samples, const WorkOptions& how,
            const Checkpoints& checkpoints)
      : on_(with_masses_of(drive, on)),
        drive_(drive),
        samples_(samples),
        gravity_(on.bed.recipe.gravity),
        way_(drive.profile, on.tire.radius),
        place_(way_.at(0)),
        bin_(on_, condition_at(place_, drive.load), [&] {
          const BedRecipe& recipe = on.bed.recipe;
          return staged_run(on_, how, checkpoints, inputs_text(recipe, on.tire, on.contact, on.rig, drive, samples));
        }) {
    bin_.run().keep("drive", *this);
    if (rig_.onlooker.keeper) bin_.run().keep("onlooker", *rig_.onlooker.keeper);
  }

  GrainDriveRecord run();

  /// For StagedRun::keep. Motor, place and stance follow.
  template <class Notes>
  void state(Notes& notes) {
    notes(record_.end, record_.end_time, record_.samples, record_.happenings, record_.hold, record_.steps);
    notes(first_, energy_, interval_, beyond_, at_limit_, lifted_, turned_to_, turned_across_, time_, travelled_,
          from_);
    notes(mean_speed_, integral_, torque_, torque_sum_, first_work_, first_kinetic_, before_share_);
    if constexpr (Notes::reads) motor_ = motor(), find_place();
  }

 private:
  void stages();
  void put_down();
  void let_go();
  void tell_rest();
  Motor motor() const;
  void find_place();
  std::int64_t end_of_interval() const;
  void begin_sample();
  void end_sample();
  void turn_gravity();
  void step();
  void account(const Vec3& velocity, double spin);
  bool goes_on() const;
  void find_end();
  GrainDriveSample state_of(const WheelSample& mean, double torque) const;
  GrainDriveEnergy energy() const;
  void note_limit(std::int64_t steps);
  void note_touch(const WheelSample& mean);
  void note(DriveEvent what) { record_.happenings.push_back({time_, travelled_, what}); }
  double share_done() const;
  Vec3 force() const { return stance_.load - Vec3{place_.drawbar, 0, 0}; }
  double spin() { return dot(bin_.wheel().spin, stance_.axle); }
  double dt() const { return bin_.simulation().setup().numerics.dt; }

  WheelOnBed on_;
  const Drive& drive_;
  const Tire& tire_ = on_.tire;
  const Rig& rig_ = on_.rig;
  int samples_;
  double gravity_;
  Way way_;
  Place place_;
  WheelInBin bin_;
  GrainDriveRecord record_;
  Motor motor_ = motor();
  WheelStance stance_ = bin_.stance();
  EnergyBalance first_;  ///< at the start, where the grains' ledger is told
  WheelEnergy energy_;
  int interval_ = 0;         ///< of the samples', that it is in
  std::int64_t beyond_ = 0;  ///< steps of this sample that the motor was at its limit
  bool at_limit_ = false, lifted_ = false;
  double turned_to_ = 0, turned_across_ = 0;  ///< inclines that gravity has [rad]
  double time_ = 0, travelled_ = 0, from_ = 0, mean_speed_ = 0, integral_ = 0, torque_ = 0, torque_sum_ = 0;
  double first_work_ = 0, first_kinetic_ = 0, before_share_ = 0;
};

/// The wheel, braked, under its whole load.
void FreeDrive::put_down() {
  bin_.tilt();
  bin_.put_wheel();
  bin_.run().once([&] { bin_.wheel().free_translation = {true, false, true}; });
  bin_.lower({force().x, 0, force().z});
}

Motor FreeDrive::motor() const {
  return Motor(drive_.controller, tire_.radius, rig_.inertia + rig_.mass * tire_.radius * tire_.radius, record_.hold);
}

/// Off the brake; the motor takes its torque over.
void FreeDrive::let_go() {
  if (const double back = -bin_.travel(); back > drive_limits::roll_back * tire_.radius)
    throw NoSolution(fmt::format(
        "the soil can't hold the wheel at rest: braked, it slid back by {:.3g} m while it was loaded", back));
  Body& wheel = bin_.wheel();
  record_.hold = -dot(bin_.moment_at_rest(), stance_.axle);
  motor_ = motor();
  motor_.require_hold();
  wheel.turning = Turning::about_axis;
  from_ = wheel.position.x;
  mean_speed_ = drive_limits::first_speed * drive_.stuck_speed;
  first_work_ = wheel.work, first_kinetic_ = free_energy(wheel, wheel.velocity, wheel.spin);
  if (rig_.ledger) first_ = bin_.simulation().energy();
  turned_to_ = place_.longitudinal_incline, turned_across_ = place_.transverse_incline;
  before_share_ = bin_.run().done();
  torque_ = record_.hold;
}

/// The first sample.
void FreeDrive::tell_rest() {
  WheelSample rest;
  rest.force = bin_.wheel().force, rest.speed = bin_.wheel().velocity.x;
  rest.sinkage = bin_.sinkage();
  record_.samples.push_back(state_of(rest, record_.hold));
  record_.samples.back().slip.reset();  // a braked wheel has none
}

/// Gravity follows the slope under the axle where that has changed.
void FreeDrive::turn_gravity() {
  if (place_.longitudinal_incline == turned_to_ && place_.transverse_incline == turned_across_) return;
  turned_to_ = place_.longitudinal_incline, turned_across_ = place_.transverse_incline;
  bin_.simulation().set_gravity(-gravity_ * stance_.up);
}

void FreeDrive::step() {
  Body& wheel = bin_.wheel();
  const Vec3 velocity = wheel.velocity;
  const double turning = spin();
  torque_ = motor_.torque(time_, turning, integral_);
  wheel.applied_torque = torque_ * stance_.axle;
  wheel.applied_force = {force().x, 0, force().z};
  const auto limits = motor_.beyond(time_, turning, integral_);
  if (limits[0] > 0 || limits[1] < 0) ++beyond_;
  integral_ += dt() * motor_.integral_rate(time_, turning, integral_);
  bin_.step();
  account(0.5 * (velocity + wheel.velocity), 0.5 * (turning + spin()));
  time_ += dt(), travelled_ = wheel.position.x - from_;
  find_place();
  ++record_.steps;
}

void FreeDrive::find_place() {
  place_ = way_.at(travelled_);
  stance_ = wheel_stance(condition_at(place_, drive_.load));
}

/// Works and the mean speed, from the motion at the step's middle.
void FreeDrive::account(const Vec3& velocity, double spin) {
  energy_.motor += dt() * torque_ * spin;
  energy_.height -= dt() * dot({stance_.load.x, 0, stance_.load.z}, velocity);
  energy_.drawbar += dt() * place_.drawbar * velocity.x;
  torque_sum_ += torque_;
  if (time_ >= drive_.controller.ramp) mean_speed_ += dt() * (velocity.x - mean_speed_) / drive_limits::memory;
}

/// Whether the drive is over now, and why.
void FreeDrive::find_end() {
  const auto ends = [&](bool is, DriveEnd end) {
    if (is) record_.end = end;
    return is;
  };
  ends(drive_.distance && travelled_ >= *drive_.distance, DriveEnd::arrived) ||
      ends(travelled_ >= bin_.way(), DriveEnd::bed_ends) || ends(mean_speed_ < drive_.stuck_speed, DriveEnd::stuck) ||
      ends(bin_.sinkage() > drive_limits::deepest * tire_.radius, DriveEnd::buried) ||
      ends(travelled_ < -drive_limits::roll_back * tire_.radius, DriveEnd::rolled_back);
}

std::int64_t FreeDrive::end_of_interval() const { return bin_.steps_of(drive_.duration * interval_ / samples_); }

bool FreeDrive::goes_on() const {
  const std::int64_t all = bin_.steps_of(drive_.duration * samples_ / samples_);
  return record_.end == DriveEnd::time_is_up && record_.steps < all;
}

/// Begins the sample of the next interval that has steps.
void FreeDrive::begin_sample() {
  do ++interval_;
  while (end_of_interval() <= record_.steps);
  bin_.begin_sample(end_of_interval() - record_.steps);
  turn_gravity();
  beyond_ = 0, torque_sum_ = 0;
}

void FreeDrive::end_sample() {
  const std::int64_t taken = bin_.sample().taken;
  const WheelSample mean = bin_.end_sample();
  record_.end_time = time_;
  note_limit(taken);
  note_touch(mean);
  record_.samples.push_back(state_of(mean, torque_sum_ / static_cast<double>(taken)));
}

GrainDriveSample FreeDrive::state_of(const WheelSample& mean, double torque) const {
  GrainDriveSample s;
  s.time = time_, s.travelled = travelled_;
  s.speed = mean.speed, s.rim_speed = tire_.radius * mean.rotation;
  s.slip = drive_slip(s.rim_speed, s.speed * stance_.heading.x, drive_.controller.rim_speed);
  s.sinkage = mean.sinkage, s.torque = torque;
  s.forward = mean.force.x, s.lateral = mean.force.y + stance_.load.y;
  s.drawbar = place_.drawbar, s.longitudinal_incline = place_.longitudinal_incline;
  s.energy = energy();
  return s;
}

GrainDriveEnergy FreeDrive::energy() const {
  const Body& wheel = bin_.wheel();
  const double kinetic = free_energy(wheel, wheel.velocity, wheel.spin);
  GrainDriveEnergy e{{energy_}};
  e.kinetic = kinetic - first_kinetic_;
  e.soil = wheel.work - first_work_;
  if (!rig_.ledger) return e;
  const EnergyBalance now = bin_.simulation().energy();
  const EnergyLosses &a = first_.ledger, &b = now.ledger;
  const double slid = now.tangential - first_.tangential, rolled = now.rolling - first_.rolling;
  e.known = true;
  e.sliding = b.into_slide - a.into_slide - slid;
  e.rolling = b.into_roll - a.into_roll - rolled;
  e.damping = b.damping - a.damping + b.adhesion - a.adhesion;
  e.stored = now.kinetic - first_.kinetic - e.kinetic + now.potential - first_.potential + now.elastic -
             first_.elastic + slid + rolled - (b.added - a.added);
  return e;
}

/// At its limit through a whole sample, or through none of it: single steps of a motor that shakes are no happening.
void FreeDrive::note_limit(std::int64_t steps) {
  if (beyond_ == steps && !at_limit_) {
    at_limit_ = true;
    note(drive_.controller.torque ? DriveEvent::speed_limit : DriveEvent::torque_limit);
  } else if (beyond_ == 0 && at_limit_) {
    at_limit_ = false;
    note(DriveEvent::free_again);
  }
}

/// No grain on the wheel through a whole sample.
void FreeDrive::note_touch(const WheelSample& mean) {
  const bool lifted = mean.force == Vec3{};
  if (lifted != lifted_) note(lifted ? DriveEvent::lifts : DriveEvent::lands);
  lifted_ = lifted;
}

double FreeDrive::share_done() const {
  const double by_time = time_ / drive_.duration, by_way = drive_.distance ? travelled_ / *drive_.distance : 0.0;
  return before_share_ + (1 - before_share_) * std::clamp(std::max(by_time, by_way), 0.0, 1.0);
}

void FreeDrive::stages() {
  put_down();
  bin_.run().once([&] { let_go(), tell_rest(); });
  bin_.run().loop(
      "driving", [&] { return goes_on(); },
      [&] {
        if (!bin_.is_sampling()) begin_sample();
        step();
        find_end();
        if (bin_.is_full() || record_.end != DriveEnd::time_is_up) end_sample();
      },
      [&] { return share_done(); });
}

GrainDriveRecord FreeDrive::run() {
  bin_.way();  // refuses a bed too short or narrow
  const double before = bin_.tilting() + rig_.lowering + rig_.resting;
  bin_.run().plan(static_cast<double>(bin_.steps_of(before + drive_.duration)));
  bin_.run().through([&] { stages(); });
  record_.grains = number_of_grains(bin_.simulation().state());
  record_.earlier = bin_.run().earlier();
  find_steady_part(record_, drive_, most_steady_drift);
  return std::move(record_);
}

}  // namespace

void check_drive(const Drive& drive) {
  constexpr const char* hint = "\n  hint: --model bekker_wong takes it";
  if (drive.pass != 1)
    throw InputError(fmt::format("the soil bin drives on undisturbed soil alone, not in pass {}{}", drive.pass, hint));
  for (const Waypoint& point : drive.profile) {
    if (point.soil)
      throw InputError(fmt::format("the soil bin has one soil from end to end; '{}' begins at {:.4g} m{}",
                                   point.soil->name, point.at, hint));
    if (point.yaw != drive.profile.front().yaw)
      throw InputError(
          fmt::format("the soil bin keeps one yaw from end to end; another one begins at {:.4g} m{}", point.at, hint));
  }
}

double bed_length_for(const Drive& drive, const Rig& rig) {
  return drive.distance ? rig.behind + *drive.distance + rig.ahead : 0.0;
}

GrainDriveRecord drive_freely(const WheelOnBed& on, const Drive& drive, int samples, const WorkOptions& how,
                              const Checkpoints& checkpoints) {
  check_drive(drive);
  try {
    return FreeDrive(on, drive, samples, how, checkpoints).run();
  } catch (const NoSolution&) {
    forget_run(checkpoints.restart);
    throw;
  } catch (const RunStopped&) {
    forget_run(checkpoints.restart);
    throw;
  }
}

}  // namespace soilbin::dem
