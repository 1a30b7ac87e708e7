// What a vehicle does and can do at best on a soil: its steady state, pull against slip, the steepest slopes, each with
// standard errors from those of the soil's values.
//
//   const std::vector<VehicleWheel> wheels = wheels_of(question);
//   const VehicleAnswers answers = answers_of(question, wheels, bekker_wong::BekkerWong({false, false}));
//   answers.up.angle->value, answers.up.angle->std_error   // [rad]
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/vehicle/go_map.hpp"
#include "compare/vehicle/steady_vehicle.hpp"

namespace soilbin::compare {

/// Why there is no steady vehicle.
struct VehicleFailure {
  GaveOut why = GaveOut::pull;
  std::optional<std::size_t> wheel{};  ///< which wheel, where it is one
  std::string words{};                 ///< of the model, where it is the wheel's
};

/// Standard errors of a steady state, to first order, from those of the soil's values and the carcass pressures.
struct SteadyErrors {
  double slip = 0.0;         ///< [-]
  double pull = 0.0;         ///< [N]
  double into_wheels = 0.0;  ///< [W]
  struct Wheel {
    double normal_load = 0.0, slip = 0.0, drawbar_pull = 0.0, torque = 0.0, sinkage = 0.0;  ///< [SI]
  };
  std::vector<Wheel> wheels{};
};

/// The steepest slope one way.
struct VehicleLimit {
  std::optional<Estimate> angle{};  ///< [rad]; none: it does not move so on any slope that is looked at. Its error is
                                    ///< not a number where it is not the pull that ends
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

struct VehicleAnswers {
  VehicleCase question{};
  std::vector<VehicleWheel> wheels{};
  std::optional<SteadyVehicle> steady{};  ///< in the question's condition
  SteadyErrors errors{};                  ///< of it
  std::optional<VehicleFailure> failure{};
  std::vector<VehiclePullRow> pulls{};  ///< in the question's condition, by the slip of the drive line
  VehicleLimit up{}, down{}, across{};  ///< straight up, straight down, level across, with the pull that is asked
  std::optional<GoMap> map{};           ///< where one was asked for; answers_of makes none
  std::optional<double> power_speed{};  ///< at which the largest power is used up [m/s]; where there is one

  /// Whether the largest power holds the condition's speed; where it travels.
  bool holds_speed() const { return !power_speed || *power_speed >= question.condition.speed; }
};

/// Everything. Throws InputError for a soil without semi_empirical values.
VehicleAnswers answers_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model);

/// Only the steepest slopes; whose order is up, down, across.
std::array<VehicleLimit, 3> steepest_slopes(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                            const Model& model);

/// The steepest one straight up alone.
VehicleLimit steepest_climb(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model);

}  // namespace soilbin::compare
