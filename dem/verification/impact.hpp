// One impact, from the first touch to the parting, and the Hertz theory that it is set up by.
#pragma once

#include "dem/surface/mass_properties.hpp"
#include "dem/verification/cases.hpp"

namespace soilbin::dem::verification {

/// Stiffness of a wall that does not give [Pa].
inline constexpr double rigid = 1e30;

struct Impact {
  double time = 0;      ///< from touch to parting [s]
  double overlap = 0;   ///< greatest [m]
  double force = 0;     ///< greatest along the normal [N]
  Vec3 velocity, spin;  ///< of grain 0, after
};

/// Steps until grain 0 parts from `other` (a grain, or -1 - p), `longest` steps at most.
Impact impact(const StartEngine& start, const VerificationSetup& setup, int other, long longest);

/// Hertz: duration of an elastic impact [s], of m*, R*, E* and the speed.
double hertz_time(double mass, double radius, double young, double speed);
/// Hertz: greatest overlap [m].
double hertz_overlap(double mass, double radius, double young, double speed);

}  // namespace soilbin::dem::verification
