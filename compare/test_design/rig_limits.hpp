// Where a rig can go, and the conditions within that a test may be made at.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compare/fit/observations.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {

/// Closed ranges within which the rig can go, by condition name (slip, load, speed, yaw, pass, ...) [SI].
using Limits = std::map<std::string, std::pair<double, double>>;

/// What the runs span, by name: every condition of theirs that takes two values or more, but for their order.
Limits ranges_of(const Observations& observations);

/// Where a campaign's rig can go as long as nobody says otherwise: the ranges that the campaign spans, of load and slip
/// a little more (thresholds::lowest_load_share and its neighbours). Candidates that fit the same runs differ best a
/// little beyond them.
Limits limits_of(const Observations& observations);

/// Limits for the next run of a wheel: a pneumatic tire is let out or pumped up at every rig, about its declared
/// pressure (thresholds::lowest_pressure_share and its neighbour) where the runs span none.
Limits limits_of(const Observations& observations, const Tire& wheel);

/// The unit of the campaign's own column of a condition, where it has one, else the one in which people read it; and
/// how many of it are one in SI.
std::pair<std::string, double> own_unit(const std::map<std::string, DataColumn>& columns, const ConditionView& view);

/// What a rig would be set to for a condition's value [SI]: the roundest number in a unit (units per SI unit: per_si),
/// 1, 2 or 5 with noughts, that differs from it by no more than re-runs of one setpoint scatter or 1 % of what was run,
/// and by a tenth and a fiftieth of itself where every run's value is positive. Where the value lies so near to a run
/// that was made, from what that run and its like were set to. Never beyond `within`, where the rig can go.
///
///     rig_setting(condition_view("speed"), 0.00998, observations, {0.001, 0.1}, 1000);   // 0.01: 10 mm/s
double rig_setting(const ConditionView& view, double value, const Observations& observations,
                   const std::pair<double, double>& within, double per_si);

/// A number to three significant digits.
double three_digits(double value);

/// So many values from the lower to the upper end of a range, evenly; its middle where it is one.
std::vector<double> evenly(const std::pair<double, double>& range, int levels);

/// A condition's name and the values that it takes [SI].
using Levels = std::pair<std::string, std::vector<double>>;

/// `centre` with each combination of these values, the last condition the fastest.
std::vector<OperatingCondition> combinations(const OperatingCondition& centre, const std::vector<Levels>& levels);

}  // namespace soilbin::compare
