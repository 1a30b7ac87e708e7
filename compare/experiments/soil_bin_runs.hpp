// Runs of the virtual soil bin as answers: what a study asks of it, who makes the runs, where they are kept.
//
//   RunStore store = store_of(settings, question, effects, keeping);
//   SoilBinRuns bin(settings, keeping);
//   for (const RunSpec& spec : specs(question, settings, packings)) obtain(spec, question.scenario, store, bin);
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/experiments/replay_recorder.hpp"
#include "compare/recorded/run_store.hpp"
#include "compare/recorded/watch.hpp"
#include "dem/rig/dem_model.hpp"
#include "dem/rig/step_criteria.hpp"

namespace soilbin::compare {

/// Files that keep runs, and who made the runs.
struct RunKeeping {
  std::filesystem::path record{};    ///< gets each run as it is finished, and is gone on with (RunStore); empty: none
  std::filesystem::path replay{};    ///< file that gets the first run that is made, to look at; empty: none is kept
  std::filesystem::path paraview{};  ///< folder that gets each run that is made, as ParaView opens it; empty: none
  std::string version{}, source{};   ///< of soilbin and of the sources that it was built from
  std::vector<std::filesystem::path> known{};  ///< records whose runs are not made again
  Writers writers = Writers::several;          ///< of the record
};

/// Makes runs, with a model for each packing and step, so that a bed is taken once, and keeps what can be looked at of
/// those at the whole step. What grains can't answer (NoSolution, RunStopped) is a run whose answer carries the error.
/// Where runs are kept (DemSettings::checkpoints) a finished one can be had again until its on_saved is called.
class SoilBinRuns {
 public:
  /// The packing, on_run and forget_finished of `settings` are not read.
  SoilBinRuns(dem::DemSettings settings, const RunKeeping& keeping);
  SoilBinRuns(const SoilBinRuns&) = delete;
  SoilBinRuns& operator=(const SoilBinRuns&) = delete;
  RecordedRun operator()(const Scenario& scenario, const RunSpec& spec);

 private:
  const dem::DemModel& model(const Scenario& scenario, const RunSpec& spec);

  dem::DemSettings settings_;
  ReplayKeeping replay_;
  std::filesystem::path paraview_;
  std::string name_;  ///< of the run that is made, for its files
  ReplayRecorder recorder_;
  dem::WheelRun last_;
  std::map<std::pair<std::uint64_t, RunKind>, std::unique_ptr<dem::DemModel>> models_;
};

/// The store of a question's runs with these settings: keeping.record, which is begun with the question whole, or
/// memory; keeping.known is known. Throws InputError where inputs differ.
RunStore store_of(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                  const RunKeeping& keeping);

/// The run of a spec: the store's, or made now and added to it. Throws TimeStepMatters where it is the second of a pair
/// of the time step, and they are not alike (step_pair.hpp).
RecordedRun obtain(const RunSpec& spec, const Scenario& scenario, RunStore& store, SoilBinRuns& bin);

/// The scenario with grains coarser_by times as large, all else alike: with the same contacts they are the same sand
/// (docs/lab/grain-size.md).
Scenario with_coarser_grains(Scenario scenario);

/// The settings with half the time step, on the same beds.
dem::DemSettings at_half_step(dem::DemSettings settings, const Scenario& scenario);

/// Most packings that a command takes, and most runs of one study.
inline constexpr int most_packings = 10'000;
inline constexpr std::size_t most_runs = 20'000;

/// Seeds of so many packings, from that of the settings on. Throws InputError for more than most_packings.
std::vector<std::uint64_t> packings_from(const dem::DemSettings& settings, int packings);

/// A study with so many runs is recorded only after a test of its time step, which costs three of them.
inline constexpr std::size_t runs_that_pay_a_test = 12;

/// The runs of a question's conditions on so many packings, with a test of the time step as it is asked, else by their
/// number. Throws InputError for more than most_runs.
std::vector<RunSpec> specs(const Case& question, const dem::DemSettings& settings, int packings,
                           std::optional<bool> test = {}, Twins twins = Twins::no);

/// Throws InputError for a condition that no wheel in the bin can be run at, and for a bin that leaves it no way; with
/// twins also where a bin is too small for their grains.
void check_runs(const Case& question, const dem::DemSettings& settings, Twins twins = Twins::no);

/// Throws InputError where the tire or the grains of a record, which was read from `file`, are not the scenario's.
void refuse_other_grains(const Record& record, const Scenario& scenario, const std::filesystem::path& file);

/// How dense the runs' beds are between the loosest and the densest of these grains, where the folder of beds holds
/// those two (`soilbin bed` makes them); "" elsewhere.
std::string relative_density_of(const std::vector<RecordedRun>& runs, const Soil& soil,
                                const std::filesystem::path& beds);

/// The time step that runs of a question take (that of the record, where it is given) beside the Rayleigh time and how
/// long an impact lasts at the fastest rim; no value where none of the question's models is dem.
std::optional<dem::StepCriteria> step_of(dem::DemSettings settings, const Case& question,
                                         const std::filesystem::path& record);
nlohmann::ordered_json to_json(const dem::StepCriteria& step);

/// The inputs of a run beside condition and packing.
Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario);

}  // namespace soilbin::compare
