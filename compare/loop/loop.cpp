#include "compare/loop/loop.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compare/loop/base_fit.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"

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

constexpr int choice_folds = 10;
constexpr double least_noise_freedom = 5.0;  // a channel; below it a residual can't be told from noise

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

std::vector<std::string> not_testable(const Campaign& campaign, const Identification& id) {
  std::map<std::string, bool> testable;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) testable[form.id] = false;
  for (const Signature& s : id.signatures)
    if (s.testable) testable[s.term.form->id] = true;
  for (const EffectChoice& declared : campaign.effects) testable.erase(declared.id);
  std::vector<std::string> hidden;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (testable.count(form.id) && !testable[form.id] && (hidden.empty() || hidden.back() != form.id))
      hidden.push_back(form.id);
  return hidden;
}

/// Conditions left out are predicted better by a standard error; or better at all, where the odds are twenty to one:
/// with a dozen conditions a standard error is more than a real effect reaches.
bool stands(const PredictiveGain& gain, double log_odds) {
  return gain.mean > gain.std_error || (gain.mean > 0 && log_odds > odds_enough);
}

/// Whether the best set stands against the base model.
bool confirmed(const LoopAnswer& answer) {
  const Identification& id = answer.details;
  return id.best &&
         stands(answer.choice_gain, weighed(id, id.rivals[*id.best].ids).log_evidence - id.base_log_evidence);
}

/// Share of the base model's excess over the noise that the best named rival leaves.
double unexplained(const Identification& id) {
  const double cells = static_cast<double>(id.observations.cells.size());
  const double excess = id.base.chi2 - cells;
  if (!(excess > 0)) return 0.0;
  return std::max(0.0, id.rivals[*id.best].fit.chi2 - cells) / excess;
}

/// Whether a single effect is the best set, and no other set comes near it.
bool stands_alone(const Identification& id) {
  const Weighted best = weighted_sets(id, competitors(id)).front();
  return best.ids.size() == 1 && best.weight >= alone_share;
}

AcceptedEffect accepted(const WheelPredictor& predictor, const Whitening& whitening, const Rival& rival, int term) {
  constexpr double two_sided = 1.96;
  Eigen::VectorXd errors = standard_errors(rival.fit, predictor);
  const Term& t = rival.terms[static_cast<std::size_t>(term)];
  AcceptedEffect effect;
  const auto all = predictor.choices(rival.fit.theta);
  effect.choice = all[all.size() - rival.terms.size() + static_cast<std::size_t>(term)];
  for (std::size_t k = 0; k < t.free.size(); ++k) {
    const Eigen::Index i = predictor.amplitude_index(term) + static_cast<Eigen::Index>(k);
    const FreeParameter& bounds = predictor.parameters()[static_cast<std::size_t>(i)];
    const bool held = errors[i] == 0.0;
    if (held) errors[i] = held_error(rival.fit, predictor, whitening, i);
    effect.at_bound.push_back(held);
    effect.fitted.push_back(t.form->parameters[static_cast<std::size_t>(t.free[k])].name);
    effect.ci95.emplace_back(std::max(bounds.lower, rival.fit.theta[i] - two_sided * errors[i]),
                             std::min(bounds.upper, rival.fit.theta[i] + two_sided * errors[i]));
  }
  return effect;
}

SemiEmpiricalSoil fitted_soil(const Campaign& campaign, const WheelPredictor& predictor, const Fit& fit) {
  SemiEmpiricalSoil soil = campaign.soil;
  const Eigen::VectorXd errors = standard_errors(fit, predictor);
  for (int i = 0; i < predictor.soil_parameters(); ++i)
    soil.*soil_parameter(predictor.parameters()[static_cast<std::size_t>(i)].name).value = {fit.theta[i], errors[i]};
  return soil;
}

std::vector<SoilShift> soil_shifts(const Identification& id, const WheelPredictor& predictor) {
  const Fit& with = id.rivals[*id.best].fit;
  const Eigen::VectorXd error = standard_errors(with, predictor);
  const Eigen::VectorXd base_error = standard_errors(id.base, predictor);  // the same soil parameters come first
  std::vector<SoilShift> shifts;
  for (int i = 0; i < predictor.soil_parameters(); ++i)
    shifts.push_back({predictor.parameters()[static_cast<std::size_t>(i)].name,
                      {with.theta[i], error[i]},
                      {id.base.theta[i], base_error[i]}});
  return shifts;
}

