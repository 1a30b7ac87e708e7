// A driven wheel for programs that couple simulators: a force table and the wheel's equations of motion as a unit of
// the Functional Mock-up Interface 2.0 for co-simulation (Modelica Association 2014, revision 2.0.5), with its source
// in C99.
//
//   const WheelFmu fmu = wheel_fmu(table, {.name = "rover", .version = "0.1.0"});
//   const CompiledC compiled = compiled_by_cc(files_in_c(fmu), "rover.c");   // where a compiler is there
//   write_file_atomically("rover.fmu", packed_fmu(fmu, compiled.library));
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/export/force_table.hpp"
#include "compare/export/packed_files.hpp"

namespace soilbin::compare {

/// A variable of the unit. All are real [SI]; two more, `spin_is_given` and `outside`, are not in this list.
struct FmuVariable {
  enum class Role { input, parameter, output };
  std::string name;
  Role role;
  std::string unit;     ///< as the standard writes it: "N.m", "1"
  std::string meaning;  ///< of it, for people
  std::optional<double> start{};
};

/// The wheel has a mass m that travels with it and an inertia I about its axle. The table gives its pull P, torque M
/// and sinkage z at the slip k of its contact, which follows the slip of its rim over a relaxation length l, as that of
/// a tire does (Pacejka 2012, chapter 7):
///
///   m dv/dt = P - D,   I dw/dt = M_mot - M,   l dk/dt = r w - v - max(|r w|, |v|) k,   l = r/2 acos(1 - z/r).
///
/// l is half the contact: under an even pressure a step of slip lets the mean shear displacement grow at 2/length at
/// first. Steady, the wheel is the table. At rest soil resists a wheel no more than it is pushed: what the table has at
/// no slip comes up over a fifth of the contact, as in a drive (docs/theory/driven-wheel.md). Forces are taken at
/// k + t dk/dt, where t damps k by a fifth of the critical damping. Both are gone in steady travel.
struct WheelFmu {
  ForceTable table;
  std::string name;                    ///< of its functions and files: modelIdentifier
  std::string version;                 ///< of soilbin
  std::string guid;                    ///< by what is in it
  std::vector<FmuVariable> variables;  ///< a variable's place is its valueReference
  std::string source, header;          ///< NAME.c, and NAME.h: the table
  std::string description;             ///< modelDescription.xml
  double rest_frequency = 0.0;  ///< of the stiffest motion of the wheel with its parameters as they start [rad/s]
};

/// Throws InputError where the table's slips do not hold 0, for a table over speed, for forces in the wheel's axes, and
/// for a model without sinkage.
WheelFmu wheel_fmu(ForceTable table, const CHeaderAbout& about);

/// The files to compile: NAME.c and what it includes.
std::vector<PackedFile> files_in_c(const WheelFmu& fmu);

/// The unit as a file: modelDescription.xml, sources/, resources/case.yaml and, where a library is given, what is
/// loaded on Linux of 64 bits. Equal inputs give equal bytes.
std::string packed_fmu(const WheelFmu& fmu, const std::optional<std::string>& library,
                       const std::string& resolved_case);

/// What a compiler made.
struct CompiledC {
  std::optional<std::string> library;  ///< bytes of the shared library
  std::string why_not;                 ///< one line where there is none
};

/// Compiles `main` of these files to a shared library by the machine's `cc`, in a folder of its own that is gone
/// afterwards.
CompiledC compiled_by_cc(const std::vector<PackedFile>& files, const std::string& main);

/// The part of the unit's source that does not depend on the table: declarations of the standard, equations of motion,
/// the standard's functions, in C99. Needs above it: the variables as an enum with the prefix V_, REALS, `roles`,
/// `starts`, AXES, `axis_names`, `axis_values`, the table's names with the prefix TABLE_, and the macros FMU_GUID,
/// RADIUS, STIFFEST_PULL, STIFFEST_TORQUE, SHORTEST_RELAXATION, LOAD, INCLINE, IN_PLANE, LOOK_UP and TELL_CHANNELS.
extern const char* const wheel_in_c;

}  // namespace soilbin::compare
