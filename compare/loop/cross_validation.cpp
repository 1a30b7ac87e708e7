#include "compare/loop/cross_validation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "compare/loop/model_discrepancy.hpp"
#include "compare/loop/smooth_term.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

std::vector<int> deal(int conditions, int folds, std::uint64_t seed) {
  std::vector<int> fold(static_cast<std::size_t>(conditions));
  for (int c = 0; c < conditions; ++c) fold[static_cast<std::size_t>(c)] = c % folds;
  std::mt19937_64 random(seed);
  for (std::size_t i = fold.size(); i > 1; --i) std::swap(fold[i - 1], fold[random() % i]);
  return fold;
}

struct FoldResult {
  std::vector<HeldOut> cells;
  std::set<std::string> chosen;
  int unpredicted = 0;
};

/// What is redone in each fold.
struct Procedure {
  const NoiseFloor& noise;  ///< in which errors are told
  bool with_model_discrepancy;
  IdentifyOptions options;
};

FoldResult run_fold(const Campaign& campaign, const Identification& whole, const Procedure& procedure,
                    const std::vector<int>& fold, int left_out) {
  const Observations& all = whole.observations;
  std::vector<bool> keep(fold.size());
  for (std::size_t c = 0; c < fold.size(); ++c) keep[c] = fold[c] != left_out;
  const Observations training = of_conditions(all, keep);
  FoldResult result;
  const Identification exact = identify(campaign, training, procedure.options);
  std::optional<DiscrepancyReading> beside;
  if (procedure.with_model_discrepancy) beside = read_with_model_discrepancy(campaign, exact, procedure.options);
  const Identification& id = beside ? beside->identification : exact;
  const WheelPredictor base(campaign, training);
  std::optional<WheelPredictor> better;
  if (id.best) {
    better.emplace(campaign, training, id.candidates[*id.best].terms);
    result.chosen = id.candidates[*id.best].ids;
  }
  VectorXd predicted = VectorXd::Constant(static_cast<Index>(all.cells.size()), not_a_number);
  std::vector<Index> of_cell;  // of each held-out cell, its index among all
  Index trained = 0, index = -1;
  for (const Cell& cell : all.cells) {
    ++index;
    if (keep[static_cast<std::size_t>(all.condition[static_cast<std::size_t>(cell.row)])]) {
      predicted[index] = exact.base.prediction[trained++];
      continue;
    }
    const OperatingCondition& at = all.rows[static_cast<std::size_t>(cell.row)];
    try {
      HeldOut held{.row = cell.row, .channel = cell.channel, .measured = cell.value};
      held.before = channel_of(base.reading(exact.base.theta, at), cell.channel);
      held.after =
          better ? channel_of(better->reading(id.candidates[*id.best].fit.theta, at), cell.channel) : held.before;
      held.sd = procedure.noise.channels[static_cast<std::size_t>(cell.channel)].sd(cell.value);
      predicted[index] = held.before;
      of_cell.push_back(index);
      result.cells.push_back(held);
    } catch (const NoSolution&) {
      ++result.unpredicted;
    }
  }
  std::vector<bool> kept_rows(all.rows.size());
  for (std::size_t r = 0; r < kept_rows.size(); ++r) kept_rows[r] = keep[static_cast<std::size_t>(all.condition[r])];
  const VectorXd term = smooth_term(all, kept_rows, predicted, exact.noise);
  for (std::size_t k = 0; k < of_cell.size(); ++k) result.cells[k].smooth = result.cells[k].before + term[of_cell[k]];
  return result;
}

/// Every fold, some at once. The first exception of any stops them all and is thrown.
std::vector<std::optional<FoldResult>> run_folds(const Campaign& campaign, const Identification& whole,
                                                 const Procedure& procedure, int folds, int threads,
                                                 const Progress& progress) {
  const std::vector<int> fold = deal(whole.observations.conditions, folds, procedure.options.seed);
  std::vector<std::optional<FoldResult>> results(static_cast<std::size_t>(folds));
  std::atomic<std::size_t> done{0};
  const Pulse tell = [&] {
    if (progress) progress(done, static_cast<std::size_t>(folds));
  };
  const ThreadPool pool{threads, tell};
  pool.each(folds, [&](int f, const Pulse& pulse) {
    Procedure own = procedure;
    own.options.pool = {pool.share_of(f, folds), pulse};
    try {
      results[static_cast<std::size_t>(f)] = run_fold(campaign, whole, own, fold, f);
    } catch (const NoSolution&) {  // this fold's conditions can't be fitted alone: its cells stay unpredicted
    }
    ++done;
  });
  return results;
}

ErrorPair errors_over(const std::vector<HeldOut>& cells, int channel) {
  ErrorPair e;
  double before = 0, after = 0, smooth = 0, noise = 0;
  for (const HeldOut& h : cells) {
    if (channel >= 0 && h.channel != channel) continue;
    const double unit = channel < 0 ? h.sd : 1.0;
    before += std::pow((h.measured - h.before) / unit, 2);
    after += std::pow((h.measured - h.after) / unit, 2);
    smooth += std::pow((h.measured - h.smooth) / unit, 2);
    noise += std::pow(h.sd / unit, 2);
    ++e.cells;
  }
  if (e.cells == 0) return e;
  e.before = std::sqrt(before / e.cells);
  e.after = std::sqrt(after / e.cells);
  e.smooth = std::sqrt(smooth / e.cells);
  e.noise_floor = std::sqrt(noise / e.cells);
  return e;
}

/// Mean and standard error over conditions of what the cells of each add up to.
std::pair<double, double> over_conditions(const std::map<int, double>& sums) {
  const double n = static_cast<double>(sums.size());
  double mean = 0, square = 0;
  for (const auto& [condition, sum] : sums) mean += sum / n;
  for (const auto& [condition, sum] : sums) square += std::pow(sum - mean, 2);
  return {mean, std::sqrt(square / std::max(1.0, n - 1) / n)};
}

