// Flags of `calibrate` that say which contact of a soil is calibrated, by which virtual test: the triaxial cell, the
// shear box or plates for sand on sand, the tilting board for tire on sand.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/element_test_flags.hpp"
#include "cli/soil_bin.hpp"
#include "cli/workplace.hpp"
#include "compare/experiments/element_experiments.hpp"
#include "compare/experiments/soil_bin_trials.hpp"

namespace soilbin::cli {

/// As typed; empty: the default.
struct ContactTestFlags {
  std::string soil, contact = "sand", strength_test = "triaxial", strength = "peak", settling_friction = "1",
                    stresses = "10kPa,20kPa,40kPa";
  std::string rolling;
  MeasuredFlags measured;
  std::string features;
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

// Flags of `calibrate` that let the soil bin decide between candidates.

/// The flags as typed; empty: the default.
struct DecisionFlags {
  std::string campaign;         ///< empty: nobody decides
  std::vector<std::string> at;  ///< NAME=LOW..HIGH of a member of the condition
  int packings = 1;
  SoilBinFlags bin;  ///< settling friction and threads are of those who have such flags anyway

  void add_to(CLI::App& command);
  bool given() const { return !campaign.empty(); }

  /// The campaign with the setpoints that are asked for, and its bin where no flag says otherwise. The contact is the
  /// caller's. Throws InputError that names the flag.
  compare::TrialQuestion question(const Workplace& place) const;
  /// Beds from this seed on; each candidate's record goes into `records`.
  compare::TrialSettings settings(std::uint64_t seed, std::filesystem::path records) const;
};

}  // namespace soilbin::cli
