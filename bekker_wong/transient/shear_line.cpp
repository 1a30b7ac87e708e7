#include "bekker_wong/transient/shear_line.hpp"

#include <algorithm>

namespace soilbin::bekker_wong {
namespace {

/// Value at place k = 0 .. N, the entry's 0 included.
double place(ShearLine j, int k) { return k == 0 ? 0.0 : j[static_cast<std::size_t>(k - 1)]; }

}  // namespace

double slope_at(ShearLine j, int i, bool with_stream) {
  const int last = static_cast<int>(j.size()), k = i + 1;
  const auto f = [&](int shift) { return place(j, k + shift); };
  const double per_step = static_cast<double>(last);
  if (k == last) return per_step * (11 * f(0) - 18 * f(-1) + 9 * f(-2) - 2 * f(-3)) / 6;
  if (with_stream) {
    if (k == 1) return per_step * 0.5 * (f(1) - f(-1));
    return per_step * (2 * f(1) + 3 * f(0) - 6 * f(-1) + f(-2)) / 6;
  }
  if (k == last - 1) return per_step * 0.5 * (f(1) - f(-1));
  return per_step * (-2 * f(-1) - 3 * f(0) + 6 * f(1) - f(2)) / 6;
}

double value_at(ShearLine j, double u) {
  const int last = static_cast<int>(j.size());
  const double x = std::clamp(u, 0.0, 1.0) * last;
  const int first = std::clamp(static_cast<int>(x) - 1, 0, last - 3);
  const double t = x - first;  // 0 .. 3
  const double a = place(j, first), b = place(j, first + 1), c = place(j, first + 2), d = place(j, first + 3);
  return -a * (t - 1) * (t - 2) * (t - 3) / 6 + b * t * (t - 2) * (t - 3) / 2 - c * t * (t - 1) * (t - 3) / 2 +
         d * t * (t - 1) * (t - 2) / 6;
}

}  // namespace soilbin::bekker_wong
