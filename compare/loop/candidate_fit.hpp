// A set of effects fitted in full beside the soil's values, and the evidence for it.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "compare/loop/identify.hpp"

namespace soilbin::compare {

/// The fit as a linear problem, with the tolerance of its terms' forms.
LinearProblem problem_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit);

/// Whether a fit leaves so much that it is no noise: then neither is it a form's own doing.
bool far_from_noise(const Identification& id, const Fit& fit);

/// ln evidence of a candidate's fit; where no candidate comes near the noise, by what it leaves alone
/// (schwarz_log_evidence).
double evidence_of(const Identification& id, const WheelPredictor& predictor, const Fit& fit);

/// Where a fit starts.
struct CandidateStart {
  Eigen::VectorXd known;  ///< values of the soil, and of the first terms; the others start at their defaults
  double chi2 = 0.0;      ///< that these leave
  std::map<int, std::vector<double>> traced;  ///< a term's parameters, amplitude first, where the trace puts them [SI]
  double promised = 0.0;                      ///< what the trace promises to take off chi2
};

/// Fits the terms in full; again from smaller amplitudes where that gained less than half of what was promised, and
/// from next to none where it gained nothing: an effect that joins others leaves no more than they did. Nothing where
/// no start balances.
std::optional<CandidateModel> refit(const Campaign& campaign, const Identification& id, const std::vector<Term>& terms,
                                    const CandidateStart& from);

}  // namespace soilbin::compare
