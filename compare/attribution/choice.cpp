#include "compare/attribution/choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "bekker_wong/gsl.hpp"
#include "compare/fit/evidence.hpp"
#include "compare/fit/setpoint_squares.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LackOfFit lack_of_fit(const FittedModel& model) {
  LackOfFit test;
  test.freedom = std::max(1.0, static_cast<double>(model.data().cells()) - model.absorbed_freedom());
  test.noise_freedom = std::max(1.0, model.data().noise.freedom());
  test.f = model.fit().chi2_cells / test.freedom;
  test.p_value = gsl::f_tail(test.f, test.freedom, test.noise_freedom);
  return test;
}

namespace {

/// h^2/12 of each channel, the variance of what is read to steps of h, with h the smallest step between two of its
/// values; 0 where all are alike. Re-runs that read alike are no re-runs without noise.
std::array<double, channel_count> reading_variance(const Observations& observations) {
  std::array<std::vector<double>, channel_count> values;
  for (const Cell& cell : observations.cells) values[cell.channel].push_back(cell.value);
  std::array<double, channel_count> variance{};
  for (int c = 0; c < channel_count; ++c) {
    std::ranges::sort(values[c]);
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < values[c].size(); ++i)
      if (const double gap = values[c][i] - values[c][i - 1]; gap > 0.0) step = std::min(step, gap);
    if (std::isfinite(step)) variance[c] = step * step / 12;
  }
  return variance;
}

}  // namespace

RerunTest rerun_test(const FittedModel& model) {
  const Observations& observations = model.data().observations;
  std::vector<SetpointSquares> channels(channel_count, SetpointSquares(observations.conditions));
  const std::array<double, channel_count> read_to = reading_variance(observations);
  std::array<double, channel_count> rounding{};  // summed over the values, in the noise's unit
  for (std::size_t i = 0; i < observations.cells.size(); ++i) {
    const Cell& cell = observations.cells[i];
    const double f = model.fit().prediction[i];
    const auto c = cell.channel;
    const double sd = model.data().noise.channels[c].sd(f, cell.spread);
    channels[c].add(observations.condition[cell.row], (cell.value - f) / sd);
    rounding[c] += read_to[c] / (sd * sd);
  }
  double setpoints = 0.0;
  for (const SetpointSquares& s : channels) setpoints += s.setpoints();
  const double taken = model.absorbed_freedom() / std::max(1.0, setpoints);  // of each setpoint's freedom
  RerunTest test;
  int tested = 0;
  double least = 1.0;
  for (int c = 0; c < channel_count; ++c) {
    const SetpointSquares& s = channels[c];
    const double freedom = s.setpoints() * (1 - taken) - 1, reruns = s.reruns();
    const double pure = s.within() / reruns + rounding[c] / (s.setpoints() + reruns);
    if (reruns < thresholds::min_reruns || freedom < 1.0 || !(pure > 0.0)) continue;
    ++tested;
    const double between = s.between() - s.largest();
    test.excess += std::max(0.0, between - freedom * pure);
    least = std::min(least, gsl::f_tail(between / freedom / pure, freedom, reruns));
  }
  if (tested > 0) test.p_value = std::min(1.0, tested * least);
  return test;
}

namespace {

/// Residuals in the order of the runs, of one channel or of a gain, of unit size where only noise is there.
struct RunSeries {
  std::optional<int> channel{};  ///< none: of a gain
  std::vector<double> values{};
};

std::vector<RunSeries> run_series(const FittedModel& model) {
  const Observations& observations = model.data().observations;
  const std::vector<Index> by_run = cells_in_order_of_runs(observations);
  std::vector<RunSeries> all(channel_count + 1);
  for (int c = 0; c < channel_count; ++c) all[c].channel = c;
  RunSeries& gain = all.back();
  double score = 0.0, weight = 0.0;
  for (std::size_t k = 0; k < by_run.size(); ++k) {
    const Cell& cell = observations.cells[by_run[k]];
    const double f = model.fit().prediction[by_run[k]];
    const double sd = model.data().noise.channels[cell.channel].sd(f, cell.spread);
    all[cell.channel].values.push_back((cell.value - f) / sd);
    if (cell.channel != sinkage) score += (cell.value - f) * f / (sd * sd), weight += f * f / (sd * sd);
    const bool last = k + 1 == by_run.size() || observations.cells[by_run[k + 1]].row != cell.row;
    if (!last) continue;
    if (weight > 0) gain.values.push_back(score / std::sqrt(weight));
    score = weight = 0.0;
  }
  return all;
}

/// Sum of the products with the 1, 2, .. lags values before, Bartlett's weights 1 - k/(lags + 1): half of the squared
/// sums of lags + 1 neighbours (beyond the ends are zeros) over their number, less the squares that are in them.
double serial_correlation(const VectorXd& r, Index lags) {
  const Index n = r.size(), width = lags + 1;
  double window = 0.0, squares = 0.0;
  for (Index last = 0; last < n + lags; ++last) {
    if (last < n) window += r[last];
    if (last >= width) window -= r[last - width];
    squares += window * window;
  }
  return 0.5 * (squares / static_cast<double>(width) - r.squaredNorm());
}

}  // namespace

