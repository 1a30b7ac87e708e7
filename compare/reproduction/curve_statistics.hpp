// Statistics of curves whose points have errors, with intervals: what a statement such as 'peaks near 20 % slip' or
// 'falls linearly' is tested by.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace soilbin::compare {

struct CurvePoint {
  double x = 0, y = 0;
  double error = 0;  ///< standard error of y; 0: exact
};
using Curve = std::vector<CurvePoint>;  ///< by rising x

/// A value and the interval that holds the truth with the stated probability.
struct Interval {
  double value = 0, lower = 0, upper = 0;
};

/// Slope of the straight line of weighted least squares, weights 1/error^2; where a point is exact, all weigh alike.
double slope(const Curve& curve);
/// Its interval by the normal law, from the points' errors alone: how well the slope of *this* line is known, whether
/// or not the points lie on it.
Interval slope_interval(const Curve& curve, double level);

/// Mean of y, each point weighing alike, and its interval by the normal law.
double mean_level(const Curve& curve);
Interval mean_interval(const Curve& curve, double level);

/// How far the parabola of weighted least squares departs from its chord in the middle of the range, over the rise
/// along the chord: c R/(4 b) of y = a + b u + c u^2, u from the middle of a range R. 0 for a line. Needs three points.
double curvature_share(const Curve& curve);

/// x of the largest y, refined by the parabola through it and its neighbours; an end of the curve is taken as it is.
double peak(const Curve& curve);
/// x of the smallest y, found alike.
double lowest(const Curve& curve);
double largest_value(const Curve& curve);

using CurveStatistic = std::function<double(std::span<const Curve>)>;

/// The statistic of the curves and its percentile interval by parametric bootstrap: `draws` times every point is moved
/// by its own error, normally distributed; same seed, same interval. Draws whose statistic isn't finite count at both
/// ends.
Interval bootstrap(std::span<const Curve> curves, const CurveStatistic& statistic, double level, std::uint64_t seed,
                   int draws = 4000);

/// z of the two-sided normal interval: 1.96 for 0.95.
double normal_quantile(double level);

}  // namespace soilbin::compare
