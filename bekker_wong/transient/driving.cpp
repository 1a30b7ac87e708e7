#include "bekker_wong/transient/driving.hpp"

#include <cmath>

#include "bekker_wong/transient/cvodes.hpp"
#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {
namespace {

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
    go_through(
        {samples, drive_.duration, drive_.controller.ramp}, integrator_, record_.end_time,
        [this](const sundials::Stop& stop) { return answer(stop); },
        [this] { record_.samples.push_back(sample(record_.end_time)); }, progress);
    return std::move(record_);
  }

 private:
  sundials::Problem problem(const DriveNumerics& numerics) {
    sundials::Problem p;
    p.rate = [this](double t, auto y, auto out) { wheel_.rate(t, y, motor_, out); };
    p.roots = [this](double t, auto y, auto out) { watch(t, y, out); };
    p.root_count = static_cast<int>(roots);
    p.summands = [this](double t, auto y, auto out) { powers(t, y, out); };
    p.sum_count = static_cast<int>(work::count);
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
    out[work::motor] = now.motor_torque * y[spin];
    out[work::height] = wheel_.load() * (y[speed] * std::sin(alpha) - y[sinking] * std::cos(alpha) * std::cos(beta));
    out[work::drawbar] = now.place.drawbar * y[speed];
    out[work::compaction] = now.compaction, out[work::shear] = now.shear;
    out[work::added] = now.added, out[work::carcass] = now.carcass, out[work::damping] = now.damping;
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
    const int upper = stop.signs[at_upper], lower = stop.signs[at_lower];
    if (upper != 0 || lower != 0) note(limit_event(upper, lower, drive_.controller));
    return false;
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
    s.energy = ledger_of(integrator_.sums(), 0.5 * wheel_.mass() * (y[speed] * y[speed] + y[sinking] * y[sinking]) +
                                                 0.5 * wheel_.inertia() * y[spin] * y[spin]);
    return s;
  }

  Drive drive_;
  DrivenWheel wheel_;
  Held held_;
  Motor motor_;
  DriveRecord record_;
  sundials::Integrator integrator_;
};

}  // namespace

EnergyLedger ledger_of(const std::vector<double>& sums, double kinetic) {
  EnergyLedger e;
  e.kinetic = kinetic;
  e.motor = sums[work::motor], e.height = sums[work::height], e.drawbar = sums[work::drawbar];
  e.compaction = sums[work::compaction], e.shear = sums[work::shear], e.added = sums[work::added];
  e.carcass = sums[work::carcass], e.damping = sums[work::damping];
  return e;
}

DriveEvent limit_event(int upper, int lower, const Controller& controller) {
  if (upper <= 0 && lower >= 0) return DriveEvent::free_again;
  return controller.torque ? DriveEvent::speed_limit : DriveEvent::torque_limit;
}

void go_through(const DriveParts& parts, sundials::Integrator& integrator, double& time,
                const std::function<bool(const sundials::Stop&)>& ends, const std::function<void()>& sample,
                const DriveProgress& progress) {
  const auto ends_before = [&](double until) {
    while (time < until) {
      const sundials::Stop stop = integrator.advance(until);
      time = stop.time;
      if (stop.at_root() && ends(stop)) return true;
    }
    return false;
  };
  sample();
  bool ended = false, ramped = false;
  for (int i = 1; i <= parts.samples && !ended; ++i) {
    const double until = parts.duration * i / parts.samples;
    if (!ramped && parts.ramp < until) {
      ended = ends_before(parts.ramp);
      integrator.restart();
      ramped = true;
    }
    if (!ended) ended = ends_before(until);
    sample();
    if (progress) progress(time, parts.duration);
  }
}

DriveRecord drive_wheel(const Scenario& scenario, const Drive& drive, int samples, const DriveNumerics& numerics,
                        const DriveProgress& progress) {
  if (samples < 1) throw InputError("a drive has at least one sample");
  return Ride(scenario, drive, numerics).run(samples, progress);
}

}  // namespace soilbin::bekker_wong
