#include "compare/vehicle/driven_answers.hpp"

#include <algorithm>
#include <cmath>

#include "compare/vehicle/doubtful_numbers.hpp"

namespace soilbin::compare {
namespace {

MovedVehicleDrive::Side moved_drive(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                    const DoubtfulNumber& number, double value) {
  MovedVehicleDrive::Side side{value};
  try {
    const VehicleDriveRecord record = drive_vehicle(question, number.in(wheels, value), 1);
    side.end = record.end, side.end_time = record.end_time, side.travelled = record.samples.back().travelled;
  } catch (const NoSolution&) {  // it does not stand
  }
  return side;
}

/// Standard error of a number of the drives' ends, by half of what lies between both sides of each value, as wide as
/// its standard deviation; none where a value has no drive on a side.
std::optional<double> error_over(const std::vector<MovedVehicleDrive>& moved, double MovedVehicleDrive::Side::*number) {
  double variance = 0.0;
  for (const MovedVehicleDrive& one : moved) {
    if (!one.lower.end || !one.higher.end) return {};
    const double width = one.higher.value - one.lower.value;
    if (width > 0.0) variance += std::pow(one.sd * (one.higher.*number - one.lower.*number) / width, 2);
  }
  return std::sqrt(variance);
}

}  // namespace

DrivenAnswers driven_answers(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                             int samples, const bekker_wong::DriveProgress& progress) {
  DrivenAnswers answers{question, wheels};
  answers.up = steepest_climb(question, wheels, model);
  try {
    answers.record = drive_vehicle(question, wheels, samples, {}, progress);
  } catch (const VehicleGaveOut& error) {
    answers.failure = {error.why(), error.wheel(), error.what()};
    return answers;
  }
  for (const DoubtfulNumber& number : doubtful_numbers(wheels)) {
    MovedVehicleDrive moved{number.title, number.value, number.sd};
    const Neighbours beside = neighbours(number.value, number.sd, number.range);
    moved.lower = moved_drive(question, wheels, number, beside.below);
    moved.higher = moved_drive(question, wheels, number, beside.above);
    answers.moved.push_back(moved);
    if (progress) progress(answers.record->end_time, question.drive.duration);
  }
  if (answers.moved.empty()) return answers;
  const auto ends_alike = [&](const MovedVehicleDrive& one) {
    return one.lower.end == answers.record->end && one.higher.end == answers.record->end;
  };
  if (!std::ranges::all_of(answers.moved, ends_alike)) return answers;  // stuck and not stuck: no slope between them
  answers.travelled_error = error_over(answers.moved, &MovedVehicleDrive::Side::travelled);
  answers.end_time_error = error_over(answers.moved, &MovedVehicleDrive::Side::end_time);
  return answers;
}

}  // namespace soilbin::compare
