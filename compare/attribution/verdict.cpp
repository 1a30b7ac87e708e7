#include "compare/attribution/verdict.hpp"

#include <algorithm>

#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

std::string_view word(Verdict verdict) {
  constexpr std::string_view words[] = {"not_enough_data", "nothing_missing", "effect_found", "unknown_effect"};
  return words[static_cast<std::size_t>(verdict)];
}

namespace {

/// Share of the base model's excess over the noise that the chosen candidate leaves.
double unexplained(const Attribution& found) {
  const double cells = static_cast<double>(found.base.data().cells());
  const double excess = found.base.fit().chi2 - cells;
  if (!(excess > 0)) return 0.0;
  return std::max(0.0, found.best().fit().chi2 - cells) / excess;
}

/// Whether a single effect is the best set, and no other set comes near it.
bool one_effect_dominates(const Candidates& candidates) {
  const WeightedSet best = ambiguity_set(candidates).front();
  return best.ids.size() == 1 && best.weight >= thresholds::dominant_share;
}

/// Where no effect is accepted: the residual may be real all the same, the work of an unknown effect. Else `nothing`.
Reason without_effect(const Attribution& found, const ResidualTests& before, Reason nothing) {
  if (found.unnamed.gain > thresholds::unnamed_instead) return NoneAccepted{found.unnamed};
  if (before.lack_of_fit.p_value <= thresholds::first_test_level) return NoneAccepted{before.lack_of_fit};
  if (before.reruns.p_value <= thresholds::rerun_level) return NoneAccepted{before.reruns};
  if (before.serial.p_value <= thresholds::serial_level) return NoneAccepted{before.serial};
  return nothing;
}

/// Why what the chosen candidate leaves is the work of another effect; nothing where it may be noise or its form's.
std::optional<SignOfMore> more_than_named(const Attribution& found, const ResidualTests& before,
                                          const ChosenCandidate& choice) {
  const double left = unexplained(found);
  const bool one = one_effect_dominates(found.candidates);
  const double test_level = one ? thresholds::dominant_test_level : thresholds::second_test_level;
  const double unnamed_level = one ? thresholds::dominant_unnamed_beside : thresholds::unnamed_beside;
  if (choice.after.lack_of_fit.p_value < test_level && left > thresholds::unexplained_share)
    return UnexplainedShare{left};
  if (choice.unnamed.gain > unnamed_level) return choice.unnamed;
  if (choice.after.reruns.p_value < thresholds::rerun_level &&
      choice.after.reruns.excess > thresholds::rerun_share * before.reruns.excess)
    return choice.after.reruns;
  return std::nullopt;
}

/// Why the data do not allow to judge any effect; nothing where they do.
std::optional<Reason> not_judgeable(const Attribution& found) {
  const double freedom = found.base.data().noise.typical_freedom();
  if (freedom < thresholds::min_noise_freedom) return NoiseUnknown{freedom};
  if (std::ranges::none_of(found.signatures.all, &Signature::testable)) return NothingVisible{};
  return std::nullopt;
}

Reason conclude(const Attribution& found, const ResidualTests& before, const std::optional<ChosenCandidate>& choice) {
  if (!choice) return without_effect(found, before, NoneStandsOut{});
  if (const auto more = more_than_named(found, before, *choice)) return MoreThanNamed{*more};
  if (!choice->stands) return without_effect(found, before, NoGain{choice->gain});
  return StandsOut{};
}

/// Chooses among the candidates, where any may stand; the choice is the best from then on.
std::optional<ChosenCandidate> settle(Attribution& found, const AttributionOptions& options) {
  if (!found.candidates.best) return std::nullopt;
  ChosenCandidate choice = choose(found, options);
  found.candidates.best = choice.candidate;
  return choice;
}

}  // namespace

std::optional<TooFewValues> too_small(const Campaign& campaign, const Observations& observations) {
  const int values = static_cast<int>(observations.cells.size());
  const int free =
      free_parameters(campaign.soil) + (bekker_wong::errs_by_carcass(campaign.wheel, campaign.effects) ? 1 : 0);
  if (values - free >= thresholds::min_spare_values && observations.blocks() >= thresholds::min_conditions)
    return std::nullopt;
  return TooFewValues{observations.cells.size(), static_cast<std::size_t>(observations.blocks()), free};
}

Judgement judge(Attribution found, const AttributionOptions& options) {
  const ResidualTests before = test_residual(found.base, options.seed);
  if (const auto reason = not_judgeable(found)) return {std::move(found), before, std::nullopt, *reason};
  auto choice = settle(found, options);
  const Reason reason = conclude(found, before, choice);
  return {std::move(found), before, std::move(choice), reason};
}

Judgement without_its_effects(Judgement judgement, const Refuted& refuted) {
  judgement.reason = without_effect(judgement.found, judgement.before, refuted);
  return judgement;
}

Judgement judge_with_model_discrepancy(Attribution found, const AttributionOptions& options) {
  const ResidualTests before = test_residual(found.base, options.seed);
  auto choice = settle(found, options);
  return {std::move(found), before, std::move(choice), BaseModelWrong{}};
}

}  // namespace soilbin::compare
