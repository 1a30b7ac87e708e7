#include "compare/test_design/next_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/fit/factorizations.hpp"
#include "compare/measured/condition_views.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

namespace {

/// A candidate, or the base model, that the next run should separate from others.
struct Contender {
  std::set<std::string> ids;
  FittedModel model;
  double log_evidence = 0.0;
  double allowed = 0.0;  ///< ln evidence by which it may stand behind the best one
};

/// What a model predicts of one run, by channel.
struct RunForecast {
  Vector4d mean;
  Matrix4d covariance;
};

/// One row whose four channels are all measured.
Observations single_run(const OperatingCondition& at) {
  Observations run{.rows = {at}, .condition = {0}, .source_row = {0}, .cells = {}, .conditions = 1, .block = {0}};
  for (int channel = 0; channel < channel_count; ++channel) run.cells.push_back({0, channel, 0.0});
  return run;
}

/// Prediction and its covariance from the parameters' uncertainty and from the tolerance of its terms' forms: their
/// contribution times the tolerance, channel by channel. Nothing where there is no balance.
std::optional<RunForecast> predict(const FittedModel& model, const Observations& run) {
  const auto forecast = model.forecast(run);
  if (!forecast) return std::nullopt;
  RunForecast predicted{forecast->prediction, forecast->covariance()};
  const WheelPredictor predictor = model.predictor().over(run);
  for (int t = 0; t < std::ssize(model.terms()); ++t) {
    VectorXd theta = model.fit().theta, without;
    theta[predictor.amplitude_index(t)] = 0.0;
    if (!predictor.predict(theta, without)) return std::nullopt;
    const double tolerance = model.terms()[t].form->form_tolerance;
    predicted.covariance.diagonal() += tolerance * tolerance * (forecast->prediction - without).cwiseAbs2();
  }
  return predicted;
}

/// Squared distance of two predictions over noise and their uncertainties, over the measured channels.
double squared_distance(const RunForecast& a, const RunForecast& b, const NoiseFloor& noise) {
  std::vector<int> measured;
  for (int c = 0; c < channel_count; ++c)
    if (noise.channels[c].measured) measured.push_back(c);
  const auto sd = [&](int c) { return noise.channels[c].sd(a.mean[c], noise.channels[c].spread); };
  MatrixXd spread = (a.covariance + b.covariance)(measured, measured);
  for (Index i = 0; i < spread.rows(); ++i)
    for (Index j = 0; j < spread.cols(); ++j)
      spread(i, j) += noise.correlation(measured[i], measured[j]) * sd(measured[i]) * sd(measured[j]);
  const VectorXd gap = (a.mean - b.mean)(measured);
  return gap.dot(Ldlt(spread).solve(gap));
}

/// Sets that the next run should separate, best first; the best one alone where all others are excluded already.
std::vector<Contender> contenders(const Attribution& found) {
  const Candidates& all = found.candidates;
  std::vector<Contender> contenders;
  const double excluded = std::log(thresholds::excluded_odds);
  const auto add = [&](const WeightedSet& w, double allowed) {
    contenders.push_back({w.ids, all.models[w.best_candidate].model, w.log_evidence, allowed});
  };
  for (const Competitor& c : competitors(all))
    if (contenders.empty() || contenders.front().log_evidence - all.sets[c.set].log_evidence <= excluded)
      add(all.sets[c.set], c.allowed);
  if (contenders.size() > 1) return contenders;
  const Contender best = contenders.front();
  if (is_settled(all)) return contenders;
  if (const WeightedSet* next = next_standing(all, best.ids))
    add(*next, best.allowed);
  else
    contenders.push_back({{}, found.base, all.base_log_evidence, best.allowed});
  return contenders;
}

/// The span of a condition in the runs that were made. A run that tells no pressure has the tire's.
std::pair<double, double> span_of(const std::string& name, const Dataset& data) {
  std::pair<double, double> span = {not_a_number, not_a_number};
  for (OperatingCondition at : data.observations.rows) {
    if (!at.inflation_pressure) at.inflation_pressure = data.campaign->wheel.inflation_pressure;
    const double value = condition_view(name).get(at);
    span = {std::fmin(span.first, value), std::fmax(span.second, value)};
  }
  return span;
}

/// The limits without what reaches beyond the runs that were made, where nobody said that the rig goes there.
Limits as_run(const Limits& limits, const Limits& given, const Dataset& data) {
  Limits narrow = limits;
  for (auto& [name, range] : narrow)
    if (const auto span = span_of(name, data); !given.contains(name) && std::isfinite(span.first)) range = span;
  return narrow;
}

/// Names of the conditions that lie outside what was run.
std::vector<std::string> beyond(const Limits& limits, const Dataset& data, const OperatingCondition& at) {
  constexpr double rounding = 1e-9;
  std::vector<std::string> names;
  for (const auto& [name, range] : limits) {
    const auto [least, most] = span_of(name, data);
    const double value = condition_view(name).get(at), slack = rounding * std::max(std::abs(least), std::abs(most));
    if (value < least - slack || value > most + slack) names.push_back(name);
  }
  return names;
}

/// Every combination of a few levels of each limited condition, at most about a thousand.
std::vector<OperatingCondition> grid(const Observations& observations, const Limits& limits) {
  OperatingCondition centre = observations.rows[observations.rows.size() / 2];
  centre.run.reset();
  std::vector<Levels> levels;
  std::size_t points = 1;
  for (const auto& [name, range] : limits) {
    const int most = name == "slip" ? 6 : name == "pass" ? static_cast<int>(range.second - range.first) + 1 : 3;
    const int used = points * most > 1000 ? 1 : most;
    levels.emplace_back(name, evenly(range, used));
    points *= used;
  }
  return combinations(centre, levels);
}

/// What a run at a condition would decide.
struct Prospect {
  double worth = 0.0;               ///< expected number of pairs that one run decides
  std::size_t against = 0;          ///< the candidate that it bears most upon, if the first is true
  double distance = 0.0, runs = 0;  ///< of these two; runs until that one is out
};

/// The candidates with their weights, the best first.
class Contest {
 public:
  Contest(std::vector<Contender> contenders, const NoiseFloor& noise)
      : contenders_(std::move(contenders)), noise_(noise) {
    double top = -std::numeric_limits<double>::infinity(), total = 0.0;
    for (const Contender& c : contenders_) top = std::max(top, c.log_evidence);
    for (const Contender& c : contenders_) weights_.push_back(std::exp(c.log_evidence - top)), total += weights_.back();
    for (double& w : weights_) w /= total;
  }

