#pragma once

#include <array>

#include "scenario/drive.hpp"

namespace soilbin::bekker_wong {

/// What turns the wheel, between two switches: a PI controller of the rim speed, held within its highest torque; or a
/// torque, given up where the rim would turn faster than its highest speed.
class Motor {
 public:
  /// `swung`: inertia that the controller is laid out for, I + m r^2 [kg m^2]; `hold`: torque at rest [N m].
  Motor(const Controller& controller, double radius, double swung, double hold);

  enum class Mode { free, upper_limit, lower_limit };
  Mode mode = Mode::free;

  /// M [N m] at a spin [rad/s] and an error integral [rad].
  double torque(double time, double spin, double integral) const;
  /// d(integral)/dt: the error of the spin, 0 at a limit (no wind-up).
  double integral_rate(double time, double spin) const;
  /// Distances from the upper and the lower limit [N m]; a change of sign switches the mode. 1 where there is none.
  std::array<double, 2> switches(double time, double spin, double integral) const;

 private:
  double share(double time) const;  ///< of the setpoint, 0 .. 1
  double wanted(double time, double spin, double integral) const;
  double governor(double spin) const;

  Controller controller_;
  double radius_, hold_, proportional_, integral_;
};

}  // namespace soilbin::bekker_wong
