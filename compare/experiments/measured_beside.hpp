// What a measured test of the laboratory gives beside what grains give in the same test.
#pragma once

#include <cmath>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

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
