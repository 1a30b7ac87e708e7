#include "compare/loop/cross_validation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <thread>

#include "scenario/errors.hpp"

namespace soilbin::compare {

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

double channel_value(const bekker_wong::Reading& r, int channel) {
  const double values[] = {r.drawbar_pull, r.torque, r.sinkage, r.lateral_force};
  return values[channel];
}

FoldResult run_fold(const Campaign& campaign, const Identification& whole, const IdentifyOptions& options,
                    const std::vector<int>& fold, int left_out) {
  const Observations& all = whole.observations;
  std::vector<bool> keep(fold.size());
  for (std::size_t c = 0; c < fold.size(); ++c) keep[c] = fold[c] != left_out;
  const Observations training = of_conditions(all, keep);
  FoldResult result;
  const Identification id = identify(campaign, training, options);
  const WheelPredictor base(campaign, training);
  std::optional<WheelPredictor> better;
  if (id.best) {
    better.emplace(campaign, training, id.rivals[*id.best].terms);
    result.chosen = id.rivals[*id.best].ids;
  }
  for (const Cell& cell : all.cells) {
    if (keep[static_cast<std::size_t>(all.condition[static_cast<std::size_t>(cell.row)])]) continue;
    const OperatingCondition& at = all.rows[static_cast<std::size_t>(cell.row)];
    try {
      HeldOut held{.row = cell.row, .channel = cell.channel, .measured = cell.value};
      held.before = channel_value(base.reading(id.base.theta, at), cell.channel);
      held.after =
          better ? channel_value(better->reading(id.rivals[*id.best].fit.theta, at), cell.channel) : held.before;
      held.sd = whole.noise.channels[static_cast<std::size_t>(cell.channel)].sd(cell.value);
      result.cells.push_back(held);
    } catch (const NoSolution&) {
      ++result.unpredicted;
    }
  }
  return result;
}

ErrorPair errors_over(const std::vector<HeldOut>& cells, int channel) {
  ErrorPair e;
  double before = 0, after = 0, noise = 0;
  for (const HeldOut& h : cells) {
    if (channel >= 0 && h.channel != channel) continue;
    const double unit = channel < 0 ? h.sd : 1.0;
    before += std::pow((h.measured - h.before) / unit, 2);
    after += std::pow((h.measured - h.after) / unit, 2);
    noise += std::pow(h.sd / unit, 2);
    ++e.cells;
  }
  if (e.cells == 0) return e;
  e.before = std::sqrt(before / e.cells);
  e.after = std::sqrt(after / e.cells);
  e.noise_floor = std::sqrt(noise / e.cells);
  return e;
}

void pair_by_condition(const Observations& all, CrossValidation& cv) {
  std::map<int, std::pair<double, int>> fall;
  for (const HeldOut& h : cv.cells) {
    const double b = (h.measured - h.before) / h.sd, a = (h.measured - h.after) / h.sd;
    auto& [sum, count] = fall[all.condition[static_cast<std::size_t>(h.row)]];
    sum += b * b - a * a;
    ++count;
  }
  const double n = static_cast<double>(fall.size());
  if (n < 2) return;
  double mean = 0, square = 0;
  for (const auto& [condition, f] : fall) mean += f.first / f.second / n;
  for (const auto& [condition, f] : fall) square += std::pow(f.first / f.second - mean, 2);
  cv.gain = mean;
  cv.gain_error = std::sqrt(square / (n - 1) / n);
}

}  // namespace

CrossValidation cross_validate(const Campaign& campaign, const Identification& whole, const IdentifyOptions& options,
                               int folds, int threads) {
  const std::vector<int> fold = deal(whole.observations.conditions, folds, options.seed);
  std::vector<std::optional<FoldResult>> results(static_cast<std::size_t>(folds));
  std::vector<std::exception_ptr> failures(results.size());
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int f = next++; f < folds; f = next++) try {
        results[static_cast<std::size_t>(f)] = run_fold(campaign, whole, options, fold, f);
      } catch (const NoSolution&) {  // this fold's conditions can't be fitted alone: its cells stay unpredicted
      } catch (...) {
        failures[static_cast<std::size_t>(f)] = std::current_exception();
      }
  };
  std::vector<std::thread> crew;
  for (int t = 1; t < std::min(threads, folds); ++t) crew.emplace_back(work);
  work();
  for (std::thread& t : crew) t.join();
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);

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
