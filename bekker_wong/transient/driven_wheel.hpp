// The equations of a wheel that is driven in time (docs/theory/driven-wheel.md).
#pragma once

#include <span>
#include <vector>

#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/drive.hpp"
#include "scenario/drive_motor.hpp"
#include "scenario/drive_way.hpp"

namespace soilbin::bekker_wong {

/// Places of the state vector; the shear displacement's nodes follow, along the wheel and, where it turns, across it.
enum StatePlace : std::size_t {
  travelled,    ///< x along the ground [m]
  speed,        ///< v [m/s]
  depth,        ///< z of the circle [m]; the sinkage is less by the carcass's deflection
  sinking,      ///< dz/dt [m/s]
  turned,       ///< angle that the wheel has turned [rad]
  spin,         ///< w [rad/s]
  rolled,       ///< e: 1 where the contact is that of a wheel rolling forward, 0 at rest, -1 backward
  mean_speed,   ///< v as it was over the last second [m/s]
  speed_error,  ///< integral of the motor's error [rad]
  first_node
};

/// Everything about the wheel at one instant.
struct Instant {
  Place place;
  double contact_slip = 0.0;  ///< slip that the soil under the wheel has seen, from j at the exit
  double motor_torque = 0.0;  ///< M [N m]
  double soil_torque = 0.0;   ///< the soil's moment about the axle [N m]
  double forward = 0.0;       ///< force of the soil along travel [N]
  double left = 0.0;          ///< force of the soil to the left of travel [N]
  double upward = 0.0;        ///< force of the soil along the ground's normal, damping included [N]
  double compaction = 0.0;    ///< power that presses the soil [W]
  double shear = 0.0;         ///< power that shears it [W]
  double added = 0.0;         ///< power against the effects' added forces [W]
  double carcass = 0.0;       ///< power that flexes the tire's carcass, negative where that gives it back [W]
  double damping = 0.0;       ///< power of the damping of heave [W]
  double deflection = 0.0;    ///< of a carcass that flattens: the tread stays so far above the circle's bottom [m]
};

/// A wheel at rest that motor and soil hold where it stands.
struct Held {
  std::vector<double> state;
  double torque = 0.0;  ///< [N m]
};

/// How finely it is computed.
struct DriveNumerics {
  int nodes = 32;                    ///< of the shear displacement along the contact
  double relative_tolerance = 1e-6;  ///< of the integration in time
};

/// Mass, wheel, soil, way and motor as one system of ordinary differential equations. const members may be called from
/// any number of threads.
class DrivenWheel {
 public:
  /// Throws InputError for a number that a case's section `drive` may not hold, for an effect that holds in a steady
  /// state only (EffectForm::steady_only), for effects in the scenario (a drive has its own) and for a soil without
  /// semi-empirical values.
  DrivenWheel(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics = {});

  /// The wheel at rest at the start of its way: soil carries its load, shear and motor hold it on a slope. Throws
  /// NoSolution where the soil can't.
  Held hold() const;

  /// The wheel at this state, which rolls forward or rests: the soil's forces on one that has turned to rolling
  /// backward are not those of a wheel mirrored, for its shear displacement still counts from the front. Drives end
  /// where the wheel has rolled back by drive_limits::roll_back.
  Instant look(double time, std::span<const double> state, const Motor& motor) const;
  /// d(state)/dt of the same; `out` has state_size() values.
  void rate(double time, std::span<const double> state, const Motor& motor, std::span<double> out) const;

  /// What the soil does to the wheel at this state on this place, under a load [N] (vertical, as the condition's of a
  /// steady wheel), whoever moves it: a vehicle, a host. Motor and mass are not asked: no motor_torque. `node_rate`
  /// gets the rates of the shear displacement. The state's speed and spin are along the wheel's own forward; on a wheel
  /// that rolls backward that is backward: see turn_about.
  Instant touch(const Place& place, double load, std::span<const double> state, std::span<double> node_rate) const;
  /// The wheel at rest under this load, pushed by `displacement` [m] against the soil that it stands on: lays its shear
  /// and its depth into the state. Throws NoSolution where the soil can't carry it.
  Instant rest(const Place& place, double load, double displacement, std::vector<double>& state) const;
  /// d(rolled)/dt
  double rolled_rate(double v, double rolled_so_far) const {
    return (v - (v < 0.0 ? -v : v) * rolled_so_far) / rolling_in_;
  }

