// The vehicle that a file and flags put together: inputs of `vehicle` and `serve`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/question.hpp"
#include "compare/vehicle/vehicle_measured.hpp"

namespace soilbin::cli {

/// Samples of a drive in time, but for the one at its start.
inline constexpr int drive_intervals = 400;

/// A vehicle of the library or a file, and flags that go before what it says.
class VehicleQuestion {
 public:
  explicit VehicleQuestion(CLI::App& app);

  /// The flags' addresses are the app's.
  VehicleQuestion(const VehicleQuestion&) = delete;
  VehicleQuestion& operator=(const VehicleQuestion&) = delete;

  /// A vehicle that is changed by flags is called so: "truck, changed". Throws InputError that names the flag that is
  /// wrong, or says what contradicts what.
  compare::VehicleCase ask(const Workplace& place) const;

  /// What of its tires is left out.
  compare::TireLeftOut left_out() const;

  /// Throws InputError for a flag of the condition that a drive would leave unread, because its file says it.
  void refuse_what_its_drive_says(const compare::VehicleDrive& drive) const;
  /// Throws InputError for a flag of the condition whose number is measured, or stands beside what is.
  void refuse_what_is_measured(const compare::MeasuredVehicle& measured) const;

 private:
  void change(compare::VehicleCase& vehicle) const;

  std::string name_, soil_, driven_, pressure_;
  std::vector<std::string> effects_;
  SoilFlags soil_values_;
  DescribedFlags<compare::VehicleCondition> condition_;
  DescribedFlags<compare::VehicleCase> machine_;
  DescribedFlags<compare::VehiclePoint> centre_of_gravity_;
  compare::TireLeftOut left_out_;
};

}  // namespace soilbin::cli
