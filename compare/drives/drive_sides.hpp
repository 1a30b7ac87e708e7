// One drive by the analytic wheel and by grains, side by side: over time, and where nothing changes any more with
// what either side doesn't know.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/discrepancy/difference.hpp"
#include "compare/drives/drive.hpp"
#include "dem/rig/drive_outcome.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// A sample of either model: of the analytic wheel an instant, of grains means since the sample before.
struct DriveSideSample : DriveState {
  WheelEnergy energy;
  double soil = 0.0;  ///< given to the soil since the start [J]
};

/// What one model makes of a case's drive.
struct DriveSide {
  SideKind kind = SideKind::analytic;
  std::string label;                       ///< "bekker_wong", "dem"; of several packings "dem packing 2"
  std::optional<std::uint64_t> packing{};  ///< of several: seed of the bed; absent: there is one
  DriveEnd end = DriveEnd::time_is_up;
  double end_time = 0.0;
  std::vector<DriveSideSample> samples;
  std::vector<DriveHappening> happenings;
  std::vector<std::pair<std::string, double>> soil_parts{};  ///< what became of the soil's share at the end [J]
  /// Steady values; errors are the soil's doubt on the analytic side, block averages on that of grains.
  std::optional<dem::SteadyDrive> steady{};
  std::string not_steady{};                     ///< why there are none
  std::vector<std::string> errors_leave_out{};  ///< values whose errors the steady values leave out
};

/// Several packings' drives as one: mean_over_packings of each value.
struct DriveOverPackings {
  std::vector<DriveEnd> ends;  ///< a packing each
  Estimate end_time;           ///< [s]
  Estimate travelled;          ///< [m]
  std::optional<dem::SteadyDrive>
      steady;  ///< where all packings have theirs; from the first to the last, drift the largest
};

/// The values of a steady drive that are set side by side.
struct SteadyValue {
  const char* name;
  const char* unit;  ///< to show it in
  double per_si;     ///< value in that unit
  Estimate dem::SteadyDrive::*value;
};
inline constexpr std::array<SteadyValue, 5> steady_values = {{{"speed", "cm/s", 100, &dem::SteadyDrive::speed},
                                                              {"slip", "%", 100, &dem::SteadyDrive::slip},
                                                              {"sinkage", "mm", 1000, &dem::SteadyDrive::sinkage},
                                                              {"torque", "N m", 1, &dem::SteadyDrive::torque},
                                                              {"soil force", "N", 1, &dem::SteadyDrive::forward}}};

/// A steady value of both sides [SI].
struct DriveDifference {
  const char* name;
  const char* unit;  ///< to show it in
  double per_si;     ///< value in that unit
  Estimate analytic, grains;
  double difference = 0.0;  ///< analytic less grains
  double std_error = 0.0;   ///< root of the sum of both errors' squares
  DifferenceFinding finding = DifferenceFinding::not_judged;
};

struct DriveSides {
  Case question;
  std::vector<DriveSide> sides;
  std::vector<DriveDifference> differences;          ///< where both sides are steady
  std::optional<DriveOverPackings> over_packings{};  ///< of the sides of grains, where they are several
  std::vector<std::string> notes;                    ///< what to know of the grains' run: bed, cost
};

/// The analytic side. Its steady values are those of the end, with the errors of the soil's values.
DriveSide analytic_side(const AnalyticDrive& part);
/// `packing`: where it is one of several.
DriveSide grain_side(const dem::GrainDriveRecord& record, std::optional<std::uint64_t> packing = {});

/// Puts sides together, with the differences where both an analytic side and that of grains are steady: the one there
/// is, or the mean over packings.
DriveSides side_by_side(const Case& question, std::vector<DriveSide> sides, std::vector<std::string> notes);

/// What is doubtful in both models' drives (compare/doubts/doubts.hpp).
Doubts doubts(const DriveSides& drive);

/// Sides of grains, in their order.
std::vector<const DriveSide*> grain_sides(const DriveSides& drive);

/// The steady values of the side of grains: the one there is, or the mean over packings.
std::optional<dem::SteadyDrive> steady_of_grains(const DriveSides& drive);

/// Where the motor's work went: a name and J of each side (absent: the side doesn't know it), the rest last.
struct DriveWorkRow {
  std::string name;
  std::vector<std::optional<double>> joules;
};
std::vector<DriveWorkRow> work_rows(const DriveSides& drive);

}  // namespace soilbin::compare
