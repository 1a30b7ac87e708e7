// The `conditions:` of a study: axes that span a grid of operating conditions.
#pragma once

#include <vector>

#include "scenario/mapping_reader.hpp"

namespace soilbin {

/// Most conditions that one study may span.
inline constexpr std::size_t most_conditions = 100'000;

/// Reads a mapping of axes, or a list of such mappings (their union, in order). An axis is a value, a list of values,
/// or a range {from, to, step} or {from, to, count}; the conditions are the full product, the first axis written
/// varying slowest. `rotation`, an axis instead of `speed`, is the wheel's speed of rotation: each condition then gets
/// the speed of travel that its slip implies for a rim of the tire's radius.
std::vector<OperatingCondition> read_conditions(const YamlNode& node, const Tire& tire, const Reading& reading);

}  // namespace soilbin
