// A wheel in time whose motion somebody else knows: a simulator of vehicles gives speed, spin and depth step by step,
// and gets the soil's forces with what the soil in contact remembers (docs/theory/driven-wheel.md).
//
//   HostedWheel wheel(scenario, {.load = 4000});                                            // [N]
//   const Instant soil = wheel.advance(1e-3, {.speed = 0.5, .spin = 1.2, .depth = 0.03});   // [s]; [m/s], [rad/s], [m]
//   soil.forward, soil.upward, soil.soil_torque                                             // [N], [N m]
#pragma once

#include <memory>

#include "bekker_wong/transient/driven_wheel.hpp"

namespace soilbin::bekker_wong {

/// The wheel's motion at the end of a step: speed and spin hold throughout it, the depth goes there evenly.
struct HostedMotion {
  double speed = 0.0;  ///< along travel [m/s]; negative: it rolls backward
  double spin = 0.0;   ///< [rad/s], that of rolling forward positive
  double depth = 0.0;  ///< of the circle's bottom below the ground [m], below 0.95 of the radius
};

/// Not to be copied. One wheel; any number of them beside each other.
class HostedWheel {
 public:
  /// drive: load (which effects read, and which tells the depth at rest), pass, damping, way and effects are read, mass
  /// and motor are not. Throws what DrivenWheel's constructor throws. The wheel stands at rest under its load.
  HostedWheel(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics = {});
  ~HostedWheel();
  HostedWheel(const HostedWheel&) = delete;
  HostedWheel& operator=(const HostedWheel&) = delete;

  /// Goes on by `step` > 0 [s] and tells what the soil does at its end. A wheel that has rolled backward by three
  /// lengths of its rolling-in is the mirrored wheel. Forces and torque are along the host's forward. Throws InputError
  /// for a step or motion that is none.
  Instant advance(double step, const HostedMotion& reached);

  double depth() const;  ///< [m]
  /// What the soil took since the start, pressing, shearing, against added forces and damping [J].
  double given_to_soil() const;
  bool turned_about() const;  ///< whether it is the mirrored wheel now

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace soilbin::bekker_wong