SerialTest serial_test(const FittedModel& model, int permutations, std::uint64_t seed) {
  SerialTest test;
  const std::vector<Covariate> variables = covariates(model.data().observations);
  if (std::ranges::find(variables, "run", &Covariate::name) == variables.end()) return test;
  std::mt19937_64 random(seed);
  int tested = 0;
  double least = 2.0;
  for (const RunSeries& series : run_series(model)) {
    if (series.values.size() < thresholds::min_serial_runs) continue;
    ++tested;
    VectorXd r = Eigen::Map<const VectorXd>(series.values.data(), static_cast<Index>(series.values.size()));
    r.array() -= r.mean();
    const Index lags = std::max<Index>(1, r.size() / thresholds::serial_runs_a_lag);
    const double seen = serial_correlation(r, lags);
    int reached = 0;
    for (int k = 0; k < permutations; ++k) {
      std::shuffle(r.begin(), r.end(), random);
      if (serial_correlation(r, lags) >= seen) ++reached;
    }
    const double p = (reached + 1.0) / (permutations + 1.0);
    if (p < least) least = p, test.channel = series.channel;
  }
  if (tested > 0) test.p_value = std::min(1.0, tested * least);
  return test;
}

namespace {

/// Orthonormal columns of 1, u, u^2 over one channel's cells; empty where the variable takes one value there.
MatrixXd parabola(const std::vector<double>& u) {
  const Index n = u.size();
  const auto [low, high] = std::ranges::minmax_element(u);
  if (!(*high > *low)) return MatrixXd(n, 0);
  MatrixXd columns(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double x = 2 * (u[i] - *low) / (*high - *low) - 1;
    columns.row(i) << 1.0, x, x * x;
  }
  return orthonormal(columns);
}

double explained(const MatrixXd& q, const VectorXd& r, double mean) {
  const VectorXd centred = r.array() - mean;
  const double whole = centred.squaredNorm();
  return whole > 0 ? (q.transpose() * centred).squaredNorm() / whole : 0.0;
}

/// False-discovery rates: the least m p/rank of m p-values among those no smaller than a p-value.
void tell_false_discovery_rates(std::vector<Dependence>& table) {
  std::vector<Dependence*> by_p;
  for (Dependence& d : table) by_p.push_back(&d);
  std::ranges::stable_sort(by_p, [](const Dependence* a, const Dependence* b) { return a->p_value < b->p_value; });
  double least = 1.0;
  for (std::size_t i = by_p.size(); i-- > 0;) {
    least = std::min(least, by_p[i]->p_value * static_cast<double>(by_p.size()) / static_cast<double>(i + 1));
    by_p[i]->false_discovery_rate = least;
  }
}

}  // namespace

std::vector<Dependence> dependences(const Observations& observations, const VectorXd& residual, int permutations,
                                    std::uint64_t seed) {
  std::vector<Dependence> table;
  std::mt19937_64 random(seed);
  const std::vector<Covariate> variables = covariates(observations);
  for (int channel = 0; channel < channel_count; ++channel) {
    std::vector<double> values;
    std::vector<int> rows, setpoints;
    for (std::size_t i = 0; i < observations.cells.size(); ++i)
      if (observations.cells[i].channel == channel) {
        values.push_back(residual[i]);
        rows.push_back(observations.cells[i].row);
        setpoints.push_back(observations.condition[rows.back()]);
      }
    if (values.size() < 6) continue;
    const VectorXd r = Eigen::Map<VectorXd>(values.data(), values.size());
    const SetpointPermutation rearranged(setpoints);
    for (const Covariate& variable : variables) {
      std::vector<double> u;
      for (const int row : rows) u.push_back(variable.values[row]);
      const MatrixXd q = parabola(u);
      if (q.cols() < 2) continue;
      Dependence d{channel, variable.name, explained(q, r, r.mean()), 1.0};
      constexpr double same = 1 - 1e-12;  // the same values in other places, summed in another order
      int reached = 0;
      for (int k = 0; k < permutations; ++k)
        if (explained(q, rearranged(r, random), r.mean()) >= same * d.share) ++reached;
      d.p_value = (reached + 1.0) / (permutations + 1.0);
      table.push_back(d);
    }
  }
  tell_false_discovery_rates(table);
  return table;
}

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
