// The loop's verdict on a campaign (an effect is found, nothing is missing, the effect is unknown, not enough data)
// and the reason for it, from the attribution of its residual. End of stage 5 of the loop.
//
//   const Judgement judged = judge(attribute(fit_base(campaign, observe(campaign), {}), {}), {});
//   if (judged.verdict() == Verdict::unknown_effect) std::get<NoneAccepted>(judged.reason).sign;
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "compare/attribution/choice.hpp"

namespace soilbin::compare {

enum class Verdict { not_enough_data, nothing_missing, effect_found, unknown_effect };
std::string_view word(Verdict verdict);

/// Why a campaign is too small to fit anything.
struct TooFewValues {
  std::size_t values = 0, conditions = 0;  ///< that were measured
  int soil_values = 0;                     ///< to be fitted
};

// Reasons, each of one verdict alone.

/// The noise of a channel is known to so few degrees of freedom [-] that nothing can be judged by it.
struct NoiseUnknown {
  static constexpr Verdict verdict = Verdict::not_enough_data;
  double freedom = 0.0;
};
/// No known effect would be visible, whatever its size.
struct NothingVisible {
  static constexpr Verdict verdict = Verdict::not_enough_data;
};

/// The strongest of all effects is no stronger than noise makes one.
struct NoneStandsOut {
  static constexpr Verdict verdict = Verdict::nothing_missing;
};
/// The best effect fits, but does not improve predictions of conditions left out.
struct NoGain {
  static constexpr Verdict verdict = Verdict::nothing_missing;
  PredictiveGain gain;
};
/// The best effect fits, but the procedure redone without conditions predicts those worse with effects.
struct Refuted {
  static constexpr Verdict verdict = Verdict::nothing_missing;
  double without = 0.0, with = 0.0;  ///< root mean square errors [sd of the noise]
};

/// The choice stands out, and stands on conditions left out.
struct StandsOut {
  static constexpr Verdict verdict = Verdict::effect_found;
};

/// Share of the base model's excess over the noise that the chosen candidate leaves [-].
struct UnexplainedShare {
  double share = 0.0;
};
/// What shows that something is left.
using SignOfMore = std::variant<UnexplainedShare, UnnamedEvidence, LackOfFit, RerunTest, SerialTest>;

/// No known effect is accepted, but the residual of the base model is more than noise.
struct NoneAccepted {
  static constexpr Verdict verdict = Verdict::unknown_effect;
  SignOfMore sign;
};
/// The best set of known effects leaves more than noise.
struct MoreThanNamed {
  static constexpr Verdict verdict = Verdict::unknown_effect;
  SignOfMore sign;
};
/// The base model is wrong by a function of load and slip; the choice is the strongest beside that.
struct BaseModelWrong {
  static constexpr Verdict verdict = Verdict::unknown_effect;
};

using Reason = std::variant<NoiseUnknown, NothingVisible, NoneStandsOut, NoGain, Refuted, StandsOut, NoneAccepted,
                            MoreThanNamed, BaseModelWrong>;

/// An attribution and what is made of it.
struct Judgement {
  Attribution found;                      ///< its best candidate is the choice
  ResidualTests before;                   ///< of what the base model leaves
  std::optional<ChosenCandidate> choice;  ///< where any candidate may stand
  Reason reason;

  Verdict verdict() const {
    return std::visit([](const auto& ground) { return ground.verdict; }, reason);
  }
  /// Whether the model uses the best candidate's effects: accepted, or in place of an unknown one.
  bool uses_candidate() const {
    return choice && choice->stands &&
           (std::holds_alternative<StandsOut>(reason) || std::holds_alternative<MoreThanNamed>(reason) ||
            std::holds_alternative<BaseModelWrong>(reason));
  }
};

/// Nothing where the campaign has values enough to fit.
std::optional<TooFewValues> too_small(const Campaign& campaign, const Observations& observations);

/// Whether an effect is missing, the base model taken as exact.
Judgement judge(Attribution found, const AttributionOptions& options);

/// A judgement whose effects conditions left out refute: nothing is missing, or something unknown.
Judgement without_its_effects(Judgement judgement, const Refuted& refuted);

/// An unknown effect, attributed with a model discrepancy and with a candidate that stands out: it stays unknown.
Judgement judge_with_model_discrepancy(Attribution found, const AttributionOptions& options);

}  // namespace soilbin::compare
