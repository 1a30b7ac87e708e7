// What there is to doubt about a vehicle and its answer.
#pragma once

#include <optional>

#include "compare/doubts/doubt.hpp"
#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_measured.hpp"
#include "compare/vehicle/vehicle_turn.hpp"

namespace soilbin::compare {

/// Of a vehicle by itself, whatever soil and tires: a centre of gravity that is not over its wheels or high over them,
/// and what an axle's wheels carry on hard level ground, with nothing at the hitch.
Doubts doubts(const VehicleCase& vehicle);

/// `notes` (declare_tires), then doubts about the vehicle, the soil, the tires, and the answers of each axle's first
/// wheel that is on the ground; each once.
Doubts doubts_about(const VehicleAnswers& answers, Doubts notes);

/// What leaves open whether the vehicle travels on the slope that is asked.
struct NotDecided {
  std::optional<Estimate> steepest{};    ///< [rad], whose error reaches the slope
  std::optional<double> as_in_grains{};  ///< [rad]: the steepest with what grains show under heavy tires
                                         ///< (doubts_of_climb), where the slope lies between it and the answer's
};

/// From `told`, doubts_about the answers; nothing where the verdict stands.
std::optional<NotDecided> not_decided(const VehicleAnswers& answers, const Doubts& told);

/// Of a turn: as those of the steady vehicle.
Doubts doubts_about(const TurnAnswers& answers, Doubts notes);
/// Beside measured states: as those of the steady vehicle at the largest slip.
Doubts doubts_about(const MeasuredAnswers& answers, Doubts notes);
/// Of a drive: `notes`, then doubts about the vehicle and the soil; each once.
Doubts doubts_about(const DrivenAnswers& answers, Doubts notes);

}  // namespace soilbin::compare
