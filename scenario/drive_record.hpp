// The record of a drive: samples over time, energy, how it ended. The analytic wheel and the grains fill the same one
// (docs/guide/drive.md).
#pragma once

#include <optional>
#include <string_view>

namespace soilbin {

/// The wheel at one time. Speeds and forces are those of the instant, or means over a short time before it where the
/// model says so.
struct DriveState {
  double time = 0.0;
  double travelled = 0.0;             ///< x [m]
  double speed = 0.0;                 ///< v [m/s]
  double rim_speed = 0.0;             ///< r w [m/s]
  std::optional<double> slip;         ///< by these speeds (drive_slip); none while the wheel all but stands
  double sinkage = 0.0;               ///< z [m]
  double torque = 0.0;                ///< M of the motor [N m]
  double forward = 0.0;               ///< force of the soil along travel [N]
  double lateral = 0.0;               ///< to the left of travel, the load's share on a cross slope included [N]
  double drawbar = 0.0;               ///< load pulled [N]
  double longitudinal_incline = 0.0;  ///< under the wheel [rad]
};

/// What any model knows of where the motor's work went, from the start [J].
struct WheelEnergy {
  double motor = 0.0;    ///< Int M w dt
  double kinetic = 0.0;  ///< gained: travel, heave and spin
  double height = 0.0;   ///< gained against the load: Int W (v sin(alpha) - dz/dt cos(alpha) cos(beta_t)) dt
  double drawbar = 0.0;  ///< done on the load that is pulled
  /// What is left for the soil.
  double left() const { return motor - kinetic - height - drawbar; }
};

/// What happened on the way.
enum class DriveEvent { torque_limit, free_again, speed_limit, lifts, lands };
std::string_view word_of(DriveEvent event);

struct DriveHappening {
  double time = 0.0, travelled = 0.0;
  DriveEvent what = DriveEvent::torque_limit;
};

/// Why the drive ended.
enum class DriveEnd {
  time_is_up,
  arrived,      ///< at Drive::distance
  stuck,        ///< the mean speed has fallen below Drive::stuck_speed
  buried,       ///< deeper than drive_limits::deepest
  rolled_back,  ///< by half a radius behind the start
  bed_ends,     ///< of the virtual soil bin alone: before time was up or the wheel had arrived
  tips_over,    ///< of a vehicle alone: one axle carries all of it
};
std::string_view word_of(DriveEnd end);

/// (r w - v)/max(|r w|, |v|), v along the wheel's plane; none where both are below a thousandth of `rim`, the rim speed
/// that the motor holds (0.1 m/s where it gives a torque).
std::optional<double> drive_slip(double rim_speed, double along, std::optional<double> rim);

/// What ends a drive in every model.
namespace drive_limits {
inline constexpr double deepest = 0.9;       ///< sinkage over radius at which the wheel is buried
inline constexpr double roll_back = 0.5;     ///< way behind the start over radius
inline constexpr double memory = 1.0;        ///< of the mean speed m, dm/dt = (v - m)/memory [s]
inline constexpr double first_speed = 20.0;  ///< m at the start over Drive::stuck_speed: 3 s of grace
}  // namespace drive_limits

}  // namespace soilbin
