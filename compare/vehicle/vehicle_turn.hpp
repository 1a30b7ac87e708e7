// How tightly a vehicle turns on level soil, steered or by its sides, and what it takes: the steady turn of a radius
// or a steering angle, and the tightest one with what ends it.
//
//   const TurnAnswers answers = turn_of(question, wheels, model, {.radius = 12.0});   // [m]
//   answers.turn->vehicle.steering, answers.turn->vehicle.wheels[0].result.lateral_force   // [rad], [N]
//   answers.tightest->radius, answers.end.limit
#pragma once

#include <optional>
#include <vector>

#include "compare/vehicle/vehicle_answers.hpp"

namespace soilbin::compare {

/// What is asked of a turn; one of the two, or neither: the tightest one.
struct TurnAsked {
  std::optional<double> radius{};  ///< of the path of the centre of gravity [m], to the left positive; 0: on the spot
  std::optional<double> steer{};   ///< of the middle of the steered axle with the longest lever [rad], as that
};

/// What ends the turns.
enum class TurnLimit {
  steering,  ///< the steered wheels turn no further
  motors,    ///< torque, power or speed of the motors
  balance,   ///< there is no steady turn
};

struct TurnEnd {
  TurnLimit limit = TurnLimit::balance;
  TravelLimit motors = TravelLimit::torque;  ///< where they are the limit
  VehicleFailure failure{};                  ///< where the balance is
};

/// A steady turn.
struct VehicleTurn {
  double radius = 0.0;  ///< of the path of the centre of gravity [m], to the left positive
  double widest = 0.0;  ///< of the path of the wheel farthest out [m], > 0
  double rate = 0.0;    ///< of its turning [rad/s], to the left positive
  SteadyVehicle vehicle{};
};

struct TurnAnswers {
  VehicleCase question{};
  std::vector<VehicleWheel> wheels{};
  TurnAsked asked{};
  std::optional<VehicleTurn> turn{};        ///< the one that is asked, else the tightest
  std::optional<TurnEnd> why_not{};         ///< where there is none: what ends before
  SteadyErrors errors{};                    ///< of the turn, at its radius
  std::optional<VehicleTurn> tightest{};    ///< to the side that is asked, else to the left; none: it does not turn
  double tightest_error = 0.0;              ///< standard error of its radius [m]; not a number where none is known
  TurnEnd end{};                            ///< of the tightest
  std::vector<VehicleTurn> ever_tighter{};  ///< from all but straight to the tightest
};

/// The wheel that slips most over the ground, along and aside, of those that are on it: s^2 + sin^2(yaw).
std::size_t slips_most(const SteadyVehicle& vehicle);

/// Throws InputError where neither an axle is steered nor the drive line turns the sides unlike, for one axle alone,
/// and on a slope, where no turn is steady; on the spot for a steered axle, and where something is pulled.
TurnAnswers turn_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                    const TurnAsked& asked = {});

}  // namespace soilbin::compare
