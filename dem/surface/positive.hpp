// The check that sizes, masses and times go through.
#pragma once

#include <cmath>

namespace soilbin::dem {

/// Above 0 and finite.
inline bool positive(double a) { return a > 0 && std::isfinite(a); }

}  // namespace soilbin::dem
