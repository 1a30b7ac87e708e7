#include "dem/worker_lammps/pair_commands.hpp"

#include <fmt/core.h>

#include <cmath>

#include "dem/bed/settled_bed.hpp"
#include "dem/engine/simulation.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

void refuse(bool has_none, const char* law) {
  if (has_none)
    throw InputError(
        fmt::format("LAMMPS has no counterpart of {}\n  hint: elastic_plastic rolling resistance, Hertz "
                    "contacts, no or linear cohesion, no twisting; or --engine soilbin",
                    law));
}

void check(const ContactLaws& laws) {
  refuse(laws.normal != NormalLaw::hertz, "linear normal springs (hooke)");
  refuse(laws.cohesion == CohesionLaw::jkr, "the engine's JKR adhesion");
  refuse(laws.twisting != TwistingLaw::none, "twisting resistance as the engine computes it");
  refuse(laws.rolling != RollingLaw::elastic_plastic && laws.rolling != RollingLaw::none,
         "this soil's rolling resistance");
}

double mean(const std::vector<Motion>& grains, std::size_t count, double (*of)(const Motion&)) {
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += of(grains[k]);
  return sum / static_cast<double>(count);
}

double mean_radius(const Grains& grains) {
  return mean(grains.motion, grains.count(), [](const Motion& m) { return m.radius; });
}

}  // namespace

double tsuji_restitution(double alpha) {
  const auto polynomial = [](double e) {
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
  };
  double low = -0.2, high = 1.1;  // it falls from 2.6 to below 0 there
  for (int turn = 0; turn < 100; ++turn) {
    const double middle = (low + high) / 2;
    (polynomial(middle) > alpha ? low : high) = middle;
  }
  return (low + high) / 2;
}

double mean_contact_radius(const Setup& setup, const State& state) {
  const Simulation simulation(setup, state);
  std::vector<double> radii(state.next_id);
  for (std::size_t k = 0; k < state.grains.count(); ++k) radii[state.grains.id[k]] = state.grains.motion[k].radius;
  double sum = 0;
  std::size_t count = 0;
  for (const Contact& contact : simulation.contacts()) {
    if (contact.second < 0) continue;
    const double a = radii[contact.first], b = radii[static_cast<std::size_t>(contact.second)];
    sum += std::sqrt(a * b / (a + b) * contact.overlap), ++count;
  }
  if (count > 0) return sum / static_cast<double>(count);
  const double radius = mean_radius(state.grains);
  return std::sqrt(radius / 2 * 1e-3 * radius);
}

RollingSpring rolling_spring(const Setup& setup, const Grains& grains, double contact) {
  const Interaction& pair = setup.materials.between(grain_material, grain_material);
  const Material& material = setup.materials.all[grain_material];
  const double radius = mean_radius(grains) / 2;  // R* of two of them
  const double mass = mean(grains.motion, grains.count(), [](const Motion& m) { return 1 / m.inverse_mass; });
  const double normal = 4.0 / 3 * reduced_young(material, material) * contact;
  const double reach = pair.rolling_friction * radius;
  const double stiffness = 2.25 * normal * reach * reach;                 // [N m/rad]
  const double inertia = 0.5 * 0.4 * mass * (2 * radius) * (2 * radius);  // I* of two of them
  const double damping = 2 * pair.rolling_damping * std::sqrt(3.5 * inertia * stiffness);
  return {stiffness / (radius * radius), damping / (radius * radius)};
}

std::vector<std::string> pair_commands(const Setup& setup, const RollingSpring& rolling) {
  check(setup.laws);
  const Material& material = setup.materials.all[grain_material];
  const Interaction& pair = setup.materials.between(grain_material, grain_material);
  const double young = reduced_young(material, material), shear = reduced_shear(material, material);
  const double alpha = std::sqrt(5.0) * damping_share(pair.restitution);
  const double along =
      setup.laws.tangential_damping >= 0 ? setup.laws.tangential_damping : 2 * std::sqrt(shear / young);
  std::string law = fmt::format("pair_coeff * * hertz/material {} {} {} tangential mindlin NULL {} {}", material.young,
                                tsuji_restitution(alpha), material.poisson, along, pair.sliding_friction);
  if (setup.laws.rolling == RollingLaw::elastic_plastic && pair.rolling_friction > 0)
    law += fmt::format(" rolling sds {} {} {}", rolling.stiffness, rolling.damping, pair.rolling_friction);
  return {"pair_style granular", law + " damping tsuji"};
}

}  // namespace soilbin::dem
