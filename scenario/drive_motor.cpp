#include "scenario/drive_motor.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin {

Motor::Motor(const Controller& controller, double radius, double swung, double hold)
    : controller_(controller),
      radius_(radius),
      hold_(hold),
      proportional_(swung / controller.response),
      integral_(proportional_ / (4 * controller.response)) {}  // critically damped where the wheel doesn't slip

void Motor::require_hold() const {
  if (controller_.highest_torque && std::abs(hold_) > *controller_.highest_torque)
    throw NoSolution("the motor's highest torque can't hold the wheel at rest where the drive begins");
}

double Motor::share(double time) const {
  const double t = std::clamp(time / controller_.ramp, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double Motor::error(double time, double spin) const {
  const double rim =
      controller_.torque ? controller_.highest_rim_speed.value_or(0.0) : share(time) * *controller_.rim_speed;
  return rim / radius_ - spin;
}

double Motor::correction(double time, double spin, double integral) const {
  return proportional_ * error(time, spin) + integral_ * integral;
}

double Motor::wanted(double time, double spin, double integral) const {
  if (controller_.torque) return hold_ + share(time) * (*controller_.torque - hold_);
  return hold_ + correction(time, spin, integral);
}

double Motor::torque(double time, double spin, double integral) const {
  const double torque = wanted(time, spin, integral);
  if (controller_.highest_rim_speed) return torque + std::min(0.0, correction(time, spin, integral));
  if (!controller_.highest_torque) return torque;
  return std::clamp(torque, -*controller_.highest_torque, *controller_.highest_torque);
}

double Motor::integral_rate(double time, double spin, double integral) const {
  if (controller_.torque && !controller_.highest_rim_speed) return 0.0;
  const double cut = controller_.torque ? std::max(0.0, correction(time, spin, integral))
                                        : wanted(time, spin, integral) - torque(time, spin, integral);
  return error(time, spin) - cut / proportional_;
}

std::array<double, 2> Motor::beyond(double time, double spin, double integral) const {
  if (controller_.highest_rim_speed) return {-correction(time, spin, integral), 1.0};
  if (!controller_.highest_torque) return {-1.0, 1.0};
  const double torque = wanted(time, spin, integral);
  return {torque - *controller_.highest_torque, torque + *controller_.highest_torque};
}

}  // namespace soilbin
