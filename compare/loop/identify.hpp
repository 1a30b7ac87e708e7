// From observations to a name: noise, base fit, trace, candidates, and which of them the data can't tell apart.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/loop/signatures.hpp"

namespace soilbin::compare {

/// A set of effects that competes, fitted in full.
struct CandidateModel {
  std::set<std::string> ids;
  std::vector<Term> terms;
  Fit fit;
  double log_evidence = 0.0;
};

/// Sets of effects with their share of the evidence, best first.
struct Weighted {
  std::set<std::string> ids;
  double weight = 0.0;
  double log_evidence = 0.0;       ///< over the set's forms, its price paid; beside Identification::base_log_evidence
  std::size_t best_candidate = 0;  ///< index of the set's best form(s) in Identification::candidates
};

struct IdentifyOptions {
  int simulations = 4000;  ///< of the maximum statistic
  double level = 0.05;     ///< family-wise
  int most_effects = 3;
  int refits = 16;  ///< forms refitted in full at each stage, at the most
  std::uint64_t seed = 1;
  bool drop_outliers = true;
  ThreadPool pool = {};  ///< for traces and fits; its pulse comes before each
};

/// What one pass over a set of observations finds.
struct Identification {
  Observations observations;  ///< after outliers were set aside
  std::vector<bool> outlier;  ///< of the cells given
  NoiseFloor noise;
  std::shared_ptr<const Whitening> whitening;
  Fit base;
  std::vector<Signature> signatures;       ///< against the base model
  double p_value = 1.0;                    ///< family-wise, of the strongest signature against the base model
  std::vector<CandidateModel> candidates;  ///< all that were refitted, base model not among them
  double base_log_evidence = 0.0;
  bool none_near_noise =
      false;                  ///< no candidate comes near the noise: what is left is not noise (schwarz_log_evidence)
  double unnamed_gain = 0.0;  ///< ln evidence that an unnamed term adds to the base model
  double residual_unnamed_gain = 0.0;  ///< the same for the best candidate, with the tolerance of its forms
  std::vector<Weighted> weights;       ///< over sets of effects, best first
  std::optional<std::size_t> best;     ///< candidate that the test accepts
};

/// The candidate of all those fitted whose effects are one of the best's set, best first; none for a single effect.
std::optional<std::size_t> best_subset(const Identification& id, std::size_t candidate);

/// Makes a candidate the best: what a later test decides against the evidence.
void prefer(const Campaign& campaign, Identification& id, std::size_t candidate);

/// Family-wise p-value of one term of a candidate beside its other terms: the probability that noise alone makes any
/// form of the catalogue stand out as much as this effect's strongest does once the others are fitted.
double p_beside_others(const Campaign& campaign, const Identification& id, const CandidateModel& candidate,
                       std::size_t term, const IdentifyOptions& options);

/// How alike the traces of an effect and of each other effect are in these data, off what the soil's values absorb: the
/// largest |cosine| over their forms, by id. 1: nothing tells them apart.
std::map<std::string, double> cosines(const Identification& id, const std::string& effect);

/// From a base fit whose noise is settled to names: traces, candidates, weights and what the test accepts.
void name_effects(const Campaign& campaign, const IdentifyOptions& options, Identification& id);

/// Throws NoSolution where no soil near the declared one carries the wheel in every run.
Identification identify(const Campaign& campaign, const Observations& observations, const IdentifyOptions& options);

}  // namespace soilbin::compare
