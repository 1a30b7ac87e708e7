// The loop on measured data: residual, cause, effect added, error before and after (docs/guide/loop.md).
//
//   const LoopAnswer answer = run_loop(campaign, {});
//   if (answer.verdict() == Verdict::effect_found) answer.effects().front().choice;  // {"slip_sinkage", "linear", ...}
//
// Stages, each a value that the next one takes:
//   1 observe            Campaign -> Observations                       fit/observations.hpp
//   2 fit_base           -> FittedModel: noise, outliers, base fit      attribution/base_fit.hpp, fit/fitted_model.hpp
//   3 residual_signatures, 4 candidates: attribute -> Attribution       attribution/signatures.hpp, candidates.hpp
//   5 choose, judge      -> ChosenCandidate, Judgement: the verdict     attribution/choice.hpp, residual_tests.hpp
//     and where the residual is more than named effects explain:
//       attribute_with_model_discrepancy                                attribution/candidates.hpp
//       learn_effects    smooth functions of the conditions             attribution/learned_effect.hpp
//       find_formula     a few terms in the place of one                attribution/learned_effect.hpp
//   6 cross_validate     -> CrossValidation: honest errors              attribution/validation.hpp
//   7 next_test          -> NextRun                                    test_design/next_run.hpp
//   8 LoopAnswer, and what it implies                                   told by telling/loop_report.hpp
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "compare/attribution/choice.hpp"
#include "compare/attribution/learned_effect.hpp"
#include "compare/attribution/validation.hpp"
#include "compare/test_design/next_run.hpp"

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

/// The residual of an unknown effect attributed twice, with a base model that is exact and with one that may be off by
/// itself (attribute_with_model_discrepancy).
struct SecondAttribution {
  bool decides = false;     ///< the base model that may be off explains the data better; else the exact one decides
  double size = 0.0;        ///< DiscrepancyAttribution::size
  Attribution alternative;  ///< the attribution that does not decide; the one that does is the judgement's
  /// Sets that only the alternative leaves: indices are those of its candidates, weights 0.
  std::vector<WeightedSet> sets{};
};

// What an answer holds by its verdict.

struct TooLittleData {};
struct NothingMissing {};

/// What fitted candidates add to an answer, whether one is accepted or none.
struct WithCandidates {
  std::vector<WeightedSet> ambiguity_set;     ///< that the data cannot tell apart, best first
  std::optional<NextRun> next;                ///< that would; of an unknown effect between the nearest named sets
  std::vector<Dependence> dependences_after;  ///< of what the model with named effects leaves
  std::vector<SoilShift> soil_shifts;         ///< of the free values, by the effects of the saved model
};

struct EffectFound : WithCandidates {
  std::vector<AcceptedEffect> effects;
};

struct UnknownEffect : WithCandidates {
  /// The best named effects, where conditions left out are predicted better with them, then the learned ones. They are
  /// in the model that is saved in place of the unknown effect, and explain nothing.
  std::vector<AcceptedEffect> proxy_effects;
  /// Smooth functions of one condition or two that predict conditions left out better still, each learned beside those
  /// before. The soil is fitted with them.
  std::vector<LearnedEffect> learned;
  std::optional<LearnedFormula> formula;  ///< of the first learned effect, where a few terms do as well
  std::optional<SecondAttribution> second;
};

struct LoopAnswer {
  std::string campaign;
  Tire wheel;              ///< of the campaign: of what it does not declare, effects presume some
  SemiEmpiricalSoil soil;  ///< refitted with the effects of the saved model, with standard errors
  /// What the verdict comes from: the attribution that decides, or why the campaign is too small to fit.
  std::variant<TooFewValues, Judgement> judged;
  std::variant<TooLittleData, NothingMissing, EffectFound, UnknownEffect> outcome;  ///< in the order of Verdict
  std::vector<std::string> not_testable;
  std::vector<Dependence> dependences_before;
  NoiseFloor noise;                           ///< beside the accepted effects where there are any: the unit of errors
  std::vector<SetAside> set_aside;            ///< measured values that were left out of every fit
  std::optional<WithOutliers> with_outliers;  ///< where any were
  CrossValidation validation;

