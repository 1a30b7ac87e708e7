// The numbers of a vehicle's wheels that have a standard deviation, soil and carcass pressures, as values that can be
// moved: for standard errors and for the chance to go.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/vehicle/vehicle.hpp"

namespace soilbin::compare {

/// A number of the wheels' scenarios that has a standard deviation.
struct DoubtfulNumber {
  double value = 0.0, sd = 0.0;  ///< [SI]
  Range range{};
  std::function<void(Scenario&, double)> set{};
  std::string title{};  ///< for people: "friction angle"

  /// The wheels with this number set to a value.
  std::vector<VehicleWheel> in(std::vector<VehicleWheel> wheels, double to) const {
    for (VehicleWheel& wheel : wheels) set(wheel.scenario, to);
    return wheels;
  }
};

/// Each once: the soil is one for all wheels, a carcass pressure one for all wheels with that tire.
std::vector<DoubtfulNumber> doubtful_numbers(const std::vector<VehicleWheel>& wheels);

}  // namespace soilbin::compare
