#include "compare/doubts/pull_without_slip.hpp"

#include <fmt/core.h>

#include <cmath>

#include "compare/sweep/varying.hpp"

namespace soilbin::compare {

std::string pull_without_slip(const Scenario& scenario, const Answer& answer) {
  constexpr double no_slip = 0.01, much = 0.15;  // chosen; the share is of the load
  const OperatingCondition& at = answer.at;
  const double beside_slope = answer.result->drawbar_pull.value + at.load * std::sin(at.longitudinal_incline);
  const double share = beside_slope / at.load, entry = answer.result->entry_angle;
  if (std::abs(at.slip) > no_slip || !(share > much) || !(entry > 0.0)) return "";
  return fmt::format(
      "the wheel pulls {:.2g} of its load at {}: even there the model shears the soil by up to {:.3g} mm under a "
      "radius "
      "of {:.4g} mm, and K is {:.3g} mm. A wheel that pulls slips: take pulls at less than 5 % slip as upper bounds",
      share, in_words(at), 1000 * scenario.tire.radius * (entry - std::sin(entry)), 1000 * scenario.tire.radius,
      1000 * scenario.soil.semi_empirical->shear_modulus.value);
}

}  // namespace soilbin::compare
