#include "bekker_wong/plate_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scenario/errors.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Cubic spline through (x, y) whose third derivative is continuous at the second and the last but one point, so that
/// it reproduces a cubic; beyond the ends the end pieces go on.
class NotAKnotSpline {
 public:
  NotAKnotSpline(const std::vector<double>& x, const std::vector<double>& y) : x_(x), y_(y), curvature_(x.size()) {
    const std::size_t n = x.size();
    if (n < 4 || y.size() != n) throw InputError("a plate test needs at least four pressures, each with its sinkage");
    for (std::size_t i = 1; i < n; ++i)
      if (!(x[i] > x[i - 1])) throw InputError("the pressures of a plate test must increase");
    solve();
  }

  double operator()(double at) const {
    const auto above = std::upper_bound(x_.begin(), x_.end(), at) - x_.begin();
    const std::size_t i = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(above, 1)), x_.size() - 1) - 1;
    const double h = gap(i), t = at - x_[i], m = curvature_[i], next = curvature_[i + 1];
    return y_[i] + t * (slope(i) - h * (2 * m + next) / 6 + t * (m / 2 + t * (next - m) / (6 * h)));
  }

 private:
  double gap(std::size_t i) const { return x_[i + 1] - x_[i]; }
  double slope(std::size_t i) const { return (y_[i + 1] - y_[i]) / gap(i); }

  /// Second derivatives by elimination in the tridiagonal system of the inner points, into which the end conditions
  /// m_0 = (1 + g) m_1 - g m_2, g = h_0/h_1 (and its mirror image) are put.
  void solve() {
    const std::size_t last = x_.size() - 1;
    const double first_ratio = gap(0) / gap(1), last_ratio = gap(last - 1) / gap(last - 2);
    std::vector<double> diagonal(last + 1), above(last + 1);
    for (std::size_t i = 1; i < last; ++i) {
      double below = gap(i - 1);
      diagonal[i] = 2 * (gap(i - 1) + gap(i));
      above[i] = gap(i);
      if (i == 1) diagonal[i] += gap(0) * (1 + first_ratio), above[i] -= gap(0) * first_ratio;
      if (i + 1 == last) diagonal[i] += gap(i) * (1 + last_ratio), below -= gap(i) * last_ratio;
      curvature_[i] = 6 * (slope(i) - slope(i - 1));
      if (i > 1) {
        diagonal[i] -= below / diagonal[i - 1] * above[i - 1];
        curvature_[i] -= below / diagonal[i - 1] * curvature_[i - 1];
      }
    }
    curvature_[last - 1] /= diagonal[last - 1];
    for (std::size_t i = last - 1; i-- > 1;)
      curvature_[i] = (curvature_[i] - above[i] * curvature_[i + 1]) / diagonal[i];
    curvature_[0] = (1 + first_ratio) * curvature_[1] - first_ratio * curvature_[2];
    curvature_[last] = (1 + last_ratio) * curvature_[last - 1] - last_ratio * curvature_[last - 2];
  }

  const std::vector<double>&x_, &y_;
  std::vector<double> curvature_;
};

std::vector<PlateSums> all_sums(std::span<const PlateCurve> curves) {
  std::vector<PlateSums> all;
  for (const PlateCurve& curve : curves) all.push_back(sums_of(curve));
  return all;
}

}  // namespace

PlateCurve mean_curve(std::span<const PlateTest> repeats, const PressureGrid& grid) {
  if (repeats.empty()) throw InputError("no plate tests to average");
  if (!(grid.step > 0.0 && grid.last >= grid.first)) throw InputError("the pressure grid is empty");
  std::vector<NotAKnotSpline> splines;
  for (const PlateTest& test : repeats) {
    if (test.radius != repeats.front().radius) throw InputError("repeats of a plate test must share the plate");
    splines.emplace_back(test.pressure, test.sinkage);
  }
  PlateCurve curve{.radius = repeats.front().radius, .pressure = {}, .sinkage = {}};
  const auto count = static_cast<std::size_t>(std::floor((grid.last - grid.first) / grid.step + 1e-9)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double pressure = grid.first + static_cast<double>(i) * grid.step;
    double sum = 0.0;
    for (const NotAKnotSpline& sinkage : splines) sum += sinkage(pressure);
    const double mean = sum / static_cast<double>(splines.size());
    if (!(pressure > 0.0 && mean > 0.0)) continue;
    curve.pressure.push_back(pressure);
    curve.sinkage.push_back(mean);
  }
  return curve;
}

