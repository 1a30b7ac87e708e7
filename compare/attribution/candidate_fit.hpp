// A set of effects fitted in full beside the soil's values.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/fit/evidence.hpp"

namespace soilbin::compare {

/// A set of effects that competes, fitted in full, each in one form.
struct CandidateModel {
  std::set<std::string> ids;
  FittedModel model;
  double log_evidence = 0.0;
  const Fit& fit() const { return model.fit(); }
  const std::vector<Term>& terms() const { return model.terms(); }
};

/// Where a fit of terms starts.
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

}  // namespace soilbin::compare
