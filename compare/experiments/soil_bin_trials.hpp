// Candidates of a calibration, decided by the virtual soil bin: each one's wheel beside a measured one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/calibrate/calibration.hpp"
#include "compare/calibrate/contact_values.hpp"
#include "compare/calibrate/decision.hpp"
#include "compare/experiments/soil_bin_runs.hpp"
#include "dem/rig/dem_model.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// Which contact of which soil, and what was measured with it.
struct TrialQuestion {
  Soil soil;  ///< with grains
  ContactKind kind = ContactKind::grain_tire;
  std::vector<Factor> factors;      ///< what the candidates' values belong to
  Campaign campaign;                ///< its wheel, and its bin where it tells one
  std::vector<Setpoint> setpoints;  ///< of the campaign: those that are run
};

struct TrialSettings {
  dem::DemSettings bin;  ///< its packing is the first bed's seed
  int packings = 1;      ///< beds on which each candidate runs
  std::filesystem::path
      records;  ///< folder that gets a record of each candidate (docs/guide/recorded.md); empty: none is kept
  std::string version, source;  ///< of soilbin and of the sources that it was built from
  Watch watch{};                ///< of each run: "soil bin: candidate B of 3, run 4 of 12"
};

/// Refuses what no run could answer, before hours are spent: a soil without grains, no setpoint, a wheel that can't be
/// meshed, a condition that the rig can't make, a bed too short or narrow. Throws InputError with a hint.
void check(const TrialQuestion& question, const TrialSettings& settings);

/// A candidate's case: the soil with its values in the contact, the campaign's wheel, the setpoints.
Case trial_case(const TrialQuestion& question, const Eigen::VectorXd& values);

/// Runs every candidate at every setpoint, candidate by candidate, or takes it from the records: the same question and
/// records give the same decision, whether it was stopped in between or not. Throws as check, and what `watch` throws.
Decision decide_in_soil_bin(const TrialQuestion& question, const TrialSettings& settings,
                            const std::vector<Candidate>& candidates, const EffectVocabulary& effects);

}  // namespace soilbin::compare
