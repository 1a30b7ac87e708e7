// Stages 3 and 4 of the loop: what stands out of the base model's residual, and the sets of effects that could have
// made it, each fitted in full and weighed by its evidence.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/attribution/base_fit.hpp"
#include "compare/attribution/candidate_fit.hpp"
#include "compare/attribution/signatures.hpp"
#include "compare/attribution/unnamed.hpp"

namespace soilbin::compare {

/// Sets of effects with their share of the evidence, best first.
struct WeightedSet {
  std::set<std::string> ids;
  double weight = 0.0;
  double log_evidence = 0.0;       ///< over the set's forms, its price paid; beside Candidates::base_log_evidence
  std::size_t best_candidate = 0;  ///< index of the set's best form(s) in Candidates::models
};

/// All that were fitted, and how they stand.
struct Candidates {
  std::vector<CandidateModel> models;  ///< the base model not among them
  std::vector<WeightedSet> sets;       ///< over sets of effects, best first
  double base_log_evidence = 0.0;
  bool none_near_noise = false;     ///< what even the best one leaves is no noise of a known size
  std::optional<std::size_t> best;  ///< of models: of largest weight, where the family-wise test lets any stand

  /// A set's weight by its effects; it must have been weighed.
  const WeightedSet& weighed(const std::set<std::string>& ids) const;
};

/// The residual of a base model attributed to effects (detection and attribution, as in optimal fingerprinting:
/// Hasselmann 1997, Clim. Dyn. 13:601).
///
///     const Attribution found = attribute(fit_base(campaign, observe(campaign), {}), {});
///     if (found.candidates.best) found.best().ids;   // {"slip_sinkage"}
struct Attribution {
  FittedModel base;
  ResidualSignatures signatures;           ///< against the base model
  std::vector<UnnamedKind> unnamed_kinds;  ///< of the base model
  UnnamedEvidence unnamed;                 ///< for an unnamed term of these beside the base model
  Candidates candidates;
  /// The candidate that stands, Candidates::best; there must be one.
  const CandidateModel& best() const { return candidates.models[*candidates.best]; }
};

/// From a base fit to names. Forward: the strongest forms, pairs of forms, then more effects beside the best pair,
/// thresholds::max_effects in all.
Attribution attribute(const FittedModel& base, const AttributionOptions& options);

/// Family-wise p-value of one term of a candidate beside its other terms: the probability that noise alone makes any
/// form of the catalogue stand out as much as this effect's strongest does once the others are fitted.
double p_beside_others(const Attribution& found, const CandidateModel& candidate, int term,
                       const AttributionOptions& options);

}  // namespace soilbin::compare
