// Closed forms of a grain on a plane that slides, rolls, stands on a slope, bounces or sticks. The first group are
// those that LAMMPS' unit tests of granular models hold.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/verification/cases.hpp"
#include "dem/verification/impact.hpp"
#include "scenario/unit.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using verification::closed_form;
using verification::first_plane;
using verification::g;
using verification::hertz_time;
using verification::impact;
using verification::rigid;

constexpr const char* lammps = "closed form, as in LAMMPS' unit tests of granular models";

using Rows = std::vector<VerificationRow>;

/// A stiff sphere at rest on a rough floor, before it is set moving.
struct Floor {
  double radius = 0.01, density = 2500, young = 1e10, poisson = 0.25, dt = 5e-6;
  double slope = 0;  ///< [rad], down along x
  Interaction contact;
  ContactLaws laws;

  double mass() const { return sphere_mass(density, radius); }
  double inertia() const { return 0.4 * mass() * radius * radius; }
  double weight() const { return mass() * g * std::cos(slope); }
  double reduced() const { return young / (2 * (1 - poisson * poisson)); }
  /// Overlap that carries the weight.
  double overlap() const { return std::pow(weight() / (4.0 / 3 * reduced() * std::sqrt(radius)), 2.0 / 3); }
  VerificationSetup setup(double speed, double spin) const {
    VerificationSetup out;
    out.materials.add({"stone", density, young, poisson}, contact);
    out.laws = laws;
    out.planes.push_back({{}, {0, 0, 1}, 0});
    out.grains.push_back({{0, 0, radius - overlap()}, {speed, 0, 0}, {0, spin, 0}, radius, 0});
    out.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
    out.dt = dt;
    return out;
  }
};

Floor floor_of(double friction, RollingLaw rolling = RollingLaw::none, double rolling_friction = 0) {
  Floor out;
  out.contact.sliding_friction = friction;
  out.contact.rolling_friction = rolling_friction;
  out.contact.rolling_damping = 0.3;
  if (rolling == RollingLaw::spring_slider) out.contact.rolling_stiffness = 1000, out.contact.rolling_viscosity = 2;
  out.laws.rolling = rolling;
  return out;
}

/// Rolling laws with a limit, which all come to the same in steady rolling.
constexpr std::pair<const char*, RollingLaw> limited[] = {{"directional", RollingLaw::directional},
                                                          {"elastic_plastic", RollingLaw::elastic_plastic},
                                                          {"spring_slider", RollingLaw::spring_slider}};

struct SphereMotion {
  Vec3 velocity, spin;
};

SphereMotion after(const StartEngine& start, const VerificationSetup& setup, double time) {
  const auto engine = start(setup);
  engine->step(std::lround(time / setup.dt));
  return {engine->velocity(0), engine->spin(0)};
}

/// A sphere thrown along the floor slides, then rolls.
void sliding(Rows& rows, const StartEngine& start) {
  const double u = 0.5, mu = 0.3, r = 0.01, ends = 2 * u / (7 * mu * g);
  const auto setup = floor_of(mu).setup(u, 0);
  const double half = std::round(ends / 2 / setup.dt) * setup.dt;
  const SphereMotion slides = after(start, setup, half), rolls = after(start, setup, 2 * ends);
  rows.push_back({"slides: speed", u - mu * g * half, slides.velocity.x, 5e-4, "m/s", lammps});
  rows.push_back({"slides: spin", 2.5 * mu * g * half / r, slides.spin.y, 0.05, "rad/s", lammps});
  rows.push_back({"rolls at last: speed", 5 * u / 7, rolls.velocity.x, 2e-4, "m/s", lammps});
  rows.push_back({"rolls at last: spin", 5 * u / (7 * r), rolls.spin.y, 0.02, "rad/s", lammps});
}

/// Rolling resistance slows a spin over ice, and a roll.
void slowing(Rows& rows, const StartEngine& start) {
  const double mu_r = 0.05, r = 0.01, w = 10, t = 0.04;
  for (const auto& [name, law] : limited) {
    const auto undamped = [&, law = law](double friction) {  // elastic_plastic damps even above the limit, at first
      Floor out = floor_of(friction, law, mu_r);
      out.contact.rolling_damping = 0;
      return out;
    };
    const SphereMotion spins = after(start, undamped(0).setup(0, w), t);
    rows.push_back({fmt::format("spins without friction, {}: spin", name), w - 2.5 * mu_r * g * t / r, spins.spin.y,
                    0.02, "rad/s", lammps});
    const SphereMotion stands = after(start, floor_of(0, law, mu_r).setup(0, w), 0.12);
    rows.push_back(
        {fmt::format("spins without friction, {}: spin in the end", name), 0, stands.spin.y, 0.01, "rad/s", lammps});
    const SphereMotion rolls = after(start, undamped(0.8).setup(w * r, w), t);
    rows.push_back({fmt::format("rolls, {}: speed", name), w * r - 5.0 / 7 * mu_r * g * t, rolls.velocity.x, 2e-4,
                    "m/s", closed_form});
  }
}

