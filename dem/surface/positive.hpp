// The check that sizes, masses and times go through.
#pragma once

#include <cmath>

#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

/// Above 0 and finite.
inline bool positive(double a) { return a > 0 && std::isfinite(a); }

inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

}  // namespace soilbin::dem
