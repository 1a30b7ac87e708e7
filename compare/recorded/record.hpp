// A study's answers by a model that takes minutes a condition, kept in a file: soilbin-recorded/1,
// docs/guide/recorded.md. Whoever compares answers gets them from the file as if the model had run.
//
//   const Record record = read_record("cases/studies/recorded/paper-straight.json");
//   if (const RecordedRun* run = find_run(record, {at, 1}))  // the condition on the bed of seed 1
//     if (run->answer.result) run->answer.result->drawbar_pull.value;  // [N]
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/sweep/answers.hpp"
#include "dem/rig/wheel_outcome.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// The inputs of an answer beside the condition and the packing, as name and value: "tire.radius", "0.496".
using Inputs = std::vector<std::pair<std::string, std::string>>;

/// Which of a record's lists a run belongs to.
enum class RunKind {
  usual,
  half_step,  ///< the same on the same bed, at half the time step (step_pair.hpp)
  coarser     ///< the same with grains coarser_by times as large
};
inline constexpr std::array run_kinds = {RunKind::usual, RunKind::half_step, RunKind::coarser};

/// The diameters of a coarser twin's grains over the soil's own.
inline constexpr double coarser_by = 1.4;

/// A run of one wheel in one bin of one soil, which are the record's inputs: what is asked for, and what it is found
/// by.
struct RunSpec {
  OperatingCondition at;
  std::uint64_t packing = 1;  ///< seed of the bed
  RunKind kind = RunKind::usual;
};

/// "load 4 kN, slip 20 %, bed sample 2"; with ", half the time step" or ", coarser grains" where it is that.
std::string in_words(const RunSpec& spec);

/// One run: a condition on one packing of the bed.
struct RecordedRun {
  Answer answer;
  std::uint64_t packing = 1;  ///< seed of the bed
  std::string source;         ///< state of the sources that the program was built from
  double seconds = 0;         ///< that it took on the clock on the wall, with the bed where that was settled for it
  bool steady = false;        ///< as in WheelRun; this and the rest mean nothing without a result
  double drift = 0;
  dem::PowerBalance power;
  dem::BedDensity bed{};  ///< not told in files from before it was kept
  dem::Rut rut;
  dem::SoilFlow flow;
  /// Whether a seal in the file vouches for it: not for runs of files from before there were seals. A new run gets one.
  bool sealed = true;
  /// Whether its standard errors are from before those of few autocorrelation times were put right
  /// (scenario/mean_value.hpp): then that of the sinkage is too small (usual_packing_factor).
  bool early_errors = false;
  /// Removes the restart that the run could be had again from; to be called once the answer is kept. Not in the file.
  std::function<void()> on_saved{};
};

/// A file of runs, and the question that they answer.
struct Record {
  std::string soilbin;   ///< version that began it
  std::string model;     ///< "dem"
  std::string question;  ///< the resolved case, as YAML; of its conditions some may not have been run
  Inputs inputs;
  std::vector<RecordedRun> runs;
  std::vector<RecordedRun> half_step{};  ///< some of them again, on the same bed at half the time step (step_pair.hpp)
  std::vector<RecordedRun> coarser{};    ///< some of them again, with coarser grains
  bool sealed = true;                    ///< whether a seal vouches for all above the runs

  std::vector<RecordedRun>& list(RunKind kind) {
    return kind == RunKind::usual ? runs : kind == RunKind::half_step ? half_step : coarser;
  }
  const std::vector<RecordedRun>& list(RunKind kind) const { return const_cast<Record*>(this)->list(kind); }
};

inline constexpr const char* recorded_format = "soilbin-recorded/1";

/// Throws InputError with file and place for everything that is no record, and for a run, or the inputs, whose seal
/// doesn't fit: something changed it after it was written.
Record parse_record(const SourceText& source);
/// The file's, and what its journal has beside (kept_file.hpp).
Record read_record(const std::filesystem::path& path);

/// The runs that no seal vouches for, in words for people; "" where all have one.
std::string unsealed_note(const Record& record, const std::filesystem::path& file);

/// The file's text; reading it gives the same record to the bit. One line a run, each with a seal, unless it was read
/// without one.
std::string record_text(const Record& record);

/// A run's line in that text.
std::string run_text(const RecordedRun& run);

/// Sorts runs by packing, then as their conditions compare: the order of every record that is written, whoever made its
/// runs and when.
void put_in_order(Record& record);

/// JSON Schema of soilbin-recorded/1.
nlohmann::ordered_json record_schema();

/// Sixteen hexadecimal digits of the inputs.
std::string inputs_key(const Inputs& inputs);

/// Throws InputError that names the file and the inputs that differ, with a hint. Where `only` is given, looks at the
/// inputs whose names begin with one of these alone.
void refuse_other_inputs(const Record& record, const Inputs& asked, const std::filesystem::path& file,
                         const std::vector<std::string>& only = {});

bool answers(const RecordedRun& run, const RunSpec& spec);

/// Adds the runs of another record that this one lacks, of all kinds, and puts all in order.
void add_missing_runs(Record& record, const Record& other);

/// The run of a record that answers a spec; nullptr where there is none.
const RecordedRun* find_run(const Record& record, const RunSpec& spec);

}  // namespace soilbin::compare
