#include "dem/verification/impact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace soilbin::dem::verification {

Impact impact(const StartEngine& start, const VerificationSetup& setup, int other, long longest) {
  const auto engine = start(setup);
  const auto overlap = [&] {
    const auto& grain = setup.grains[0];
    if (other >= 0)
      return grain.radius + setup.grains[other].radius - length(engine->position(0) - engine->position(other));
    const auto& plane = setup.planes[-1 - other];
    return grain.radius - dot(engine->position(0) - plane.point, plane.normal);
  };
  Impact out;
  bool touched = false;
  double before = overlap(), begun = 0;
  long steps = 0;
  while (steps < longest) {
    engine->step(1);
    ++steps;
    const double now = overlap();
    // time of the zero between two steps
    const auto zero = [&] { return setup.dt * (static_cast<double>(steps) - now / (now - before)); };
    if (!touched && now > 0) touched = true, begun = zero();
    out.overlap = std::max(out.overlap, now);
    out.force = std::max(out.force, engine->normal_force(0, other));
    if (touched && now <= 0) {
      out.time = zero() - begun;
      break;
    }
    before = now;
  }
  out.velocity = engine->velocity(0);
  out.spin = engine->spin(0);
  return out;
}

double hertz_overlap(double mass, double radius, double young, double speed) {
  return std::pow(15 * mass * speed * speed / (16 * std::sqrt(radius) * young), 0.4);
}

double hertz_time(double mass, double radius, double young, double speed) {
  // 2 delta/v times the integral of dx/sqrt(1 - x^(5/2)) over 0 to 1
  using std::numbers::pi;
  const double integral = std::sqrt(pi) * std::tgamma(0.4) * 0.4 / std::tgamma(0.9);
  return 2 * hertz_overlap(mass, radius, young, speed) / speed * integral;
}

}  // namespace soilbin::dem::verification
