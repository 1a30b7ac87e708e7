#include "compare/drives/drive_errors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DriveRecord;

constexpr int few_samples = 40;  // the end and whether it is steady are all that is asked for

/// Soil k of the way: 0 the case's own, then those that begin on the way.
Soil& soil_of_way(Case& question, std::size_t k) {
  if (k == 0) return question.scenario.soil;
  for (Waypoint& point : question.drive->profile)
    if (point.soil && --k == 0) return *point.soil;
  throw std::out_of_range("no such soil on the way");
}

std::size_t soils_of_way(const Case& question) {
  std::size_t count = 1;
  for (const Waypoint& point : question.drive->profile) count += point.soil ? 1 : 0;
  return count;
}

/// A value of a soil on the way that is to be moved.
struct Uncertain {
  std::size_t soil;
  MovedDrive drive;
};

std::vector<Uncertain> uncertain_values(Case question) {
  std::vector<Uncertain> values;
  for (std::size_t k = 0; k < soils_of_way(question); ++k) {
    const Soil& soil = soil_of_way(question, k);
    if (!soil.semi_empirical) continue;
    for (const SoilParameter& parameter : soil_parameters) {
      const Estimate of = (*soil.semi_empirical).*parameter.value;
      if (!(of.std_error > 0.0)) continue;
      const auto [below, above] = neighbours(of.value, of.std_error, parameter.range);
      values.push_back({k, {soil.name, &parameter, of, {below}, {above}}});
    }
  }
  return values;
}

void drive_side(Case question, std::size_t soil, const MovedDrive& moved, MovedDrive::Side& side, const Pulse& pulse) {
  if (!moved.was_moved(side)) return;
  ((*soil_of_way(question, soil).semi_empirical).*moved.parameter->value).value = side.value;
  try {
    side.record =
        bekker_wong::drive_wheel(question.scenario, *question.drive, few_samples, {}, [&](double, double) { pulse(); });
  } catch (const NoSolution&) {
  } catch (const InputError&) {  // a value that the wheel does not take
  }
}

std::optional<double> root_of_sum(const DriveErrors& errors, double as_declared,
                                  const std::function<std::optional<double>(const DriveRecord&)>& value) {
  double variance = 0.0;
  for (const MovedDrive& drive : errors.moved) {
    const auto by = change(drive, as_declared, value);
    if (!by) return std::nullopt;
    variance += *by * *by;
  }
  return errors.moved.empty() ? std::nullopt : std::optional(std::sqrt(variance));
}

}  // namespace

std::optional<double> change(const MovedDrive& drive, double as_declared,
                             const std::function<std::optional<double>(const DriveRecord&)>& value) {
  const auto of = [&](const MovedDrive::Side& side) { return side.record ? value(*side.record) : std::nullopt; };
  const std::optional<double> low = of(drive.lower), high = of(drive.higher);
  if (!low && !high) return std::nullopt;
  const double width = (high ? drive.higher.value : drive.of.value) - (low ? drive.lower.value : drive.of.value);
  return drive.of.std_error * (high.value_or(as_declared) - low.value_or(as_declared)) / width;
}

DriveErrors drive_errors(const Case& question, const DriveRecord& record, const ThreadPool& pool) {
  std::vector<Uncertain> values = uncertain_values(question);
  pool.each(2 * static_cast<int>(values.size()), [&](int i, const Pulse& pulse) {
    Uncertain& one = values[static_cast<std::size_t>(i / 2)];
    drive_side(question, one.soil, one.drive, i % 2 == 0 ? one.drive.lower : one.drive.higher, pulse);
  });
  DriveErrors errors;
  for (Uncertain& one : values) errors.moved.push_back(std::move(one.drive));
  errors.travelled = root_of_sum(errors, record.samples.back().travelled,
                                 [](const DriveRecord& r) { return std::optional(r.samples.back().travelled); });
  if (std::ranges::none_of(errors.moved, [&](const MovedDrive& drive) {
        return drive.ends_otherwise(drive.lower, record.end) || drive.ends_otherwise(drive.higher, record.end);
      }))
    errors.end_time =
        root_of_sum(errors, record.end_time, [](const DriveRecord& r) { return std::optional(r.end_time); });
  return errors;
}

}  // namespace soilbin::compare
