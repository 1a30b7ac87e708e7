// The noise of a measured campaign, estimated from its re-runs: the scatter between runs of one setpoint.
#pragma once

#include <vector>

#include "compare/fit/noise_floor.hpp"

namespace soilbin::compare {

/// What these runs measured of a channel (of channel_views) [SI]; runs without it are left out.
std::vector<double> values_of(const std::vector<const Run*>& runs, std::size_t channel);

/// Noise of one run, channel by channel, pooled over setpoints: sum of squares about each setpoint's mean over the
/// sum of runs beyond each setpoint's first, which is the freedom. All channels need not be measured in all runs.
/// Freedom 0: no setpoint has two runs with the channel, and nothing is known of its noise.
///
/// The standard deviation is one number, a, unless there are 20 degrees of freedom or more and the re-runs show that it
/// grows with the signal f: sqrt(a^2 + b^2 f^2) is taken where it makes them likelier by exp(2), which chance alone
/// does in about one campaign in thirty. `correlation`: between channels of one run, of the same residuals.
NoiseFloor rerun_noise(const std::vector<std::vector<const Run*>>& setpoints);

}  // namespace soilbin::compare
