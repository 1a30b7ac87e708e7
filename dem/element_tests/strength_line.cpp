#include "dem/element_tests/strength_line.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

/// y = a + b x by weighted least squares, with covariances.
struct Line {
  double a = 0, b = 0, aa = 0, ab = 0, bb = 0, chi2 = 0;
  double through_origin = 0, through_origin_variance = 0;
};

void check(std::span<const StrengthPoint> points) {
  bool two = false;
  for (const StrengthPoint& point : points) {
    two |= point.normal != points.front().normal;
    if (!(point.shear.std_error > 0) || !std::isfinite(point.normal + point.shear.value + point.shear.std_error))
      throw InputError("a strength needs an error above 0");
  }
  if (!two) throw InputError("cohesion and friction angle need strengths at two stresses");
}

/// By how much variances grow where the scatter is more than the errors tell.
double growth(double chi2, std::size_t points, int parameters) {
  const double freedom = static_cast<double>(points) - parameters;
  return freedom > 0 ? std::max(1.0, chi2 / freedom) : 1;
}

Line fit_line(std::span<const StrengthPoint> points) {
  check(points);
  double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [x, y] : points) {
    const double w = 1 / (y.std_error * y.std_error);
    s += w, sx += w * x, sy += w * y.value, sxx += w * x * x, sxy += w * x * y.value;
  }
  const double determinant = s * sxx - sx * sx;
  Line line;
  line.b = (s * sxy - sx * sy) / determinant;
  line.a = (sy - line.b * sx) / s;
  line.through_origin = sxy / sxx;
  double of_origin = 0;
  for (const auto& [x, y] : points) {
    const double miss = (y.value - line.a - line.b * x) / y.std_error;
    const double miss_of_origin = (y.value - line.through_origin * x) / y.std_error;
    line.chi2 += miss * miss, of_origin += miss_of_origin * miss_of_origin;
  }
  const double grown = growth(line.chi2, points.size(), 2);
  line.aa = grown * sxx / determinant, line.ab = -grown * sx / determinant, line.bb = grown * s / determinant;
  line.through_origin_variance = growth(of_origin, points.size(), 1) / sxx;
  return line;
}

}  // namespace

StrengthLine fit_strength(std::span<const StrengthPoint> points) {
  const Line line = fit_line(points);
  const double turn = 1 / (1 + line.b * line.b);  // d phi / d tan(phi)
  StrengthLine out;
  out.cohesion = {line.a, std::sqrt(line.aa)};
  out.friction_angle = {std::atan(line.b), turn * std::sqrt(line.bb)};
  out.covariance = turn * line.ab;
  out.chi2 = line.chi2;
  out.points = static_cast<int>(points.size());
  const double m = line.through_origin;
  out.friction_angle_without_cohesion = {std::atan(m), std::sqrt(line.through_origin_variance) / (1 + m * m)};
  return out;
}

StrengthLine fit_circles(std::span<const StrengthPoint> points) {
  const Line line = fit_line(points);
  const auto angle_of = [](double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)); };
  const double phi = angle_of(line.b), cosine = std::cos(phi);
  // c = a/cos(phi), so dc = da/cos + a sin/cos^2 dphi, dphi = db/cos.
  const double by_phi = line.a * line.b / (cosine * cosine);
  const double pp = line.bb / (cosine * cosine), ap = line.ab / cosine;
  StrengthLine out;
  out.friction_angle = {phi, std::sqrt(pp)};
  out.cohesion = {line.a / cosine,
                  std::sqrt(line.aa / (cosine * cosine) + by_phi * by_phi * pp + 2 * by_phi / cosine * ap)};
  out.covariance = ap / cosine + by_phi * pp;
  out.chi2 = line.chi2;
  out.points = static_cast<int>(points.size());
  const double psi = angle_of(line.through_origin);
  out.friction_angle_without_cohesion = {psi, std::sqrt(line.through_origin_variance) / std::cos(psi)};
  return out;
}

StrengthLine fit_over_packings(std::span<const StrengthPoint> points, std::span<const std::uint64_t> packings,
                               StrengthLine (*fit)(std::span<const StrengthPoint>)) {
  StrengthLine all = fit(points);
  std::map<std::uint64_t, std::vector<StrengthPoint>> by_packing;
  for (std::size_t i = 0; i < points.size(); ++i) by_packing[packings[i]].push_back(points[i]);
  std::vector<double> cohesions, angles, angles_without_cohesion;
  for (const auto& [packing, own] : by_packing) {
    const StrengthLine line = fit(own);
    cohesions.push_back(line.cohesion.value), angles.push_back(line.friction_angle.value);
    angles_without_cohesion.push_back(line.friction_angle_without_cohesion.value);
  }
  const auto widen = [](Estimate& told, const std::vector<double>& each) {
    const double before = told.std_error;
    told.std_error = std::max(before, mean_of(each).std_error);
    return before > 0 ? told.std_error / before : 1.0;
  };
  all.covariance *= widen(all.cohesion, cohesions) * widen(all.friction_angle, angles);
  widen(all.friction_angle_without_cohesion, angles_without_cohesion);
  return all;
}

}  // namespace soilbin::dem
