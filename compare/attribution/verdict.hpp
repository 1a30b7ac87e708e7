// The loop's verdict on a campaign (an effect is found, nothing is missing, the effect is unknown, not enough data),
// from the attribution of its residual. End of stage 5 of the loop.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/attribution/choice.hpp"

namespace soilbin::compare {

enum class Verdict { effect_found, nothing_missing, unknown_effect, not_enough_data };
std::string_view word(Verdict verdict);

/// An attribution and what is made of it.
struct Judgement {
  Attribution found;                      ///< its best candidate is the choice
  ResidualTests before;                   ///< of what the base model leaves
  std::optional<ChosenCandidate> choice;  ///< where any candidate may stand
  Verdict verdict = Verdict::not_enough_data;
  std::string reason;  ///< one plain sentence
  /// The model takes the best candidate's effects: accepted (effect_found), or as stand-ins for an unknown one.
  bool takes_best() const { return choice && choice->stands && verdict != Verdict::nothing_missing; }
};

/// Why a campaign is too small to fit anything; nothing where it isn't.
std::optional<std::string> too_small(const Campaign& campaign, const Observations& observations);

/// Whether an effect is missing, the base model taken as exact.
Judgement judge(Attribution found, const AttributionOptions& options);

/// The same where the effects that were found are not confirmed after all, for this reason: as where none stands.
Judgement without_its_effects(Judgement judgement, const std::string& why_not);

/// The same for an unknown effect, with an attribution that has a model discrepancy and a candidate that stands out:
/// the verdict stays unknown_effect.
Judgement judge_with_model_discrepancy(Attribution found, const AttributionOptions& options);

}  // namespace soilbin::compare
