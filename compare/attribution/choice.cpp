#include "compare/attribution/choice.hpp"

#include <algorithm>
#include <cmath>

#include "compare/fit/evidence.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

namespace {

/// The best candidate whose effects are one fewer of these; none for a single effect.
std::optional<std::size_t> best_with_one_fewer(const Candidates& candidates, const std::set<std::string>& all) {
  for (const WeightedSet& w : candidates.sets)
    if (w.ids.size() + 1 == all.size() && std::includes(all.begin(), all.end(), w.ids.begin(), w.ids.end()))
      return w.best_candidate;
  return std::nullopt;
}

double allowed_behind(const Candidates& candidates, const WeightedSet& best, const std::set<std::string>& ids) {
  if (ids.size() > best.ids.size() && std::includes(ids.begin(), ids.end(), best.ids.begin(), best.ids.end()))
    return thresholds::superset_allowed;
  const double values = static_cast<double>(candidates.models.front().model.data().cells());
  return std::clamp(std::sqrt(thresholds::few_values / values), 1.0, thresholds::max_growth) *
         (thresholds::allowed_behind +
          thresholds::allowed_growth * std::max(0.0, best.log_evidence - candidates.base_log_evidence));
}

}  // namespace

bool earns_its_place(const PredictiveGain& gain, double log_odds) {
  return gain.mean > gain.std_error || (gain.mean > 0 && log_odds > thresholds::odds_enough);
}

ChosenCandidate choose(const Attribution& found, const AttributionOptions& options) {
  const Candidates& all = found.candidates;
  const auto evidence = [&](std::size_t i) { return all.weighed(all.models[i].ids).log_evidence; };
  const auto densities = [&](const FittedModel& model) { return fold_densities(model, options.seed, options.pool); };
  std::size_t best = *all.best;
  std::vector<FoldDensity> held_out = densities(all.models[best].model);
  for (auto fewer = best_with_one_fewer(all, all.models[best].ids); fewer;
       fewer = best_with_one_fewer(all, all.models[best].ids)) {
    auto without = densities(all.models[*fewer].model);
    if (earns_its_place(predictive_gain(held_out, without), evidence(best) - evidence(*fewer))) break;
    best = *fewer, held_out = std::move(without);
  }
  const FittedModel& model = all.models[best].model;
  const PredictiveGain gain = predictive_gain(held_out, densities(found.base));
  return {.candidate = best,
          .gain = gain,
          .after = test_residual(model, options.seed),
          .unnamed = unnamed_evidence(problem_of(model), found.unnamed_kinds),
          .stands = earns_its_place(gain, evidence(best) - all.base_log_evidence)};
}

std::vector<Competitor> competitors(const Candidates& candidates) {
  const std::vector<WeightedSet>& sets = candidates.sets;
  const WeightedSet& best = candidates.weighed(candidates.models[*candidates.best].ids);
  std::vector<Competitor> all = {
      {static_cast<std::size_t>(&best - sets.data()), allowed_behind(candidates, best, best.ids)}};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].ids == best.ids || !(sets[i].weight > 0)) continue;
    const double allowed = allowed_behind(candidates, best, sets[i].ids);
    if (best.log_evidence - sets[i].log_evidence <= allowed) all.push_back({i, allowed});
  }
  return all;
}

const WeightedSet* next_standing(const Candidates& candidates, const std::set<std::string>& best) {
  const auto next =
      std::ranges::find_if(candidates.sets, [&](const WeightedSet& w) { return w.weight > 0 && w.ids != best; });
  return next == candidates.sets.end() ? nullptr : &*next;
}

double lead(const Candidates& candidates) {
  const WeightedSet& best = candidates.weighed(candidates.models[*candidates.best].ids);
  double behind = candidates.base_log_evidence;
  for (const WeightedSet& w : candidates.sets)
    if (w.weight > 0 && w.ids != best.ids) behind = std::max(behind, w.log_evidence);
  return best.log_evidence - behind;
}

bool is_settled(const Candidates& candidates) { return lead(candidates) > std::log(thresholds::excluded_odds); }

std::vector<WeightedSet> ambiguity_set(const Candidates& candidates) {
  std::vector<WeightedSet> sets;
  double total = 0.0;
  for (const Competitor& c : competitors(candidates)) {
    sets.push_back(candidates.sets[c.set]);
    total += sets.back().weight;
  }
  for (WeightedSet& w : sets) w.weight /= total;
  return sets;
}

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
Reason reason_of_residual(const Attribution& found, const ResidualTests& before, Reason nothing) {
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
  if (!choice) return reason_of_residual(found, before, NoneStandsOut{});
  if (const auto more = more_than_named(found, before, *choice)) return MoreThanNamed{*more};
  if (!choice->stands) return reason_of_residual(found, before, NoGain{choice->gain});
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

Judgement refuted_by(Judgement judgement, const Refuted& refuted) {
  judgement.reason = reason_of_residual(judgement.found, judgement.before, refuted);
  return judgement;
}

Judgement judge_with_model_discrepancy(Attribution found, const AttributionOptions& options) {
  const ResidualTests before = test_residual(found.base, options.seed);
  auto choice = settle(found, options);
  return {std::move(found), before, std::move(choice), BaseModelWrong{}};
}

}  // namespace soilbin::compare