PlateSums sums_of(const PlateCurve& curve) {
  const std::size_t n = curve.pressure.size();
  if (n < 2 || curve.sinkage.size() != n) throw InputError("a plate's curve needs at least two points");
  if (!(curve.radius > 0.0)) throw InputError("a plate's radius must be positive");
  PlateSums m{.radius = curve.radius};
  for (std::size_t i = 0; i < n; ++i) {
    const double p = curve.pressure[i], z = curve.sinkage[i];
    if (!(p > 0.0 && z > 0.0)) throw InputError("a plate's pressures and sinkages must be positive");
    m.weight += p * p;
    m.ln_z += p * p * std::log(z);
    m.ln_p += p * p * std::log(p);
  }
  m.ln_z /= m.weight, m.ln_p /= m.weight;
  for (std::size_t i = 0; i < n; ++i) {
    const double p = curve.pressure[i], dz = std::log(curve.sinkage[i]) - m.ln_z, dp = std::log(p) - m.ln_p;
    m.zz += p * p * dz * dz;
    m.zp += p * p * dz * dp;
    m.pp += p * p * dp * dp;
  }
  constexpr double rounding = 1e-20;  // of the squares of the means, that sums of equal sinkages may leave
  if (!(m.zz > rounding * m.weight * (1.0 + m.ln_z * m.ln_z)))
    throw InputError("a plate's sinkages are all the same: no exponent follows from them");
  return m;
}

double PlateSums::modulus(double exponent) const { return std::exp(ln_p - exponent * ln_z); }

double reference_sinkage(std::span<const PlateSums> curves) {
  double sum = 0.0;
  for (const PlateSums& m : curves) sum += m.ln_z;
  return std::exp(sum / static_cast<double>(curves.size()));
}

double exponent_of(std::span<const PlateSums> curves, PlateExponent exponent) {
  double zz = 0.0, zp = 0.0, mean = 0.0;
  for (const PlateSums& m : curves) {
    zz += m.zz, zp += m.zp;
    mean += m.exponent() / static_cast<double>(curves.size());
  }
  return exponent == PlateExponent::common ? zp / zz : mean;
}

PlateFit fit_plates_at(std::span<const PlateSums> curves, double exponent) {
  PlateFit fit;
  fit.exponent = exponent;
  double sum_u = 0.0, sum_k = 0.0, sum_uu = 0.0, sum_uk = 0.0;  // u = 1/b
  for (const PlateSums& m : curves) {
    const double u = 1 / m.radius, k = m.modulus(exponent);
    fit.plate_exponents.push_back(m.exponent());
    fit.plate_moduli.push_back(k);
    sum_u += u, sum_k += k, sum_uu += u * u, sum_uk += u * k;
  }
  const double count = static_cast<double>(curves.size()), spread = count * sum_uu - sum_u * sum_u;
  if (!(spread > 1e-9 * sum_uu)) throw InputError("k_c and k_phi need plates of at least two radii");
  fit.k_c = (count * sum_uk - sum_u * sum_k) / spread;
  fit.k_phi = (sum_k - fit.k_c * sum_u) / count;
  return fit;
}

PlateFit fit_plates_at(std::span<const PlateCurve> curves, double exponent) {
  return fit_plates_at(std::span<const PlateSums>(all_sums(curves)), exponent);
}

PlateFit fit_plates(std::span<const PlateCurve> curves, PlateExponent exponent) {
  const std::vector<PlateSums> sums = all_sums(curves);
  return fit_plates_at(std::span<const PlateSums>(sums), exponent_of(sums, exponent));
}

}  // namespace soilbin::bekker_wong
