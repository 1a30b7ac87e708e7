// A vehicle beside what somebody measured of the whole machine: the slope that it climbed, or its pull, at a slip.
//
//   const MeasuredVehicle measured = read_measured_vehicle(read_source_text("climbs.csv", largest_csv));
//   const MeasuredAnswers answers = beside_measured(question, wheels, model, measured);
//   answers.rms, answers.mean   // [rad], where slopes were measured
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/vehicle/vehicle_answers.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// What can be measured of a vehicle at a slip of its drive line.
enum class VehicleChannel {
  slope,           ///< straight up, on which it travels steadily with the pull that is asked
  drawbar_pull,    ///< that is left at the hitch
  traction_angle,  ///< atan of that pull over the weight
};

struct VehicleChannelView {
  const char* key;    ///< of its column, and in answers
  const char* title;  ///< for people
  const char* unit;   ///< in which people read it
};

/// In the order of VehicleChannel.
inline constexpr std::array<VehicleChannelView, 3> vehicle_channels = {{
    {"slope", "slope", "deg"},
    {"drawbar_pull", "drawbar pull", "N"},
    {"traction_angle", "traction angle", "deg"},
}};

/// The vehicle as it was measured at one slip.
struct MeasuredState {
  double slip = 0.0;              ///< of the drive line, by its mean rim speed
  double value = 0.0;             ///< of the channel [SI]
  std::optional<double> slope{};  ///< on which a pull was measured [rad]; absent: the condition's
};

struct MeasuredVehicle {
  std::string file{};  ///< as errors name it
  VehicleChannel channel = VehicleChannel::slope;
  std::vector<MeasuredState> states{};
  bool tells_slopes = false;  ///< the condition's slope is not read
};

/// Reads a CSV with one row a state: slip (or slip_percent), and slope_deg, drawbar_pull_N or traction_angle_deg, each
/// in any unit of its kind. A slope beside a pull is that on which the pull was measured. Throws InputError with file,
/// line and hint.
MeasuredVehicle read_measured_vehicle(const SourceText& csv);

/// The model at a slip.
struct ModelledState {
  double slip = 0.0;
  std::optional<Estimate> value{};          ///< of the channel [SI], its error by the soil's and the carcasses'
  std::optional<SteadyVehicle> vehicle{};   ///< as it is then
  std::optional<VehicleFailure> failure{};  ///< where there is none
};

struct MeasuredAnswers {
  VehicleCase question{};
  std::vector<VehicleWheel> wheels{};
  MeasuredVehicle measured{};
  std::vector<ModelledState> modelled{};  ///< beside each measured state
  std::vector<ModelledState> curve{};     ///< over slip, rising; empty where pulls were measured on unlike slopes

  // Over the states that the model answers: model less measured.
  std::size_t answered = 0;
  double rms = 0.0;  ///< [SI]; not a number where it answers none
  Estimate mean{};   ///< its error holds that all states share one soil

  /// Model less measured [SI].
  std::optional<double> difference(std::size_t state) const {
    const auto& model = modelled[state].value;
    return model ? std::optional(model->value - measured.states[state].value) : std::nullopt;
  }
};

/// The vehicle in its question's condition at each measured slip, where slopes were measured on the slope that lets it
/// travel steadily so, else on the slope of the state. Standard errors are to first order (errors_of).
MeasuredAnswers beside_measured(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                const Model& model, const MeasuredVehicle& measured);

}  // namespace soilbin::compare
