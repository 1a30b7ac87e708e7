// The virtual soil bin as the command has it: its flags, where it keeps settled beds and records, its progress.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/outputs.hpp"
#include "cli/workplace.hpp"
#include "compare/calibrate/experiment_store.hpp"
#include "compare/experiments/study_results.hpp"

namespace soilbin::cli {

/// Heading of the flags of the virtual soil bin in --help.
inline constexpr const char* grains_heading = "Grains, in the virtual soil bin (model dem)";

/// Where settled beds are kept: $SOILBIN_BEDS, else soilbin/beds in the user's cache; empty where there is no home.
std::filesystem::path folder_of_beds();

/// Stops at Ctrl-C; shows stage, share and time left where standard error is a terminal.
void show_dem_progress(const dem::Progress& progress);
/// Shows progress with what it is of in front: `work`, such as "run 3 of 12".
void show_progress_of(const std::string& work, const dem::Progress& progress);

/// A line on standard error that progress doesn't write over.
void print_beside_progress(const std::string& words);

/// The value of --settling-friction: a name (dem::named_densities) or a share of friction. Throws InputError.
double read_settling_friction(const std::string& text, double unless_given);
inline constexpr const char* settling_type = "loose|medium|dense|SHARE";

/// Throws InputError for a --threads that no machine has.
void check_threads(int threads);

/// Flags of the model dem, as typed; empty: the default.
struct SoilBinFlags {
  std::map<std::string, std::string> texts;  ///< of bed, rig and numerics, by flag
  std::string record;                        ///< file that keeps each run as it is finished, and is gone on with
  std::string recorded;                      ///< file to answer from, without running
  std::string replay;    ///< file for a replay of the first run that is made; flag of those who add it
  std::string paraview;  ///< folder for each run that is made, as ParaView opens it; flag of those who add it
  int packing = 1, packings = 1, threads = 0, ranks = 1;
  std::string engine;      ///< who moves the grains: soilbin, without a word too, or lammps; flag of those who add it
  std::string settled_by;  ///< who settles the beds: soilbin, without a word too, or lammps; likewise
  std::vector<std::string> known;  ///< records whose runs are not made again; flag of those who add it
  std::string shard;               ///< "K/N": the part to be made; flag of those who add it
  bool patch = false;              ///< flag of those who add it
  bool coarser_twin = false;       ///< flag of those who add it
  std::string half_step;           ///< yes, no or, without a word, by the number of runs; flag of those who add it

  std::string text(const std::string& flag) const;  ///< "" where it wasn't given

  void add_to(CLI::App& command);
  /// Flags of bed, rig and numerics only: their lengths, times and steps.
  void add_measures_to(CLI::App& command);
  /// Flags of the bed and threads, for commands that only settle beds.
  void add_bed_to(CLI::App& command);
  void add_starting_to(CLI::App& command);
  /// --patch and --until-error.
  void add_patch_to(CLI::App& command);
  /// Bed, rig and numerics only, for commands that keep no records.
  void add_rig_to(CLI::App& command);
  /// --packings alone.
  void add_packings_to(CLI::App& command);
  void add_coarser_twin_to(CLI::App& command);
  /// The value of --half-step; nothing where it was not given.
  std::optional<bool> tests_step() const;
  /// The runs that a question is answered by, or those of the shard alone. Throws as compare::specs and check_runs.
  std::vector<compare::RunSpec> runs(const Case& question) const;
  void add_half_step_to(CLI::App& command);
  /// --engine, --ranks, --settled-by.
  void add_engine_to(CLI::App& command);
  /// --shard, --known.
  void add_shard_to(CLI::App& command);
  void add_known_to(CLI::App& command);

 private:
  /// --packing, --settling-friction, --threads.
  void add_seed_to(CLI::App& command);
};

/// Throws InputError that names the flag.
dem::DemSettings settings_of(const SoilBinFlags& flags);

/// The files of runs that the flags name, and this program as their maker.
compare::RunKeeping keeping_of(const SoilBinFlags& flags);

/// What is doubtful in the bed that the flags and the case's bin make under its tire.
compare::Doubts bed_doubts(const SoilBinFlags& flags, const Case& question);

/// On standard error, before minutes of grains: that they are coarse for the wheel or too soft, values that are hardly
/// meant, and bed_doubts. Beside the answer stands what coarse ones do to it.
void tell_grain_doubts(const SoilBinFlags& flags, const Case& question);

/// Read by resistive force theory too.
inline constexpr const char* wheel_mesh_flag = "--wheel-mesh";

/// Whether a command asks grains; how that is asked for; and the flags under grains_heading that it reads without them.
struct GrainsAsked {
  bool asked = true;
  std::string hint = "--model dem";
  std::vector<std::string> read_without_them{};
};

/// Throws InputError for flags of `command` under grains_heading that would change nothing of the answers: all of them
/// where no grains are asked; beside --recorded those about runs to be made; --bed-width and --bed-depth where the case
/// declares a bin, whose measures the bed takes.
void check_flags_of_grains(const SoilBinFlags& flags, const CLI::App& command, const Case& question,
                           const GrainsAsked& grains = {});

/// The source of grain answers with these flags; reads the record that is to answer (read_record_with_notes).
compare::StudyGrains grains_of(const SoilBinFlags& flags);

/// compare::read_record; says so where no seal vouches for a run.
compare::Record read_record_with_notes(const std::filesystem::path& file);
std::vector<compare::NamedRecord> read_records(const std::vector<std::string>& files);
/// Tells the experiments of a store that no seal vouches for, where there are any.
void tell_unsealed(const compare::ExperimentStore& store, const std::filesystem::path& file);

/// After the answer and all files are written: what the runs could be had again from is removed. Where a file is
/// missing it stays, and the person is told.
void delete_restarts(const std::vector<compare::RecordedRun>& runs, const Outputs& outputs);
inline constexpr const char* finished_runs_stay =
    "finished runs are kept where their restarts could be written: the same command goes on from there";

}  // namespace soilbin::cli
