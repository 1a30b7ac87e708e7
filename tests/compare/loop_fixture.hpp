// Campaigns made in the test: the base model with chosen effects at chosen conditions, plus normal noise.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/measured/campaign.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// A 250 mm wheel on dry sand, soil known to a few per cent, as in the contract's example.
inline Campaign sand_campaign() {
  Campaign c;
  c.name = "made";
  c.wheel.radius = 0.25;
  c.wheel.width = 0.10;
  c.soil.exponent = {1.10, 0.05};
  c.soil.k_c = {990, 300};
  c.soil.k_phi = {1528e3, 150e3};
  c.soil.cohesion = {1040, 300};
  c.soil.friction_angle = {28 * degree, 1.5 * degree};
  c.soil.shear_modulus = {0.020, 0.006};
  c.soil.stress_angle_c1 = {0.18, 0.08};
  c.soil.stress_angle_c2 = {0.32, 0.08};
  c.soil.density = 1600;
  return c;
}

/// Slips x loads, each setpoint run twice; pass, position and run order vary as well.
inline std::vector<OperatingCondition> sweep() {
  std::vector<OperatingCondition> rows;
  int run = 0;
  for (const double load : {600.0, 1000.0, 1500.0})
    for (const double slip : {0.05, 0.12, 0.2, 0.3, 0.42, 0.55, 0.7}) {
      OperatingCondition at;
      at.load = load;
      at.slip = slip;
      at.pass = 1 + (run % 3 == 2);
      at.position = 0.5 + 0.37 * (run % 7);
      rows.push_back(at);
      rows.push_back(at);
      ++run;
    }
  return rows;
}

/// Noise: standard deviations of the four channels [N, N m, m, N].
using Noise = std::array<double, 4>;
inline constexpr Noise fine_noise = {6.0, 2.0, 4e-4, 4.0};

/// Runs of the truth (declared soil moved by `shift` sd each, with effects) at the rows, in shuffled order.
inline void measure(Campaign& campaign, const std::vector<OperatingCondition>& rows,
                    const std::vector<EffectChoice>& effects, const Noise& noise, std::uint64_t seed,
                    double shift = 0.5) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  SemiEmpiricalSoil truth = campaign.soil;
  for (Estimate* e : {&truth.exponent, &truth.k_phi, &truth.cohesion, &truth.friction_angle, &truth.shear_modulus,
                      &truth.stress_angle_c1, &truth.stress_angle_c2})
    e->value += shift * e->std_error * (random() % 2 == 0 ? 1 : -1);
  const bekker_wong::RollingWheel wheel(campaign.wheel, bekker_wong::values_of(truth),
                                        bekker_wong::make_effects(effects), campaign.bin);
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  campaign.runs.clear();
  for (std::size_t k = 0; k < order.size(); ++k) {
    Run run;
    run.at = rows[order[k]];
    run.at.run = static_cast<int>(k + 1);
    run.setpoint = fmt::format("S{}", order[k] / 2);
    const bekker_wong::Reading r = wheel.roll(run.at).reading;
    run.drawbar_pull = r.drawbar_pull + noise[0] * normal(random);
    run.torque = r.torque + noise[1] * normal(random);
    run.sinkage = r.sinkage + noise[2] * normal(random);
    if (run.at.yaw != 0.0) run.lateral_force = r.lateral_force + noise[3] * normal(random);
    campaign.runs.push_back(run);
  }
}

}  // namespace soilbin::compare
