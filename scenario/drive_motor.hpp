// The motor of a drive: the torque that a controller of speed or of torque gives at each moment.
#pragma once

#include <array>

#include "scenario/drive.hpp"

namespace soilbin {

/// What turns the wheel: a PI controller of the rim speed, held within its highest torque; or a torque, given up to a
/// PI controller where the rim would turn faster than its highest speed. Beyond a limit the integral is led back by
/// what the limit cuts off (back-calculation: Astrom and Hagglund), so that torque and rates have no jumps.
class Motor {
 public:
  /// `swung`: inertia that the controller is laid out for, I + m r^2 [kg m^2]; `hold`: torque at rest [N m].
  Motor(const Controller& controller, double radius, double swung, double hold);

  /// Throws NoSolution where the highest torque is less than the torque at rest.
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

  Controller controller_;
  double radius_, hold_, proportional_, integral_;
};

}  // namespace soilbin
