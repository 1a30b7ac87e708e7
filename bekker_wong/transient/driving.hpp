// A wheel driven in time by the analytic model, from rest until it arrives or gets stuck (docs/theory/driven-wheel.md).
//
//   const DriveRecord record = drive_wheel(scenario, drive);
//   record.end == DriveEnd::stuck, record.samples.back().travelled, record.samples.back().energy.unaccounted()
#pragma once

#include <functional>
#include <vector>

#include "bekker_wong/transient/driven_wheel.hpp"
#include "scenario/drive_record.hpp"

namespace soilbin::sundials {
class Integrator;
struct Stop;
}  // namespace soilbin::sundials

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

// What the drives of a wheel and of a whole vehicle have in common.

/// The powers whose integrals over time make a ledger, by their places among an integrator's sums.
namespace work {
enum Sum : std::size_t { motor, height, drawbar, compaction, shear, added, carcass, damping, count };
}

/// The ledger of such sums, with what is in motion [J].
EnergyLedger ledger_of(const std::vector<double>& sums, double kinetic);

/// What happens where a motor's limit is reached or left: the signs of the roots of Motor::beyond.
DriveEvent limit_event(int upper, int lower, const Controller& controller);

/// The time of a drive in parts, after each of which a sample is taken.
struct DriveParts {
  int samples = 400;
  double duration = 0.0;  ///< [s]
  double ramp = 0.0;      ///< the mean speed begins to count then [s]: a rate that jumps
};

/// Goes on until the duration is over, or `ends`, which is told each root, says so. `time`: how far it has come [s].
/// `sample` is called at the start and after each part.
void go_through(const DriveParts& parts, sundials::Integrator& integrator, double& time,
                const std::function<bool(const sundials::Stop&)>& ends, const std::function<void()>& sample,
                const DriveProgress& progress);

}  // namespace soilbin::bekker_wong
