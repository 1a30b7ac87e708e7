// The loop on measured data: residual, cause, effect added, error before and after (docs/guide/loop.md).
//
//   const LoopAnswer answer = run_loop(campaign, {});
//   if (answer.verdict == Verdict::effect_found) answer.effects.front().choice;  // {"slip_sinkage", "linear", ...}
//
// Stages, each a value that the next one takes:
//   1 observe            Campaign -> Observations                       fit/observations.hpp
//   2 fit_base           -> FittedModel: noise, outliers, base fit      attribution/base_fit.hpp, fit/fitted_model.hpp
//   3 residual_signatures, 4 candidates: attribute -> Attribution       attribution/signatures.hpp, candidates.hpp
//   5 choose, judge      -> ChosenCandidate, Judgement: the verdict     attribution/choice.hpp, verdict.hpp
//     and where the residual is more than named effects explain:
//       attribute_with_model_discrepancy                                attribution/model_discrepancy.hpp
//       learn_effects    smooth functions of the conditions             attribution/learned_effect.hpp
//       find_formula     a few terms in the place of one                attribution/learned_formula.hpp
//   6 cross_validate     -> CrossValidation: honest errors              attribution/validation.hpp
//   7 next_test          -> NextTest                                    test_design/next_test.hpp
//   8 LoopAnswer: JSON, sentences, page, saved model                    answer_json.cpp, answer_words.hpp,
//                                                                       loop_page.cpp
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compare/attribution/learned_formula.hpp"
#include "compare/attribution/validation.hpp"
#include "compare/attribution/verdict.hpp"
#include "compare/test_design/next_test.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

// What the best candidate puts into the answer: effects with their errors, the soil refitted with them.

/// An effect that the loop accepts, in the form that fits best.
struct AcceptedEffect {
  EffectChoice choice;                          ///< with fitted parameters [SI]
  std::vector<std::string> fitted;              ///< names of the parameters that were fitted
  std::vector<std::pair<double, double>> ci95;  ///< of each fitted parameter, cut off at its bounds
  std::vector<bool> at_bound;                   ///< of each: the fit ended at a bound, where its form ends
  double p_value = 1.0;                         ///< family-wise, beside the other accepted effects
  std::map<std::string, double> cosines;        ///< of its signature with each other effect's: what separates them
};

/// A soil value refitted with the accepted effects and without: the difference is the bias of leaving them out.
struct SoilShift {
  std::string name;
  Estimate with, without;    ///< [SI]
  double declared_sd = 0.0;  ///< that the campaign gives the value [SI]
  bool held = false;         ///< with the effects a bound holds it
};

struct LoopOptions {
  AttributionOptions attribution;
  int folds = 5;
  int threads = 2;       ///< changes the time, never the answer
  Limits limits;         ///< of the next test; where there is none, the campaign's own range
  bool validate = true;  ///< honest errors by the whole procedure redone in each fold; without it they are absent
  Progress progress;     ///< share of the work done, from the calling thread; may throw to stop
};

/// A measured value that was set aside, beside the base model's prediction.
struct SetAside {
  int csv_line = 0;
  int channel = 0;
  double measured = 0.0, predicted = 0.0;  ///< [SI]; predicted not a number where the base model carries no such wheel
};

/// What the loop would say with no value set aside.
struct WithOutliers {
  Verdict verdict = Verdict::not_enough_data;
  std::set<std::string> effects;
};

/// Of an unknown effect: the residual attributed twice, with a base model that is exact and with one that may be off by
/// itself (model_discrepancy.hpp).
struct SecondAttribution {
  bool decides = false;     ///< the base model that may be off explains the data better; else the exact one decides
  double size = 0.0;        ///< DiscrepancyAttribution::size
  Attribution alternative;  ///< the attribution that does not decide; the one that does is LoopAnswer::judgement
};

