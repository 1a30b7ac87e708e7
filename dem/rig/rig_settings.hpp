// The members of a rig, said once: a run's inputs, the job of a LAMMPS worker, the command's flags and Python's
// keywords are made from this list. A member of Rig that isn't in it doesn't compile.
//
//   describe_rig(rig, [](const char* key, auto& member, const auto&... measure_of_and_meaning) { ... });
#pragma once

#include "dem/rig/dem_model.hpp"
#include "scenario/description.hpp"

namespace soilbin::dem {

/// What a setting is of; a settled bed hangs on those of the bed.
enum class SettingOf { bed, run, start, patch };

/// Calls on(key, member) for each member, in the order of records; on(key, member, measure, of, meaning) for one that
/// people set, where "{}" in the meaning stands for the default. Constants that records name are const members.
template <class SomeRig, class On>
void describe_rig(SomeRig& rig, const On& on) {
  auto& [mass, tilting, lowering, resting, starting, behind, ahead, travel, patch, until_error, sampling, inertia,
         meshing, dt, skin, deepest_overlap, sleep_speed, ledger, drive_torque, onlooker] = rig;  // onlooker: no number
  const Measure way{"m", above_zero}, time{"s", above_zero};
  on("mass", mass);
  on("tilting", tilting, time, SettingOf::run, "time in which gravity turns to an incline; {} s");
  on("lowering", lowering, time, SettingOf::run, "time in which the load comes on; {} s");
  on("resting", resting, Measure{"s", zero_or_more}, SettingOf::run,
     "time under the whole load before the start; {} s");
  on("starting", starting, time, SettingOf::start, "time in which speed and rotation come on; {} s");
  on("behind", behind, way, SettingOf::run, "distance from the axle to the bin's rear end at the start; {} m");
  on("ahead", ahead, way, SettingOf::run, "distance from the axle to the bin's front end when the run ends; {} m");
  on("travel", travel, way, SettingOf::run, "distance that the axle travels; as far as the bin allows");
  on("sampling", sampling), on("sectors", stress_sectors), on("inertia", inertia), on("mesh_edge", meshing.edge);
  on("chevron_angle", usual_lug_angle), on("wheel_mesh", meshing.drawn), on("young", tire_young);
  on("poisson", tire_poisson), on("skin", skin);
  on("deepest_overlap", deepest_overlap, Measure{"-", {.lower = 0.05, .upper = 2}}, SettingOf::run,
     "share of the smaller radius by which grains may overlap before the run stops; {}");
  on("steady_drift", most_steady_drift);
  on("sleep", sleep_speed, Measure{"-", {.lower = 0, .upper = 0.1}}, SettingOf::run,
     "far from the wheel, grains slower than this share of sqrt(g d) are not computed; {}; 0: all are");
  on("sleep_time", sleep_time), on("drive_torque", drive_torque), on("patch", patch), on("ledger", ledger);
  on("until_error", until_error, Measure{"-", {.lower = 1e-4, .upper = 0.5}}, SettingOf::patch,
     "on a patch without a given travel: the wheel goes on until the run is steady and its mean pull has a standard "
     "error of this share of the load, 30 outer radii at most; {}");
  on("time_step", dt, time, SettingOf::bed, "time step of bed and run; a fifth of the Rayleigh time");
}

/// Calls on(key, number, measure, of, meaning) for the settings of a soil bin: the bed's, then the rig's. A key is that
/// of the flag, "bed_length" of --bed-length.
template <class On>
void each_setting(DemSettings& settings, const On& on) {
  const Measure length{"m", above_zero};
  on("bed_length", settings.size.length, length, SettingOf::bed, "length of the bed; {} m");
  on("bed_width", settings.size.width, length, SettingOf::bed, "width of the bed; {} m");
  on("bed_depth", settings.size.depth, length, SettingOf::bed, "depth of the bed; {} m");
  on("graded", settings.graded, Measure{"-", {.lower = 1, .upper = 4}}, SettingOf::bed,
     "grains below and beside the track up to so many times larger than the soil's, which stay under the wheel; "
     "1 .. 4; {}: the soil's grains everywhere");
  on("graded_for", settings.highest_lugs, length, SettingOf::bed,
     "of a graded bed: height of lugs for which it is fine too; a tire with lower lugs then runs on the same bed; the "
     "tire's own");
  describe_rig(settings.rig, [&](const char* key, auto& member, const auto&... told) {
    if constexpr (sizeof...(told) > 0) on(key, member, told...);
  });
}

}  // namespace soilbin::dem
