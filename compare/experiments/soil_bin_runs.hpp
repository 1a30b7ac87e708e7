// Runs of the virtual soil bin as answers: kept in a record, shown by a replay, taken from a record in their place.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/experiments/replay_recorder.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/recorded/run_list.hpp"
#include "dem/rig/dem_model.hpp"
#include "dem/rig/step_criteria.hpp"

namespace soilbin::compare {

/// Runs conditions, with a model for each packing, so that a bed is taken once. A RunOnce: what grains can't answer
/// (NoSolution, RunStopped) is a run whose answer carries the error. Where runs are kept (DemSettings::checkpoints) a
/// finished one can be had again until its on_saved is called.
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
  std::shared_ptr<dem::WheelRun> last_ = std::make_shared<dem::WheelRun>();
  std::map<std::uint64_t, std::unique_ptr<dem::DemModel>> models_;
};

/// What is kept of runs beside their answers, and who made them.
struct RunKeeping {
  std::filesystem::path
      record;  ///< gets each run as it is finished, and is gone on with (kept_in); empty: none is kept
  std::filesystem::path replay;    ///< file that gets the first run that is made, to look at; empty: none is kept
  std::filesystem::path paraview;  ///< folder that gets each run that is made, as ParaView opens it; empty: none
  std::string version, source;     ///< of soilbin and of the sources that it was built from
  std::vector<std::filesystem::path> known{};  ///< records whose runs are not made again
  Writers writers = Writers::several;          ///< of the record
};

/// Reads records of runs with these inputs. Throws InputError that names the file for one with others.
std::vector<Record> read_records(const std::vector<std::filesystem::path>& files, const Inputs& inputs);

/// Runs conditions of a question with these settings, and keeps them. A record that is begun holds `question` whole.
RunOnce run_once(const dem::DemSettings& settings, const Case& question, const EffectVocabulary& effects,
                 const RunKeeping& keeping);

/// The settings with half the time step, on the same beds.
dem::DemSettings at_half_step(dem::DemSettings settings, const Scenario& scenario);

/// Most packings that a command takes, and most runs of one study.
inline constexpr int most_packings = 10'000;
inline constexpr std::size_t most_runs = 20'000;

/// Seeds of so many packings, from that of the settings on. Throws InputError for more than most_packings.
std::vector<std::uint64_t> packings_from(const dem::DemSettings& settings, int packings);

/// A study with so many runs is recorded only after a test of its time step, which costs three of them.
inline constexpr std::size_t runs_that_pay_a_test = 12;
/// Whether the runs of a question's conditions begin with a test of the time step: as it is asked, else by their
/// number.
TestStep test_of_step(const Case& question, int packings, std::optional<bool> asked);

/// The runs of a question's conditions on so many packings (run_list), with a test of the step as test_of_step says.
/// Throws InputError for more than most_runs.
std::vector<AskedRun> list_of(const Case& question, const dem::DemSettings& settings, int packings,
                              std::optional<bool> test = {});

/// list_of, for runs that are to be made.
/// Throws InputError for a condition that no wheel in the bin can be run at, and for a bin that leaves it no way.
std::vector<AskedRun> runs_of(const Case& question, const dem::DemSettings& settings, int packings,
                              std::optional<bool> test = {});

/// Called before a run of a list is made: its place in the list, from 0, and what it is.
using BeforeRun = std::function<void(std::size_t place, const AskedRun& run)>;

/// Makes the runs of a list, in its order, that are neither in keeping.record, which must be given, nor in a record of
/// keeping.known; each is in the record as soon as it is finished. `question`: what a record that is begun holds. Once
/// both runs of a pair of the time step are there, throws TimeStepMatters where they are not alike (step_pair.hpp).
void make_runs(const std::vector<AskedRun>& list, const dem::DemSettings& settings, const Case& question,
               const EffectVocabulary& effects, const RunKeeping& keeping, const BeforeRun& before = {});

/// The model dem on `packings` beds of the seeds from settings.packing on.
std::unique_ptr<const Model> soil_bin_model(const dem::DemSettings& settings, int packings, RunOnce run,
                                            RunListener on_run);

/// Throws InputError where the tire or the grains of a record, which was read from `file`, are not the scenario's.
void refuse_other_grains(const Record& record, const Scenario& scenario, const std::filesystem::path& file);

/// The model dem as a record has it; bed and rig are the record's. Throws as refuse_other_grains.
std::unique_ptr<const Model> recorded_soil_bin(Record record, const Scenario& scenario,
                                               const std::filesystem::path& file, RunListener on_run);

/// How dense the runs' beds are between the loosest and the densest of these grains, where the folder of beds holds
/// those two (`soilbin bed` makes them); "" elsewhere.
std::string relative_density_of(const std::vector<RecordedRun>& runs, const Soil& soil,
                                const std::filesystem::path& beds);

/// The time step that runs of a question take (that of the record, where it is given) beside the Rayleigh time and how
/// long an impact lasts at the fastest rim; no value where none of the question's models is dem.
std::optional<dem::StepCriteria> step_of(dem::DemSettings settings, const Case& question,
                                         const std::filesystem::path& record);
std::string in_words(const dem::StepCriteria& step);
nlohmann::ordered_json to_json(const dem::StepCriteria& step);

/// The runs of a case, kept in keeping's record (kept_in), which is begun by its version of soilbin.
RunOnce kept_runs(const RunKeeping& keeping, const dem::DemSettings& settings, const Case& question,
                  const EffectVocabulary& effects, RunOnce run, RunList list = &Record::runs);

/// What a run follows from beside condition and packing.
Inputs inputs_of(const dem::DemSettings& settings, const Scenario& scenario);

}  // namespace soilbin::compare