struct LoopAnswer {
  std::string campaign;
  Tire wheel;  ///< of the campaign: of what it does not declare, effects presume some
  Verdict verdict = Verdict::not_enough_data;
  std::string reason;  ///< one plain sentence
  std::vector<AcceptedEffect> effects;
  /// Of an unknown effect: the best named ones, where conditions left out are predicted better with them, then the
  /// learned ones. They stand in for it in the model that is saved, and explain nothing.
  std::vector<AcceptedEffect> stand_in;
  std::optional<LearnedFormula> formula;   ///< of the first learned effect, where a few terms do as well
  std::vector<WeightedSet> ambiguity_set;  ///< best first; empty unless effects compete
  /// Sets that only the attribution which does not decide leaves: indices are those of its candidates, weights 0.
  std::vector<WeightedSet> alternative_sets;
  std::vector<std::string> not_testable;
  std::optional<NextTest> next;  ///< also of an unknown effect: between the named sets that come nearest
  std::vector<Dependence> dependences_before, dependences_after;
  NoiseFloor noise;                    ///< beside the accepted effects where there are any: the unit of errors
  std::vector<SoilShift> soil_shifts;  ///< of the free values, where effects are accepted or stand in
  SemiEmpiricalSoil soil;           ///< refitted with the accepted effects or those that stand in, with standard errors
  std::vector<SetAside> set_aside;  ///< measured values that were left out of every fit
  std::optional<WithOutliers> with_outliers;  ///< where any were
  CrossValidation validation;
  /// Of an unknown effect: smooth functions of one condition or two that predict conditions left out better still, each
  /// learned beside those before. The soil is fitted with them.
  std::vector<LearnedEffect> learned;
  std::optional<SecondAttribution> second;
  /// The attribution that decides and what is made of it: verdict, shares, tables, saved model and next test are its.
  /// Absent where the campaign is too small to fit.
  std::optional<Judgement> judgement;

  int outliers() const { return static_cast<int>(set_aside.size()); }
  const Attribution& found() const { return judgement->found; }
  /// Whether any set of effects was fitted.
  bool has_candidates() const { return judgement && !found().candidates.sets.empty(); }
  /// What the chosen candidate leaves, and what it gains over the base model; without one nothing.
  ChosenCandidate choice() const { return judgement && judgement->choice ? *judgement->choice : ChosenCandidate{}; }
  /// The effects of the model that is saved: those accepted, or those that stand in.
  const std::vector<AcceptedEffect>& taken() const { return effects.empty() ? stand_in : effects; }
  /// A learned effect as it stands in that model.
  const EffectChoice& learned_choice(std::size_t k) const {
    return stand_in[stand_in.size() - learned.size() + k].choice;
  }
  /// What is saved: the base model, or one with the accepted effects or those that stand in.
  const FittedModel& model() const {
    return !learned.empty()          ? learned.back().candidate.model
           : judgement->takes_best() ? found().best().model
                                     : found().base;
  }
  /// Whether the attribution with a model discrepancy decides; and that attribution, null where there was none.
  bool decided_with_model_discrepancy() const { return second && second->decides; }
  const Attribution* with_model_discrepancy() const {
    return !second ? nullptr : second->decides ? &found() : &second->alternative;
  }
};

/// Ids of effects that stand together.
std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects);

/// Runs the loop. Throws InputError for a campaign that can't be used; a campaign too small to say anything is a
/// verdict, not an error.
LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options);

/// The answer as JSON, soilbin-loop/1.
nlohmann::ordered_json to_json(const LoopAnswer& answer);

/// What stands behind it: p-values, chi2, evidence, every set of effects that competed, the choice of each fold.
nlohmann::ordered_json details_json(const LoopAnswer& answer);

/// The campaign's wheel on the refitted soil with the accepted effects, at each of its conditions: what estimate, run
/// and predict --model take.
Case resolved_model(const Campaign& campaign, const LoopAnswer& answer);

/// The source that such a case tells: "fitted to campaign cmu-smooth".
std::string source_of_fit(const std::string& campaign);

}  // namespace soilbin::compare
