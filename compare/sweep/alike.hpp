#pragma once

#include "scenario/operating_condition.hpp"

namespace soilbin::compare {

/// Whether two conditions agree as far as a person who types numbers can tell: to 1e-9 of each number.
bool alike(const OperatingCondition& a, const OperatingCondition& b);

}  // namespace soilbin::compare
