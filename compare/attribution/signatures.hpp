// Signatures of effects: the pattern that each form of each effect would leave in the measured values, less what a
// refit of the soil's values absorbs, and how well the residual follows it. Stage 3 of the loop.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "compare/fit/evidence.hpp"
#include "compare/fit/thread_pool.hpp"

namespace soilbin::compare {

/// One form's signature and how well the residual follows it.
struct Signature {
  Term term;
  Eigen::VectorXd white;        ///< whitened change of the cells per unit amplitude
  Eigen::VectorXd direction;    ///< unit vector of its part off the nuisance columns (augmented rows)
  double projected_norm = 0.0;  ///< |P d|
  double share_kept = 0.0;      ///< |P d|/|d|
  double score = 0.0;           ///< d'P r/|P d|, standard normal where the effect is absent
  double amplitude = 0.0;       ///< least-squares amplitude d'P r/(d'P d) [SI]
  double std_error = 0.0;       ///< of the amplitude [SI]
  double detectable = 0.0;      ///< amplitude of thresholds::detectable_noncentrality [SI]
  bool one_sided = false;       ///< physics fixes the sign: only positive amplitudes count
  bool testable = false;        ///< the detectable amplitude lies within the form's bounds
  /// The statistic that competes: score, or |score| where both signs are possible.
  double strength() const { return one_sided ? score : (score < 0 ? -score : score); }
};

/// What stands out of a model's residual.
struct ResidualSignatures {
  std::vector<Signature> all;
  double p_value = 1.0;  ///< family-wise, of the strongest
  int simulations = 0;   ///< campaigns of noise alone that p_value is counted in
};

/// Signatures of all forms of the catalogue that are not of an effect among the declared or the model's own; secants at
/// two sizes each, because some effects have no derivative at 0. Forms that leave no trace are listed with
/// projected_norm 0. problem: the model's (problem_of).
///
///     const std::vector<Signature> all = residual_signatures(base, problem_of(base));
///     const double p = family_wise_p(all, strongest(all), base.data().noise.typical_freedom(), 4000, 1);
std::vector<Signature> residual_signatures(const FittedModel& model, const LinearProblem& problem,
                                           const ThreadPool& pool = {});

/// The largest strength of all; 0 where none leaves a trace.
double strongest(const std::vector<Signature>& signatures);

/// Probability that the largest strength of all signatures would reach `observed` if nothing were missing: simulated
/// maximum over normal residuals, with the noise's scale known to `freedom` degrees of freedom.
double family_wise_p(const std::vector<Signature>& signatures, double observed, double freedom, int simulations,
                     std::uint64_t seed);

/// How alike the signatures of an effect and of each other effect are in these data, off what the soil's values absorb:
/// the largest |cosine| over their forms, by id. 1: nothing tells them apart.
std::map<std::string, double> cosines(const std::vector<Signature>& signatures, const std::string& effect);

}  // namespace soilbin::compare
