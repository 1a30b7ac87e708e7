#include "compare/attribution/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/attribution/evidence_words.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {

std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::effect_found:
      return "effect_found";
    case Verdict::nothing_missing:
      return "nothing_missing";
    case Verdict::unknown_effect:
      return "unknown_effect";
    case Verdict::not_enough_data:
      return "not_enough_data";
  }
  return "";
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

struct Conclusion {
  Verdict verdict;
  std::string reason;
};

/// Where no effect is accepted: the residual may be real all the same, the work of an unknown effect. Else `nothing`.
Conclusion without_effect(const Attribution& found, const ResidualTests& before, std::string nothing) {
  const double p = before.lack_of_fit.p_value, p_reruns = before.reruns.p_value;
  std::string why;
  if (found.unnamed.gain > thresholds::unnamed_instead)
    why = fmt::format(
        "a function of the conditions unlike any of them explains the residual {} better than noise: most like {}",
        times_likelier(found.unnamed.gain), found.unnamed.most_likely);
  else if (p <= thresholds::first_test_level)
    why = fmt::format("the residual is more than noise (p = {:.2g})", p);
  else if (p_reruns <= thresholds::rerun_level)
    why = fmt::format("setpoints deviate more than their re-runs scatter (p = {:.2g})", p_reruns);
  else if (before.serial.p_value <= thresholds::serial_level)
    why = fmt::format("the residuals of the {} are alike in runs made one after the other (p = {:.2g})",
                      before.serial.series, before.serial.p_value);
  else
    return {Verdict::nothing_missing, std::move(nothing)};
  return {Verdict::unknown_effect,
          fmt::format("no known effect is accepted ({}), but {}", noise_verdict(found.signatures), why)};
}

/// Why what the chosen candidate leaves is the work of another effect; nothing where it may be noise or its form's.
std::optional<std::string> more_than_named(const Attribution& found, const ResidualTests& before,
                                           const ChosenCandidate& choice) {
  const double left = unexplained(found);
  const bool one = one_effect_dominates(found.candidates);
  const double test_level = one ? thresholds::dominant_test_level : thresholds::second_test_level;
  const double unnamed_level = one ? thresholds::dominant_unnamed_beside : thresholds::unnamed_beside;
  if (choice.after.lack_of_fit.p_value < test_level && left > thresholds::unexplained_share)
    return fmt::format("but the best set of known effects leaves {:.0f} % of it", 100 * left);
  if (choice.unnamed.gain > unnamed_level)
    return fmt::format(
        "and after the best set of known effects a function of the conditions unlike any of them explains the rest {} "
        "better than noise: most like {}",
        times_likelier(choice.unnamed.gain), choice.unnamed.most_likely);
  if (choice.after.reruns.p_value < thresholds::rerun_level &&
      choice.after.reruns.excess > thresholds::rerun_share * before.reruns.excess)
    return fmt::format(
        "and after the best set of known effects setpoints still deviate more than their re-runs scatter (p = {:.2g})",
        choice.after.reruns.p_value);
  return std::nullopt;
}

/// Why the data do not allow to judge any effect; nothing where they do.
std::optional<std::string> not_judgeable(const Attribution& found) {
  const double freedom = found.base.data().noise.typical_freedom();
  if (freedom < thresholds::min_noise_freedom)
    return fmt::format("the noise of a channel has only {:.1f} degrees of freedom, too few to judge by", freedom);
  const std::vector<Signature>& all = found.signatures.all;
  if (std::ranges::none_of(all, [](const Signature& s) { return s.testable; }))
    return "no known effect would be visible in these data, whatever its size";
  return std::nullopt;
}

Conclusion conclude(const Attribution& found, const ResidualTests& before,
                    const std::optional<ChosenCandidate>& choice) {
  const double p = found.signatures.p_value;
  if (!choice)
    return without_effect(found, before, fmt::format("the strongest of all known effects reaches p = {:.3g}", p));
  if (const auto more = more_than_named(found, before, *choice))
    return {Verdict::unknown_effect,
            fmt::format("the residual is real ({}), {}", noise_verdict(found.signatures), *more)};
  if (!choice->stands)
    return without_effect(found, before,
                          fmt::format("the best effect fits ({}) but does not improve cross-validated "
                                      "predictions (gain in ln density a condition {:.2g} +- {:.2g})",
                                      p_words(found.signatures), choice->gain.mean, choice->gain.std_error));
  return {Verdict::effect_found, fmt::format("{} among the whole catalogue", p_words(found.signatures))};
}

/// Chooses among the candidates, where any may stand; the choice is the best from then on.
std::optional<ChosenCandidate> settle(Attribution& found, const AttributionOptions& options) {
  if (!found.candidates.best) return std::nullopt;
  ChosenCandidate choice = choose(found, options);
  found.candidates.best = choice.candidate;
  return choice;
}

}  // namespace

std::optional<std::string> too_small(const Campaign& campaign, const Observations& observations) {
  const int values = static_cast<int>(observations.cells.size());
  const int free =
      free_parameters(campaign.soil) + (bekker_wong::errs_by_carcass(campaign.wheel, campaign.effects) ? 1 : 0);
  if (values - free >= thresholds::min_spare_values && observations.blocks() >= thresholds::min_conditions)
    return std::nullopt;
  return fmt::format("{} measured values of {} are too few for {} soil values", values,
                     counted(observations.blocks(), "condition"), free);
}

Judgement judge(Attribution found, const AttributionOptions& options) {
  const ResidualTests before = test_residual(found.base, options.seed);
  if (auto reason = not_judgeable(found))
    return {std::move(found), before, std::nullopt, Verdict::not_enough_data, std::move(*reason)};
  auto choice = settle(found, options);
  Conclusion conclusion = conclude(found, before, choice);
  return {std::move(found), before, std::move(choice), conclusion.verdict, std::move(conclusion.reason)};
}

Judgement without_its_effects(Judgement judgement, const std::string& why_not) {
  judgement.choice->stands = false;
  Conclusion conclusion =
      without_effect(judgement.found, judgement.before,
                     fmt::format("the best effect fits ({}), but {}", p_words(judgement.found.signatures), why_not));
  judgement.verdict = conclusion.verdict, judgement.reason = std::move(conclusion.reason);
  return judgement;
}

Judgement judge_with_model_discrepancy(Attribution found, const AttributionOptions& options) {
  const ResidualTests before = test_residual(found.base, options.seed);
  auto choice = settle(found, options);
  std::string reason =
      fmt::format("the base model is wrong by a smooth function of load and slip; beside that {} is strongest ({})",
                  named_effects(found.best().ids), noise_verdict(found.signatures));
  return {std::move(found), before, std::move(choice), Verdict::unknown_effect, std::move(reason)};
}

}  // namespace soilbin::compare
