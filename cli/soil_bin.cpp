#include "cli/soil_bin.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "cli/described_flags.hpp"
#include "cli/flag_values.hpp"
#include "cli/progress.hpp"
#include "cli/versions.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "dem/bed/relative_density.hpp"
#include "dem/rig/rig_settings.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

namespace fs = std::filesystem;
using dem::SettingOf;

std::filesystem::path folder_of_beds() {
  if (const char* folder = std::getenv("SOILBIN_BEDS"); folder && *folder) return folder;
  const fs::path cache = user_cache();
  return cache.empty() ? fs::path() : cache / "beds";
}

void show_dem_progress(const dem::Progress& progress) { show_progress_of("dem", progress); }

void show_progress_of(const std::string& work, const dem::Progress& progress) {
  if (interrupt_asked()) throw Interrupted();
  if (progress.done >= 1) return clear_progress_line();
  const bool known = std::isfinite(progress.seconds_left);
  show_progress_line(fmt::format("{}, {}: {:.0f} %{}", work, progress.stage, 100 * progress.done,
                                 known ? fmt::format(", {:.0f} s left", progress.seconds_left) : ""));
}

void print_beside_progress(const std::string& words) {
  clear_progress_line();
  fmt::print(stderr, "{}\n", words);
}

namespace {

void add_settings(CLI::App& command, std::map<std::string, std::string>& texts,
                  std::initializer_list<SettingOf> wanted) {
  dem::DemSettings defaults;
  dem::each_setting(
      defaults, [&](const char* key, double& usual, const Measure& measure, SettingOf of, const char* meaning) {
        const std::string flag = flag_of("", key);
        if (std::ranges::find(wanted, of) == wanted.end()) return;
        const auto& [unit, range] = measure;
        const char* type = unit == "m" ? "LENGTH" : unit == "s" ? "TIME" : range.lower < 1 ? "SHARE" : "FACTOR";
        add_value(command, flag, texts[flag], type, fmt::format(fmt::runtime(meaning), usual))->group(grains_heading);
      });
}

void add_patch_flag(CLI::App& command, bool& patch, const char* meaning) {
  command.add_flag("--patch", patch, meaning)->group(grains_heading);
}

}  // namespace

double read_settling_friction(const std::string& text, double unless_given) {
  if (text.empty()) return unless_given;
  std::vector<std::string> names;
  for (const dem::NamedDensity& bed : dem::named_densities) {
    if (text == bed.name) return bed.settling_friction;
    names.emplace_back(bed.name);
  }
  if (std::isalpha(static_cast<unsigned char>(text.front())) != 0)
    throw InputError(
        fmt::format("--settling-friction: '{}' is none of {}{}\n  hint: or a share of the friction, 0 .. 1",
                    clipped(text), listed(names), did_you_mean(text, names)));
  return read_flag("--settling-friction", text, {"-", fractions});
}

void check_threads(int threads) {
  if (threads < 0 || threads > dem::most_threads())
    throw InputError(fmt::format("--threads: 0 (one a core) .. {}", dem::most_threads()));
}

/// The LAMMPS worker of --engine and --ranks. Its program lies beside this one; SOILBIN_MPIRUN says what starts it.
std::optional<dem::LammpsWorker> lammps_of(const SoilBinFlags& flags) {
  if (flags.engine != "lammps") {
    if (flags.settled_by == "lammps") throw InputError("--settled-by lammps also needs --engine lammps");
    if (flags.ranks != 1) throw InputError("--ranks is for grains in LAMMPS\n  hint: --engine lammps, or --threads");
    return std::nullopt;
  }
  if (flags.ranks < 1) throw InputError("--ranks: 1 or more");
  if (!flags.replay.empty())
    throw InputError(
        "--replay needs soilbin's own engine, which keeps the motion of the grains\n  hint: leave out "
        "--engine lammps, or --replay");
  dem::LammpsWorker worker{.ranks = flags.ranks, .program = this_program().parent_path() / "soilbin-lammps"};
  if (const char* launcher = std::getenv("SOILBIN_MPIRUN")) worker.launcher = launcher;
  return worker;
}

