// Standard errors of what is computed of a vehicle, to first order, from those of the soil's values and the carcass
// pressures.
#pragma once

#include <functional>
#include <vector>

#include "compare/vehicle/vehicle_answers.hpp"

namespace soilbin::compare {

/// What is told of a vehicle, as numbers.
using VehicleNumbers = std::vector<double>;
using VehicleNumbersOf = std::function<VehicleNumbers(const std::vector<VehicleWheel>&)>;

/// Standard errors of so many numbers: central differences over a thousandth of each standard deviation, the doubtful
/// values taken as independent. Not a number where a vehicle beside this one has no balance.
VehicleNumbers errors_of(const std::vector<VehicleWheel>& wheels, std::size_t count, const VehicleNumbersOf& numbers);

/// Those of the steady vehicle in a condition.
SteadyErrors errors_of_steady(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                              const VehicleCondition& at);

}  // namespace soilbin::compare
