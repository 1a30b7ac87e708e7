#include "compare/attribution/predictive_gain.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::VectorXd;

Folds deal_folds(const Observations& observations, int folds, std::uint64_t seed) {
  std::map<int, std::size_t> place;  // of each block, in the order of their first conditions
  for (const int block : observations.block) place.emplace(block, place.size());
  std::vector<int> fold(place.size());
  Folds dealt{std::min(folds, static_cast<int>(fold.size())), {}};
  for (std::size_t b = 0; b < fold.size(); ++b) fold[b] = static_cast<int>(b) % dealt.count;
  std::mt19937_64 random(seed);
  for (std::size_t i = fold.size(); i > 1; --i) std::swap(fold[i - 1], fold[random() % i]);
  for (const int block : observations.block) dealt.of_condition.push_back(fold[place.at(block)]);
  return dealt;
}

std::pair<double, double> over_blocks(const std::map<int, double>& sums) {
  const double n = static_cast<double>(sums.size());
  double mean = 0, square = 0;
  for (const auto& [block, sum] : sums) mean += sum / n;
  for (const auto& [block, sum] : sums) square += std::pow(sum - mean, 2);
  return {mean, std::sqrt(square / std::max(1.0, n - 1) / n)};
}

namespace {

/// The model fitted to other runs of its campaign, from where it ended.
std::optional<FittedModel> refitted(const FittedModel& model, const Observations& runs) {
  const Dataset& whole = model.data();
  VectorXd about;
  BalanceMemory memory = giving_way();
  if (!model.predictor().over(runs).predict(model.fit().restart, about, memory)) return std::nullopt;
  const auto data = std::make_shared<const Dataset>(
      Dataset{whole.campaign, runs, {}, whole.noise, Whitening(runs, whole.noise, about)});
  return fitted(data, model.predictor().over(data->observations), model.fit().restart, std::move(memory));
}

/// ln density of each cell left out under the model fitted to the rest.
std::optional<VectorXd> density_of(const FittedModel& model, const Observations& training, const Observations& held) {
  const auto found = refitted(model, training);
  if (!found) return std::nullopt;
  const auto forecast = found->forecast(held, giving_way());
  if (!forecast) return std::nullopt;
  VectorXd density(forecast->prediction.size());
  for (Index i = 0; i < density.size(); ++i) {
    const Cell& cell = held.cells[i];
    const double sd = model.data().noise.channels[cell.channel].sd(cell.value, cell.spread);
    const double variance = sd * sd + forecast->variance(i);
    density[i] = -0.5 * std::log(variance) - 0.5 * std::pow(cell.value - forecast->prediction[i], 2) / variance;
  }
  return density;
}

}  // namespace

std::vector<FoldDensity> fold_densities(const FittedModel& model, std::uint64_t seed, const ThreadPool& pool) {
  const Observations& all = model.data().observations;
  const bool many = std::ssize(all.rows) > thresholds::max_searched_rows;
  const Folds folds = deal_folds(all, many ? thresholds::choice_folds_of_many_runs : thresholds::choice_folds, seed);
  const std::vector<int>& fold = folds.of_condition;
  std::vector<FoldDensity> densities(folds.count);
  pool.each(folds.count, [&](int f, const Pulse& pulse) {
    pulse();
    std::vector<bool> keep(fold.size()), held(fold.size());
    for (std::size_t c = 0; c < fold.size(); ++c) keep[c] = fold[c] != f, held[c] = !keep[c];
    const Observations rest = of_conditions(all, held);
    for (const Cell& cell : rest.cells) densities[f].block.push_back(rest.block[rest.condition[cell.row]]);
    densities[f].log_density = density_of(model, of_conditions(all, keep), rest);
  });
  return densities;
}

PredictiveGain predictive_gain(const std::vector<FoldDensity>& model, const std::vector<FoldDensity>& over) {
  std::map<int, double> gain;  // of each block
  for (std::size_t f = 0; f < model.size(); ++f) {
    const auto &better = model[f].log_density, &base = over[f].log_density;
    if (!better || !base) continue;
    for (Index i = 0; i < better->size(); ++i) gain[model[f].block[i]] += (*better)[i] - (*base)[i];
  }
  if (gain.size() < 2) return {};
  const auto [mean, error] = over_blocks(gain);
  return {mean, error, static_cast<int>(gain.size())};
}

}  // namespace soilbin::compare
