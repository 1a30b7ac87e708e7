#include "compare/loop/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>

#include "compare/loop/accepted_model.hpp"
#include "compare/loop/answer_words.hpp"

namespace soilbin::compare {

namespace {

constexpr int choice_folds = 10;

/// Thresholds of the verdict, set once on the tuning sets of bench/loop (docs/loop.md), never on those reported.
constexpr double odds_enough = 3.0;         // ln 20 to 1 over the base model, price paid
constexpr double second_test_level = 0.1;   // of lack of fit after the best named effects: the noise was estimated
                                            // beside a smooth function, so that it seldom falls under 0.3 by chance
constexpr double unexplained_share = 0.15;  // of the base model's excess chi2 that a form 40 % off would leave
constexpr double first_test_level = 0.02;   // of lack of fit where no effect is named
constexpr double rerun_level = 0.005;       // of the same against re-runs alone, of the channel where it is least
constexpr double rerun_share = 0.5;         // of the base model's excess over the re-runs that is left then
constexpr double unnamed_alone = 2.0;       // ln evidence over the base model where no effect is named
constexpr double unnamed_after = 1.0;       // ln evidence beyond the best named effects
constexpr double alone_share = 0.9;         // of the sets' weight: then one effect stands alone, and what it leaves is
constexpr double alone_test_level = 0.03;   // likelier to be its form's; the same two thresholds in that case
constexpr double alone_unnamed_after = 3.0;

/// Conditions left out are predicted better by a standard error; or better at all, where the odds are twenty to one:
/// with a dozen conditions a standard error is more than a real effect reaches.
bool stands(const PredictiveGain& gain, double log_odds) {
  return gain.mean > gain.std_error || (gain.mean > 0 && log_odds > odds_enough);
}

/// Whether the best set stands against the base model.
bool confirmed(const LoopAnswer& answer) {
  const Identification& id = answer.details;
  return id.best &&
         stands(answer.choice_gain, weighed(id, id.candidates[*id.best].ids).log_evidence - id.base_log_evidence);
}

/// Share of the base model's excess over the noise that the best named candidate leaves.
double unexplained(const Identification& id) {
  const double cells = static_cast<double>(id.observations.cells.size());
  const double excess = id.base.chi2 - cells;
  if (!(excess > 0)) return 0.0;
  return std::max(0.0, id.candidates[*id.best].fit.chi2 - cells) / excess;
}

/// Whether a single effect is the best set, and no other set comes near it.
bool stands_alone(const Identification& id) {
  const Weighted best = weighted_sets(id, competitors(id)).front();
  return best.ids.size() == 1 && best.weight >= alone_share;
}

/// Where no effect is accepted: whether the residual is real all the same. Then the verdict is `unknown_effect`.
bool unnamed_residual(LoopAnswer& answer) {
  const Identification& id = answer.details;
  const bool patterned = id.unnamed_gain > unnamed_alone, beyond_noise = answer.before.p_value <= first_test_level;
  if (!patterned && !beyond_noise && answer.reruns_before.p_value > rerun_level) return false;
  answer.verdict = Verdict::unknown_effect;
  answer.reason = fmt::format("no effect of the catalogue is accepted (p = {:.3g}), but ", id.p_value);
  if (patterned)
    answer.reason += fmt::format(
        "a function of the conditions that none of them makes explains the residual e^{:.1f} times better than noise",
        id.unnamed_gain);
  else if (beyond_noise)
    answer.reason += fmt::format("the residual is more than noise (p = {:.2g})", answer.before.p_value);
  else
    answer.reason += fmt::format("the setpoints are off by more than their re-runs differ (p = {:.2g})",
                                 answer.reruns_before.p_value);
  return true;
}

/// Why what the best named effects leave is the work of another one; nothing where it may be noise or their form's.
std::optional<std::string> more_than_named(const LoopAnswer& answer) {
  const Identification& id = answer.details;
  const double left = unexplained(id);
  const bool alone = stands_alone(id);
  if (answer.after.p_value < (alone ? alone_test_level : second_test_level) && left > unexplained_share)
    return fmt::format("but the best set of named effects leaves {:.0f} % of it", 100 * left);
  if (id.residual_unnamed_gain > (alone ? alone_unnamed_after : unnamed_after))
    return fmt::format(
        "and after the best set of named effects a function of the conditions that none of them makes explains "
        "e^{:.0f} "
        "times more than chance would",
        id.residual_unnamed_gain);
  if (answer.reruns_after.p_value < rerun_level &&
      answer.reruns_after.excess > rerun_share * answer.reruns_before.excess)
    return fmt::format(
        "and after the best set of named effects the setpoints are still off by more than their re-runs differ "
        "(p = {:.2g})",
        answer.reruns_after.p_value);
  return std::nullopt;
}

}  // namespace

void confirm(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options) {
  Identification& id = answer.details;
  for (auto fewer = best_subset(id, *id.best); fewer; fewer = best_subset(id, *id.best)) {
    const CandidateModel &more = id.candidates[*id.best], &less = id.candidates[*fewer];
    const PredictiveGain gain = predictive_gain(campaign, id, more.terms, more.fit, less.terms, less.fit, choice_folds,
                                                options.seed, options.pool);
    if (stands(gain, weighed(id, more.ids).log_evidence - weighed(id, less.ids).log_evidence)) break;
    prefer(campaign, id, *fewer);
  }
  const CandidateModel& best = id.candidates[*id.best];
  answer.choice_gain =
      predictive_gain(campaign, id, best.terms, best.fit, {}, id.base, choice_folds, options.seed, options.pool);
  answer.after = lack_of_fit(best.fit, id.noise, static_cast<Eigen::Index>(id.observations.cells.size()));
  answer.reruns_after = rerun_test(id.observations, id.noise, best.fit);
}

bool explains_all(const LoopAnswer& answer) { return confirmed(answer) && !more_than_named(answer); }

void decide(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  const bool improves = confirmed(answer);
  if (!id.best) {
    if (unnamed_residual(answer)) return;
    answer.verdict = Verdict::nothing_missing;
    answer.reason =
        fmt::format("the strongest of all effects reaches p = {:.3g} among the whole catalogue", id.p_value);
    return;
  }
  if (const auto more = more_than_named(answer)) {
    answer.verdict = Verdict::unknown_effect;
    answer.reason = fmt::format("the residual is real (p = {:.2g}), {}", id.p_value, *more);
    if (improves) answer.stand_in = take_best(campaign, answer);
    return;
  }
  if (!improves) {
    if (unnamed_residual(answer)) return;
    answer.verdict = Verdict::nothing_missing;
    answer.reason = fmt::format(
        "the best effect fits (p = {:.2g}) but does not predict held-out conditions better "
        "(gain in ln density a condition {:.2g} +- {:.2g})",
        id.p_value, answer.choice_gain.mean, answer.choice_gain.std_error);
    return;
  }
  answer.verdict = Verdict::effect_found;
  answer.effects = take_best(campaign, answer);
  answer.reason = fmt::format("p = {:.2g} among the whole catalogue", id.p_value);
}

void decide_with_model_discrepancy(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  answer.reason = fmt::format(
      "the base model is off by what a smooth function of load and slip makes good, and beside that {} stands out most "
      "(p = {:.2g})",
      joined(id.candidates[*id.best].ids), id.p_value);
  answer.stand_in.clear(), answer.dependences_after.clear(), answer.soil_shifts.clear();
  if (confirmed(answer)) answer.stand_in = take_best(campaign, answer);
}

}  // namespace soilbin::compare
