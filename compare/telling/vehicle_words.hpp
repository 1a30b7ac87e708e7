// Words about a vehicle that several of its reports use.
#pragma once

#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/vehicle/vehicle_answers.hpp"

namespace soilbin::compare {

/// A standard error as it is told: none where it is not known.
double told_error(double error);

/// What gave out, without a full stop.
std::string failure_in_words(const std::vector<VehicleWheel>& wheels, const VehicleFailure& failure);
Json failure_json(const std::vector<VehicleWheel>& wheels, const VehicleFailure& failure);

/// "torque"
const char* travel_limit_word(TravelLimit limit);
/// "the motors give no more torque"
std::string travel_limit_in_words(TravelLimit limit);

}  // namespace soilbin::compare
