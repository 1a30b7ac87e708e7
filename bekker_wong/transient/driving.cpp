#include "bekker_wong/transient/driving.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/transient/cvodes.hpp"
#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {
namespace {

enum SumPlace : std::size_t {
  by_motor,
  by_height,
  by_drawbar,
  by_compaction,
  by_shear,
  by_added,
  by_carcass,
  by_damping,
  sums
};
enum RootPlace : std::size_t { at_goal, at_stuck, at_lift, at_upper, at_lower, at_bury, at_roll_back, roots };

static_assert(drive_limits::deepest <= max_sinkage_share, "a drive ends before the model does");

/// One drive under way.
class Ride {
 public:
  Ride(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics)
      : drive_(drive),
        wheel_(scenario, drive, numerics),
        held_(wheel_.hold()),
        motor_(wheel_.motor(held_.torque)),
        integrator_(problem(numerics), 0.0, held_.state) {
    motor_.require_hold();
  }

  DriveRecord run(int samples, const DriveProgress& progress) {
    record_.samples.push_back(sample(0.0));
    bool ended = false;
    bool ramped = false;
    for (int i = 1; i <= samples && !ended; ++i) {
      const double until = drive_.duration * i / samples;
      if (!ramped && drive_.controller.ramp < until) {  // the mean speed begins to count: a rate that jumps
        ended = advance(drive_.controller.ramp);
        integrator_.restart();
        ramped = true;
      }
      if (!ended) ended = advance(until);
      record_.samples.push_back(sample(record_.end_time));
      if (progress) progress(record_.end_time, drive_.duration);
    }
    return std::move(record_);
  }

 private:
  sundials::Problem problem(const DriveNumerics& numerics) {
    sundials::Problem p;
    p.rate = [this](double t, auto y, auto out) { wheel_.rate(t, y, motor_, out); };
    p.roots = [this](double t, auto y, auto out) { watch(t, y, out); };
    p.root_count = static_cast<int>(roots);
    p.summands = [this](double t, auto y, auto out) { powers(t, y, out); };
    p.sum_count = static_cast<int>(sums);
    p.relative_tolerance = numerics.relative_tolerance;
    p.absolute_tolerances = wheel_.tolerances(numerics.relative_tolerance);
    p.sum_tolerance = numerics.relative_tolerance * wheel_.load() * wheel_.radius();
    const double rim = drive_.controller.rim_speed.value_or(drive_.controller.highest_rim_speed.value_or(0.0));
    p.longest_step = rim > 0.0 ? 0.5 * wheel_.radius() / rim : 0.01 * drive_.duration;
    return p;
  }

  void watch(double t, std::span<const double> y, std::span<double> out) const {
    const auto limits = motor_.beyond(t, y[spin], y[speed_error]);
    out[at_goal] = drive_.distance ? y[travelled] - *drive_.distance : 1.0;
    out[at_stuck] = y[mean_speed] - drive_.stuck_speed;
    out[at_lift] = y[depth];
    out[at_upper] = limits[0], out[at_lower] = limits[1];
    out[at_bury] = y[depth] - drive_limits::deepest * wheel_.radius();
    out[at_roll_back] = y[travelled] + drive_limits::roll_back * wheel_.radius();
  }

  void powers(double t, std::span<const double> y, std::span<double> out) const {
    const Instant now = wheel_.look(t, y, motor_);
    const double alpha = now.place.longitudinal_incline, beta = now.place.transverse_incline;
    out[by_motor] = now.motor_torque * y[spin];
    out[by_height] = wheel_.load() * (y[speed] * std::sin(alpha) - y[sinking] * std::cos(alpha) * std::cos(beta));
    out[by_drawbar] = now.place.drawbar * y[speed];
    out[by_compaction] = now.compaction, out[by_shear] = now.shear;
    out[by_added] = now.added, out[by_carcass] = now.carcass, out[by_damping] = now.damping;
  }

  /// Goes on to `until`; true where the drive ended on the way.
  bool advance(double until) {
    while (record_.end_time < until) {
      const sundials::Stop stop = integrator_.advance(until);
      record_.end_time = stop.time;
      if (stop.at_root() && answer(stop)) return true;
    }
    return false;
  }

  void note(DriveEvent what) { record_.happenings.push_back({record_.end_time, integrator_.state()[travelled], what}); }

  /// What a root means; true where the drive ends.
  bool answer(const sundials::Stop& stop) {
    const auto ends = [&](RootPlace place, int sign, DriveEnd end) {
      if (stop.signs[place] != sign) return false;
      record_.end = end;
      return true;
    };
    if (ends(at_goal, 1, DriveEnd::arrived) || ends(at_stuck, -1, DriveEnd::stuck) ||
        ends(at_bury, 1, DriveEnd::buried) || ends(at_roll_back, -1, DriveEnd::rolled_back))
      return true;
    if (stop.signs[at_lift] != 0) note(stop.signs[at_lift] < 0 ? DriveEvent::lifts : DriveEvent::lands);
    if (stop.signs[at_upper] != 0 || stop.signs[at_lower] != 0) note_limit(stop);
    return false;
  }

  void note_limit(const sundials::Stop& stop) {
    const bool reached = stop.signs[at_upper] > 0 || stop.signs[at_lower] < 0;
    note(!reached                   ? DriveEvent::free_again
         : drive_.controller.torque ? DriveEvent::speed_limit
                                    : DriveEvent::torque_limit);
  }

  DriveSample sample(double t) const {
    const std::vector<double>& y = integrator_.state();
    const Instant now = wheel_.look(t, y, motor_);
    const double rim = wheel_.radius() * y[spin], alpha = now.place.longitudinal_incline;
    DriveSample s;
    s.time = t, s.travelled = y[travelled], s.speed = y[speed], s.rim_speed = rim;
    s.slip = drive_slip(rim, y[speed] * std::cos(now.place.yaw), drive_.controller.rim_speed);
    s.contact_slip = now.contact_slip, s.sinkage = y[depth] - now.deflection, s.torque = now.motor_torque;
    s.forward = now.forward, s.drawbar = now.place.drawbar, s.longitudinal_incline = alpha;
    s.lateral = now.left - wheel_.load() * std::cos(alpha) * std::sin(now.place.transverse_incline);
    s.energy = ledger(y);
    return s;
  }

  EnergyLedger ledger(const std::vector<double>& y) const {
    const std::vector<double>& sum = integrator_.sums();
    EnergyLedger e;
    e.kinetic = 0.5 * wheel_.mass() * (y[speed] * y[speed] + y[sinking] * y[sinking]) +
                0.5 * wheel_.inertia() * y[spin] * y[spin];
    e.motor = sum[by_motor], e.height = sum[by_height], e.drawbar = sum[by_drawbar];
    e.compaction = sum[by_compaction], e.shear = sum[by_shear];
    e.added = sum[by_added], e.carcass = sum[by_carcass], e.damping = sum[by_damping];
    return e;
  }

  Drive drive_;
  DrivenWheel wheel_;
  Held held_;
  Motor motor_;
  DriveRecord record_;
  sundials::Integrator integrator_;
};

}  // namespace

DriveRecord drive_wheel(const Scenario& scenario, const Drive& drive, int samples, const DriveNumerics& numerics,
                        const DriveProgress& progress) {
  if (samples < 1) throw InputError("a drive has at least one sample");
  return Ride(scenario, drive, numerics).run(samples, progress);
}

}  // namespace soilbin::bekker_wong
