#include "compare/design/next_point.hpp"

#include <cmath>

#include "bekker_wong/gsl.hpp"

namespace soilbin::compare {

double chance_within(const Estimate& predicted, double target, double half_width) {
  const double off = predicted.value - target, sd = predicted.std_error;
  if (sd <= 0) return std::abs(off) <= half_width ? 1.0 : 0.0;
  return gsl::normal_tail((-half_width - off) / sd) - gsl::normal_tail((half_width - off) / sd);
}

double straddle(const Estimate& predicted, double limit) {
  return 1.96 * predicted.std_error - std::abs(std::abs(predicted.value) - limit);
}

}  // namespace soilbin::compare
