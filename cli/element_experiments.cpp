#include "cli/element_experiments.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

using compare::ContactKind;
using Eigen::VectorXd;

GranularSoil with_values(const ElementExperiment& experiment, ContactKind kind, const VectorXd& values) {
  GranularSoil soil = experiment.soil;
  for (std::size_t j = 0; j < experiment.factors.size(); ++j)
    compare::value_of(compare::pair_of(soil, kind), experiment.factors[j].name) = values[static_cast<Eigen::Index>(j)];
  return soil;
}

/// All of a soil that a test may read, with what is varied set to 0.
std::string soil_text(const ElementExperiment& experiment, ContactKind kind) {
  GranularSoil soil =
      with_values(experiment, kind, VectorXd::Zero(static_cast<Eigen::Index>(experiment.factors.size())));
  std::string text = fmt::format("radii {} {}, density {}, E {}, nu {}", soil.radius_min, soil.radius_max,
                                 soil.grain_density, soil.youngs_modulus, soil.poisson_ratio);
  const auto add = [&](const char* name, const ContactPair& pair) {
    text += fmt::format("\n{} {} {} {} {}", name, pair.restitution, pair.sliding_friction, pair.rolling_friction,
                        pair.cohesion);
  };
  add("grain_grain", soil.grain_grain);
  if (kind == ContactKind::grain_tire) add("grain_tire", soil.grain_tire);
  return text;
}

std::string laws_text(const dem::ContactLaws& laws) {
  return fmt::format("laws {} {} {} {}", static_cast<int>(laws.normal), static_cast<int>(laws.rolling),
                     static_cast<int>(laws.cohesion), laws.tangential_damping);
}

compare::VirtualTest test_of(const ElementExperiment& experiment, std::string identity) {
  compare::VirtualTest test;
  test.identity = std::move(identity);
  test.factors = experiment.factors;
  test.targets = experiment.targets;
  return test;
}

/// What the engine had to stop is an experiment without an answer.
template <class Run>
std::vector<Estimate> answered(const Run& run) {
  try {
    return run();
  } catch (const dem::RunStopped& stopped) {
    throw NoSolution(stopped.what());
  }
}

Estimate mean_of(const std::vector<double>& values) {
  double mean = 0.0, square = 0.0;
  const double n = static_cast<double>(values.size());
  for (const double value : values) mean += value / n;
  for (const double value : values) square += (value - mean) * (value - mean) / (n - 1);
  return {mean, std::sqrt(square / n)};
}

}  // namespace

compare::VirtualTest shear_box_test(const ElementExperiment& experiment, const dem::DirectShearSettings& settings,
                                    Strength strength) {
  const dem::SpecimenSettings& s = settings.specimen;
  compare::VirtualTest test = test_of(
      experiment,
      fmt::format("direct shear, {} strength\n{}\n{}\nsettling friction {}, dt {}, packings {}\nbox {} {} {}, stresses "
                  "{}, travel {}, inertial {}, residual share {}, peak window {}",
                  strength == Strength::peak ? "peak" : "residual", soil_text(experiment, ContactKind::grain_grain),
                  laws_text(s.laws), s.settling_friction, s.dt, settings.packings, settings.length, settings.width,
                  settings.height, fmt::join(settings.stresses, " "), settings.travel, settings.inertial,
                  settings.residual_share, settings.peak_window));
  test.run = [=](const VectorXd& values, std::uint64_t seed) {
    return answered([&] {
      dem::DirectShearSettings own = settings;
      own.specimen.packing = 1 + (seed - 1) * static_cast<std::uint64_t>(settings.packings);
      const dem::DirectShearResult result =
          dem::direct_shear(with_values(experiment, ContactKind::grain_grain, values), own, experiment.how);
      const dem::StrengthLine& line = strength == Strength::peak ? result.peak : result.residual;
      std::vector<Estimate> answer;
      for (const compare::Target& target : experiment.targets)
        answer.push_back(target.name == "cohesion" ? line.cohesion : line.friction_angle);
      return answer;
    });
  };
  return test;
}

compare::VirtualTest tilting_board_test(const ElementExperiment& experiment, const dem::TiltingBoardSettings& settings,
                                        int packings) {
  if (packings < 2) throw InputError("--packings: an angle with an error needs at least two boards");
  compare::VirtualTest test = test_of(
      experiment,
      fmt::format("tilting board\n{}\n{}\nacross {}, layers {}, packings {}, rate {}, onset {}, gone {}, steepest {}, "
                  "dt {}, gravity {}",
                  soil_text(experiment, ContactKind::grain_tire), laws_text(settings.laws), settings.across,
                  settings.layers, packings, settings.rate, settings.onset, settings.gone, settings.steepest,
                  settings.dt, settings.gravity));
  test.run = [=](const VectorXd& values, std::uint64_t seed) {
    return answered([&] {
      std::vector<double> angles;
      for (int k = 0; k < packings; ++k) {
        dem::TiltingBoardSettings own = settings;
        own.packing = 1 + (seed - 1) * static_cast<std::uint64_t>(packings) + static_cast<std::uint64_t>(k);
        const dem::TiltingBoardResult result =
            dem::tilting_board(with_values(experiment, ContactKind::grain_tire, values), own, experiment.how);
        if (!result.slid) throw NoSolution("the sand holds up to the steepest tilt");
        angles.push_back(result.onset);
      }
      return std::vector<Estimate>{mean_of(angles)};
    });
  };
  return test;
}

std::vector<std::string> target_names(ContactKind kind) {
  if (kind == ContactKind::grain_tire) return {"board_angle"};
  return {"friction_angle", "cohesion"};
}

std::string unit_of_target(const std::string& name) { return name == "cohesion" ? "kPa" : "deg"; }

std::vector<compare::Factor> usual_factors(ContactKind kind) {
  if (kind == ContactKind::grain_tire)
    return {{"restitution", 0.3, 0.7, "-"}, {"sliding_friction", 0.3, 0.9, "-"}, {"rolling_friction", 0.1, 0.7, "-"}};
  return {{"sliding_friction", 0.1, 0.9, "-"}, {"rolling_friction", 0.0, 0.5, "-"}, {"cohesion", 0.0, 1e6, "kJ/m^3"}};
}

}  // namespace soilbin::cli
