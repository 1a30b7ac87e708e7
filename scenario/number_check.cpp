#include "scenario/number_check.hpp"

#include <fmt/core.h>

namespace soilbin::number_check_detail {

void check(const char* key, double value, const Measure& measure) {
  if (!std::isfinite(value)) throw InputError(fmt::format("{} is {}: it must be a number", key, value));
  if (!measure.range.holds(value))
    throw InputError(fmt::format("{} {:.6g} (SI) is out of range: must be {}", key, value, describe_range(measure)));
}

void check(const char* key, int value, int lowest) {
  if (value < lowest) throw InputError(fmt::format("{} {} is out of range: must be at least {}", key, value, lowest));
}

}  // namespace soilbin::number_check_detail
