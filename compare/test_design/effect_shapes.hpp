// What one run at a condition would tell of each effect and of the soil, before any run is made; and how well some such
// runs tell the effects apart.
//
// About the declared soil the model is linear: a form f with amplitude a moves the whitened values of a run by a d_f, a
// soil value by its column of J. Let S be the Gram matrix of all d of the runs, off what J can make within the soil's
// priors. Where f is true with amplitude a and g is fitted in its place, what stays is at least
//
//   D = a^2 (S_ff - S_fg^2/S_gg)                                     [variances of the noise]
//
// (g's amplitude free, or not below 0 where physics fixes its sign), a squared distance: the better of the two
// likelihoods is the truth's with probability Phi(sqrt(D)/2). D is what T-optimal designs maximise (Atkinson and
// Fedorov 1975, Biometrika 62:57).
#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/attribution/signatures.hpp"
#include "compare/fit/noise_floor.hpp"
#include "compare/fit/thread_pool.hpp"

namespace soilbin::compare {

/// A form of an effect as it would show.
struct EffectShape {
  std::size_t effect = 0;  ///< of EffectShapes::ids
  bool one_sided = false;
  double amplitude = 1.0;  ///< as large as the noise: 1 sd a run (rms over the conditions), off what the soil absorbs
};

/// The catalogue's forms at some conditions, and how a run at each responds to them.
struct EffectShapes {
  std::vector<std::string> ids;        ///< effects that these conditions can show
  std::vector<std::string> not_shown;  ///< those of the wanted ones that they can't
  std::vector<EffectShape> shapes;     ///< of these effects
  /// Whitened slopes of the channels, by condition: a row a channel, a column a shape, then the soil's J.
  std::vector<Eigen::MatrixXd> sensitivities;
  NoiseFloor noise;       ///< of one run
  Eigen::Index soil = 0;  ///< columns of J, in units of the priors' sd
  /// Fisher information of a run at one of the conditions: sensitivities' times sensitivities.
  Eigen::MatrixXd information_of(std::size_t condition) const;
  /// The shapes' block of the information summed over runs, the soil's values fitted (Schur complement).
  Eigen::MatrixXd off_soil(const Eigen::MatrixXd& information) const;
  /// Columns of the sensitivities.
  Eigen::Index columns() const { return static_cast<Eigen::Index>(shapes.size()) + soil; }
};

/// sd of one run's value, for each channel that is measured [SI].
using ExpectedNoise = std::array<std::optional<double>, channel_count>;

/// Shapes of some effects (wanted: ids; empty: of all) at these conditions, at which the declared soil must carry the
/// wheel; a run's channels are those in `noise`. An effect is shown where a form of it reaches the size of the noise
/// within its bounds; that size is a mean over the first `spread` conditions.
EffectShapes effect_shapes(const Campaign& campaign, const std::vector<OperatingCondition>& conditions,
                           std::size_t spread, const ExpectedNoise& noise, const std::vector<std::string>& wanted = {},
                           const ThreadPool& pool = {});

/// thresholds::typical_noise_share of each channel's range over the conditions, as the loop takes it before it knows
/// better; the side force where yaw or cross slope is not 0 in some.
ExpectedNoise usual_noise(const Campaign& campaign, const std::vector<OperatingCondition>& conditions);

/// An effect that is there, and what may be taken for it.
struct CandidatePair {
  std::size_t truth = 0;
  std::optional<std::size_t> other;  ///< nothing: the soil alone, no effect
  double separation = 0.0;           ///< sqrt(D), mean over the truth's forms, each against the other's nearest [sd]
  double right = 0.5;                ///< Phi(sqrt(D)/2), the mean over the same
};

/// Every effect against every other one and against none. information: summed over the runs.
std::vector<CandidatePair> candidate_pairs(const EffectShapes& shapes, const Eigen::MatrixXd& information);

/// Share of the effects that are expected to be named right: of each form the product of Phi(sqrt(D)/2) over the others
/// (as if these erred each by itself), the mean over an effect's forms, the mean over the effects.
double share_named_right(const EffectShapes& shapes, const Eigen::MatrixXd& information);

}  // namespace soilbin::compare
