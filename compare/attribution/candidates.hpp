// Stages 3 and 4 of the loop: what stands out of the base model's residual, and the sets of effects that could have
// made it, each fitted in full and weighed by its evidence.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/attribution/base_fit.hpp"
#include "compare/attribution/signatures.hpp"
#include "compare/attribution/unnamed.hpp"
#include "compare/fit/evidence.hpp"

namespace soilbin::compare {

// A set of effects fitted in full beside the soil's values.

/// A set of effects that competes, fitted in full, each in one form.
struct CandidateModel {
  std::set<std::string> ids;
  FittedModel model;
  double log_evidence = 0.0;
  const Fit& fit() const { return model.fit(); }
  const std::vector<Term>& terms() const { return model.terms(); }
};

struct CandidateStart {
  const Fit* from;  ///< of the soil, and of the first terms; the others start at their defaults
  std::map<int, std::vector<double>>
      estimated;               ///< a term's parameters, amplitude first, where its signature puts them [SI]
  double expected_drop = 0.0;  ///< what the signatures promise to take off its chi2
};

/// Fits the terms in full beside the base model; again from smaller amplitudes where that gained less than half of what
/// was expected_drop, and from next to none where it gained nothing: an effect that joins others leaves no more than
/// they did. Nothing where no start balances.
std::optional<FittedModel> fit_terms(const FittedModel& base, const std::vector<Term>& terms,
                                     const CandidateStart& known);

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
  bool none_near_noise = false;  ///< what even the best one leaves is no noise of a known size
  /// The model of largest weight, where the family-wise test accepts any; once judged (judge), the one chosen.
  std::optional<std::size_t> best;

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

// Model discrepancy (Kennedy and O'Hagan 2001): a second attribution of the residual, in which the base model's own
// form may be wrong. One with an exact base model has no way to say so but to name effects that make up for it.

/// What the base model's own form may leave in the cells: smooth functions of its variables, load and slip, in every
/// channel, whitened to about 1 sd a cell each (the model discrepancy of Kennedy and O'Hagan 2001, J.
/// R. Stat. Soc. B 63:425).
Eigen::MatrixXd model_discrepancy_columns(const FittedModel& base);

/// An attribution of the same observations in which the base model may be off by such functions.
struct DiscrepancyAttribution {
  double size = 0.0;  ///< sd of each function's weight, in sd of the noise: the one that explains the data best
  /// Its ln evidence stands beside that of the first attribution, the price of the size paid.
  Attribution found;
};

/// Finds signatures, fits and weighs the effects of the catalogue once more, now that load and slip alone explain
/// nothing. Nothing where either attribution is far from the noise (Candidates::none_near_noise), or no soil carries
/// the wheel.
std::optional<DiscrepancyAttribution> attribute_with_model_discrepancy(const Attribution& first,
                                                                       const AttributionOptions& options);

}  // namespace soilbin::compare
