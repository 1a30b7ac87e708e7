// A doubt about the analytic wheel at no slip: a part of the list of doubts (doubts.hpp).
#pragma once

#include <string>

#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// A wheel that pulls more than 15 % of its load at a slip of up to 1 %, level or on a slope; "" where it doesn't. Even
/// without slip the model shears the soil by up to r (theta_1 - sin theta_1) under the wheel, and a large or deep one
/// by many times K. Wheels that pull slip.
std::string pull_without_slip(const Scenario& scenario, const Answer& answer);

}  // namespace soilbin::compare
