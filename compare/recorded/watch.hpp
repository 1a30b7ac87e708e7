// How far work of many pieces is, told to whoever watches: the runs of a record, a calibration, a map, a decision.
//
//   const Watch watch = [](const dem::Progress& at) { fmt::print("{}: {:.0f} %\n", at.stage, 100 * at.done); };
//   for (int k = 0; k < 12; ++k) tell(watch, fmt::format("run {} of 12", k + 1), k, 12), seconds += make(k);
#pragma once

#include <functional>
#include <string>

#include "dem/bed/work_options.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

/// Told of each piece before it begins, and of what goes on inside it (dem::WorkOptions). May throw to stop; what is
/// finished is kept.
using Watch = std::function<void(const dem::Progress&)>;

/// Tells that the next piece begins, after `done` of `all`, which took `seconds`; a watch that is empty hears nothing.
inline void tell(const Watch& watch, const std::string& stage, std::size_t done, std::size_t all, double seconds = 0) {
  const double pieces = static_cast<double>(done), left = static_cast<double>(all) - pieces;
  if (watch) watch({stage, pieces / static_cast<double>(all), seconds > 0 ? seconds / pieces * left : not_a_number});
}

}  // namespace soilbin::compare