  /// Nothing where a candidate has no balance there, or can't be asked.
  std::optional<Prospect> at(const OperatingCondition& condition) const {
    const Observations run = single_run(condition);
    std::vector<RunForecast> forecasts;
    for (const Contender& c : contenders_) {
      const auto forecast = predict(c.model, run);
      if (!forecast) return std::nullopt;
      forecasts.push_back(*forecast);
    }
    Prospect p;
    double most = 0.0;
    for (std::size_t i = 0; i < contenders_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double d = squared_distance(forecasts[i], forecasts[j], noise_);
        p.worth += weights_[i] * std::min(1.0, d / needed(i, j)) + weights_[j] * std::min(1.0, d / needed(j, i));
        if (j > 0) continue;
        const double bears = std::min(1.0, d / needed(0, i)) * (thresholds::min_weight + weights_[i]);
        if (bears > most) most = bears, p.against = i, p.distance = d, p.runs = std::ceil(needed(0, i) / d);
      }
    return p.distance > 0 ? std::optional(p) : std::nullopt;
  }

  const std::set<std::string>& ids(std::size_t i) const { return contenders_[i].ids; }

 private:
  /// Squared distance that puts j out where i is true.
  double needed(std::size_t i, std::size_t j) const {
    const double ahead = contenders_[i].log_evidence - contenders_[j].log_evidence;
    return 2 * std::max(thresholds::min_fall, contenders_[j].allowed - ahead);
  }

  std::vector<Contender> contenders_;
  std::vector<double> weights_;
  const NoiseFloor& noise_;
};

/// The condition so far that decides most.
class ConditionSearch {
 public:
  explicit ConditionSearch(const Contest& contest) : contest_(contest) {}
  void ask(const OperatingCondition& at) {
    if (const auto p = contest_.at(at); p && (!best_ || p->worth > best_->second.worth)) best_.emplace(at, *p);
  }
  const auto& best() const { return best_; }

  /// Each condition back to what was run, where it decides as much there.
  void draw_back(const Limits& run) {
    constexpr double as_much = 0.99;
    for (const auto& [name, range] : run) {
      if (!best_) return;
      OperatingCondition at = best_->first;
      const ConditionView& view = condition_view(name);
      view.set(at, std::clamp(view.get(at), range.first, range.second));
      if (const auto p = contest_.at(at); p && p->worth >= as_much * best_->second.worth) best_.emplace(at, *p);
    }
  }

 private:
  const Contest& contest_;
  std::optional<std::pair<OperatingCondition, Prospect>> best_;
};

/// One condition after the other on finer levels, from the best so far.
void refine(ConditionSearch& search, const Limits& limits) {
  constexpr int levels = 13;
  for (const auto& [name, range] : limits) {
    if (name == "pass" || !search.best()) continue;
    const OperatingCondition from = search.best()->first;
    for (int k = 0; k < levels; ++k) {
      OperatingCondition at = from;
      condition_view(name).set(at, range.first + (range.second - range.first) * k / (levels - 1));
      search.ask(at);
    }
  }
}

}  // namespace

std::optional<NextRun> next_run(const Attribution& found, const Limits& given) {
  const Dataset& data = found.base.data();
  Limits limits = given;  // what is given comes before what the campaign spans
  limits.merge(limits_of(data.observations, data.campaign->wheel));
  const Limits run = as_run(limits, given, data);
  std::vector<Contender> all = contenders(found);
  if (all.size() < 2) return std::nullopt;
  const Contest contest(std::move(all), data.noise);
  const auto search_within = [&](const Limits& within) {
    ConditionSearch search(contest);
    for (const OperatingCondition& at : grid(data.observations, within)) search.ask(at);
    refine(search, within);
    search.draw_back(run);
    return search.best();
  };
  auto best = search_within(run);
  if (!best || best->second.runs > thresholds::few_runs) best = search_within(limits);
  if (!best || best->second.runs > thresholds::max_runs) return std::nullopt;
  const auto& [at, prospect] = *best;
  NextRun next{.at = at,
               .quantities = {},
               .given = given,
               .beyond = beyond(limits, data, at),
               .separates = {contest.ids(0), contest.ids(prospect.against)},
               .runs = static_cast<int>(prospect.runs),
               .distance = prospect.distance};
  for (const auto& [name, range] : limits) next.quantities.push_back(name);
  return next;
}

}  // namespace soilbin::compare