dem::DemSettings settings_of(const SoilBinFlags& flags) {
  dem::DemSettings settings;
  dem::each_setting(settings, [&](const char* key, double& number, const Measure& measure, auto...) {
    const std::string flag = flag_of("", key);
    set_where_given(flag, flags.text(flag), measure, number);
  });
  if (settings.highest_lugs > 0 && settings.graded == 1)
    throw InputError("--graded-for has no effect on a bed of the soil's grains everywhere\n  hint: --graded 2");
  settings.rig.patch = flags.patch;
  if (!flags.text("--until-error").empty() && !(flags.patch && flags.text("--travel").empty()))
    throw InputError(
        "--until-error has no effect: it ends a run on a moving patch whose travel is not given\n  hint: "
        "--patch, without --travel");
  settings.settling_friction = read_settling_friction(flags.text("--settling-friction"), settings.settling_friction);
  if (flags.packing < 0) throw InputError("--packing: a seed is 0 or more");
  if (flags.packings < 1) throw InputError("--packings: 1 or more");
  check_threads(flags.threads);
  if (const std::string mesh = flags.text(wheel_mesh_flag); !mesh.empty())
    settings.rig.meshing.drawn = fs::absolute(mesh).string();
  settings.packing = static_cast<std::uint64_t>(flags.packing);
  settings.beds = folder_of_beds();
  settings.how.threads = flags.threads;
  settings.how.progress = show_dem_progress;
  settings.how.tell = print_beside_progress;
  settings.checkpoints.restart = settings.beds;
  settings.checkpoints.tell = print_beside_progress;
  settings.lammps = lammps_of(flags);
  settings.settled_by = flags.settled_by == "lammps" ? dem::SettledBy::lammps : dem::SettledBy::soilbin;
  return settings;
}

std::string SoilBinFlags::text(const std::string& flag) const {
  const auto given = texts.find(flag);
  return given == texts.end() ? "" : given->second;
}

void SoilBinFlags::add_measures_to(CLI::App& command) {
  add_settings(command, texts, {SettingOf::bed, SettingOf::run});
}

void SoilBinFlags::add_bed_to(CLI::App& command) {
  add_settings(command, texts, {SettingOf::bed});
  add_patch_flag(command, patch, "the bed of a moving patch, which repeats itself every --bed-length");
  add_seed_to(command);
}

void SoilBinFlags::add_rig_to(CLI::App& command) {
  add_measures_to(command);
  add_value(command, wheel_mesh_flag, texts[wheel_mesh_flag], "FILE.stl|obj",
            "the wheel as drawn, a mesh as large as the tire, in place of the one that is made from the tire's "
            "measures, of rft too; soilbin mesh FILE shows what is in it")
      ->group(grains_heading);
  add_seed_to(command);
}

void SoilBinFlags::add_seed_to(CLI::App& command) {
  add_value(command, "--packing", packing, "SEED", "seed of the bed; 1")->group(grains_heading);
  add_value(command, "--settling-friction", texts["--settling-friction"], settling_type,
            "how dense the bed settles: loose (the default), medium, dense, or the share of the friction that acts "
            "meanwhile: 1 loose .. 0 densest")
      ->group(grains_heading);
  add_value(command, "--threads", threads, "N",
            "number of threads, which changes no bit of the answer; 0: one for each core, fewer for few grains or "
            "while other programs keep the cores busy")
      ->group(grains_heading);
}

void SoilBinFlags::add_starting_to(CLI::App& command) { add_settings(command, texts, {SettingOf::start}); }

void SoilBinFlags::add_patch_to(CLI::App& command) {
  add_patch_flag(command, patch,
                 "a moving patch: only the soil from --behind to --ahead of the axle is simulated and goes along with "
                 "the wheel, on a bed that repeats itself every --bed-length without an end");
  add_settings(command, texts, {SettingOf::patch});
}

