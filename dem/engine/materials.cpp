#include "dem/engine/materials.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "dem/surface/positive.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

void require(bool holds, const std::string& name, const char* what) {
  if (!holds) throw InputError(fmt::format("material {}: {}", name, what));
}

void check(const Material& m) {
  require(positive(m.density), m.name, "the density must be above 0");
  require(positive(m.young), m.name, "Young's modulus must be above 0");
  require(m.poisson > -1 && m.poisson <= 0.5, m.name, "Poisson's ratio must lie in (-1, 0.5]");
}

void check(const Interaction& c, const std::string& pair) {
  require(c.restitution >= 0 && c.restitution <= 1, pair, "the restitution must lie in [0, 1]");
  const auto not_negative = [&](double value, const char* what) {
    if (!(value >= 0 && std::isfinite(value)))
      throw InputError(fmt::format("material {}: the {} must be 0 or more and finite, not {}", pair, what, value));
  };
  not_negative(c.sliding_friction, "sliding friction");
  not_negative(c.rolling_friction, "rolling friction");
  not_negative(c.rolling_damping, "rolling damping");
  not_negative(c.rolling_stiffness, "rolling stiffness");
  not_negative(c.rolling_viscosity, "rolling viscosity");
  not_negative(c.cohesion, "cohesion");
  not_negative(c.normal_stiffness, "normal stiffness");
  not_negative(c.shear_stiffness, "shear stiffness");
}

}  // namespace

int Materials::add(Material material, const Interaction& with_all) {
  check(material);
  if (all.size() == most_materials) throw InputError(fmt::format("no more than {} materials in a run", most_materials));
  check(with_all, material.name);
  const std::size_t n = all.size();
  std::vector<Interaction> wider((n + 1) * (n + 1), with_all);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) wider[a * (n + 1) + b] = interactions[a * n + b];
  interactions = std::move(wider);
  all.push_back(std::move(material));
  return static_cast<int>(n);
}

void Materials::set(int a, int b, const Interaction& interaction) {
  check(interaction, all.at(a).name + " on " + all.at(b).name);
  interactions[a * all.size() + b] = interactions[b * all.size() + a] = interaction;
}

double reduced_young(const Material& a, const Material& b) {
  return 1 / ((1 - a.poisson * a.poisson) / a.young + (1 - b.poisson * b.poisson) / b.young);
}

double reduced_shear(const Material& a, const Material& b) {
  return 1 / (2 * (2 - a.poisson) * (1 + a.poisson) / a.young + 2 * (2 - b.poisson) * (1 + b.poisson) / b.young);
}

double damping_share(double restitution) {
  if (restitution <= 0) return 1;
  const double log_e = std::log(restitution);
  return -log_e / std::sqrt(log_e * log_e + pi * pi);
}

LawConstants<double> law_constants(const Materials& materials, const ContactLaws& laws, int a, int b,
                                   double largest_radius) {
  const Interaction& pair = materials.between(a, b);
  const double young = reduced_young(materials.all[a], materials.all[b]);
  const double shear = reduced_shear(materials.all[a], materials.all[b]);
  const double beta = damping_share(pair.restitution);
  LawConstants<double> c{};
  if (laws.normal == NormalLaw::hooke) {
    if (pair.normal_stiffness <= 0)
      throw InputError(
          fmt::format("hooke: {} on {} has no normal stiffness", materials.all[a].name, materials.all[b].name));
    c.normal = pair.normal_stiffness;
    c.damping = 2 * beta * std::sqrt(pair.normal_stiffness);
    c.shear = pair.shear_stiffness;
    c.shear_damping = 2 * beta * std::sqrt(pair.shear_stiffness);
  } else {
    const double mindlin = 2 * std::sqrt(5.0 / 6) * beta;
    c.normal = 4.0 / 3 * young;
    c.damping = mindlin * std::sqrt(2 * young);
    c.shear = 8 * shear;
    c.shear_damping = mindlin * std::sqrt(8 * shear);
  }
  if (laws.tangential_damping >= 0) c.shear_damping = laws.tangential_damping * c.damping;
  c.sliding = pair.sliding_friction;
  c.rolling = pair.rolling_friction;
  c.roll_stiffness = pair.rolling_stiffness;
  c.roll_damping = laws.rolling == RollingLaw::spring_slider ? pair.rolling_viscosity : pair.rolling_damping;
  if (laws.cohesion == CohesionLaw::linear) c.cohesion = pi * pair.cohesion;
  if (laws.cohesion == CohesionLaw::jkr) {
    c.adhesion_force = std::sqrt(8 * pi * pair.cohesion * young);
    c.adhesion_overlap = std::sqrt(2 * pi * pair.cohesion / young);
    c.adhesion_start = std::cbrt(c.adhesion_overlap * largest_radius);
    c.pull_off = 3 * pi * pair.cohesion;
  }
  return c;
}

double adhesion_reach(const LawConstants<double>& constants, double radius) {
  const double b2 = constants.adhesion_overlap * constants.adhesion_overlap;
  return 0.75 * std::cbrt(b2 * b2 * radius / 4);
}

}  // namespace soilbin::dem
