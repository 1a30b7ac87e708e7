// Round plates pressed into grains as measured plates were pressed into sand: pressures at the same sinkages.
//
//   const auto tests = read_plates(read_source_text("plates.csv", largest_plate_csv));
//   const auto points = points_of(tests);
//   const auto runs = dem::plate_sinkage(grains, pressed_as(points, grains, {}));
//   for (const FeatureBeside& one : beside_measured(tests, points, runs).features) one.off();
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compare/bevameter/plate_tests.hpp"
#include "compare/experiments/measured_beside.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

/// A pressure that is asked of plates.
struct PlatePoint {
  double diameter = 0.0, sinkage = 0.0;  ///< [m]
};

/// Four sinkages of each size of plate, smallest plate first: an eighth, a quarter, a half and the whole of what its
/// shallowest test reached, or of `deepest` [m] where that is less; in two digits.
std::vector<PlatePoint> points_of(std::span<const MeasuredPlate> tests, std::optional<double> deepest = std::nullopt);

/// Pressures at these points as targets: "pressure.20mm", of several sizes "pressure.100mm.20mm". Mean over the tests
/// of a size on their loading curves (loading_curve.hpp). Their error is 10 %, about what re-tests scatter (chosen;
/// docs/lab/plates.md), or that of the mean where it is larger; a target counts as met within two of these errors.
std::vector<Target> targets_of(std::span<const MeasuredPlate> tests, std::span<const PlatePoint> points);

/// The settings with the points' plates, pressed as far as the deepest of them.
dem::PlateSettings pressed_as(std::span<const PlatePoint> points, const GranularSoil& soil,
                              dem::PlateSettings settings);

/// The pressure at a point [Pa], its sinkage counted from the seat: mean over the packings of its plate, and its error,
/// 0 of one.
Estimate simulated(const PlatePoint& point, const std::vector<dem::PlateRun>& runs);

/// Each target beside the runs; without tests none.
MeasuredBeside<MeasuredPlate> beside_measured(std::vector<MeasuredPlate> tests, std::span<const PlatePoint> points,
                                              const std::vector<dem::PlateRun>& runs);

}  // namespace soilbin::compare
