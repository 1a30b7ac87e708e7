// A case's wheel driven in time by the analytic model: what came of it, and its errors.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/transient/driving.hpp"
#include "compare/doubts/doubt.hpp"
#include "compare/fit/thread_pool.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

// What the standard deviations of the soils' values and of fitted effects do to a drive: the same drive again, one
// value at a time a standard deviation lower and higher. Whole drives, not slopes: a wheel that just climbs may get
// stuck with a little less friction.
//
//   const DriveErrors errors = drive_errors(question, record, {.threads = 2});
//   errors.travelled, errors.end_time   // standard errors [m], [s]

/// The drive with one value moved by its standard deviation, or as far as its bound.
struct MovedDrive {
  struct Side {
    double value = 0.0;                                ///< [SI]; the declared one where that lies on its bound
    std::optional<bekker_wong::DriveRecord> record{};  ///< none: not moved, or the soil can't hold the wheel then
  };
  std::string soil;       ///< its name; "" of an effect's parameter
  std::string parameter;  ///< "cohesion", "slip_sinkage.a"
  std::string title;      ///< for people: "cohesion c", "slip_sinkage.a"
  std::string unit;       ///< in tables: "kPa"; "-": a plain number
  double per_si = 1.0;    ///< units per SI unit
  Estimate of;            ///< [SI]
  Side lower, higher;

  bool was_moved(const Side& side) const { return side.value != of.value; }
  /// Whether it was moved and the drive then has another end than this, or none.
  bool ends_otherwise(const Side& side, DriveEnd end) const {
    return was_moved(side) && !(side.record && side.record->end == end);
  }
};

struct DriveErrors {
  std::vector<MovedDrive> moved;    ///< each uncertain value, a soil that returns once; empty: all values are exact
  Eigen::MatrixXd correlations;     ///< of those, a row and a column each
  std::optional<double> travelled;  ///< standard error of the way to the end [m]; none: nothing was moved, or some of
                                    ///< the drives end in another way
  std::optional<double> end_time;   ///< [s]; as that

  /// Whether some of the values err together.
  bool correlated() const { return !correlations.isIdentity(0.0); }
  /// Standard error of a number that changes so by a standard deviation of each of `moved`: the root of g'C g.
  double standard_error(const Eigen::VectorXd& changes) const;
};

/// Drives again. `record`: the drive with the values as declared. question: a case with a drive. The correlations are
/// those of drive.errors, between values of the case's soil and of the effects; other values err by themselves.
DriveErrors drive_errors(const Case& question, const bekker_wong::DriveRecord& record, const ThreadPool& pool);

/// What a value of the drive gains by a standard deviation of what was moved: half of what lies between both sides, all
/// of it where there is one side, in proportion where a bound cuts it. `value` gives nothing for a drive that has it
/// not; none where neither side has it.
std::optional<double> change(const MovedDrive& drive, double as_declared,
                             const std::function<std::optional<double>(const bekker_wong::DriveRecord&)>& value);

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
