// A case's wheel driven in time by the analytic model: what came of it, and its errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/transient/driving.hpp"
#include "compare/doubts/doubt.hpp"
#include "compare/drives/drive_errors.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// A case's drive and what came of it.
struct AnalyticDrive {
  Case question;
  bekker_wong::DriveRecord record;
  std::optional<double> steepest;  ///< slope that the wheel climbs in a steady state at the soil, the cross slope and
                                   ///< the yaw of the start [rad]
  DriveErrors errors;
};

/// Runs the drive of a case, and again for its errors, on so many threads. Throws InputError where the case has none,
/// and what drive_wheel throws.
AnalyticDrive run_drive(const Case& question, int samples, const bekker_wong::DriveProgress& progress = {},
                        int threads = 1);

/// What is doubtful in a drive (compare/doubts/doubts.hpp): its wheel and soil, how deep it sank on its way, what
/// changes nothing.
Doubts doubts(const AnalyticDrive& part);

}  // namespace soilbin::compare
