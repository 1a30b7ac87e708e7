// What a wheel that travels takes of its motor.
//
//   if (const auto power = power_of(tire, result)) power->energy.value;   // [J/m]
#pragma once

#include <optional>

#include "scenario/tire.hpp"
#include "scenario/traction_result.hpp"

namespace soilbin::compare {

/// By M w of a wheel in a steady state; negative where it brakes.
struct WheelPower {
  double spin = 0.0;  ///< angular speed w [rad/s]
  Estimate power{};   ///< [W]
  Estimate energy{};  ///< a metre of the axle's travel [J/m]: it depends on the speed as the torque does
};

/// None of a wheel that spins on the spot (a slip of 100 %), whose speed of travel says nothing of w, nor of a model
/// without a torque.
std::optional<WheelPower> power_of(const Tire& tire, const TractionResult& result);

}  // namespace soilbin::compare
