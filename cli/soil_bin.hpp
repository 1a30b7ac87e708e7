// The virtual soil bin as a model of the command: its flags, where it keeps settled beds and records, its progress.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/workplace.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "dem/rig/dem_model.hpp"

namespace soilbin::cli {

/// Flags of the model dem, as typed; empty: the default.
struct SoilBinFlags {
  std::string length, width, depth, settling_friction;
  std::string record;    ///< file that keeps each run as it is finished, and is gone on with
  std::string recorded;  ///< file to answer from, without running
  std::string replay;    ///< file for a replay of the first run that is made; flag of those who add it
  int packing = 1, packings = 1, threads = 0;

  void add_to(CLI::App& command);
};

/// Throws InputError that names the flag.
dem::DemSettings settings_of(const SoilBinFlags& flags);

/// The runs behind a model's answers, in the order in which they came.
using RunLog = std::shared_ptr<std::vector<compare::RecordedRun>>;

/// Makes dem with these flags, running it or taking it from a record, and every other model as compare::make_model
/// does. A run that the engine had to stop is an answer without solution, with what it said. Every run goes to `log`; a
/// record that is begun keeps `question` whole.
compare::MakeModel models_with(const SoilBinFlags& flags, const Case& question, const EffectVocabulary& effects,
                               const RunLog& log);

/// What to know about runs beside their results: which did not become steady, how far packings differ, what it cost.
std::string notes_on(const std::vector<compare::RecordedRun>& runs);

}  // namespace soilbin::cli
