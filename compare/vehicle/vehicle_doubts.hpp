// What there is to doubt about a vehicle's answer.
#pragma once

#include "compare/doubts/doubt.hpp"
#include "compare/vehicle/vehicle_answers.hpp"

namespace soilbin::compare {

/// `notes` (declare_tires), then doubts about the soil, the tires, and the answers of each axle's first wheel that is
/// on the ground; each once.
Doubts doubts_about(const VehicleAnswers& answers, Doubts notes);

}  // namespace soilbin::compare