void SoilBinFlags::add_packings_to(CLI::App& command) {
  add_value(command, "--packings", packings, "N", "number of beds, from --packing on; answers are means over them; 1")
      ->check(whole_number(1, compare::most_packings))
      ->group(grains_heading);
}

std::optional<bool> SoilBinFlags::tests_step() const {
  return half_step.empty() ? std::nullopt : std::optional(half_step == "yes");
}

std::vector<compare::RunSpec> SoilBinFlags::runs(const Case& question) const {
  const dem::DemSettings settings = settings_of(*this);
  const compare::Twins twins = coarser_twin ? compare::Twins::yes : compare::Twins::no;
  std::vector<compare::RunSpec> list = compare::specs(question, settings, packings, tests_step(), twins);
  compare::check_runs(question, settings, twins);
  return shard.empty() ? list : compare::shard_of(list, compare::parse_shard(shard));
}

void SoilBinFlags::add_coarser_twin_to(CLI::App& command) {
  command
      .add_flag("--coarser-twin", coarser_twin,
                fmt::format("make each run also with grains {} times as large, for about a quarter more time: each "
                            "answer then carries its own error of resolution",
                            compare::coarser_by))
      ->group(grains_heading);
}

void SoilBinFlags::add_half_step_to(CLI::App& command) {
  add_value(command, "--half-step", half_step, "yes|no",
            "run the hardest condition first, also at half the time step, and stop where its answer differs; yes for a "
            "dozen runs or more")
      ->group(grains_heading)
      ->check(CLI::IsMember({"yes", "no"}));
}

void SoilBinFlags::add_engine_to(CLI::App& command) {
  add_value(
      command, "--engine", engine, "soilbin|lammps",
      "who moves the grains under the wheel: soilbin, or LAMMPS over MPI, for beds that fit no workstation; soilbin")
      ->group(grains_heading)
      ->check(CLI::IsMember({"soilbin", "lammps"}));
  add_value(command, "--ranks", ranks, "N", "number of processes of LAMMPS; 1")->group(grains_heading);
  add_value(command, "--settled-by", settled_by, "soilbin|lammps",
            "who settles the bed: soilbin, on this machine, up to 20 million grains; or LAMMPS, of any size; soilbin")
      ->group(grains_heading)
      ->check(CLI::IsMember({"soilbin", "lammps"}));
}

void SoilBinFlags::add_shard_to(CLI::App& command) {
  add_value(command, "--shard", shard, "K/N",
            "only the K-th of N parts of the work; parts may be made at once, anywhere")
      ->group(grains_heading);
}

void SoilBinFlags::add_known_to(CLI::App& command) {
  add_value(command, "--known", known, "RECORD.json", "records whose runs are not made again")
      ->group(grains_heading)
      ->allow_extra_args(true);
}

void SoilBinFlags::add_to(CLI::App& command) {
  add_rig_to(command);
  add_starting_to(command);
  add_patch_to(command);
  add_packings_to(command);
  add_kept_file(command, "--record", record, "FILE.json",
                "keep each run in this file as it is finished, and go on with what is there")
      ->group(grains_heading);
  add_value(command, "--recorded", recorded, "[FILE.json]",
            "answer from this record, without running; without a file from the one in the library")
      ->group(grains_heading)
      ->expected(0, 1)
      ->default_str(library_record)
      ->excludes("--record");
}

compare::RunKeeping keeping_of(const SoilBinFlags& flags) {
  return {flags.record,
          flags.replay,
          flags.paraview,
          SOILBIN_VERSION,
          source_state(),
          {flags.known.begin(), flags.known.end()},
          flags.shard.empty() ? Writers::several : Writers::one};
}

