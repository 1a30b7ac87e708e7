#include "scenario/estimate.hpp"

#include <cmath>
#include <numeric>

namespace soilbin {
namespace {

double mean(std::span<const double> repeats) {
  return std::accumulate(repeats.begin(), repeats.end(), 0.0) / static_cast<double>(repeats.size());
}

}  // namespace

double spread_of(std::span<const double> repeats) {
  if (repeats.size() < 2) return 0.0;
  const double middle = mean(repeats);
  double squares = 0.0;
  for (const double one : repeats) squares += (one - middle) * (one - middle);
  return std::sqrt(squares / static_cast<double>(repeats.size() - 1));
}

Estimate mean_of(std::span<const double> repeats) {
  return {mean(repeats), spread_of(repeats) / std::sqrt(static_cast<double>(repeats.size()))};
}

}  // namespace soilbin
