// A learned effect as a formula: a few plain terms that predict conditions left out as well as the learned curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/formula.hpp"
#include "compare/attribution/learned_effect.hpp"

namespace soilbin::compare {

struct LearnedFormula {
  std::vector<bekker_wong::FormulaTerm> terms;
  std::vector<Estimate> weights;  ///< of each term [-]
  std::string joint;              ///< where g joins the model: "torque W_n r g"
  PredictiveGain over_learned;    ///< mean gain over the learned effect; within a standard error of none, or above
};

/// The formula of fewest terms (thresholds::max_formula_terms at the most) that predicts conditions left out as well
/// as the learned effect does: no worse by more than a standard error (the rule of Breiman et al. 1984). Of each number
/// of terms the one of most evidence is tried, over all combinations of formula_terms (of three: those that hold one of
/// the best pairs). beside: the model that the effect was learned beside. Nothing where none does.
std::optional<LearnedFormula> find_formula(const FittedModel& beside, const LearnedEffect& learned,
                                           const AttributionOptions& options);

}  // namespace soilbin::compare