namespace {

/// The flags of a command under grains_heading that were given, in its order, but for those named.
std::vector<std::string> given_flags_of_grains(const CLI::App& command, const std::vector<std::string>& but) {
  std::vector<std::string> given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group() != grains_heading || option->count() == 0) continue;
    std::string flag = "--" + option->get_lnames().front();
    if (std::ranges::find(but, flag) == but.end()) given.push_back(std::move(flag));
  }
  return given;
}

[[noreturn]] void refuse_flags(const std::vector<std::string>& given, const std::string& reason,
                               const std::string& hint) {
  const bool one = given.size() == 1;
  throw InputError(fmt::format("{} {} {}\n  hint: {}, or leave {} out", listed(given),
                               one ? "has no effect" : "have no effect", reason, hint, one ? "it" : "them"));
}

}  // namespace

void check_flags_of_grains(const SoilBinFlags& flags, const CLI::App& command, const Case& question,
                           const GrainsAsked& grains) {
  if (!grains.asked) {
    const std::vector<std::string> given = given_flags_of_grains(command, grains.read_without_them);
    if (!given.empty()) refuse_flags(given, "on the analytic model", grains.hint + " runs grains");
  } else if (!flags.recorded.empty()) {
    const std::vector<std::string> given = given_flags_of_grains(command, {"--recorded"});
    if (!given.empty()) refuse_flags(given, "on recorded runs", "run them anew without --recorded");
  } else if (const std::optional<Bin>& bin = question.scenario.bin) {
    for (const auto& [flag, measure] : {std::pair{"--bed-width", bin->width}, {"--bed-depth", bin->depth}})
      if (!flags.text(flag).empty())
        refuse_flags({flag}, fmt::format("beside the case's bin, whose {:g} m the bed takes", measure),
                     "change 'bin' of the case");
  }
}

compare::StudyGrains grains_of(const SoilBinFlags& flags) {
  compare::StudyGrains grains{settings_of(flags), flags.packings, keeping_of(flags)};
  if (!flags.recorded.empty()) grains.recorded = {flags.recorded, read_record_with_notes(flags.recorded)};
  return grains;
}

compare::Record read_record_with_notes(const fs::path& file) {
  compare::Record record = compare::read_record(file);
  if (const std::string note = compare::unsealed_note(record, file); !note.empty())
    fmt::print(stderr, "note: {}\n", note);
  return record;
}

std::vector<compare::NamedRecord> read_records(const std::vector<std::string>& files) {
  std::vector<compare::NamedRecord> records;
  for (const std::string& file : files) records.push_back({file, read_record_with_notes(file)});
  return records;
}

void tell_unsealed(const compare::ExperimentStore& store, const fs::path& file) {
  if (store.unsealed() > 0)
    fmt::print(stderr,
               "note: {}: {} of its {} experiments carry no seal, as from before there were any: damage to them can't "
               "be told\n",
               file.string(), store.unsealed(), store.size());
}

compare::Doubts bed_doubts(const SoilBinFlags& flags, const Case& question) {
  const std::optional<Bin>& bin = question.scenario.bin;
  return compare::narrow_bed_doubts(question.scenario.tire, bin ? bin->width : settings_of(flags).size.width);
}

void tell_grain_doubts(const SoilBinFlags& flags, const Case& question) {
  const Scenario& scenario = question.scenario;
  if (!scenario.soil.granular) return;
  compare::Doubts doubts = compare::grain_doubts(scenario, question.study.conditions, {});
  append(doubts, bed_doubts(flags, question));
  for (const std::string& line : in_words(doubts)) fmt::print(stderr, "note: {}\n", line);
}

void delete_restarts(const std::vector<compare::RecordedRun>& runs, const Outputs& outputs) {
  if (runs.empty()) return;
  if (!outputs.complete() || std::fflush(stdout) != 0) {
    fmt::print(stderr, "soilbin: {}\n", finished_runs_stay);
    return;
  }
  for (const compare::RecordedRun& run : runs)
    if (run.on_saved) run.on_saved();
}

}  // namespace soilbin::cli
