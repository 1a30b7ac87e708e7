// Stage 5 of the loop: which candidate stands on conditions left out, what it leaves, and which others the data can't
// tell from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "compare/attribution/candidates.hpp"
#include "compare/attribution/detection.hpp"
#include "compare/attribution/predictive_gain.hpp"

namespace soilbin::compare {

/// The rule by which an effect is accepted: conditions left out are predicted better by a standard error; or better at
/// all, where the odds pass thresholds::odds_enough: with a dozen conditions a standard error is more than a real
/// effect reaches.
/// log_odds: ln evidence over the model without it, its price paid.
bool earns_its_place(const PredictiveGain& gain, double log_odds);

/// What a model leaves, against the noise and against re-runs.
struct ResidualTests {
  LackOfFit lack_of_fit;
  RerunTest reruns;
  SerialTest serial;
};
ResidualTests test_residual(const FittedModel& model, std::uint64_t seed);

/// The candidate that is left after each of its effects had to earn its place.
struct ChosenCandidate {
  std::size_t candidate = 0;  ///< index in Candidates::models
  PredictiveGain gain;        ///< over the base model
  ResidualTests after;        ///< of what it leaves
  UnnamedEvidence unnamed;    ///< for an unnamed term beside it, with the tolerance of its forms
  bool stands = false;        ///< against the base model
};

/// Backward from Candidates::best, which must be there: an effect stays only if the candidate with it predicts
/// conditions left out better than the best one without.
ChosenCandidate choose(const Attribution& found, const AttributionOptions& options);

/// A set of effects that competes with the best one.
struct Competitor {
  std::size_t set = 0;   ///< index in Candidates::sets
  double allowed = 0.0;  ///< ln evidence by which it may stand behind and still competes
};

/// The sets that the data can't tell from that of Candidates::best, which must be there, itself first. How far behind a
/// set may stand grows with what the best one explains: the more there is to explain, the more a form that nature does
/// not share costs. It is wider on small designs, where a few values decide, and narrower for sets that hold the best
/// one and more.
std::vector<Competitor> competitors(const Candidates& candidates);

/// The set of most evidence behind the best one; nullptr where no other was fitted.
const WeightedSet* next_standing(const Candidates& candidates, const std::set<std::string>& best);

/// ln odds of the best set over every other one that was fitted, and over the base model.
double lead(const Candidates& candidates);
/// Whether that is so large that no further run is worth it: thresholds::excluded_odds.
bool is_settled(const Candidates& candidates);

/// The competitors as an answer lists them, with weights that sum to 1.
std::vector<WeightedSet> ambiguity_set(const Candidates& candidates);

}  // namespace soilbin::compare
