#include "scenario/drive_motor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenario/errors.hpp"

namespace soilbin {

Motor::Motor(const Controller& controller, double radius, double swung, double hold, std::optional<double> power,
             std::optional<Halt> halt, std::optional<GearedMotor> geared)
    : controller_(controller),
      radius_(radius),
      hold_(hold),
      proportional_(swung / controller.response),
      integral_(proportional_ / (4 * controller.response)),  // critically damped where the wheel doesn't slip
      power_(power),
      halt_(halt),
      geared_(std::move(geared)) {}

void Motor::require_hold() const {
  if ((controller_.highest_torque && std::abs(hold_) > *controller_.highest_torque) ||
      (geared_ && hold_ > torque_at_wheels(*geared_, 0.0)))
    throw NoSolution("the motor's highest torque can't hold the wheel at rest where the drive begins");
}

Motor::Limits Motor::limits(double spin) const {
  const double most = controller_.highest_torque.value_or(HUGE_VAL);
  if (!power_ && !geared_) return {-most, most};
  double driven = most, held = most;  // that it drives with; that it stops a wheel with that rolls back
  if (power_) {
    constexpr double standing = 1e-3;  // [rad/s]
    driven = std::min(most, *power_ / std::max(std::abs(spin), standing));
  }
  if (geared_) {
    driven = std::min(driven, torque_at_wheels(*geared_, std::abs(spin)));
    held = std::min(held, torque_at_wheels(*geared_, 0.0));
  }
  return spin >= 0.0 ? Limits{-most, driven} : Limits{-driven, held};
}

double Motor::share(double time) const {
  const auto grown = [&](double since) {
    const double t = std::clamp(since / controller_.ramp, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  };
  const double share = grown(time);
  if (!halt_) return share;
  return share - grown(time - halt_->at) + grown(time - halt_->at - controller_.ramp - halt_->lasts);
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
  const double within =
      controller_.highest_rim_speed ? torque + std::min(0.0, correction(time, spin, integral)) : torque;
  const Limits limit = limits(spin);
  return std::clamp(within, limit.lower, limit.upper);
}

double Motor::integral_rate(double time, double spin, double integral) const {
  if (controller_.torque && !controller_.highest_rim_speed) return 0.0;
  const double cut = controller_.torque ? std::max(0.0, correction(time, spin, integral))
                                        : wanted(time, spin, integral) - torque(time, spin, integral);
  return error(time, spin) - cut / proportional_;
}

std::array<double, 2> Motor::beyond(double time, double spin, double integral) const {
  if (controller_.highest_rim_speed) return {-correction(time, spin, integral), 1.0};
  const Limits limit = limits(spin);
  const double torque = wanted(time, spin, integral);
  return {std::isfinite(limit.upper) ? torque - limit.upper : -1.0,
          std::isfinite(limit.lower) ? torque - limit.lower : 1.0};
}

}  // namespace soilbin
