// What a free drive of the virtual soil bin gives: samples, happenings and the steady part, as plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenario/drive_record.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::dem {

/// Where the motor's work went, from the start [J].
struct GrainDriveEnergy : WheelEnergy {
  double soil = 0;     ///< given to the grains, counted step by step
  double sliding = 0;  ///< of that: lost where grains slide on each other and on the wheel
  double rolling = 0;  ///< lost by rolling resistance
  double damping = 0;  ///< lost in normal dashpots, and left in bonds that broke
  double stored = 0;   ///< the grains hold it: motion, height, springs; less what turning gravity brought in
  bool known = false;  ///< whether these four were counted (Rig::ledger)
  /// What the wheel's own balance leaves over: rounding alone.
  double unaccounted() const { return left() - soil; }
  /// What the time step leaves over of the grains' balance; 0 where it was not counted.
  double soil_unaccounted() const { return known ? soil - sliding - rolling - damping - stored : 0.0; }
};

/// The wheel over the time since the sample before: means over all steps of it, but for time, way and energy, which are
/// those at its end.
struct GrainDriveSample : DriveState {
  GrainDriveEnergy energy;
};

/// Means with block-averaged errors over the part of a drive in which nothing changes any more.
struct SteadyDrive {
  double from = 0, to = 0;    ///< [s]
  Estimate speed, rim_speed;  ///< [m/s]
  Estimate slip;              ///< mean of the samples' [-]
  Estimate sinkage;           ///< [m]
  Estimate torque;            ///< of the motor [N m]
  Estimate forward;           ///< force of the soil along travel [N]
  double drift = 0;           ///< SteadyPart::drift of speed, sinkage and torque
  bool steady = false;        ///< whether that is at most most_steady_drift
};

struct GrainDriveRecord {
  DriveEnd end = DriveEnd::time_is_up;
  double end_time = 0;                    ///< to a step [s]
  std::vector<GrainDriveSample> samples;  ///< the first at rest
  std::vector<DriveHappening> happenings;
  std::optional<SteadyDrive> steady;
  std::string not_steady;  ///< why there is no `steady`
  double hold = 0;         ///< torque of the brake at rest [N m]
  std::size_t grains = 0;
  std::int64_t steps = 0;  ///< of the drive, without the stages before
  double earlier = 0;      ///< on the clock on the wall, before it was gone on with [s]
};

}  // namespace soilbin::dem
