// Closed forms of grains of several spheres: mass properties, free precession, an impact at a slant, the slope on which
// one tips. On the fast engine whichever is started.
#include <cmath>
#include <numbers>

#include "dem/engine/simulation.hpp"
#include "dem/verification/cases.hpp"
#include "scenario/unit.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using verification::closed_form;
using verification::g;

using Rows = std::vector<VerificationRow>;
constexpr double stone = 2500;  // density [kg/m^3]

/// Two spheres of radius r whose centres are a radius apart.
ClumpShape rod(double r) { return clump_shape({{{-r / 2, 0, 0}, r}, {{r / 2, 0, 0}, r}}); }

/// V = 2 Int pi (r^2 - x^2) dx, I_x = Int pi (r^2 - x^2)^2 dx, x from -r/2 to r: of what two spheres fill once.
void mass(Rows& rows, const StartEngine&) {
  const ClumpShape ours = rod(1);
  rows.push_back({"a clump of two: volume", 2 * pi * (1.5 - 0.375), ours.volume, 1e-8, "m^3", closed_form});
  const double integral = 1.5 - 2.0 / 3 * (1 + 0.125) + 0.2 * (1 + 1.0 / 32);
  rows.push_back({"a clump of two: moment of inertia", pi * integral, ours.inertia.x, 1e-8, "m^5", closed_form});
}

Simulation simulation_of(double dt, const Interaction& contact, double young, bool floor) {
  Setup setup;
  setup.materials.add({"stone", stone, young, 0.25}, contact);
  setup.laws.rolling = RollingLaw::none;
  setup.numerics.dt = dt;
  setup.numerics.threads = 1;
  Simulation simulation(setup);
  Body plane;
  plane.surfaces.push_back({Plane{}, 0});
  if (floor) simulation.add_body(plane);
  return simulation;
}

/// The axis of a free symmetric body goes round its angular momentum at L/I_t.
void precession(Rows& rows, const StartEngine&) {
  const ClumpShape shape = rod(0.01);
  const Vec3 spin{200, 60, 0}, momentum{shape.inertia.x * spin.x, shape.inertia.y * spin.y, 0};
  Simulation simulation = simulation_of(1e-5, {}, 5e6, false);
  simulation.add_clump(shape, {.position = {}, .spin = spin}, 0);
  const double time = 0.02;
  simulation.run(std::lround(time / 1e-5));
  const Vec3 axis = rotation_by(time / shape.inertia.y * momentum)({1, 0, 0});
  const Vec3 now = simulation.state().clumps.all[0].motion.rotation({1, 0, 0});
  const char* names[] = {"a spinning clump: its axis, x", "a spinning clump: its axis, y",
                         "a spinning clump: its axis, z"};
  const double ours[] = {now.x, now.y, now.z}, exact[] = {axis.x, axis.y, axis.z};
  for (int k = 0; k < 3; ++k) rows.push_back({names[k], exact[k], ours[k], 2e-5, "-", closed_form});
}

/// A rod at a slant strikes a smooth floor: an elastic impact gives back the speed v of the point of contact, by
/// J = 2 v/(1/m + c^2/I), c its lever.
void impact_at_a_slant(Rows& rows, const StartEngine&) {
  const double r = 0.01, slant = 0.5, fall = 0.3;
  Simulation simulation =
      simulation_of(2e-7, {.restitution = 1, .sliding_friction = 0, .rolling_friction = 0}, 5e9, true);
  const ClumpShape shape = rod(r);
  const double lever = r / 2 * std::cos(slant), low = r / 2 * std::sin(slant);
  simulation.add_clump(
      shape, {.position = {0, 0, r + low + 1e-5}, .rotation = rotation_by({0, slant, 0}), .velocity = {0, 0, -fall}},
      0);
  simulation.run(250);  // it has reached the floor
  while (!simulation.contacts().empty()) simulation.run(10);
  const double m = stone * shape.volume, inertia = stone * shape.inertia.y;
  const double impulse = 2 * fall / (1 / m + lever * lever / inertia);
  const ClumpMotion& after = simulation.state().clumps.all[0].motion;
  rows.push_back(
      {"a clump strikes at a slant: speed", -fall + impulse / m, after.velocity.z, 6e-4, "m/s", closed_form});
  rows.push_back(
      {"a clump strikes at a slant: spin", -impulse * lever / inertia, after.spin.y, 0.1, "rad/s", closed_form});
}

/// Four spheres on three of them, without any law of rolling: they stand until the weight passes over an edge,
/// tan = (a/(2 sqrt 3))/(r + a/(2 sqrt 6)) with a between centres.
void tipping(Rows& rows, const StartEngine&) {
  const double r = 0.01, a = 1.5 * r, low = a / std::sqrt(12.0), high = a * std::sqrt(2.0 / 3);
  const double height = r + a / (2 * std::sqrt(6.0));
  const ClumpShape shape =
      clump_shape({{{-low, -a / 2, 0}, r}, {{-low, a / 2, 0}, r}, {{2 * low, 0, 0}, r}, {{0, 0, high}, r}});
  const auto tips = [&](double slope) {
    Simulation simulation =
        simulation_of(1e-5, {.restitution = 0.2, .sliding_friction = 1, .rolling_friction = 0}, 5e8, true);
    simulation.set_gravity({-g * std::sin(slope), 0, -g * std::cos(slope)});
    simulation.add_clump(shape, {.position = {0, 0, height}}, 0);
    simulation.run(40000);
    return simulation.state().clumps.all[0].motion.position.x < -r / 2;
  };
  double stands = 0, falls = 0.6;
  for (int k = 0; k < 8; ++k) (tips((stands + falls) / 2) ? falls : stands) = (stands + falls) / 2;
  rows.push_back({"a clump of four tips on a slope", std::atan(low / height) / degree, (stands + falls) / 2 / degree,
                  0.1, "deg", closed_form});
}

}  // namespace

std::vector<VerificationCase> clump_cases() {
  return {{{"a clump of two"}, mass},
          {{"a spinning clump"}, precession},
          {{"a clump strikes at a slant"}, impact_at_a_slant},
          {{"a clump of four tips on a slope"}, tipping}};
}

}  // namespace soilbin::dem
