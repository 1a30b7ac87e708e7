#include "compare/attribution/validation.hpp"

#include <atomic>
#include <cmath>
#include <map>
#include <tuple>

#include "compare/attribution/choice.hpp"
#include "compare/attribution/learned_effect.hpp"
#include "compare/attribution/predictive_gain.hpp"
#include "compare/fit/condition_functions.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

struct FoldResult {
  std::vector<HeldOut> cells;
  std::set<std::string> chosen;
};

FoldResult run_fold(const Dataset& whole, const NoiseFloor& noise, const ValidationOptions& options,
                    const std::vector<int>& fold, int left_out) {
  const Observations& all = whole.observations;
  std::vector<bool> keep(fold.size());
  for (std::size_t c = 0; c < fold.size(); ++c) keep[c] = fold[c] != left_out;
  const Attribution exact =
      attribute(fit_base(*whole.campaign, of_conditions(all, keep), options.attribution), options.attribution);
  std::optional<DiscrepancyAttribution> beside;
  if (options.with_model_discrepancy) beside = attribute_with_model_discrepancy(exact, options.attribution);
  const Attribution& found = beside ? beside->found : exact;
  const FittedModel& base = exact.base;
  const CandidateModel* chosen =
      found.candidates.best ? &found.candidates.models[choose(found, options.attribution).candidate] : nullptr;
  const FittedModel* better = chosen && options.use_candidate ? &chosen->model : nullptr;
  std::vector<LearnedEffect> learned;
  if (options.learn) learned = learn_effects(refitted_as_exact(base, better), options.attribution);
  FoldResult result;
  if (chosen) result.chosen = chosen->ids;
  VectorXd predicted = VectorXd::Constant(all.cells.size(), not_a_number);
  std::vector<Index> of_cell;  // of each held-out cell, its index among all
  Index trained = 0, index = -1;
  for (const Cell& cell : all.cells) {
    ++index;
    if (keep[all.condition[cell.row]]) {
      predicted[index] = base.fit().prediction[trained++];
      continue;
    }
    const auto value_of = [&](const FittedModel& model) {
      return channel_of(model.predictor().reading(model.fit().theta, all.rows[cell.row]), cell.channel);
    };
    try {
      HeldOut held{.row = cell.row, .channel = cell.channel, .measured = cell.value};
      held.before = value_of(base);
      held.named = better ? value_of(*better) : held.before;
      held.after = learned.empty() ? held.named : value_of(learned.back().candidate.model);
      held.sd = noise.channels[cell.channel].sd(cell.value, cell.spread);
      predicted[index] = held.before;
      of_cell.push_back(index);
      result.cells.push_back(held);
    } catch (const NoSolution&) {}
  }
  std::vector<bool> kept_rows(all.rows.size());
  for (std::size_t r = 0; r < kept_rows.size(); ++r) kept_rows[r] = keep[all.condition[r]];
  const VectorXd term = smooth_term(all, kept_rows, predicted, base.data().noise);
  for (std::size_t k = 0; k < of_cell.size(); ++k) result.cells[k].smooth = result.cells[k].before + term[of_cell[k]];
  return result;
}

/// Every fold, some at once. The first exception of any stops them all and is thrown.
std::vector<std::optional<FoldResult>> run_folds(const Dataset& whole, const NoiseFloor& noise,
                                                 const ValidationOptions& options) {
  const Folds folds = deal_folds(whole.observations, options.folds, options.attribution.seed);
  std::vector<std::optional<FoldResult>> results(folds.count);
  std::atomic<std::size_t> done{0};
  const ThreadPool pool{options.threads, [&] {
                          if (options.progress) options.progress(done, folds.count);
                        }};
  pool.each(folds.count, [&](int f, const Pulse& pulse) {
    ValidationOptions own = options;
    own.attribution.pool = {pool.share_of(f, folds.count), pulse};
    try {
      results[f] = run_fold(whole, noise, own, folds.of_condition, f);
    } catch (const NoSolution&) {  // this fold's conditions can't be fitted by themselves: its cells stay unpredicted
    }
    ++done;
  });
  return results;
}

HeldOutErrors errors_over(const std::vector<HeldOut>& cells, int channel) {
  HeldOutErrors e;
  double before = 0, after = 0, named = 0, smooth = 0, noise = 0;
  for (const HeldOut& h : cells) {
    if (channel >= 0 && h.channel != channel) continue;
    const double unit = channel < 0 ? h.sd : 1.0;
    before += std::pow((h.measured - h.before) / unit, 2);
    after += std::pow((h.measured - h.after) / unit, 2);
    named += std::pow((h.measured - h.named) / unit, 2);
    smooth += std::pow((h.measured - h.smooth) / unit, 2);
    noise += std::pow(h.sd / unit, 2);
    ++e.cells;
  }
  if (e.cells == 0) return e;
  e.before = std::sqrt(before / e.cells);
  e.after = std::sqrt(after / e.cells);
  e.named = std::sqrt(named / e.cells);
  e.smooth = std::sqrt(smooth / e.cells);
  e.noise_floor = std::sqrt(noise / e.cells);
  return e;
}

void pair_by_block(const Observations& all, CrossValidation& cv) {
  std::map<int, std::pair<double, int>> fall;
  for (const HeldOut& h : cv.cells) {
    const double b = (h.measured - h.before) / h.sd, a = (h.measured - h.after) / h.sd;
    auto& [sum, count] = fall[all.block[all.condition[h.row]]];
    sum += b * b - a * a;
    ++count;
  }
  if (fall.size() < 2) return;
  std::map<int, double> means;
  for (const auto& [block, f] : fall) means[block] = f.first / f.second;
  std::tie(cv.gain, cv.gain_error) = over_blocks(means);
}

void sum_up(const Observations& whole, CrossValidation& cv) {
  for (int c = 0; c < channel_count; ++c) cv.channels[c] = errors_over(cv.cells, c);
  cv.overall = errors_over(cv.cells, -1);
  pair_by_block(whole, cv);
}

}  // namespace

CrossValidation cross_validate(const Dataset& whole, const NoiseFloor& noise, const ValidationOptions& options) {
  const auto results = run_folds(whole, noise, options);
  CrossValidation cv;
  for (const auto& result : results) {
    if (!result) continue;
    cv.cells.insert(cv.cells.end(), result->cells.begin(), result->cells.end());
    cv.chosen.push_back(result->chosen);
  }
  sum_up(whole.observations, cv);
  return cv;
}

CrossValidation errors_of_base_alone(CrossValidation validation, const Observations& whole) {
  for (HeldOut& held : validation.cells) held.after = held.named = held.before;
  sum_up(whole, validation);
  return validation;
}

CrossValidation errors_without_learned(CrossValidation validation, const Observations& whole) {
  for (HeldOut& held : validation.cells) held.after = held.named;
  sum_up(whole, validation);
  return validation;
}

}  // namespace soilbin::compare
