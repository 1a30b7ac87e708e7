#include "compare/attribution/choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

ResidualTests test_residual(const FittedModel& model, std::uint64_t seed) {
  return {lack_of_fit(model), rerun_test(model), serial_test(model, thresholds::serial_rearrangements, seed)};
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

}  // namespace soilbin::compare
