// Runs of the virtual soil bin for a record.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "compare/recorded/recorded_model.hpp"
#include "dem/rig/dem_model.hpp"

namespace soilbin::compare {

/// Runs conditions, with a model for each packing, so that a bed is taken once. A RunOnce: what grains can't answer
/// (NoSolution, RunStopped) is a run whose answer carries the error. Where runs are kept (DemSettings::checkpoints) a
/// finished one can be had again until its when_safe is called.
class SoilBinRuns {
 public:
  /// `source`: state of the sources that the program was built from. The packing, on_run and forget_finished of
  /// `settings` are not read.
  SoilBinRuns(dem::DemSettings settings, std::string source);
  RecordedRun operator()(const Scenario& scenario, const OperatingCondition& at, std::uint64_t packing);

 private:
  const dem::DemModel& model(std::uint64_t packing);

  dem::DemSettings settings_;
  std::string source_;
  std::shared_ptr<dem::WheelRun> told_ = std::make_shared<dem::WheelRun>();
  std::map<std::uint64_t, std::unique_ptr<dem::DemModel>> models_;
};

/// The runs of a case, kept in a file (kept_in) that is begun by `version` of soilbin.
RunOnce kept_runs(const std::filesystem::path& file, const dem::DemSettings& settings, const Case& question,
                  const EffectVocabulary& effects, std::string version, RunOnce run);

/// What a run follows from beside condition and packing.
Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario);

}  // namespace soilbin::compare