  Verdict verdict() const { return static_cast<Verdict>(outcome.index()); }
  int outliers() const { return static_cast<int>(set_aside.size()); }
  const Judgement* judgement() const { return std::get_if<Judgement>(&judged); }
  const Attribution& found() const { return std::get<Judgement>(judged).found; }
  /// Whether any set of effects was fitted.
  bool has_candidates() const { return judgement() && !found().candidates.sets.empty(); }
  /// What the chosen candidate leaves, and what it gains over the base model; without one nothing.
  ChosenCandidate choice() const {
    return judgement() && judgement()->choice ? *judgement()->choice : ChosenCandidate{};
  }
  /// Null but for an unknown effect.
  const UnknownEffect* unknown() const { return std::get_if<UnknownEffect>(&outcome); }
  // Members of the outcome, empty where it has none such.
  const WithCandidates& with_candidates() const;
  const std::vector<WeightedSet>& ambiguity_set() const { return with_candidates().ambiguity_set; }
  const std::optional<NextRun>& next() const { return with_candidates().next; }
  const std::vector<AcceptedEffect>& effects() const { return of(&EffectFound::effects); }
  const std::vector<AcceptedEffect>& proxy_effects() const { return of(&UnknownEffect::proxy_effects); }
  const std::vector<LearnedEffect>& learned() const { return of(&UnknownEffect::learned); }
  /// The effects of the model that is saved: those accepted, or the proxies.
  const std::vector<AcceptedEffect>& effects_in_model() const {
    return effects().empty() ? proxy_effects() : effects();
  }
  bool uses_effects() const { return !effects_in_model().empty(); }
  /// What is saved: the base model, or one with these effects.
  const FittedModel& model() const {
    return !learned().empty() ? learned().back().candidate.model : uses_effects() ? found().best().model : found().base;
  }
  /// The attribution beside the one that decides; null where there was none.
  const SecondAttribution* second() const { return unknown() && unknown()->second ? &*unknown()->second : nullptr; }

 private:
  template <class Held, class Member>
  const Member& of(Member Held::*member) const {
    static const Member none{};
    const Held* held = std::get_if<Held>(&outcome);
    return held ? held->*member : none;
  }
};

std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects);

/// Sets worth showing: those that compete, then those that stand next.
std::vector<const WeightedSet*> sets_shown(const LoopAnswer& answer);

/// The forms of a candidate's effects, in the order of its ids.
std::vector<std::string> forms_in_order(const CandidateModel& candidate);

/// Whether a held-out error is larger with the effects than without, or smaller, by more than its third digit.
bool rises(const HeldOutErrors& error);
bool falls(const HeldOutErrors& error);

/// The channels whose held-out error rises with the effects that the answer's model takes (Channel); none where it
/// takes none.
std::vector<int> worse_channels(const LoopAnswer& answer);

/// Whether the run of LoopAnswer::next is worth making: not where the sets that it decides between are a hundred to one
/// apart already and neither explains the data.
bool proposes_next(const LoopAnswer& answer);

/// Names of the conditions of the next run that lie outside what was run, and for which no limit of the rig is given.
std::vector<std::string> beyond_what_is_known(const NextRun& next);

/// How the residual of the saved model, or of the base model where there is no other, depends on conditions.
const std::vector<Dependence>& dependences_left(const LoopAnswer& answer);

/// At an unknown effect: what the residual depends on (dependences_left), surest first, as many as keep the
/// false-discovery rate at 5 %.
std::vector<Dependence> sure_dependences(const LoopAnswer& answer);

/// Where an unknown effect depends on a condition (sure_dependences), runs that show how, with that condition alone
/// at five settings over the range that was run, all else as in the run that the model misses most. Empty where none is
/// known.
std::vector<OperatingCondition> shape_series(const LoopAnswer& answer);

/// A condition of a run to be made as the rig would be set to it (rig_setting) [SI]; not a number where it is not
/// known.
double rig_setting_of(const LoopAnswer& answer, const OperatingCondition& at, const std::string& condition);

/// Runs the loop. Throws InputError for a campaign that can't be used; a campaign too small to say anything is a
/// verdict, not an error.
LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options);

}  // namespace soilbin::compare
