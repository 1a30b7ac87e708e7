// What a vehicle does and can do at best on a soil: its steady state, pull against slip, the steepest slopes, each with
// standard errors from those of the soil's values.
//
//   const std::vector<VehicleWheel> wheels = wheels_of(question);
//   const VehicleAnswers answers = answers_of(question, wheels, bekker_wong::BekkerWong({false, false}));
//   answers.up.angle->value, answers.up.angle->std_error   // [rad]
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/vehicle/steady_vehicle.hpp"
#include "compare/vehicle/vehicle_drive.hpp"

namespace soilbin::compare {

// The chance that a vehicle goes, over slope and heading: on how many soils, drawn by their standard deviations, it has
// a steady state.
//
//   const GoMap map = go_map(question, wheels, model, {.samples = 100});
//   map.cells[2][0].chance   // on the third slope, straight up

struct GoMapPlan {
  std::vector<double> slopes{};    ///< of the ground [rad], rising; empty: 0, 5 .. 35 deg
  std::vector<double> headings{};  ///< from straight up to the right [rad]; empty: 0, 30 .. 180 deg
  int samples = 50;
  std::uint64_t seed = 1;
  std::function<void(std::size_t done, std::size_t total)> progress{};
};

struct GoCell {
  double chance = 0.0;
  double std_error = 0.0;  ///< of so many samples
};

struct GoMap {
  std::vector<double> slopes{}, headings{};
  std::vector<std::vector<GoCell>> cells{};  ///< a row a slope
  int samples = 0;
};

/// The condition of a heading on a slope: the slope along its travel and across it, sin(a) = sin(S) cos(h), cos(a)
/// sin(b) = sin(S) sin(h).
VehicleCondition heading_on(const VehicleCondition& asked, double slope, double heading);

/// Monte Carlo over a Latin hypercube of the soil's values and the carcass pressures, normal and independent, held
/// within their ranges. A soil on which the vehicle fails on one slope counts as failed on every steeper one with that
/// heading. Slope and cross slope of the question's condition are not read.
GoMap go_map(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
             GoMapPlan plan = {});

// The steady state, pull against slip, limits.

/// Why there is no steady vehicle.
struct VehicleFailure {
  GaveOut why = GaveOut::pull;
  std::optional<std::size_t> wheel{};  ///< which wheel, where it is one
  std::string words{};                 ///< of the model, where it is the wheel's
};

VehicleFailure as_failure(const VehicleGaveOut& error);

/// Standard errors of a steady state, to first order, from those of the soil's values and the carcass pressures.
struct SteadyErrors {
  double slip = 0.0;         ///< [-]
  double pull = 0.0;         ///< [N]
  double into_wheels = 0.0;  ///< [W]
  double steering = 0.0;     ///< [rad]
  struct Wheel {
    double normal_load = 0.0, slip = 0.0, drawbar_pull = 0.0, torque = 0.0, sinkage = 0.0;  ///< [SI]
  };
  std::vector<Wheel> wheels{};
};

/// The steepest slope one way.
struct VehicleLimit {
  std::optional<Estimate> angle{};  ///< [rad]; none: it does not move so on any slope that is looked at, or on all of
                                    ///< them. Its error is not a number where it is not the pull that ends
  bool on_all = false;              ///< that are looked at, to 69 deg
  double slip = 0.0;                ///< of the drive line there
  VehicleFailure beyond{};          ///< what a steeper slope ends with
};

/// The vehicle at one slip of its drive line.
struct VehiclePullRow {
  double slip = 0.0;
  std::optional<SteadyVehicle> vehicle{};
  double pull_error = 0.0;  ///< [N]
  std::optional<VehicleFailure> failure{};
};

/// What keeps a vehicle from going faster, or from climbing steeper at a speed.
enum class TravelLimit {
  soil,    ///< it has no steady state, whatever its motors
  torque,  ///< of its motors, at their speed
  power,   ///< that reaches the wheels
  speed,   ///< the fastest that its motors turn
};

/// The fastest steady travel on a slope.
struct FastestTravel {
  double slope = 0.0;               ///< [rad]
  std::optional<Estimate> speed{};  ///< [m/s]; none: nothing limits it (soil: it does not travel). Its error is not a
                                    ///< number where each wheel has a motor
  std::optional<TravelLimit> limit{};  ///< none: nothing limits it
};

/// The steepest slope straight up at the condition's speed.
struct Gradeability {
  std::optional<Estimate> angle{};  ///< [rad]; none: it does not hold the speed on level ground. Error as above
  TravelLimit limit = TravelLimit::soil;
};

struct VehicleAnswers {
  VehicleCase question{};
  std::vector<VehicleWheel> wheels{};
  std::optional<SteadyVehicle> steady{};  ///< in the question's condition
  SteadyErrors errors{};                  ///< of it
  std::optional<VehicleFailure> failure{};
  std::vector<VehiclePullRow> pulls{};  ///< in the question's condition, by the slip of the drive line
  bool in_full = true;  ///< else without standard errors, and what is below was not looked for: state_of
  VehicleLimit up{}, down{}, across{};  ///< straight up, straight down, level across, with the pull that is asked
  std::optional<GoMap> map{};           ///< where one was asked for; answers_of makes none
  std::optional<double> power_speed{};  ///< at which the largest power is used up [m/s]; where there is one

