// Cohesion and friction angle from strengths at several stresses.
#pragma once

#include <cstdint>
#include <span>

#include "scenario/estimate.hpp"

namespace soilbin::dem {

/// A strength at a normal stress [Pa]. The error of the strength must be above 0.
struct StrengthPoint {
  double normal = 0;
  Estimate shear;
};

/// tau = c + sigma tan(phi).
struct StrengthLine {
  Estimate cohesion;        ///< c [Pa]; may come out below 0
  Estimate friction_angle;  ///< phi [rad]
  double covariance = 0;    ///< of c and phi [Pa rad]
  double chi2 = 0;          ///< sum of squared residuals over their errors
  int points = 0;
  /// phi of the line through the origin, c = 0 [rad]
  Estimate friction_angle_without_cohesion;
};

/// Weighted least squares, weights 1/error^2. Where the points scatter by more than their errors tell (chi2 above
/// points - 2), errors and covariance grow with it. Throws InputError for fewer than two stresses or an error that is
/// not above 0.
StrengthLine fit_strength(std::span<const StrengthPoint> points);

/// Fits Mohr's circles: each point holds s = (sigma_1 + sigma_3)/2 and t = (sigma_1 - sigma_3)/2, and
/// t = c cos(phi) + s sin(phi).
StrengthLine fit_circles(std::span<const StrengthPoint> points);

/// The line of all points by one of these fits. Points of one packing err together, since its grains lie as they lie
/// under each stress, so errors are also those of the packings' own lines, where these are larger.
/// `packings`: of each point.
StrengthLine fit_over_packings(std::span<const StrengthPoint> points, std::span<const std::uint64_t> packings,
                               StrengthLine (*fit)(std::span<const StrengthPoint>));

}  // namespace soilbin::dem
