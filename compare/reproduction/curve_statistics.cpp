#include "compare/reproduction/curve_statistics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace soilbin::compare {
namespace {

std::vector<double> weights(const Curve& curve) {
  const bool exact = std::any_of(curve.begin(), curve.end(), [](const CurvePoint& p) { return !(p.error > 0); });
  std::vector<double> out;
  for (const CurvePoint& point : curve) out.push_back(exact ? 1.0 : 1 / (point.error * point.error));
  return out;
}

/// A line's slope as a weighted sum of y: the factors.
std::vector<double> slope_factors(const Curve& curve) {
  const std::vector<double> w = weights(curve);
  double sum = 0, mean = 0, spread = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) sum += w[k], mean += w[k] * curve[k].x;
  mean /= sum;
  for (std::size_t k = 0; k < curve.size(); ++k) spread += w[k] * (curve[k].x - mean) * (curve[k].x - mean);
  std::vector<double> factors;
  for (std::size_t k = 0; k < curve.size(); ++k) factors.push_back(w[k] * (curve[k].x - mean) / spread);
  return factors;
}

/// A weighted sum of y with its normal interval.
Interval sum_interval(const Curve& curve, const std::vector<double>& factors, double level) {
  double value = 0, variance = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    value += factors[k] * curve[k].y;
    variance += std::pow(factors[k] * curve[k].error, 2);
  }
  const double reach = normal_quantile(level) * std::sqrt(variance);
  return {value, value - reach, value + reach};
}

std::vector<double> mean_factors(const Curve& curve) {
  return std::vector<double>(curve.size(), 1 / static_cast<double>(curve.size()));
}

/// Where the parabola through three points has its extreme.
double vertex(const CurvePoint& a, const CurvePoint& b, const CurvePoint& c) {
  const double ab = (b.y - a.y) / (b.x - a.x), bc = (c.y - b.y) / (c.x - b.x);
  const double bend = (bc - ab) / (c.x - a.x);
  return bend == 0 ? b.x : (a.x + b.x) / 2 - ab / (2 * bend);
}

double extreme(const Curve& curve, double sign) {
  const auto top = std::max_element(curve.begin(), curve.end(),
                                    [&](const CurvePoint& a, const CurvePoint& b) { return sign * a.y < sign * b.y; });
  if (top == curve.begin() || top + 1 == curve.end()) return top->x;
  return vertex(*(top - 1), *top, *(top + 1));
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at);
  if (below + 1 >= sorted.size() || sorted[below] == sorted[below + 1]) return sorted[below];
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

}  // namespace

double normal_quantile(double level) { return std::sqrt(2.0) * boost::math::erf_inv(level); }

double slope(const Curve& curve) { return slope_interval(curve, 0.5).value; }
Interval slope_interval(const Curve& curve, double level) { return sum_interval(curve, slope_factors(curve), level); }

double mean_level(const Curve& curve) { return mean_interval(curve, 0.5).value; }
Interval mean_interval(const Curve& curve, double level) { return sum_interval(curve, mean_factors(curve), level); }

double curvature_share(const Curve& curve) {
  const std::vector<double> w = weights(curve);
  const double middle = (curve.front().x + curve.back().x) / 2, range = curve.back().x - curve.front().x;
  const Eigen::Index n = static_cast<Eigen::Index>(curve.size());
  Eigen::MatrixXd design(n, 3);
  Eigen::VectorXd values(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const CurvePoint& point = curve[k];
    const double u = (point.x - middle) / range, root = std::sqrt(w[k]);
    design.row(k) << root, root * u, root * u * u;
    values(k) = root * point.y;
  }
  const Eigen::VectorXd c = design.colPivHouseholderQr().solve(values);
  return c(2) / (4 * c(1));
}

double peak(const Curve& curve) { return extreme(curve, 1); }
double lowest(const Curve& curve) { return extreme(curve, -1); }

double largest_value(const Curve& curve) {
  double most = -std::numeric_limits<double>::infinity();
  for (const CurvePoint& point : curve) most = std::max(most, point.y);
  return most;
}

Interval bootstrap(std::span<const Curve> curves, const CurveStatistic& statistic, double level, std::uint64_t seed,
                   int draws) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> found;
  int lost = 0;
  std::vector<Curve> moved(curves.begin(), curves.end());
  for (int draw = 0; draw < draws; ++draw) {
    for (std::size_t c = 0; c < curves.size(); ++c)
      for (std::size_t k = 0; k < curves[c].size(); ++k)
        moved[c][k].y = curves[c][k].y + curves[c][k].error * normal(random);
    const double value = statistic(moved);
    if (std::isfinite(value)) found.push_back(value);
    lost += std::isfinite(value) ? 0 : 1;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  found.insert(found.end(), lost, infinity);
  found.insert(found.end(), lost, -infinity);
  std::sort(found.begin(), found.end());
  return {statistic(curves), quantile(found, (1 - level) / 2), quantile(found, (1 + level) / 2)};
}

}  // namespace soilbin::compare