  std::optional<FastestTravel> fastest{};      ///< in the condition, where power or motors limit it and it travels
  std::optional<TravelLimit> not_held{};       ///< what does not hold the condition's speed, where it travels
  std::optional<Gradeability> gradeability{};  ///< where power or motors limit it
  std::vector<FastestTravel> climbs{};         ///< on slopes straight up, as that

  /// Whether power and motors hold the condition's speed; where it travels.
  bool holds_speed() const { return !not_held; }
};

/// Its steady state and its pull against slip alone, in a hundredth of the time of answers_of, with the same numbers.
/// Throws InputError for a soil without semi_empirical values.
VehicleAnswers state_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model);

/// Everything. Throws as state_of does.
VehicleAnswers answers_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model);

/// Only the steepest slopes; whose order is up, down, across.
std::array<VehicleLimit, 3> steepest_slopes(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                            const Model& model);

/// The steepest one straight up alone.
VehicleLimit steepest_climb(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model);

// What came of a vehicle driven in time, with its errors and what it climbs in a steady state.
//
//   const DrivenAnswers answers = driven_answers(question, wheels, bekker_wong::BekkerWong({false, false}));
//   answers.record->end, answers.travelled_error

/// The drive with one value of the soil or of a carcass moved by its standard deviation, or as far as its bound.
struct MovedVehicleDrive {
  struct Side {
    double value = 0.0;             ///< [SI]
    std::optional<DriveEnd> end{};  ///< none: the soil can't hold it at its start
    double end_time = 0.0, travelled = 0.0;
  };
  std::string title;
  double value = 0.0, sd = 0.0;
  Side lower{}, higher{};
};

struct DrivenAnswers {
  VehicleCase question{};
  std::vector<VehicleWheel> wheels{};
  std::optional<VehicleDriveRecord> record{};
  std::optional<VehicleFailure> failure{};  ///< why it does not stand at its start; then there is no record
  VehicleLimit up{};                        ///< what it climbs in a steady state, with the condition's pull
  std::vector<MovedVehicleDrive> moved{};
  std::optional<double> travelled_error{};  ///< standard error of the way to the end [m]; none where some of the drives
                                            ///< end in another way, or do not stand
  std::optional<double> end_time_error{};   ///< [s]; as that
};

/// The drive, and again for its errors: each doubtful value a standard deviation lower and higher, all taken as
/// independent, those of the soils that begin on the way too. Throws what drive_vehicle throws, but for a vehicle that
/// does not stand.
DrivenAnswers driven_answers(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                             int samples = 400, const bekker_wong::DriveProgress& progress = {});

}  // namespace soilbin::compare
