#include "compare/experiments/grain_drives.hpp"

#include <fmt/core.h>

#include "scenario/errors.hpp"

namespace soilbin::compare {

GrainDrives::GrainDrives(dem::DemSettings settings, const Case& question, int samples, int packings,
                         ReplayKeeping replay)
    : settings_(std::move(settings)),
      question_(question),
      samples_(samples),
      packings_(packings),
      replay_(std::move(replay)) {}

void GrainDrives::run() {
  began_ = std::chrono::steady_clock::now();
  for (int k = 0; k < packings_; ++k) {
    const auto named = [&](const std::exception& error) {
      return fmt::format("bed sample {}: {}", packing(k), error.what());
    };
    try {
      drive(k);
    } catch (const NoSolution& error) {
      if (packings_ == 1) throw;
      throw NoSolution(named(error));
    } catch (const dem::RunStopped& error) {
      if (packings_ == 1) throw;
      throw dem::RunStopped(named(error));
    }
  }
}

void GrainDrives::forget() {
  for (int k = 0; k < packings_; ++k) model(k).forget(question_.scenario, *question_.drive, samples_);
}

dem::DemModel GrainDrives::model(int k) {
  dem::DemSettings settings = settings_;
  settings.packing = packing(k);
  if (k == 0 && !replay_.file.empty()) {
    settings.rig.onlooker = recorder_.onlooker();
  }
  if (packings_ > 1 && settings_.how.progress)
    settings.how.progress = [this, k](const dem::Progress& progress) { show(k, progress); };
  return dem::DemModel(std::move(settings));
}

/// Time left: this packing's, and for those to come what one has taken so far.
void GrainDrives::show(int k, dem::Progress progress) const {
  const std::string stage = fmt::format("bed sample {} of {}, {}", k + 1, packings_, progress.stage);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began_;
  progress.stage = stage;
  progress.seconds_left += (packings_ - k - 1) * (spent.count() + progress.seconds_left) / (k + 1);
  settings_.how.progress(progress);
}

void GrainDrives::drive(int k) {
  const auto began = std::chrono::steady_clock::now();
  const dem::GrainDriveRecord record = model(k).drive(question_.scenario, *question_.drive, samples_);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
  if (recorder_.has_frames()) recorder_.write(replay_, question_.name, packing(k));
  note(record, packing(k), record.earlier + spent.count());
  sides_.push_back(grain_side(record, packings_ > 1 ? std::optional(packing(k)) : std::nullopt));
}

void GrainDrives::note(const dem::GrainDriveRecord& record, std::uint64_t packing, double seconds) {
  const dem::BedSize& size = settings_.size;
  notes_.push_back(fmt::format(
      "dem: {} grains in {:.4g} x {:.4g} x {:.4g} m, bed sample {}, settling friction {:.3g}; {} steps, {:.0f} s with "
      "the bed",
      record.grains, size.length, size.width, size.depth, packing, settings_.settling_friction, record.steps, seconds));
}

}  // namespace soilbin::compare
