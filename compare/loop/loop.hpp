// The loop on measured data: residual, cause, effect added, error before and after (docs/loop.md).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/loop/cross_validation.hpp"
#include "compare/loop/detection.hpp"
#include "compare/loop/model_discrepancy.hpp"
#include "compare/loop/next_test.hpp"

namespace soilbin::compare {

enum class Verdict { effect_found, nothing_missing, unknown_effect, not_enough_data };
std::string_view word(Verdict verdict);

struct LoopOptions {
  IdentifyOptions identify;
  int folds = 5;
  int threads = 2;       ///< changes the time, never the answer
  Limits limits;         ///< of the next test; where there is none, the campaign's own range
  bool validate = true;  ///< honest errors by the whole procedure redone in each fold; without it they are absent
  Progress progress;     ///< share of the work done, from the calling thread; may throw to stop
};

/// An effect that the loop accepts, in the form that fits best.
struct AcceptedEffect {
  EffectChoice choice;                          ///< with fitted parameters [SI]
  std::vector<std::string> fitted;              ///< names of the parameters that were fitted
  std::vector<std::pair<double, double>> ci95;  ///< of each fitted parameter, cut off at its bounds
  std::vector<bool> at_bound;                   ///< of each: the fit ended at a bound, where its form ends
  double p_value = 1.0;                         ///< family-wise, beside the other accepted effects
  std::map<std::string, double> cosines;        ///< of its trace with each other effect's: what separates them
};

/// A soil value refitted with the accepted effects and without: the difference is the bias of leaving them out.
struct SoilShift {
  std::string name;
  Estimate with, without;  ///< [SI]
};

/// What the loop would say with no value set aside.
struct WithOutliers {
  Verdict verdict = Verdict::not_enough_data;
  std::set<std::string> effects;
};

/// Of an unknown effect: the data read twice, with a base model that is exact and with one that may be off by itself.
struct SecondReading {
  bool decides =
      false;            ///< whether the base model that may be off explains the data better; else the exact one decides
  double size = 0.0;    ///< DiscrepancyReading::size
  Identification note;  ///< the reading that does not decide; the one that does is LoopAnswer::details
};

struct LoopAnswer {
  std::string campaign;
  Tire wheel;  ///< of the campaign: of what it does not declare, effects presume some
  Verdict verdict = Verdict::not_enough_data;
  std::string reason;  ///< one plain sentence
  std::vector<AcceptedEffect> effects;
  /// Of an unknown effect: the best named ones, where conditions left out are predicted better with them. They stand in
  /// for it in the model that is saved, and explain nothing.
  std::vector<AcceptedEffect> stand_in;
  std::vector<Weighted> ambiguity_set;  ///< best first; empty unless effects compete
  /// Sets that only the reading which does not decide leaves: indices are those of SecondReading::note, weights 0.
  std::vector<Weighted> noted_sets;
  std::optional<SecondReading> second;
  std::vector<std::string> not_testable;
  std::optional<NextTest> next;  ///< also of an unknown effect: between the named sets that come nearest
  PredictiveGain choice_gain;    ///< of the best candidate over the base model
  CrossValidation validation;
  LackOfFit before, after;
  RerunTest reruns_before, reruns_after;
  std::vector<Dependence> dependences_before, dependences_after;
  Identification details;  ///< the reading that decides: verdict, shares, tables, saved model and next test are its
  NoiseFloor noise;        ///< beside the accepted effects where there are any: what errors are told in
  std::vector<SoilShift> soil_shifts;  ///< of the free values, where effects are accepted
  SemiEmpiricalSoil soil;  ///< refitted with the accepted effects or those that stand in, with standard errors
  int outliers = 0;        ///< cells set aside
  std::optional<WithOutliers> with_outliers;  ///< where any were
};

/// Whether the reading beside a base model that may be off by itself decides.
bool decided_with_model_discrepancy(const LoopAnswer& answer);

/// That reading, whether it decides or not; null where there was none.
const Identification* with_model_discrepancy(const LoopAnswer& answer);

/// Ids of effects that stand together.
std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects);

/// Runs the loop. Throws InputError for a campaign that can't be used; a campaign too small to say anything is a
/// verdict, not an error.
LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options);

/// The answer in the contract's form, soilbin-loop/1.
nlohmann::ordered_json to_json(const LoopAnswer& answer);

/// What stands behind it: p-values, chi2, evidence, every set of effects that competed, the choice of each fold.
nlohmann::ordered_json details_json(const LoopAnswer& answer);

}  // namespace soilbin::compare
