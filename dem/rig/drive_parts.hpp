// What a restart of a drive keeps of it, struct by struct (dem/archive/note_text.hpp).
#pragma once

#include "dem/archive/note_text.hpp"
#include "dem/engine/energy.hpp"
#include "dem/rig/drive_outcome.hpp"
#include "dem/rig/wheel_in_bin.hpp"

namespace soilbin::dem {

template <class Notes>
void archive(Notes& notes, EnergyBalance& e) {
  auto& [kinetic, potential, elastic, tangential, rolling, work_of_drives, ledger] = e;
  notes(kinetic, potential, elastic, tangential, rolling, work_of_drives, ledger);
}

template <class Notes>
void archive(Notes& notes, WheelEnergy& e) {
  auto& [motor, kinetic, height, drawbar] = e;
  notes(motor, kinetic, height, drawbar);
}

template <class Notes>
void archive(Notes& notes, GrainDriveEnergy& e) {
  static_assert(sizeof(GrainDriveEnergy) == sizeof(WheelEnergy) + 6 * sizeof(double));
  notes(static_cast<WheelEnergy&>(e), e.soil, e.sliding, e.rolling, e.damping, e.stored, e.known);
}

template <class Notes>
void archive(Notes& notes, DriveState& s) {
  auto& [time, travelled, speed, rim_speed, slip, sinkage, torque, forward, lateral, drawbar, incline] = s;
  notes(time, travelled, speed, rim_speed, slip, sinkage, torque, forward, lateral, drawbar, incline);
}

template <class Notes>
void archive(Notes& notes, GrainDriveSample& s) {
  static_assert(sizeof(GrainDriveSample) == sizeof(DriveState) + sizeof(GrainDriveEnergy));
  notes(static_cast<DriveState&>(s), s.energy);
}

template <class Notes>
void archive(Notes& notes, DriveHappening& h) {
  auto& [time, travelled, what] = h;
  notes(time, travelled, what);
}

}  // namespace soilbin::dem
