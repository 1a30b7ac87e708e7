// Where a rig can go, and the conditions within that a test may be made at.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compare/loop/observations.hpp"

namespace soilbin::compare {

/// Closed ranges within which the rig can go, by condition name (slip, load, speed, yaw, pass, ...) [SI].
using Limits = std::map<std::string, std::pair<double, double>>;

/// What the runs span, by name: every condition of theirs that takes two values or more, but for their order.
Limits ranges_of(const Observations& observations);

/// Where a campaign's rig can go as long as nobody says otherwise: the ranges that the campaign spans; loads from 0.7
/// to 1.4 times them; slip at least -0.2 .. 0.8. Candidates that fit the same runs part best a little beyond them.
Limits limits_of(const Observations& observations);

/// So many values from the lower to the upper end of a range, evenly; its middle where it is one.
std::vector<double> evenly(const std::pair<double, double>& range, int levels);

/// A condition's name and the values that it takes [SI].
using Levels = std::pair<std::string, std::vector<double>>;

/// `centre` with each combination of these values, the last condition the fastest.
std::vector<OperatingCondition> combinations(const OperatingCondition& centre, const std::vector<Levels>& levels);

}  // namespace soilbin::compare
