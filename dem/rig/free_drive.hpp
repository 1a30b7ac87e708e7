// A wheel driven freely over a settled bed: its motor turns it, and the grains alone say how far it gets.
//
//   const GrainDriveRecord record = drive_freely({bed, tire, grains.grain_tire, rig}, drive);
//   record.end == DriveEnd::stuck, record.samples.back().travelled, record.samples.back().energy.unaccounted()
#pragma once

#include "dem/bed/settled_bed.hpp"
#include "dem/rig/drive_outcome.hpp"
#include "dem/rig/wheel_run.hpp"
#include "scenario/drive.hpp"
#include "scenario/tire.hpp"

namespace soilbin::dem {

/// Drives it from rest. Mass and inertia are the drive's; the wheel is free along the bin, along its normal and about
/// its axle, and guided across. Gravity and load turn with the slope under the axle, so the whole bed has that slope:
/// the load at each step, gravity at each sample. Before time 0 the load comes on and rests with the wheel braked
/// (Rig::lowering, resting); the brake's torque is what the motor begins with. `samples`: how many are taken over the
/// drive's duration. Of the rig, mass, inertia, sampling, starting and drive_torque are not read.
///
/// Throws InputError for what the bin can't do (other soils on the way, a yaw that changes, later passes) and a bed too
/// short or narrow; NoSolution where the grains or the motor can't hold the wheel at its start; RunStopped where a
/// grain is lost; Stopped. `checkpoints`: as for run_wheel.
GrainDriveRecord drive_freely(const WheelOnBed& on, const Drive& drive, int samples = 400, const WorkOptions& how = {},
                              const Checkpoints& checkpoints = {});

/// Throws InputError for a drive that the bin can't do, before a bed is made for it.
void check_drive(const Drive& drive);

/// Length that a bed must have for a drive to arrive [m]; 0 where the drive has no distance.
double bed_length_for(const Drive& drive, const Rig& rig);

}  // namespace soilbin::dem
