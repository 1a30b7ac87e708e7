#include "cli/soil_bin.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "cli/progress.hpp"
#include "dem/rig/dem_model.hpp"
#include "scenario/errors.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::cli {

namespace fs = std::filesystem;

std::filesystem::path folder_of_beds() {
  if (const char* folder = std::getenv("SOILBIN_BEDS")) return folder;
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return fs::path(cache) / "soilbin/beds";
  if (const char* home = std::getenv("HOME"); home && fs::is_directory(home))
    return fs::path(home) / ".cache/soilbin/beds";
  return {};
}

void show_dem_progress(const dem::Progress& progress) {
  if (interrupt_asked()) throw Interrupted();
  if (isatty(STDERR_FILENO) != 1) return;
  const bool last = progress.done >= 1;
  fmt::print(stderr, "\r\033[K");
  if (last) return;
  fmt::print(stderr, "dem, {}: {:.0f} %", progress.stage, 100 * progress.done);
  if (std::isfinite(progress.seconds_left)) fmt::print(stderr, ", {:.0f} s left", progress.seconds_left);
  std::fflush(stderr);
}

namespace {

dem::DemSettings settings_of(const SoilBinFlags& flags) {
  dem::DemSettings settings;
  const auto read = [](const char* flag, const std::string& text, const Measure& measure, double& into) {
    try {
      if (!text.empty()) into = read_quantity(text, measure);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", flag, error.what()));
    }
  };
  read("--bed-length", flags.length, {"m", above_zero}, settings.size.length);
  read("--bed-width", flags.width, {"m", above_zero}, settings.size.width);
  read("--bed-depth", flags.depth, {"m", above_zero}, settings.size.depth);
  read("--settling-friction", flags.settling_friction, {"-", {.lower = 0, .upper = 1}}, settings.settling_friction);
  if (flags.packing < 0) throw InputError("--packing: a seed is 0 or more");
  if (flags.threads < 0) throw InputError("--threads: 0 (one a core) or more");
  settings.packing = static_cast<std::uint64_t>(flags.packing);
  settings.beds = folder_of_beds();
  settings.how.threads = flags.threads;
  settings.how.progress = show_dem_progress;
  return settings;
}

class SoilBin : public Model {
 public:
  explicit SoilBin(dem::DemSettings settings) : model_(std::move(settings)) {}
  std::string name() const override { return model_.name(); }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    try {
      return model_.evaluate(scenario, at);
    } catch (const dem::RunStopped& stopped) {
      throw NoSolution(stopped.what());
    }
  }

 private:
  dem::DemModel model_;
};

}  // namespace

void SoilBinFlags::add_to(CLI::App& command) {
  command.add_option("--bed-length", length, "dem: length of the bed, 2.5 m")->type_name("LENGTH");
  command.add_option("--bed-width", width, "dem: its width, 0.8 m")->type_name("LENGTH");
  command.add_option("--bed-depth", depth, "dem: its depth, 0.3 m")->type_name("LENGTH");
  command.add_option("--packing", packing, "dem: seed of the bed, 1")->type_name("SEED");
  command
      .add_option("--settling-friction", settling_friction,
                  "dem: share of friction while the bed settles, 1; 0: densest")
      ->type_name("SHARE");
  command.add_option("--threads", threads, "dem: 0, one a core")->type_name("N");
}

compare::MakeModel models_with(const SoilBinFlags& flags) {
  return [flags](ModelKind kind) -> std::unique_ptr<const Model> {
    if (kind == ModelKind::dem) return std::make_unique<const SoilBin>(settings_of(flags));
    return compare::make_model(kind);
  };
}

}  // namespace soilbin::cli
