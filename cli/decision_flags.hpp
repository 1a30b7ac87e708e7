// Flags of `calibrate` that let the soil bin decide between candidates.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/soil_bin.hpp"
#include "cli/workplace.hpp"
#include "compare/experiments/soil_bin_trials.hpp"

namespace soilbin::cli {

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
