// A wheel driven in time by the analytic model, from rest until it arrives or gets stuck (docs/theory/driven-wheel.md).
//
//   const DriveRecord record = drive_wheel(scenario, drive);
//   record.end == DriveEnd::stuck, record.samples.back().travelled, record.samples.back().energy.unaccounted()
#pragma once

#include <functional>
#include <vector>

#include "bekker_wong/transient/driven_wheel.hpp"
#include "scenario/drive_record.hpp"

namespace soilbin::bekker_wong {

/// Where the motor's work went, from the start [J].
struct EnergyLedger : WheelEnergy {
  double compaction = 0.0;  ///< pressing the soil
  double shear = 0.0;       ///< shearing it
  double added = 0.0;       ///< against the effects' added forces
  double carcass = 0.0;     ///< in the flexed carcass, which gives it back
  double damping = 0.0;     ///< of heave
  /// What is left over: the integration's error.
  double unaccounted() const { return left() - compaction - shear - added - carcass - damping; }
};

/// The wheel at one instant.
struct DriveSample : DriveState {
  double contact_slip = 0.0;  ///< that the soil under the wheel has seen
  EnergyLedger energy;
};

struct DriveRecord {
  DriveEnd end = DriveEnd::time_is_up;
  double end_time = 0.0;             ///< found to the integration's tolerance, not to a sample
  std::vector<DriveSample> samples;  ///< at equal times, and one at the end
  std::vector<DriveHappening> happenings;
};

/// Called with the time reached and the drive's duration [s]; may throw to stop the work.
using DriveProgress = std::function<void(double time, double duration)>;

/// Drives the wheel. `samples`: how many intervals of time are recorded over the whole duration.
/// Throws what DrivenWheel's constructor throws, InputError for samples below 1, NoSolution where the soil can't hold
/// the wheel at its start.
DriveRecord drive_wheel(const Scenario& scenario, const Drive& drive, int samples = 400,
                        const DriveNumerics& numerics = {}, const DriveProgress& progress = {});

}  // namespace soilbin::bekker_wong
