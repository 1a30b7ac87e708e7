#include "dem/element_tests/mobilised.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenario/mean_value.hpp"

namespace soilbin::dem {

Mobilised peak_and_residual(std::span<const double> way, std::span<const double> curve, double window,
                            double residual_share) {
  Mobilised out;
  const std::size_t n = curve.size();
  const double end = way.back(), begin = way.front();
  out.residual_from = static_cast<std::size_t>(std::floor(static_cast<double>(n) * (1 - residual_share)));
  out.residual_from = std::min(out.residual_from, n - 2);
  out.residual = mean_with_error(curve.subspan(out.residual_from));

  const double spacing = (end - begin) / static_cast<double>(n - 1);
  const auto wide = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(window / spacing)), 1, n);
  double highest = -INFINITY;
  std::size_t at = 0;
  for (std::size_t k = 0; k + wide <= n; ++k) {
    const auto first = curve.begin() + static_cast<std::ptrdiff_t>(k);
    const double mean =
        std::accumulate(first, first + static_cast<std::ptrdiff_t>(wide), 0.0) / static_cast<double>(wide);
    if (mean > highest) highest = mean, at = k;
  }
  out.peak = mean_with_error(curve.subspan(at, wide));
  out.peak.std_error = std::max(out.peak.std_error, out.residual.std_error);
  out.peak_at = (way[at] + way[at + wide - 1]) / 2;
  out.peak_from = at, out.peak_samples = wide;
  return out;
}

HeldStress held_stress(std::span<const double> curve, const Mobilised& strength, double asked) {
  const auto mean = [](std::span<const double> part) {
    return std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(part.size());
  };
  HeldStress out;
  out.at_peak = mean(curve.subspan(strength.peak_from, strength.peak_samples));
  out.at_residual = mean(curve.subspan(strength.residual_from));
  out.error = std::max(std::abs(out.at_peak / asked - 1), std::abs(out.at_residual / asked - 1));
  return out;
}

}  // namespace soilbin::dem
