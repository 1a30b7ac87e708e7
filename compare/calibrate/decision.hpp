// Candidates that one test can't tell apart, decided by another: a wheel is driven with each of them where a campaign
// was measured, and the one that comes nearest is chosen, as Zhou et al. choose among their four (section 3.2.2).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// An array over channels, in the order of channel_views.
template <class T>
using OfChannels = std::array<T, channel_views.size()>;

/// A condition of a campaign, and what was measured there.
struct Setpoint {
  OperatingCondition at;  ///< means of its runs, without what grains don't know: moisture, position, run, pressure
  int runs = 0;           ///< that the campaign made there
  OfChannels<std::optional<Estimate>> measured;  ///< means [SI]; the error is the mean's, from all re-runs of the
                                                 ///< campaign, and 0 where it has none
};

/// The setpoints of a campaign at which a channel was measured, as the loop tells them apart (observe), in the order of
/// its rows.
std::vector<Setpoint> setpoints_of(const Campaign& campaign);

/// The setpoints between the bounds of one member of the condition, both included [SI].
std::vector<Setpoint> between(const std::vector<Setpoint>& setpoints, double OperatingCondition::*member, double lower,
                              double upper);

/// How far a candidate's wheel is from the measured one.
struct Trial {
  std::vector<Answer> answers;  ///< a setpoint each
  /// Root mean square of simulated - measured over the setpoints, as a share of the load: forces over W, torque over
  /// W r, sinkage over r [-]. None where the campaign doesn't measure the channel, or an answer has no result.
  OfChannels<std::optional<Estimate>> errors;
  std::optional<Estimate> error;  ///< root mean square of the channels' [-]
  bool apart = false;  ///< told apart from the nearest candidate: farther off by more than two standard errors
};

/// The candidate that the soil bin chose, and the trials behind the choice.
struct Decision {
  std::string campaign;
  std::vector<Setpoint> setpoints;
  std::vector<Trial> trials;  ///< a candidate each, in their order: the likeliest first
  std::size_t nearest = 0;    ///< has the smallest error
  std::size_t chosen = 0;     ///< the first, so the likeliest, of those that can't be told apart from it
  int runs = 0;               ///< behind the answers
  int not_steady = 0;         ///< of them
  /// Whether any candidate has an error at all; else nothing is decided.
  bool decided() const;
  /// Candidates that can't be told apart from the nearest one, itself included.
  int tied() const;
};

/// Compares answers, a row a candidate and a setpoint each, with what was measured. `radius`: of the wheel [m].
///
/// With misses d (share of the load) of weight w = 1/(channels x setpoints of the channel), E^2 = sum w d^2. The
/// difference of two candidates, D = E_k^2 - E_b^2, has to first order the standard error
///     S^2 = sum over setpoints of (sum_c 2 w |d_k| s_k)^2 + (sum_c 2 w |d_b| s_b)^2 + (sum_c 2 w |d_k - d_b| s_m)^2,
/// s_k, s_b the answers' own standard errors, s_m the measurement's, which both share: the channels of one run are
/// taken to err together and the answers of two candidates apart, each of which makes S the larger. They are told apart
/// where D > 2 S. Throws std::invalid_argument for rows of another length.
Decision decide(std::string campaign, std::vector<Setpoint> setpoints, std::vector<std::vector<Answer>> answers,
                double radius);

/// "(a)" for the first.
std::string candidate_name(std::size_t candidate);

}  // namespace soilbin::compare