  Motor motor(double hold_torque) const;
  std::size_t state_size() const;
  std::vector<double> tolerances(double relative) const;
  /// The steady wheel of the soil that holds at the start, for comparisons.
  const RollingWheel& steady() const { return soils_.front().wheel; }

  double radius() const { return tire_.radius; }
  double load() const { return drive_.load; }
  double mass() const { return mass_; }
  double inertia() const { return inertia_; }
  const Way& way() const { return way_; }

 private:
  /// A soil along the way, the wheel on it, and the outline that its effects give it.
  struct OnSoil {
    RollingWheel wheel;
    Outline outline;
    bool flexes;  ///< the carcass flattens
  };
  /// Ends of the contact and how they move.
  struct Span {
    double entry = 0.0, exit = 0.0, entry_rate = 0.0, exit_rate = 0.0;
    double grip = 1.0;  ///< 1 in contact, falling to 0 as the wheel leaves the ground
    double length() const { return entry - exit; }
  };
  /// The tread at the nodes of the shear displacement.
  struct Tread;
  /// The shear displacement as a share of the tread's travel and a rest.
  struct Cornered;
  /// A contact with its tread, and the slip that the soil under it has seen.
  struct Contact;
  /// Forces in the wheel's axes and powers on one soil.
  struct Push;

  OperatingCondition condition(const Place& place, double load, double slip, double speed, double x) const;
  /// at: what a carcass and its soil look at.
  Span contact_span(const OnSoil& on, double z, double z_rate, const OperatingCondition& at) const;
  Tread tread(const OnSoil& on, const Span& span, const OperatingCondition& at) const;
  Contact contact(const OnSoil& on, const Place& place, double load, std::span<const double> state) const;
  double slip_in_contact(const OnSoil& on, const Span& span, const Tread& tread, std::span<const double> state) const;
  void node_rates(const OnSoil& on, const Contact& contact, const Place& place, std::span<const double> state,
                  std::span<double> out) const;
  Push push(const OnSoil& on, const Contact& touching, const OperatingCondition& at, std::span<const double> state,
            std::span<const double> effective_j) const;
  /// On all the soils that the contact touches, each by its share. touching: the first of them.
  Push push(const Place& place, const Contact& touching, const OperatingCondition& at, std::span<const double> state,
            std::span<const double> effective_j) const;
  Push push_at_rest(const Place& start, double load, std::span<const double> state) const;
  Instant assemble(double time, std::span<const double> state, const Motor& motor, std::span<double> node_rate) const;
  std::span<const double> line(std::span<const double> nodes, int across) const;
  double held_depth(const Place& start, double load, std::vector<double>& state) const;
  void lay_held_shear(std::vector<double>& state, double displacement) const;

  Tire tire_;
  Drive drive_;
  Way way_;
  std::vector<OnSoil> soils_;
  int nodes_;
  bool turns_;
  double mass_, inertia_;
  double floor_ = 0.0;          ///< depth below which the contact fades [m]
  double rolling_in_ = 0.0;     ///< travel over which the contact turns from a standing to a rolling wheel's [m]
  double shear_time_ = 0.0;     ///< of the damping of shear [s]
  double heave_damping_ = 0.0;  ///< [N s/m]
};

/// A wheel that rolls backward is the mirrored wheel: its rolling-in and the shear displacement at its nodes, as the
/// wheel that looks the other way has them. Its forces along the ground and its torque then go on where they were.
void turn_about(double& rolled_so_far, std::span<double> nodes);

}  // namespace soilbin::bekker_wong
