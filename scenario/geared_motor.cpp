#include "scenario/geared_motor.hpp"

#include <algorithm>
#include <cstddef>

namespace soilbin {

double top_spin(const GearedMotor& motor) { return motor.torque_curve.back().speed / motor.gear_ratio; }

double torque_at_wheels(const GearedMotor& motor, double spin) {
  const std::vector<TorquePoint>& curve = motor.torque_curve;
  const double speed = std::clamp(motor.gear_ratio * spin, curve.front().speed, curve.back().speed);
  const auto after = std::ranges::lower_bound(curve, speed, {}, &TorquePoint::speed);
  double torque = after->torque;
  if (after != curve.begin()) {
    const auto before = after - 1;
    torque =
        before->torque + (after->torque - before->torque) * (speed - before->speed) / (after->speed - before->speed);
  }
  return motor.efficiency * motor.gear_ratio * torque;
}

std::optional<double> fastest_spin(const GearedMotor& motor, double torque, double below) {
  const double end = std::min(below, top_spin(motor)), at_end = torque_at_wheels(motor, end);
  if (at_end >= torque) return end;
  // From the fastest down: the first stretch between two points whose slower end gives enough.
  double fast = end, weak = at_end;
  for (std::size_t i = motor.torque_curve.size(); i-- > 0;) {
    const double slow = motor.torque_curve[i].speed / motor.gear_ratio;
    if (slow >= fast) continue;
    const double strong = torque_at_wheels(motor, slow);
    if (strong >= torque) return slow + (fast - slow) * (strong - torque) / (strong - weak);
    fast = slow, weak = strong;
  }
  return std::nullopt;
}

std::string contradiction(const GearedMotor& motor) {
  if (motor.torque_curve.size() < 2) return "a torque_curve needs two points or more";
  for (std::size_t i = 0; i + 1 < motor.torque_curve.size(); ++i)
    if (!(motor.torque_curve[i].speed < motor.torque_curve[i + 1].speed))
      return "the speeds of the torque_curve don't rise";
  return "";
}

}  // namespace soilbin
