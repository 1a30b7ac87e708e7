// A number that several packings of one test gave.
//
//   over_packings(std::vector<Estimate>{{0.27, 0.01}, {0.29, 0.01}})  // 0.28 +- 0.01
#pragma once

#include <span>

#include "scenario/estimate.hpp"

namespace soilbin::dem {

/// Mean and its standard error: by how much the packings differ, or, where that is more, by what each one tells of
/// itself (both over the root of their number). Few packings may agree by chance.
/// The number and its own error for a single one; NaN without any.
Estimate over_packings(std::span<const Estimate> each);

}  // namespace soilbin::dem
