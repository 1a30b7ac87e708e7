// A wheel driven in time, from rest to where it arrives or gets stuck (docs/drive.md).
//
//   const DriveRecord record = drive_wheel(scenario, drive);
//   record.end == DriveEnd::stuck, record.samples.back().travelled, record.samples.back().energy.unaccounted()
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "bekker_wong/transient/cvodes.hpp"
#include "bekker_wong/transient/driven_wheel.hpp"

namespace soilbin::bekker_wong {

/// Where the motor's work went, from the start [J].
struct EnergyLedger {
  double motor = 0.0;       ///< Int M w dt
  double kinetic = 0.0;     ///< gained: travel, heave and spin
  double height = 0.0;      ///< gained against the load: Int W (v sin(alpha) - dz/dt cos(alpha) cos(beta_t)) dt
  double drawbar = 0.0;     ///< done on the load that is pulled
  double compaction = 0.0;  ///< pressing the soil
  double shear = 0.0;       ///< shearing it
  double added = 0.0;       ///< against the effects' added forces
  double damping = 0.0;     ///< of heave
  /// What is left over: the integration's error.
  double unaccounted() const { return motor - kinetic - height - drawbar - compaction - shear - added - damping; }
};

/// The wheel at one time.
struct DriveSample {
  double time = 0.0;
  double travelled = 0.0;             ///< x [m]
  double speed = 0.0;                 ///< v [m/s]
  double rim_speed = 0.0;             ///< r w [m/s]
  std::optional<double> slip;         ///< by the speeds of this instant; none while the wheel all but stands
  double contact_slip = 0.0;          ///< that the soil under the wheel has seen
  double sinkage = 0.0;               ///< z [m]
  double torque = 0.0;                ///< M of the motor [N m]
  double forward = 0.0;               ///< force of the soil along travel [N]
  double lateral = 0.0;               ///< to the left of travel, the load's share on a cross slope included [N]
  double drawbar = 0.0;               ///< load pulled [N]
  double longitudinal_incline = 0.0;  ///< under the wheel [rad]
  EnergyLedger energy;
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
  buried,       ///< deeper than the model answers for
  rolled_back,  ///< by half a radius behind the start
};
std::string_view word_of(DriveEnd end);

struct DriveRecord {
  DriveEnd end = DriveEnd::time_is_up;
  double end_time = 0.0;             ///< found to the integration's tolerance, not to a sample
  std::vector<DriveSample> samples;  ///< at equal times, and one at the end
  std::vector<DriveHappening> happenings;
  sundials::Effort effort;
};

/// Called with the time reached and the drive's duration [s]; may throw to stop the work.
using DriveProgress = std::function<void(double time, double duration)>;

/// Drives the wheel. `samples`: how many intervals of time are recorded over the whole duration.
/// Throws InputError for an effect that a drive can't take, NoSolution where the soil can't hold the wheel at its
/// start.
DriveRecord drive_wheel(const Scenario& scenario, const Drive& drive, int samples = 400,
                        const DriveNumerics& numerics = {}, const DriveProgress& progress = {});

}  // namespace soilbin::bekker_wong