/// p-value and separability of each accepted effect.
void describe_effects(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options) {
  const Identification& id = answer.details;
  for (std::size_t t = 0; t < answer.effects.size(); ++t) {
    answer.effects[t].p_value = p_beside_others(campaign, id, id.rivals[*id.best], t, options);
    answer.effects[t].cosines = cosines(id, answer.effects[t].choice.id);
  }
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

/// The best rival's effects; its soil and what its residual still depends on go into the answer.
std::vector<AcceptedEffect> take_best(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  const Rival& best = id.rivals[*id.best];
  const WheelPredictor predictor(campaign, id.observations, best.terms);
  std::vector<AcceptedEffect> effects;
  for (int t = 0; t < static_cast<int>(best.terms.size()); ++t)
    effects.push_back(accepted(predictor, *id.whitening, best, t));
  answer.soil = fitted_soil(campaign, predictor, best.fit);
  answer.soil_shifts = soil_shifts(id, predictor);
  answer.dependences_after = dependences(
      id.observations, best.fit.residual.head(static_cast<Eigen::Index>(id.observations.cells.size())), 999, 11);
  return effects;
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

void decide(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  const CrossValidation& cv = answer.validation;
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
  if (cv.overall.cells > 0)
    answer.reason += fmt::format("; held-out error falls by {:.2g} +- {:.2g} sigma^2", cv.gain, cv.gain_error);
}

/// Backward: an effect stays only if the set with it stands against the set without; then the same for what stays
/// against the base model, and what it leaves.
void confirm(const Campaign& campaign, LoopAnswer& answer, const IdentifyOptions& options) {
  Identification& id = answer.details;
  for (auto fewer = best_subset(id, *id.best); fewer; fewer = best_subset(id, *id.best)) {
    const Rival &more = id.rivals[*id.best], &less = id.rivals[*fewer];
    const PredictiveGain gain = predictive_gain(campaign, id, more.terms, more.fit, less.terms, less.fit, choice_folds,
                                                options.seed, options.crew);
    if (stands(gain, weighed(id, more.ids).log_evidence - weighed(id, less.ids).log_evidence)) break;
    prefer(campaign, id, *fewer);
  }
  const Rival& best = id.rivals[*id.best];
  answer.choice_gain =
      predictive_gain(campaign, id, best.terms, best.fit, {}, id.base, choice_folds, options.seed, options.crew);
  answer.after = lack_of_fit(best.fit, id.noise, static_cast<Eigen::Index>(id.observations.cells.size()));
  answer.reruns_after = rerun_test(id.observations, id.noise, best.fit);
  if (confirmed(answer) && !more_than_named(answer)) answer.noise = noise_beside(campaign, id, best);
}

bool too_small(const Campaign& campaign, const Observations& observations, std::string& reason) {
  const WheelPredictor base(campaign, observations);
  const int spare = static_cast<int>(observations.cells.size()) - base.soil_parameters();
  if (spare >= 6 && observations.conditions >= 6) return false;
  reason = fmt::format("{} measured values of {} conditions for {} soil values leave too little to judge by",
                       observations.cells.size(), observations.conditions, base.soil_parameters());
  return true;
}

/// Steps of the progress: what the identification and the choice take of all.
constexpr std::size_t all_steps = 100, identified = 30, chosen = 40, pulses_a_step = 10;

/// What the data allow before any effect is judged; false where they are too few, with the reason.
bool describe_base(const Campaign& campaign, LoopAnswer& answer) {
  const Identification& id = answer.details;
  answer.noise = id.noise;
  answer.outliers = static_cast<int>(std::count(id.outlier.begin(), id.outlier.end(), true));
  answer.not_testable = not_testable(campaign, id);
  const Eigen::Index cells = static_cast<Eigen::Index>(id.observations.cells.size());
  answer.before = lack_of_fit(id.base, id.noise, cells);
  answer.reruns_before = rerun_test(id.observations, id.noise, id.base);
  answer.dependences_before = dependences(id.observations, id.base.residual.head(cells), 999, 7);
  answer.soil = fitted_soil(campaign, WheelPredictor(campaign, id.observations), id.base);
  if (id.noise.typical_freedom() < least_noise_freedom) {
    answer.reason = fmt::format("the noise of a channel rests on {:.1f} degrees of freedom only, too few to judge by",
                                id.noise.typical_freedom());
    return false;
  }
  if (std::none_of(id.signatures.begin(), id.signatures.end(), [](const Signature& s) { return s.testable; })) {
    answer.reason = "no effect of the catalogue would show in these data, whatever its size";
    return false;
  }
  return true;
}

/// The run that would best set the competing sets of a reading apart.
std::optional<NextTest> proposed(const Campaign& campaign, const Identification& id, const Limits& limits) {
  Limits reach = limits;  // what is given comes before what the campaign spans
  reach.merge(limits_of(id.observations));
  return next_test(campaign, id, competitors(id), reach);
}

/// The named sets that come nearest to an unknown effect, also where the base model's own form may be off: then effects
/// can stand out that nothing but a change with load and slip, taken for another effect, had hidden. The next test is
/// asked of the reading that explains the data better.
void read_again(const Campaign& campaign, LoopAnswer& answer, const Limits& limits, const IdentifyOptions& options) {
  const Identification& first = answer.details;
  const Identification* ahead = first.best ? &first : nullptr;
  if (ahead) answer.ambiguity_set = weighted_sets(first, competitors(first));
  answer.inadequate = read_beside_inadequacy(campaign, first, options);
  if (answer.inadequate && answer.inadequate->identification.best) {
    const Identification& second = answer.inadequate->identification;
    const std::vector<Competitor> all = competitors(second);
    answer.ambiguity_set = merged(answer.ambiguity_set, weighted_sets(second, all), all.front().allowed);
    const auto explains = [](const Identification& id) { return weighed(id, id.rivals[*id.best].ids).log_evidence; };
    if (!ahead || explains(second) > explains(first)) ahead = &second;
  }
  if (ahead) answer.next = proposed(campaign, *ahead, limits);
}

/// The choice within a fold: fewer simulations, its outliers set aside by the whole.
IdentifyOptions of_a_fold(IdentifyOptions options) {
  options.simulations = std::max(500, options.simulations / 4);
  options.drop_outliers = false;
  return options;
}

/// Steps 1 to 7 on these observations; false where they are too few, with the reason.
bool judge(const Campaign& campaign, const Observations& observations, const IdentifyOptions& options,
           LoopAnswer& answer) {
  answer.details = identify(campaign, observations, options);
  if (!describe_base(campaign, answer)) return false;
  if (answer.details.best) confirm(campaign, answer, options);
  return true;
}

/// The conclusion with every value kept: a choice by the rest must not be the doing of what was set aside.
WithOutliers keep_outliers(const Campaign& campaign, const Observations& observations, IdentifyOptions options) {
  options.drop_outliers = false;
  LoopAnswer answer;
  if (judge(campaign, observations, options, answer)) decide(campaign, answer);
  return {answer.verdict, ids_of(answer.effects)};
}

}  // namespace

std::set<std::string> ids_of(const std::vector<AcceptedEffect>& effects) {
  std::set<std::string> ids;
  for (const AcceptedEffect& effect : effects) ids.insert(effect.choice.id);
  return ids;
}

LoopAnswer run_loop(const Campaign& campaign, const LoopOptions& options) {
  const auto say = [&](std::size_t step) {
    if (options.progress) options.progress(step, all_steps);
  };
  LoopAnswer answer;
  answer.campaign = campaign.name;
  answer.soil = campaign.soil;
  const Observations observations = observe(campaign);
  if (too_small(campaign, observations, answer.reason)) return answer;
  IdentifyOptions whole = options.identify;
  std::size_t pulses = 0;
  whole.crew = {options.threads, [&] { say(std::min(++pulses / pulses_a_step, identified)); }};
  if (!judge(campaign, observations, whole, answer)) return answer;
  say(chosen);
  const IdentifyOptions inner = of_a_fold(options.identify);
  if (options.validate)
    answer.validation = cross_validate(
        campaign, answer.details, answer.noise, inner, options.folds, options.threads,
        [&](std::size_t done, std::size_t folds) { say(chosen + (all_steps - 1 - chosen) * done / folds); });
  decide(campaign, answer);
  whole.crew.pulse = [&] { say(all_steps - 1); };
  describe_effects(campaign, answer, whole);
  if (answer.verdict == Verdict::unknown_effect) read_again(campaign, answer, options.limits, whole);
  if (answer.verdict == Verdict::effect_found) {
    answer.ambiguity_set = weighted_sets(answer.details, competitors(answer.details));
    answer.next = proposed(campaign, answer.details, options.limits);
  }
  if (answer.outliers > 0) answer.with_outliers = keep_outliers(campaign, observations, whole);
  say(all_steps);
  return answer;
}

}  // namespace soilbin::compare
