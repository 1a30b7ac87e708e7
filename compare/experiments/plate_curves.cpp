#include "compare/experiments/plate_curves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/bevameter/loading_curve.hpp"
#include "compare/bevameter/measured_plates.hpp"
#include "scenario/mean_value.hpp"

namespace soilbin::compare {
namespace {

constexpr double taken_error = 0.10;

/// The pressure where the plate first comes to this depth, or to the deepest that it came to.
double pressure_at(double depth, const std::vector<double>& sinkage, const std::vector<double>& pressure) {
  return first_at(pressure, sinkage, std::min(depth, std::ranges::max(sinkage)));
}

bekker_wong::PlateCurve loaded(const MeasuredPlate& test) {
  return readings_of(test.curve, loading_curve(test.curve).readings);
}

double rounded(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::floor(value / step * (1 + 1e-12)) * step;
}

std::string name_of(const PlatePoint& point, bool one_size) {
  const std::string at = fmt::format("{:.4g}mm", point.sinkage * 1e3);
  return one_size ? "pressure." + at : fmt::format("pressure.{:.4g}mm.{}", point.diameter * 1e3, at);
}

}  // namespace

std::vector<PlatePoint> points_of(std::span<const MeasuredPlate> tests, std::optional<double> deepest) {
  std::set<double> radii;
  for (const MeasuredPlate& test : tests) radii.insert(test.curve.radius);
  std::vector<PlatePoint> points;
  for (const double radius : radii) {
    double end = deepest.value_or(HUGE_VAL);
    for (const MeasuredPlate& test : tests)
      if (test.curve.radius == radius) end = std::min(end, std::ranges::max(loaded(test).sinkage));
    for (const double share : {0.125, 0.25, 0.5, 1.0}) points.push_back({2 * radius, rounded(share * end)});
  }
  return points;
}

std::vector<Target> targets_of(std::span<const MeasuredPlate> tests, std::span<const PlatePoint> points) {
  std::vector<bekker_wong::PlateCurve> curves;
  for (const MeasuredPlate& test : tests) curves.push_back(loaded(test));
  const bool one_size = points.empty() || points.front().diameter == points.back().diameter;
  std::vector<Target> targets;
  for (const PlatePoint& point : points) {
    std::vector<Estimate> pressures;
    for (const bekker_wong::PlateCurve& curve : curves)
      if (2 * curve.radius == point.diameter)
        pressures.push_back({pressure_at(point.sinkage, curve.sinkage, curve.pressure), 0.0});
    Estimate measured = mean_of_repeats(pressures);
    measured.std_error = std::max(measured.std_error, taken_error * measured.value);
    targets.push_back({name_of(point, one_size), measured, "kPa", met_within * measured.std_error});
  }
  return targets;
}

dem::PlateSettings pressed_as(std::span<const PlatePoint> points, const GranularSoil& soil,
                              dem::PlateSettings settings) {
  const double grain = mean_diameter(soil);
  settings.diameters.clear(), settings.sinkage = 0;
  for (const PlatePoint& point : points) {
    if (settings.diameters.empty() || settings.diameters.back() != point.diameter / grain)
      settings.diameters.push_back(point.diameter / grain);
    settings.sinkage = std::max(settings.sinkage, point.sinkage / grain);
  }
  return settings;
}

Estimate simulated(const PlatePoint& point, const std::vector<dem::PlateRun>& runs) {
  std::vector<Estimate> pressures;
  for (const dem::PlateRun& run : runs) {
    if (std::abs(run.diameter - point.diameter) > 1e-9 * point.diameter) continue;
    const std::span<const dem::PlateSample> samples(run.curve);
    const double seat = run.seat();
    const auto sinkage = series_of(samples, [&](const dem::PlateSample& at) { return at.sinkage - seat; });
    const auto pressure = series_of(samples, [](const dem::PlateSample& at) { return at.pressure; });
    pressures.push_back({pressure_at(point.sinkage, sinkage, pressure), 0.0});
  }
  return mean_of_repeats(pressures);
}

MeasuredBeside<MeasuredPlate> beside_measured(std::vector<MeasuredPlate> tests, std::span<const PlatePoint> points,
                                              const std::vector<dem::PlateRun>& runs) {
  MeasuredBeside<MeasuredPlate> beside{std::move(tests), {}};
  const std::vector<Target> targets = targets_of(beside.tests, points);
  for (std::size_t k = 0; k < points.size(); ++k) beside.features.push_back({targets[k], simulated(points[k], runs)});
  return beside;
}

}  // namespace soilbin::compare
