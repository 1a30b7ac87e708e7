// Flags of `calibrate` that say which contact of a soil is calibrated, by which virtual test: the triaxial cell or the
// shear box for sand on sand, the tilting board for tire on sand.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "cli/workplace.hpp"
#include "compare/experiments/element_experiments.hpp"

namespace soilbin::cli {

/// As typed; empty: the default.
struct ContactTestFlags {
  std::string soil, contact = "sand", strength_test = "triaxial", strength = "peak", settling_friction = "1",
                    stresses = "10kPa,20kPa,40kPa";
  std::string rolling;
  std::string curves, tests, features;
  std::vector<std::string> targets, bounds, kept;
  int packings = 0, threads = 0, across = 16;

  void add_to(CLI::App& command);

  // Each throws InputError that names its flag.
  compare::ContactKind kind() const;
  /// The soil with the rolling resistance that is asked for, as if it were its own.
  Soil soil_with_grains(const Workplace& place) const;
  /// progress: of each run of it.
  compare::VirtualTest test(const Soil& soil, std::function<void(const dem::Progress&)> progress) const;
};

}  // namespace soilbin::cli
