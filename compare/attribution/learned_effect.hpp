// Stage 5 of the loop, where no named effect explains the residual: smooth functions of one condition or of two, each
// at the joint of the model where it predicts conditions left out best (bekker_wong/learned.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/formula.hpp"
#include "compare/attribution/base_fit.hpp"
#include "compare/attribution/candidates.hpp"
#include "compare/attribution/predictive_gain.hpp"

namespace soilbin::compare {

/// A learned effect, fitted together with the soil and with the effects, named or learned, that it stands beside.
struct LearnedEffect {
  CandidateModel candidate;           ///< the learned term is its last
  double log_evidence = 0.0;          ///< gained over the model without it, the choice among all forms and sizes paid
  std::vector<FoldDensity> held_out;  ///< what it gives to conditions left out
  PredictiveGain gain;                ///< over that model
};

/// A chosen model (null: the base model) fitted to the data of the base model taken as exact: beside a model
/// discrepancy its terms were fitted to less.
FittedModel refitted_as_exact(const FittedModel& base, const FittedModel* chosen);

/// Looks for learned effects beside a model (the base model, or one with named effects), one after the other, each
/// beside those before, as long as the next one stands by the rule of a named effect (choice.hpp), at most
/// thresholds::max_learned. Every form's weights, normal about 0 and the smaller the more the function bends, join the
/// linear problem of the model; the forms of most evidence (thresholds::learned_refits of them, later_refits beside
/// another learned one) are fitted in full, and the one that predicts conditions left out best is the next one. Empty
/// where none stands.
///
///     const std::vector<LearnedEffect> learned = learn_effects(found.best().model, options);
///     if (!learned.empty()) learned.back().candidate.ids;   // {"learned", "slip_sinkage"}
std::vector<LearnedEffect> learn_effects(const FittedModel& beside, const AttributionOptions& options);

/// What each weight of a term with a learned form, or with a formula, does to the cells: whitened, of 1 sd of the
/// weight; nothing where the form leaves no trace.
std::optional<Eigen::MatrixXd> columns_of_weights(const FittedModel& beside, const Term& term);

/// The model with such a term, from where it ended without.
std::optional<FittedModel> fitted_with_learned(const FittedModel& beside, const Term& term);

// A learned effect as a formula: a few plain terms that predict conditions left out as well as the learned curve.

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
