#include "compare/design/next_point.hpp"

#include <cmath>
#include <numbers>

#include "bekker_wong/gsl.hpp"

namespace soilbin::compare {

double uncertainty(const Estimate& predicted) { return predicted.std_error; }

double expected_improvement(const Estimate& predicted, double lowest) {
  const double gain = lowest - predicted.value, sd = predicted.std_error;
  if (sd <= 0) return std::max(0.0, gain);
  const double z = gain / sd;
  return gain * gsl::normal_tail(-z) + sd * std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

double chance_within(const Estimate& predicted, double target, double half_width) {
  const double off = predicted.value - target, sd = predicted.std_error;
  if (sd <= 0) return std::abs(off) <= half_width ? 1.0 : 0.0;
  return gsl::normal_tail((-half_width - off) / sd) - gsl::normal_tail((half_width - off) / sd);
}

double straddle(const Estimate& predicted, double limit) {
  return 1.96 * predicted.std_error - std::abs(std::abs(predicted.value) - limit);
}

}  // namespace soilbin::compare
