#include "dem/rig/steady_drive.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "scenario/mean_value.hpp"

namespace soilbin::dem {
namespace {

constexpr std::size_t fewest = 16;  // samples

template <class Read>
Estimate mean_of(std::span<const GrainDriveSample> samples, const Read& read) {
  return mean_with_error(series_of(samples, read));
}

/// From the first sample on that lies wholly behind the ramp and the last place.
std::span<const GrainDriveSample> unchanging(const std::vector<GrainDriveSample>& samples, const Drive& drive) {
  const double last_place = drive.profile.empty() ? 0.0 : drive.profile.back().at;
  const auto begins = std::find_if(samples.begin(), samples.end(), [&](const GrainDriveSample& s) {
    return s.time >= drive.controller.ramp && s.travelled >= last_place;
  });
  return begins == samples.end() ? std::span<const GrainDriveSample>() : std::span(begins + 1, samples.end());
}

SteadyDrive means_of(std::span<const GrainDriveSample> part) {
  SteadyDrive steady;
  steady.from = part.front().time, steady.to = part.back().time;
  steady.speed = mean_of(part, [](auto& s) { return s.speed; });
  steady.rim_speed = mean_of(part, [](auto& s) { return s.rim_speed; });
  steady.slip = mean_of(part, [](auto& s) { return s.slip.value_or(0.0); });
  steady.sinkage = mean_of(part, [](auto& s) { return s.sinkage; });
  steady.torque = mean_of(part, [](auto& s) { return s.torque; });
  steady.forward = mean_of(part, [](auto& s) { return s.forward; });
  return steady;
}

}  // namespace

void find_steady_part(GrainDriveRecord& record, const Drive& drive, double allowed) {
  if (record.end == DriveEnd::stuck || record.end == DriveEnd::buried || record.end == DriveEnd::rolled_back) {
    record.not_steady = fmt::format("the wheel is {}", word_of(record.end));
    return;
  }
  const std::span<const GrainDriveSample> kept = unchanging(record.samples, drive);
  if (kept.size() < fewest) {
    record.not_steady = "it ended before its way and its motor's setpoint had stopped changing for long enough";
    return;
  }
  const SteadyPart part =
      steady_part({series_of(kept, [](auto& s) { return s.speed; }), series_of(kept, [](auto& s) { return s.torque; }),
                   series_of(kept, [](auto& s) { return s.sinkage; })});
  record.steady = means_of(kept.subspan(part.from));
  record.steady->drift = part.drift;
  record.steady->steady = kept.size() - part.from >= fewest && part.drift <= allowed;
}

}  // namespace soilbin::dem