void pair_by_condition(const Observations& all, CrossValidation& cv) {
  std::map<int, std::pair<double, int>> fall;
  for (const HeldOut& h : cv.cells) {
    const double b = (h.measured - h.before) / h.sd, a = (h.measured - h.after) / h.sd;
    auto& [sum, count] = fall[all.condition[static_cast<std::size_t>(h.row)]];
    sum += b * b - a * a;
    ++count;
  }
  if (fall.size() < 2) return;
  std::map<int, double> means;
  for (const auto& [condition, f] : fall) means[condition] = f.first / f.second;
  std::tie(cv.gain, cv.gain_error) = over_conditions(means);
}

/// ln density of each held-out cell under a model fitted to the rest.
std::optional<Eigen::VectorXd> held_out_density(const Campaign& campaign, const Identification& whole,
                                                const Observations& training, const Observations& held,
                                                const std::vector<Term>& terms, const Eigen::VectorXd& start) {
  const WheelPredictor predictor(campaign, training, terms);
  Eigen::VectorXd about;
  BalanceMemory there = giving_way(), at_held = giving_way();
  if (!predictor.predict(start, about, there)) return std::nullopt;
  const Whitening whitening(training, whole.noise, about);
  const auto found = fit(predictor, training.values(), whitening, start);
  if (!found) return std::nullopt;
  const WheelPredictor elsewhere(campaign, held, terms);
  Eigen::VectorXd prediction;
  Eigen::MatrixXd jacobian;
  if (!elsewhere.predict(found->theta, prediction, at_held) || !elsewhere.linearise(found->theta, jacobian, at_held))
    return std::nullopt;
  Eigen::MatrixXd used(jacobian.rows(), static_cast<Eigen::Index>(found->column_parameter.size()));
  for (std::size_t c = 0; c < found->column_parameter.size(); ++c) {
    const int p = found->column_parameter[c];
    used.col(static_cast<Eigen::Index>(c)) =
        jacobian.col(p) * predictor.parameters()[static_cast<std::size_t>(p)].scale;
  }
  Eigen::MatrixXd gram = found->columns.transpose() * found->columns;
  gram.diagonal().array() += 1e-9;
  const Eigen::MatrixXd solved = gram.ldlt().solve(used.transpose());
  Eigen::VectorXd density(prediction.size());
  for (Eigen::Index i = 0; i < prediction.size(); ++i) {
    const Cell& cell = held.cells[static_cast<std::size_t>(i)];
    const double sd = whole.noise.channels[static_cast<std::size_t>(cell.channel)].sd(cell.value);
    const double variance = sd * sd + used.row(i).dot(solved.col(i));
    density[i] = -0.5 * std::log(variance) - 0.5 * std::pow(cell.value - prediction[i], 2) / variance;
  }
  return density;
}

}  // namespace

PredictiveGain predictive_gain(const Campaign& campaign, const Identification& whole, const std::vector<Term>& terms,
                               const Fit& fit, const std::vector<Term>& over_terms, const Fit& over_fit, int folds,
                               std::uint64_t seed, const ThreadPool& pool) {
  const Observations& all = whole.observations;
  folds = std::min(folds, all.conditions);
  const std::vector<int> fold = deal(all.conditions, folds, seed);
  std::vector<std::map<int, double>> gains(static_cast<std::size_t>(folds));  // of each condition left out
  pool.each(folds, [&](int f, const Pulse& pulse) {
    pulse();
    std::vector<bool> keep(fold.size()), held(fold.size());
    std::vector<int> original;
    for (std::size_t c = 0; c < fold.size(); ++c) {
      keep[c] = fold[c] != f, held[c] = !keep[c];
      if (held[c]) original.push_back(static_cast<int>(c));
    }
    const Observations training = of_conditions(all, keep), rest = of_conditions(all, held);
    const auto base = held_out_density(campaign, whole, training, rest, over_terms, over_fit.restart);
    const auto better = held_out_density(campaign, whole, training, rest, terms, fit.restart);
    if (!base || !better) return;
    for (std::size_t i = 0; i < rest.cells.size(); ++i) {
      const int condition = rest.condition[static_cast<std::size_t>(rest.cells[i].row)];
      const Eigen::Index k = static_cast<Eigen::Index>(i);
      gains[static_cast<std::size_t>(f)][original[static_cast<std::size_t>(condition)]] += (*better)[k] - (*base)[k];
    }
  });
  std::map<int, double> gain;
  for (std::map<int, double>& of_fold : gains) gain.merge(of_fold);
  if (gain.size() < 2) return {};
  const auto [mean, error] = over_conditions(gain);
  return {mean, error, static_cast<int>(gain.size())};
}

CrossValidation cross_validate(const Campaign& campaign, const Identification& whole, const NoiseFloor& noise,
                               bool with_model_discrepancy, const IdentifyOptions& options, int folds, int threads,
                               const Progress& progress) {
  const auto results = run_folds(campaign, whole, {noise, with_model_discrepancy, options}, folds, threads, progress);
  CrossValidation cv;
  for (const auto& result : results) {
    if (!result) continue;
    cv.cells.insert(cv.cells.end(), result->cells.begin(), result->cells.end());
    cv.chosen.push_back(result->chosen);
    cv.unpredicted += result->unpredicted;
  }
  for (int c = 0; c < channel_count; ++c) cv.channels[static_cast<std::size_t>(c)] = errors_over(cv.cells, c);
  cv.overall = errors_over(cv.cells, -1);
  pair_by_condition(whole.observations, cv);
  return cv;
}

}  // namespace soilbin::compare
