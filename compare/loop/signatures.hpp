// Tracing a residual: what each form of each effect would do to the cells, seen off what the soil's values absorb.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/loop/evidence.hpp"
#include "compare/loop/thread_pool.hpp"

namespace soilbin::compare {

/// One form's signature and how well the residual follows it.
struct Signature {
  Term term;
  double at_amplitude = 0.0;    ///< amplitude of the secant [SI]
  Eigen::VectorXd white;        ///< whitened change of the cells per unit amplitude
  Eigen::VectorXd direction;    ///< unit vector of its part off the nuisance columns (augmented rows)
  double projected_norm = 0.0;  ///< |P d|
  double share_kept = 0.0;      ///< |P d|/|d|
  double score = 0.0;           ///< d'P r/|P d|, standard normal where the effect is absent
  double amplitude = 0.0;       ///< least-squares amplitude d'P r/(d'P d) [SI]
  double std_error = 0.0;       ///< of the amplitude [SI]
  double detectable = 0.0;      ///< amplitude found in 80 % of repetitions at a family-wise 5 % [SI]
  bool one_sided = false;       ///< physics fixes the sign: only positive amplitudes count
  bool testable = false;        ///< the detectable amplitude lies within the form's bounds
  /// The statistic that competes: score, or |score| where both signs are possible.
  double strength() const { return one_sided ? score : (score < 0 ? -score : score); }
};

/// Noncentrality at which a form is detected in 80 % of repetitions against a family of about fifty: (3.29 + 0.84)^2.
inline constexpr double detectable_noncentrality = 17.0;

/// What a traced model stands on: predictor with the terms accepted so far, its fit, whitening, and the linear problem.
struct TracedModel {
  const Campaign& campaign;
  const Observations& observations;
  const Whitening& whitening;
  const WheelPredictor& predictor;
  const Fit& fit;
  const LinearProblem& problem;
};

/// Signatures of all forms of the catalogue that are not of an effect among the declared or accepted ones; secants at
/// two sizes each, because some effects have no derivative at 0. Forms without any trace are listed with
/// projected_norm 0.
std::vector<Signature> residual_signatures(const TracedModel& model, const ThreadPool& pool = {});

/// Probability that the largest strength of all signatures would reach `observed` if nothing were missing: simulated
/// maximum over normal residuals, with the noise's scale known to `freedom` degrees of freedom.
double family_wise_p(const std::vector<Signature>& signatures, double observed, double freedom, int simulations,
                     std::uint64_t seed);

}  // namespace soilbin::compare
