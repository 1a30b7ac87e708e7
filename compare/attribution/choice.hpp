// Stage 5 of the loop: which candidate stands on conditions left out, which others the data can't tell from it, and the
// verdict.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "compare/attribution/candidates.hpp"
#include "compare/attribution/predictive_gain.hpp"
#include "compare/attribution/residual_tests.hpp"

namespace soilbin::compare {

/// The rule by which an effect is accepted: conditions left out are predicted better by a standard error; or better at
/// all, where the odds pass thresholds::odds_enough: with a dozen conditions a standard error is more than a real
/// effect reaches.
/// log_odds: ln evidence over the model without it, its price paid.
bool earns_its_place(const PredictiveGain& gain, double log_odds);

/// The candidate that is left after each of its effects had to earn its place.
struct ChosenCandidate {
  std::size_t candidate = 0;  ///< index in Candidates::models
  PredictiveGain gain;        ///< over the base model
  ResidualTests after;        ///< of what it leaves
  UnnamedEvidence unnamed;    ///< for an unnamed term beside it, with the tolerance of its forms
  bool stands = false;        ///< against the base model
};

/// Backward from Candidates::best, which must be there: an effect stays only if the candidate with it predicts
/// conditions left out better than the best one without.
ChosenCandidate choose(const Attribution& found, const AttributionOptions& options);

/// A set of effects that competes with the best one.
struct Competitor {
  std::size_t set = 0;   ///< index in Candidates::sets
  double allowed = 0.0;  ///< ln evidence by which it may stand behind and still competes
};

/// The sets that the data can't tell from that of Candidates::best, which must be there, itself first. How far behind a
/// set may stand grows with what the best one explains: the more there is to explain, the more a form that nature does
/// not share costs. It is wider on small designs, where a few values decide, and narrower for sets that hold the best
/// one and more.
std::vector<Competitor> competitors(const Candidates& candidates);

/// The set of most evidence behind the best one; nullptr where no other was fitted.
const WeightedSet* next_standing(const Candidates& candidates, const std::set<std::string>& best);

/// ln odds of the best set over every other one that was fitted, and over the base model.
double lead(const Candidates& candidates);
/// Whether that is so large that no further run is worth it: thresholds::excluded_odds.
bool is_settled(const Candidates& candidates);

/// The competitors as an answer lists them, with weights that sum to 1.
std::vector<WeightedSet> ambiguity_set(const Candidates& candidates);

// The loop's verdict on a campaign (an effect is found, nothing is missing, the effect is unknown, not enough data)
// and the reason for it, from the attribution of its residual. End of stage 5 of the loop.
//
//   const Judgement judged = judge(attribute(fit_base(campaign, observe(campaign), {}), {}), {});
//   if (judged.verdict() == Verdict::unknown_effect) std::get<NoneAccepted>(judged.reason).sign;

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
  bool may_use_candidate() const {
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
Judgement refuted_by(Judgement judgement, const Refuted& refuted);

/// An unknown effect, attributed with a model discrepancy and with a candidate that stands out: it stays unknown.
Judgement judge_with_model_discrepancy(Attribution found, const AttributionOptions& options);

}  // namespace soilbin::compare
