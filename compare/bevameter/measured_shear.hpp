// Shear tests that somebody made (a ring, a box, a plate that is dragged), as a CSV of the readings holds them, and the
// c, phi and K that they give.
//
//   const auto tests = read_shear(read_source_text("shear.csv", largest_plate_csv));
//   const MeasuredShearFit fit = fit_measured_shear(tests);
//   fit.friction_angle.value, fit.friction_angle.std_error  // [rad]
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/bevameter/bevameter.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// One test under one normal stress.
struct MeasuredShear {
  std::string test;  ///< what tells it from others: "dense, 2"
  ShearCurve curve;  ///< readings with a displacement and a shear stress above 0, in the order of the file
  double normal_stress_spread = 0.0;  ///< standard deviation of a normal stress that was logged [Pa]; the curve's is
                                      ///< its mean
};

/// Reads a CSV with one row a reading. A column's name ends in its unit: displacement_mm, shear_stress_kPa,
/// normal_stress_kPa. Columns without a unit tell one test from another, and so does the normal stress where it is one
/// that was set: where it has fewer than six readings a value, it was logged, and is a test's mean. Other columns are
/// left aside. `only`: column and value; rows in which they differ are left out. `normal_stress` [Pa]: of all tests,
/// where no column tells it. Throws InputError with file, line and hint.
std::vector<MeasuredShear> read_shear(const SourceText& csv,
                                      const std::vector<std::pair<std::string, std::string>>& only = {},
                                      std::optional<double> normal_stress = std::nullopt);

/// What one test gives. Where its stress falls again behind a peak (a hump), Janosi's curve is fitted up to the peak.
struct ShearTestFit {
  JanosiFit janosi;
  double peak = 0.0;                 ///< largest shear stress [Pa]
  double peak_at = 0.0;              ///< and its displacement [m]
  std::optional<double> residual{};  ///< mean over the last tenth of the way, where that is below 0.9 of the peak [Pa]
};

struct MeasuredShearFit {
  std::vector<ShearTestFit> tests;                   ///< in the order of the tests
  Estimate cohesion, friction_angle, shear_modulus;  ///< [Pa], [rad], [m]
  /// Cohesion before it was cut off at 0 [Pa]; the friction angle then belongs to a line through 0.
  double cohesion_as_fitted = 0.0;
  /// Angle of the residual strengths of the tests that have one, through 0 [rad]; none: no test has.
  std::optional<Estimate> residual_angle{};
  /// Tests of one normal stress do not part c from phi: c is 0 then and phi stands for both, good for this stress.
  bool one_stress = false;
};

/// c and phi: a line through the tests' tau_max over their normal stress, every test of equal relative weight, errors
/// by the scatter about it. K: mean over the tests with their standard deviation, since a wheel's soil is one more
/// preparation; 0 for a single test. Throws InputError for a test of fewer than six readings, or none.
MeasuredShearFit fit_measured_shear(std::span<const MeasuredShear> tests);

}  // namespace soilbin::compare
