// What a measured test of the laboratory gives beside what grains give in the same test.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

/// x at which y first reaches a level above 0, by a line from the reading before, or from the origin.
inline double first_at(const std::vector<double>& x, const std::vector<double>& y, double level) {
  const auto first = std::ranges::find_if(y, [&](double value) { return value >= level; }) - y.begin();
  const auto k = static_cast<std::size_t>(std::min<std::ptrdiff_t>(first, static_cast<std::ptrdiff_t>(y.size()) - 1));
  const double before = k == 0 ? 0.0 : x[k - 1], from = k == 0 ? 0.0 : y[k - 1];
  return y[k] > from ? before + (level - from) / (y[k] - from) * (x[k] - before) : x[k];
}

/// A target of a measured test counts as met within so many of its errors.
inline constexpr double met_within = 2.0;

/// A feature of a measured test beside that of grains [SI].
struct FeatureBeside {
  Target measured;
  Estimate grains;

  /// Grains less measured, over the error of both.
  double off() const {
    return (grains.value - measured.measured.value) / std::hypot(measured.measured.std_error, grains.std_error);
  }
};

/// Measured tests (CompressionCurve, MeasuredPlate) beside runs of grains that were pressed as they were.
template <class Test>
struct MeasuredBeside {
  std::vector<Test> tests;
  std::vector<FeatureBeside> features;
};

}  // namespace soilbin::compare
