// A vehicle driven in time by the analytic model, straight up or down from rest: travel of the body, load transfer with
// its inertia, each axle's wheels in the soil (docs/theory/driven-vehicle.md).
//
//   const VehicleDriveRecord climb = drive_vehicle(question, wheels_of(question));
//   climb.end == DriveEnd::stuck, climb.gave_out     // the axle that gave least for its load
#pragma once

#include <optional>
#include <vector>

#include "bekker_wong/transient/driving.hpp"
#include "compare/vehicle/vehicle.hpp"

namespace soilbin::compare {

/// An axle at one time; numbers of each of its wheels.
struct DrivenAxle {
  double normal_load = 0.0;      ///< N, normal to the ground [N]
  double rim_speed = 0.0;        ///< r w [m/s]
  std::optional<double> slip{};  ///< none while the wheel all but stands
  double contact_slip = 0.0;     ///< that the soil under the wheel has seen
  double sinkage = 0.0;          ///< [m]
  double torque = 0.0;           ///< at the axle: against the soil and the wheel's inertia [N m]
  double forward = 0.0;          ///< force of the soil along travel [N]
};

struct VehicleDriveSample {
  double time = 0.0;
  double travelled = 0.0;     ///< x of its centre of gravity along the ground [m]
  double speed = 0.0;         ///< v [m/s]
  double acceleration = 0.0;  ///< [m/s^2]
  double rim_speed = 0.0;     ///< of the drive line: the mean of the driven wheels', less their leads [m/s]
  std::optional<double> slip{};
  double torque = 0.0;  ///< of all motors [N m]
  double pull = 0.0;    ///< of the drawbar [N]
  double slope = 0.0;   ///< [rad]
  std::vector<DrivenAxle> axles{};
  /// height: gained by the climb, less what the wheels' loads give where the wheels sink.
  bekker_wong::EnergyLedger energy{};
};

struct VehicleDriveHappening {
  double time = 0.0, travelled = 0.0;
  DriveEvent what = DriveEvent::torque_limit;
  std::size_t axle = 0;  ///< of the wheels that lift or land; of a motor's limit the first axle that it drives
};

struct VehicleDriveRecord {
  DriveEnd end = DriveEnd::time_is_up;
  double end_time = 0.0;
  std::vector<VehicleDriveSample> samples{};  ///< at equal times, and one at the end
  std::vector<VehicleDriveHappening> happenings{};
  std::optional<std::size_t> gave_out{};  ///< of one that is stuck or has rolled back the axle whose wheels give least
                                          ///< for their load, of a buried one the axle that is
  bool at_motors_limit = false;           ///< at the end a motor gives no more
};

/// Drives a vehicle as its `drive` says. Of the two wheels of an axle one is followed: the vehicle is alike on both
/// sides. Throws InputError where it is not, on a cross slope, for an effect that holds in a steady state only, for
/// samples below 1; VehicleGaveOut where the soil can't hold it at its start.
VehicleDriveRecord drive_vehicle(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                 int samples = 400, const bekker_wong::DriveNumerics& numerics = {},
                                 const bekker_wong::DriveProgress& progress = {});

/// The vehicle that looks the other way, which one is that backs up: its places along it mirrored.
VehicleCase mirrored(VehicleCase vehicle);

}  // namespace soilbin::compare
