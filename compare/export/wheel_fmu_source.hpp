// The C source of a wheel as an FMI 2.0 unit: declarations of the standard, equations of motion, the standard's
// functions. What depends on the table stands before it (wheel_fmu.cpp).
#pragma once

namespace soilbin::compare {

/// C99. Needs above it: the variables as an enum with the prefix V_, REALS, `roles`, `starts`, AXES, `axis_names`,
/// `axis_values`, the table's names with the prefix TABLE_, and the macros FMU_GUID, RADIUS, STIFFEST_PULL,
/// STIFFEST_TORQUE, SHORTEST_RELAXATION, LOAD, INCLINE, IN_PLANE, LOOK_UP and TELL_CHANNELS.
extern const char* const wheel_in_c;

}  // namespace soilbin::compare
