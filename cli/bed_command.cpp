// soilbin bed: the beds that a study's runs need, settled before the runs.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "dem/bed/relative_density.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

/// The loosest and the densest bed of these grains; none where they don't come to rest.
std::optional<dem::DensityLimits> limits_of(dem::DemSettings settings, const Scenario& scenario) {
  settings.how.progress = [](const dem::Progress& progress) { show_progress_of("loosest and densest bed", progress); };
  dem::BedStore store(settings.beds);
  try {
    return dem::density_limits(dem::DemModel(settings).recipe(scenario).soil, store, settings.how);
  } catch (const dem::RunStopped& stopped) {
    print_beside_progress(fmt::format("note: no relative density: {}", stopped.what()));
    return std::nullopt;
  }
}

/// Settles the bed of one packing, unless it is there. Throws std::runtime_error where it can't be kept.
void settle(dem::DemSettings settings, const Scenario& scenario, std::uint64_t packing,
            const std::optional<dem::DensityLimits>& limits) {
  settings.packing = packing;
  const std::string name = fmt::format("bed sample {}", packing);
  settings.how.progress = [&](const dem::Progress& progress) { show_progress_of(name, progress); };
  const dem::DemModel model(settings);
  const dem::BedRecipe recipe = model.recipe(scenario);
  const fs::path file = dem::BedStore(settings.beds).file(recipe);
  const bool was_there = is_there(file);
  const auto bed = model.bed(recipe);
  clear_progress_line();
  if (!is_there(file)) throw std::runtime_error(fmt::format("{}: {} can't be kept", file.string(), name));
  std::string density;
  if (limits) {
    const double share = dem::relative_density(bed->report.void_ratio, *limits);
    density = fmt::format(", relative density {:.0f} %{}", 100 * share, dem::beyond_limits(share));
  }
  fmt::print("{}: {} grains, void ratio {:.3f}{}, {} {}\n", name, bed->report.grains, bed->report.void_ratio, density,
             was_there ? "is there:" : "settled:", file.string());
}

int beds(const std::string& study, const SoilBinFlags& flags, const CLI::App& command, const Session& session) {
  const Case question = find_study(session.place, study);
  check_flags_of_grains(flags, command, question);
  const dem::DemSettings settings = settings_of(flags);
  if (settings.beds.empty())
    throw InputError("there is no folder to keep beds in\n  hint: export SOILBIN_BEDS=FOLDER, one that all jobs see");
  std::vector<std::uint64_t> packings = compare::packings_from(settings, flags.packings);
  if (!flags.shard.empty()) packings = compare::shard_of(packings, compare::parse_shard(flags.shard));
  try {
    const std::optional<dem::DensityLimits> limits = limits_of(settings, question.scenario);
    if (limits)
      fmt::print("void ratios of these grains: {:.3f} loosest, {:.3f} densest\n", limits->loosest, limits->densest);
    for (const std::uint64_t packing : packings) settle(settings, question.scenario, packing, limits);
  } catch (const Interrupted&) {
    return unfinished;
  }
  return done;
}

}  // namespace

void add_bed(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("bed", "settle the beds of grains that a study's runs begin on");
  const auto study = std::make_shared<std::string>();
  const auto flags = std::make_shared<SoilBinFlags>();
  add_value(*command, "study", *study, "STUDY", "a study of the library, or a case file")->required();
  flags->add_bed_to(*command);
  flags->add_packings_to(*command);
  flags->add_engine_to(*command);
  flags->add_shard_to(*command);
  command->footer(
      "Beds are kept in $SOILBIN_BEDS, else in the user's cache; one that is there is not settled again. Any number "
      "of\n"
      "processes on any number of machines may fill one folder. Stopped, it ends with status 3: the same command goes\n"
      "on.\n"
      "Example: soilbin bed paper-straight --settling-friction dense --packings 3");
  command->callback(
      [=, &session] { session.action = [=, &session] { return beds(*study, *flags, *command, session); }; });
}

}  // namespace soilbin::cli
