// The motor of a drive: the torque that a controller of speed or of torque gives at each moment.
#pragma once

#include <array>
#include <optional>

#include "scenario/drive.hpp"
#include "scenario/geared_motor.hpp"

namespace soilbin {

/// A stop on the way: the setpoint falls to that of rest over the controller's ramp, stays there, and grows again.
struct Halt {
  double at = 0.0;     ///< it begins to brake [s]
  double lasts = 0.0;  ///< at rest [s]
  /// When the setpoint is that of travel again.
  double over(double ramp) const { return at + lasts + 2 * ramp; }
};

/// What turns the wheel: a PI controller of the rim speed, held within its highest torque; or a torque, given up to a
/// PI controller where the rim would turn faster than its highest speed. Beyond a limit the integral is led back by
/// what the limit cuts off (back-calculation: Astrom and Hagglund), so that torque and rates have no jumps.
class Motor {
 public:
  /// `swung`: inertia that the controller is laid out for, I + m r^2 [kg m^2]; `hold`: torque at rest [N m]; `power`:
  /// that it gives at most [W], whatever the controller asks; it may brake with more; `halt`: where it stops on the
  /// way; `geared`: whose torque curve limits it at its spin, but for braking.
  Motor(const Controller& controller, double radius, double swung, double hold, std::optional<double> power = {},
        std::optional<Halt> halt = {}, std::optional<GearedMotor> geared = {});

  /// Throws NoSolution where the highest torque, or that of the curve, is less than the torque at rest.
  void require_hold() const;

  /// M [N m] at a spin [rad/s] and an error integral [rad].
  double torque(double time, double spin, double integral) const;
  /// d(integral)/dt [rad/s]
  double integral_rate(double time, double spin, double integral) const;
  /// How far it is beyond its upper limit and, negative, beyond its lower one; -1 and 1 where there is none.
  std::array<double, 2> beyond(double time, double spin, double integral) const;

 private:
  double share(double time) const;               ///< of the setpoint, 0 .. 1
  double error(double time, double spin) const;  ///< of the spin [rad/s]
  double correction(double time, double spin, double integral) const;
  double wanted(double time, double spin, double integral) const;

  struct Limits {
    double lower, upper;  ///< [N m]
  };
  Limits limits(double spin) const;

  Controller controller_;
  double radius_, hold_, proportional_, integral_;
  std::optional<double> power_;
  std::optional<Halt> halt_;
  std::optional<GearedMotor> geared_;
};

}  // namespace soilbin
