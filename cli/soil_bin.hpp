// The virtual soil bin as a model of the command: its flags, where it keeps settled beds, its progress.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "compare/sweep/answers.hpp"
#include "dem/bed/work_options.hpp"

namespace soilbin::cli {

/// Where settled beds are kept: $SOILBIN_BEDS, else soilbin/beds in the user's cache; empty where there is no home.
std::filesystem::path folder_of_beds();

/// Stops at Ctrl-C; shows stage, share and time left where standard error is a terminal.
void show_dem_progress(const dem::Progress& progress);

/// Flags of the model dem, as typed; empty: the default.
struct SoilBinFlags {
  std::string length, width, depth, settling_friction;
  int packing = 1, threads = 0;

  void add_to(CLI::App& command);
};

/// Makes dem with these flags, and every other model as compare::make_model does. A run that the engine had to stop is
/// an answer without solution, with what it said.
compare::MakeModel models_with(const SoilBinFlags& flags);

}  // namespace soilbin::cli
