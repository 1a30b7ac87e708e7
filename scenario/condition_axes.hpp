// The `conditions:` of a study: axes that span a grid of operating conditions.
#pragma once

#include <optional>
#include <vector>

#include "scenario/mapping_reader.hpp"

namespace soilbin {

/// Most conditions that one study may span.
inline constexpr std::size_t most_conditions = 100'000;

/// Conditions, and the speed of rotation [rad/s] from which each got its speed; none where the file gives the speed.
struct ConditionGrid {
  std::vector<OperatingCondition> conditions;
  std::vector<std::optional<double>> rotations;
};

/// Reads a mapping of axes, or a list of such mappings (their union, in order). An axis is a value, a list of values,
/// or a range {from, to, step} or {from, to, count}; the conditions are the full product, the first axis written
/// varying slowest. `rotation`, an axis instead of `speed`, is the wheel's speed of rotation: each condition then gets
/// speed_at_rotation for a rim of the tire's radius.
ConditionGrid read_conditions(const YamlNode& node, const Tire& tire, const Reading& reading);

/// The numbers [SI] from one to another in equal steps, each rounded to 12 digits in the unit in which the range is
/// written, so that 0 % .. 60 % in steps of 10 % gives 30 %, not 30.000000000000004 %. `to` is among them where a step
/// ends there. `n` is the soil's exponent, for units that depend on it. Throws InputError, without a position, where
/// the step doesn't lead from `from` to `to`, and for more than 10,000 numbers.
std::vector<double> numbers_by_step(const Quantity& from, double to, const Quantity& step,
                                    std::optional<double> n = std::nullopt);

/// A range as a number of values, at least 2, both ends among them.
std::vector<double> numbers_by_count(const Quantity& from, double to, int count,
                                     std::optional<double> n = std::nullopt);

/// The speed of travel [m/s] that slip and a speed of rotation w [rad/s] imply (docs/reference/conventions.md): r w (1
/// - s) driven, r w/(1 + s) braked; that is the speed in the wheel's plane, v cos(yaw), or, where the condition's
/// slip_by says so, the whole v. Throws InputError at slip -1, where the wheel does not turn, and at a yaw of 90 deg.
double speed_at_rotation(const OperatingCondition& at, double rotation, const Tire& tire);

}  // namespace soilbin
