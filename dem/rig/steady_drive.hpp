// The part of a drive in which nothing changes any more, and its means.
#pragma once

#include "dem/rig/drive_outcome.hpp"
#include "scenario/drive.hpp"

namespace soilbin::dem {

/// Fills record.steady from the samples after the motor's ramp and behind the last place of the profile, their start-up
/// cut off by steady_part; or says in record.not_steady why there is none: the drive ended otherwise than by time, by
/// arriving or at the bed's end, or fewer than 16 samples are left. `allowed`: drift of a steady drive.
void find_steady_part(GrainDriveRecord& record, const Drive& drive, double allowed);

}  // namespace soilbin::dem