/// On a slope: rolls down, or stands where the rolling friction is above its tangent.
void on_a_slope(Rows& rows, const StartEngine& start) {
  const double alpha = 20 * degree, t = 0.1;
  const auto down = [&](RollingLaw law, double mu_r) {
    Floor floor = floor_of(0.8, law, mu_r);
    floor.slope = alpha;
    return after(start, floor.setup(0, 0), t).velocity.x;
  };
  const auto expected = [&](double mu_r) { return 5.0 / 7 * g * (std::sin(alpha) - mu_r * std::cos(alpha)) * t; };
  rows.push_back({"slope of 20 deg: speed", expected(0), down(RollingLaw::none, 0), 3e-4, "m/s", lammps});
  for (const auto& [name, law] : limited) {
    rows.push_back({fmt::format("slope of 20 deg, {}, mu_r 0.1: speed", name), expected(0.1), down(law, 0.1), 1e-3,
                    "m/s", lammps});
    rows.push_back({fmt::format("slope of 20 deg, {}, mu_r 0.4: speed", name), 0, down(law, 0.4), 1e-3, "m/s", lammps});
  }
}

/// Heights above the floor of the first two bounces of a dropped sphere.
void bounces(Rows& rows, const StartEngine& start) {
  const double drop = 0.05;
  for (const double e : {0.5, 0.8}) {
    Floor floor = floor_of(0);
    floor.contact.restitution = e;
    auto setup = floor.setup(0, 0);
    setup.grains[0].position.z = floor.radius + drop;
    setup.dt = 5e-7;
    const auto engine = start(setup);
    double before = 0, apex = 0;
    for (int bounce = 0; bounce < 3;) {  // the first apex is the release
      const double z = engine->position(0).z, v = engine->velocity(0).z;
      if (before > 0 && v <= 0 && z > floor.radius) {
        ++bounce;
        const double expected = std::pow(e, 2 * bounce) * drop;
        rows.push_back({fmt::format("bounces, e {}: apex {}", e, bounce), expected * 1e3, (apex - floor.radius) * 1e3,
                        0.01 * expected * 1e3, "mm", lammps});
        if (bounce == 2) break;
      }
      apex = v > 0 ? std::max(apex, z) : 0;
      before = v;
      engine->step(1);
    }
  }
}

/// A frictional, else elastic impact must not gain energy.
void no_gain(Rows& rows, const StartEngine& start) {
  const double r = 0.01, v = 1, young = 1e8 / (1 - 0.25 * 0.25);
  double greatest = 0;
  for (int angle = 5; angle <= 85; angle += 5) {
    VerificationSetup setup;
    Interaction contact;
    contact.restitution = 1;
    setup.materials.add({"stone", 2500, 1e8, 0.25}, contact);
    setup.materials.add({"wall", 2500, rigid, 0.25}, contact);
    setup.planes.push_back({{}, {0, 0, 1}, 1});
    setup.grains.push_back({{0, 0, r}, {v * std::sin(angle * degree), 0, -v * std::cos(angle * degree)}, {}, r, 0});
    setup.dt = hertz_time(sphere_mass(2500, r), r, young, v * std::cos(angle * degree)) / 1000;
    const auto out = impact(start, setup, first_plane, 20000);
    greatest = std::max(greatest, squared(out.velocity) + 0.4 * r * r * squared(out.spin) - v * v);
  }
  rows.push_back(
      {"frictional impacts at 5 to 85 deg: greatest gain of energy", 0, greatest, 1e-6, "of the energy", lammps});
}

/// Rolling springs below their limit swing a frictionless sphere to and fro.
void swinging(Rows& rows, const StartEngine& start) {
  const double w = 0.01, mu_r = 0.3, eta = 0.1;
  Floor floor = floor_of(0, RollingLaw::torsion_spring);
  floor.contact.rolling_stiffness = 0.05;
  const double half = pi * std::sqrt(floor.inertia() / 0.05);
  rows.push_back({"torsion_spring: spin after half a period", -w, after(start, floor.setup(0, w), half).spin.y, 1e-5,
                  "rad/s", closed_form});
  floor = floor_of(0, RollingLaw::elastic_plastic, mu_r);
  floor.contact.rolling_damping = eta;
  const double stiffness = 2.25 * floor.weight() / floor.overlap() * std::pow(mu_r * floor.radius, 2);
  const double share = eta * std::sqrt(3.5);  // of critical; critical by J = 3.5 I, the motion by I
  const double damped = std::sqrt(1 - share * share);
  const double swing = pi / (std::sqrt(stiffness / floor.inertia()) * damped);
  floor.dt = swing / 1000;
  rows.push_back({"elastic_plastic: spin after half a period", -w * std::exp(-pi * share / damped),
                  after(start, floor.setup(0, w), swing).spin.y, 1e-5, "rad/s", closed_form});
}

}  // namespace

std::vector<VerificationCase> motion_cases() {
  return {{{"slides", "rolls at last"}, sliding},
          {{"spins without friction", "rolls"}, slowing},
          {{"slope of 20 deg"}, on_a_slope},
          {{"bounces"}, bounces},
          {{"frictional impacts at 5 to 85 deg"}, no_gain},
          {{"torsion_spring", "elastic_plastic"}, swinging}};
}

}  // namespace soilbin::dem
