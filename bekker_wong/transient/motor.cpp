#include "bekker_wong/transient/motor.hpp"

#include <algorithm>

namespace soilbin::bekker_wong {

Motor::Motor(const Controller& controller, double radius, double swung, double hold)
    : controller_(controller),
      radius_(radius),
      hold_(hold),
      proportional_(swung / controller.response),
      integral_(proportional_ / (4 * controller.response)) {}  // critically damped where the wheel doesn't slip

double Motor::share(double time) const {
  const double t = std::clamp(time / controller_.ramp, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double Motor::wanted(double time, double spin, double integral) const {
  const double s = share(time);
  if (controller_.torque) return hold_ + s * (*controller_.torque - hold_);
  return hold_ + proportional_ * (s * *controller_.rim_speed / radius_ - spin) + integral_ * integral;
}

double Motor::governor(double spin) const { return proportional_ * (*controller_.highest_rim_speed / radius_ - spin); }

double Motor::torque(double time, double spin, double integral) const {
  switch (mode) {
    case Mode::upper_limit:
      return controller_.torque ? governor(spin) : *controller_.highest_torque;
    case Mode::lower_limit:
      return -*controller_.highest_torque;
    case Mode::free:
      break;
  }
  return wanted(time, spin, integral);
}

double Motor::integral_rate(double time, double spin) const {
  if (controller_.torque || mode != Mode::free) return 0.0;
  return share(time) * *controller_.rim_speed / radius_ - spin;
}

std::array<double, 2> Motor::switches(double time, double spin, double integral) const {
  const double torque = wanted(time, spin, integral);
  if (controller_.highest_torque) return {torque - *controller_.highest_torque, torque + *controller_.highest_torque};
  if (controller_.highest_rim_speed) return {torque - governor(spin), 1.0};
  return {1.0, 1.0};
}

}  // namespace soilbin::bekker_wong
