// Runs of the virtual soil bin as answers: kept in a record, shown by a replay, taken from a record in their place.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "compare/experiments/replay_recorder.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "dem/rig/dem_model.hpp"
#include "dem/rig/step_criteria.hpp"

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

/// What is kept of runs beside their answers, and who made them.
struct RunKeeping {
  std::filesystem::path
      record;  ///< gets each run as it is finished, and is gone on with (kept_in); empty: none is kept
  std::filesystem::path replay;    ///< file that gets the first run that is made, to look at; empty: none is kept
  std::filesystem::path paraview;  ///< folder that gets each run that is made, as ParaView opens it; empty: none
  std::string version, source;     ///< of soilbin and of the sources that it was built from
};

/// Runs conditions of a question with these settings, and keeps them. A record that is begun holds `question` whole.
RunOnce run_once(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                 const RunKeeping& keeping);

/// The settings with half the time step, on the same beds.
dem::DemSettings at_half_step(dem::DemSettings settings, const Scenario& scenario);

/// Answers the hardest of the question's conditions on the first packing, at the time step and at half of it, and keeps
/// both in keeping.record, which must be given. Throws std::runtime_error where they are not alike (step_pair.hpp).
void test_time_step(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                    const RunKeeping& keeping);
/// A study with so many runs is recorded only after this test, which costs three of them.
inline constexpr std::size_t runs_that_pay_a_test = 12;

/// The model dem on `packings` beds of the seeds from settings.packing on.
std::unique_ptr<const Model> soil_bin_model(const dem::DemSettings& settings, int packings, RunOnce run,
                                            RunListener on_run);

/// The model dem as a record has it, which was read from `file`. Throws InputError where its tire or its grains are not
/// the scenario's; bed and rig are the record's.
std::unique_ptr<const Model> recorded_soil_bin(Record record, const Scenario& scenario,
                                               const std::filesystem::path& file, RunListener on_run);

/// The time step that runs of a question take (that of the record, where it is given) beside the Rayleigh time and how
/// long an impact lasts at the fastest rim; no value where none of the question's models is dem.
std::optional<dem::StepCriteria> step_of(dem::DemSettings settings, const Case& question,
                                         const std::filesystem::path& record);
std::string in_words(const dem::StepCriteria& step);
nlohmann::ordered_json to_json(const dem::StepCriteria& step);

/// The runs of a case, kept in a file (kept_in) that is begun by `version` of soilbin.
RunOnce kept_runs(const std::filesystem::path& file, const dem::DemSettings& settings, const Case& question,
                  const EffectVocabulary& effects, std::string version, RunOnce run, RunList list = &Record::runs);

/// What a run follows from beside condition and packing.
Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario);

}  // namespace soilbin::compare
