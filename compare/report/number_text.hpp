// Numbers as people read them.
#pragma once

#include <string>

#include "scenario/estimate.hpp"

namespace soilbin::compare {

/// Four digits, never "-0", an exponent only beyond everyday sizes; "-" for what is not a number.
std::string number(double value);

/// "4.18 ± 0.31": the error to two digits, the value to the error's place; the value alone for an error of 0.
std::string number(const Estimate& estimate, double per_unit = 1.0);

}  // namespace soilbin::compare
