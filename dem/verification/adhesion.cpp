// Closed forms of cohesion: Johnson, Kendall and Roberts 1971, Proc. R. Soc. Lond. A 324:301, and the linear law.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/verification/cases.hpp"
#include "dem/verification/impact.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;
using verification::first_plane;

constexpr const char* jkr = "Johnson, Kendall and Roberts 1971";

/// A soft, sticky sphere at a wall.
constexpr double radius = 1e-4, density = 2500, young = 1e7, poisson = 0.25, work = 0.1;
constexpr double reduced_modulus = young / (1 - poisson * poisson);

VerificationSetup at_wall(CohesionLaw law, double cohesion, double restitution, double overlap, double speed,
                          double dt) {
  VerificationSetup setup;
  Interaction contact;
  contact.restitution = restitution;
  contact.cohesion = cohesion;
  setup.materials.add({"soft", density, young, poisson}, contact);
  setup.materials.add({"wall", density, verification::rigid, poisson}, contact);
  setup.laws.cohesion = law;
  setup.planes.push_back({{}, {0, 0, 1}, 1});
  setup.grains.push_back({{0, 0, radius - overlap}, {0, 0, speed}, {}, radius, 0});
  setup.dt = dt;
  return setup;
}

/// Overlap at which adhesion and elasticity balance, and the time of swings about it.
double rest() { return std::pow(4.5 * pi * work * radius * radius / reduced_modulus, 2.0 / 3) / (3 * radius); }
double swing() {
  return 2 * pi * std::sqrt(sphere_mass(density, radius) / (2 * reduced_modulus * std::sqrt(radius * rest())));
}

void jkr_rows(std::vector<VerificationRow>& rows, const StartEngine& start) {
  const double pull_off = 1.5 * pi * work * radius, mass = sphere_mass(density, radius);
  const double made = start(at_wall(CohesionLaw::jkr, work, 1, 1e-9 * radius, 0, 1e-9))->normal_force(0, first_plane);
  rows.push_back({"jkr: force where the contact is made", -8.0 / 9 * pull_off * 1e6, made * 1e6, 1e-4 * pull_off * 1e6,
                  "uN", jkr});

  const double dt = swing() / 500;
  const auto settled = start(at_wall(CohesionLaw::jkr, work, 0.1, 1e-6 * radius, 0, dt));
  settled->step(20000);
  rows.push_back({"jkr: overlap at rest without load", rest() * 1e9, (radius - settled->position(0).z) * 1e9,
                  1e-4 * rest() * 1e9, "nm", jkr});

  // Thrown off from rest: the greatest pull, the overlap where it breaks, and the speed that is left.
  const double breaks = -0.75 * std::cbrt(pi * pi * work * work * radius / (reduced_modulus * reduced_modulus));
  const double speed = 0.5, short_step = rest() / speed / 1000;
  const auto thrown = start(at_wall(CohesionLaw::jkr, work, 1, rest(), speed, short_step));
  double pull = 0, last = rest();
  for (int i = 0; i < 100000 && last > 2 * breaks; ++i) {
    thrown->step(1);
    const double force = thrown->normal_force(0, first_plane);
    pull = std::min(pull, force);
    if (force == 0) break;
    last = radius - thrown->position(0).z;
  }
  rows.push_back({"jkr: greatest pull", -pull_off * 1e6, pull * 1e6, 1e-4 * pull_off * 1e6, "uN", jkr});
  rows.push_back({"jkr: overlap where the contact breaks", breaks * 1e9, last * 1e9, -3e-3 * breaks * 1e9, "nm", jkr});

  // An elastic impact loses the work of the law from parting to touch, E* c^2 (R* c)^(4/3) (0.3 + 0.2/4^(4/3)) with
  // c = sqrt(2 pi w/E*); that is 7.09 (w^5 R*^4/E*^2)^(1/3).
  const double c = std::sqrt(2 * pi * work / reduced_modulus);
  const double lost = reduced_modulus * c * c * std::pow(radius * c, 4.0 / 3) * (0.3 + 0.2 / std::pow(4, 4.0 / 3));
  const double fast = 3 * std::sqrt(2 * lost / mass);
  const auto hits = start(at_wall(CohesionLaw::jkr, work, 1, -1e-3 * radius, -fast, short_step));
  for (int i = 0; i < 400000 && hits->position(0).z < 1.2 * radius; ++i) hits->step(1);
  rows.push_back({"jkr: speed after an impact", std::sqrt(fast * fast - 2 * lost / mass), hits->velocity(0).z,
                  1e-3 * fast, "m/s", verification::closed_form});
}

void linear_rows(std::vector<VerificationRow>& rows, const StartEngine& start) {
  const double overlap = 0.01 * radius, density_of_energy = 1e4;
  const double linear =
      start(at_wall(CohesionLaw::linear, density_of_energy, 1, overlap, 0, 1e-9))->normal_force(0, first_plane);
  const double expected = 4.0 / 3 * reduced_modulus * std::sqrt(radius) * std::pow(overlap, 1.5) -
                          density_of_energy * pi * radius * overlap;
  rows.push_back({"linear cohesion: force", expected * 1e6, linear * 1e6, 1e-6 * std::abs(expected) * 1e6, "uN",
                  verification::closed_form});
}

}  // namespace

std::vector<VerificationCase> adhesion_cases() { return {{{"jkr"}, jkr_rows}, {{"linear cohesion"}, linear_rows}}; }

}  // namespace soilbin::dem
