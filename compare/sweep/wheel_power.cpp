#include "compare/sweep/wheel_power.hpp"

#include <cmath>

#include "bekker_wong/kinematics.hpp"

namespace soilbin::compare {

std::optional<WheelPower> power_of(const Tire& tire, const TractionResult& result) {
  if (!std::isfinite(result.torque.value)) return std::nullopt;
  const bekker_wong::Kinematics motion = bekker_wong::kinematics(result.at);
  if (motion.locked) return WheelPower{};
  constexpr double on_the_spot = 1e-9;
  if (!(motion.travel_ratio > on_the_spot)) return std::nullopt;
  const double turns = 1.0 / (tire.radius * motion.travel_ratio);  // [rad/m]
  const Estimate& torque = result.torque;
  const Estimate energy{torque.value * turns, torque.std_error * turns};
  return WheelPower{
      result.at.speed * turns, {energy.value * result.at.speed, energy.std_error * result.at.speed}, energy};
}

}  // namespace soilbin::compare
