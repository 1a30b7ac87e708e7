#include "compare/loop/next_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/measured/condition_views.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

namespace {

/// A candidate's predictor with its fit, and the covariance of its parameters.
struct Contender {
  std::set<std::string> ids;
  WheelPredictor predictor;
  VectorXd theta;
  std::vector<int> free;
  MatrixXd covariance;  ///< of the free parameters [SI]
  double log_evidence = 0.0, allowed = 0.0;
};

Contender contender(const Campaign& campaign, const Identification& id, const std::vector<Term>& terms, const Fit& fit,
                    std::set<std::string> ids) {
  Contender c{std::move(ids), WheelPredictor(campaign, id.observations, terms), fit.theta, fit.column_parameter, {}};
  MatrixXd gram = fit.columns.transpose() * fit.columns;
  gram.diagonal().array() += 1e-9;
  c.covariance = gram.ldlt().solve(MatrixXd::Identity(gram.rows(), gram.cols()));
  for (Index i = 0; i < gram.rows(); ++i)
    for (Index j = 0; j < gram.cols(); ++j)
      c.covariance(i, j) *=
          c.predictor.parameters()[static_cast<std::size_t>(c.free[static_cast<std::size_t>(i)])].scale *
          c.predictor.parameters()[static_cast<std::size_t>(c.free[static_cast<std::size_t>(j)])].scale;
  return c;
}

Vector4d as_vector(const bekker_wong::Reading& reading) {
  Vector4d vector;
  for (int channel = 0; channel < channel_count; ++channel) vector[channel] = channel_of(reading, channel);
  return vector;
}

/// Variance that each term's form may be wrong by: its contribution times the form's tolerance, channel by channel.
Matrix4d form_variance(const Contender& c, const OperatingCondition& at, const Vector4d& here) {
  Matrix4d variance = Matrix4d::Zero();
  for (int t = 0; t < static_cast<int>(c.predictor.terms().size()); ++t) {
    VectorXd theta = c.theta;
    theta[c.predictor.amplitude_index(t)] = 0.0;
    const double tolerance = c.predictor.terms()[static_cast<std::size_t>(t)].form->form_tolerance;
    const Vector4d contribution = here - as_vector(c.predictor.reading(theta, at));
    variance.diagonal() += tolerance * tolerance * contribution.cwiseAbs2();
  }
  return variance;
}

/// Prediction and its covariance from the parameters' uncertainty, by one-sided differences of 0.1 sd, and from the
/// tolerance of its forms.
std::pair<Vector4d, Matrix4d> predict(const Contender& c, const OperatingCondition& at) {
  const Vector4d here = as_vector(c.predictor.reading(c.theta, at));
  MatrixXd jacobian(4, static_cast<Index>(c.free.size()));
  for (std::size_t i = 0; i < c.free.size(); ++i) {
    const FreeParameter& p = c.predictor.parameters()[static_cast<std::size_t>(c.free[i])];
    double step = 1e-3 * p.scale;
    if (c.theta[c.free[i]] + step > p.upper) step = -step;
    VectorXd theta = c.theta;
    theta[c.free[i]] += step;
    jacobian.col(static_cast<Index>(i)) = (as_vector(c.predictor.reading(theta, at)) - here) / step;
  }
  return {here, jacobian * c.covariance * jacobian.transpose() + form_variance(c, at, here)};
}

/// Squared distance of two predictions over noise and their uncertainties, over the measured channels.
double squared_distance(const std::pair<Vector4d, Matrix4d>& a, const std::pair<Vector4d, Matrix4d>& b,
                        const NoiseFloor& noise) {
  std::vector<int> measured;
  for (int c = 0; c < channel_count; ++c)
    if (noise.channels[static_cast<std::size_t>(c)].measured) measured.push_back(c);
  const Index n = static_cast<Index>(measured.size());
  VectorXd gap(n);
  MatrixXd spread(n, n);
  for (Index i = 0; i < n; ++i) {
    const int ci = measured[static_cast<std::size_t>(i)];
    gap[i] = a.first[ci] - b.first[ci];
    for (Index j = 0; j < n; ++j) {
      const int cj = measured[static_cast<std::size_t>(j)];
      spread(i, j) = a.second(ci, cj) + b.second(ci, cj) +
                     noise.correlation(ci, cj) * noise.channels[static_cast<std::size_t>(ci)].sd(a.first[ci]) *
                         noise.channels[static_cast<std::size_t>(cj)].sd(a.first[cj]);
    }
  }
  return gap.dot(spread.ldlt().solve(gap));
}

/// The set that stands next behind the best one and doesn't hold it; nullptr where none was refitted.
const Weighted* next_standing(const Identification& id, const Weighted& best) {
  for (const Weighted& w : id.weights)
    if (w.weight > 0 && !std::includes(w.ids.begin(), w.ids.end(), best.ids.begin(), best.ids.end())) return &w;
  return nullptr;
}

/// What the campaign spans, by name.
Limits ranges_of(const Observations& observations) {
  Limits ranges;
  for (const Covariate& c : covariates(observations))
    if (c.name != "run") ranges[c.name] = {c.values.minCoeff(), c.values.maxCoeff()};
  return ranges;
}

/// Names of the conditions that lie outside what was run.
std::vector<std::string> beyond(const Observations& observations, const OperatingCondition& at) {
  Observations more = observations;
  more.rows.push_back(at);
  const Limits run = ranges_of(observations);
  std::vector<std::string> names;
  for (const auto& [name, range] : ranges_of(more))
    if (const auto was = run.find(name); was == run.end() || was->second != range) names.push_back(name);
  return names;
}

/// Every combination of a few levels of each limited condition, at most about a thousand.
std::vector<OperatingCondition> grid(const Observations& observations, const Limits& limits) {
  OperatingCondition centre = observations.rows[observations.rows.size() / 2];
  centre.run.reset();
  std::vector<OperatingCondition> points = {centre};
  for (const auto& [name, range] : limits) {
    const int levels = name == "slip" ? 6 : name == "pass" ? static_cast<int>(range.second - range.first) + 1 : 3;
    std::vector<OperatingCondition> more;
    const int used = points.size() * static_cast<std::size_t>(levels) > 1000 ? 1 : levels;
    for (const OperatingCondition& p : points)
      for (int k = 0; k < used; ++k) {
        OperatingCondition at = p;
        const double share = used > 1 ? static_cast<double>(k) / (used - 1) : 0.5;
        condition_view(name).set(at, range.first + share * (range.second - range.first));
        more.push_back(at);
      }
    points = std::move(more);
  }
  return points;
}

/// What a run at a condition would tell.
struct Prospect {
  double worth = 0.0;               ///< expected number of pairs that one run decides
  std::size_t against = 0;          ///< the candidate that it bears most upon, if the first is true
  double distance = 0.0, runs = 0;  ///< of these two; runs until that one is out
};

/// The candidates with their weights, the best first.
class Contest {
 public:
  Contest(std::vector<Contender> candidates, const NoiseFloor& noise)
      : candidates_(std::move(candidates)), noise_(noise) {
    double top = -std::numeric_limits<double>::infinity(), total = 0.0;
    for (const Contender& c : candidates_) top = std::max(top, c.log_evidence);
    for (const Contender& c : candidates_) weights_.push_back(std::exp(c.log_evidence - top)), total += weights_.back();
    for (double& w : weights_) w /= total;
  }

  /// Nothing where a candidate has no balance there, or can't be asked.
  std::optional<Prospect> at(const OperatingCondition& condition) const try {
    std::vector<std::pair<Vector4d, Matrix4d>> predictions;
    for (const Contender& c : candidates_) predictions.push_back(predict(c, condition));
    Prospect p;
    double most = 0.0;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double d = squared_distance(predictions[i], predictions[j], noise_);
        p.worth += weights_[i] * std::min(1.0, d / needed(i, j)) + weights_[j] * std::min(1.0, d / needed(j, i));
        if (j > 0) continue;
        constexpr double any = 0.1;  // what a candidate counts for, however unlikely
        const double bears = std::min(1.0, d / needed(0, i)) * (any + weights_[i]);
        if (bears > most) most = bears, p.against = i, p.distance = d, p.runs = std::ceil(needed(0, i) / d);
      }
    return p.distance > 0 ? std::optional(p) : std::nullopt;
  } catch (const NoSolution&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }

  const Contender& candidate(std::size_t i) const { return candidates_[i]; }

 private:
  /// Squared distance that puts j out where i is true.
  double needed(std::size_t i, std::size_t j) const {
    constexpr double least = 0.5;  // ln evidence: one that stands at the very edge
    return 2 * std::max(least, candidates_[j].allowed - (candidates_[i].log_evidence - candidates_[j].log_evidence));
  }

  std::vector<Contender> candidates_;
  std::vector<double> weights_;
  const NoiseFloor& noise_;
};

/// The most telling condition so far.
class Search {
 public:
  explicit Search(const Contest& contest) : contest_(contest) {}
  void ask(const OperatingCondition& at) {
    if (const auto p = contest_.at(at); p && (!best_ || p->worth > best_->second.worth)) best_.emplace(at, *p);
  }
  const auto& best() const { return best_; }

 private:
  const Contest& contest_;
  std::optional<std::pair<OperatingCondition, Prospect>> best_;
};

/// One condition after the other on finer levels, from the best so far.
void refine(Search& search, const Limits& limits) {
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

Limits limits_of(const Observations& observations) {
  Limits limits = ranges_of(observations);
  auto& slip = limits.try_emplace("slip", 0.0, 0.0).first->second;
  slip = {std::min(slip.first, -0.2), std::max(slip.second, 0.8)};
  const double load = observations.rows.front().load;
  auto& loads = limits.try_emplace("load", load, load).first->second;
  loads = {0.7 * loads.first, 1.4 * loads.second};
  return limits;
}

std::optional<NextTest> next_test(const Campaign& campaign, const Identification& id,
                                  const std::vector<Competitor>& competitors, const Limits& limits) {
  std::vector<Contender> candidates;
  const auto add = [&](const std::vector<Term>& terms, const Fit& fit, std::set<std::string> ids, double evidence,
                       double allowed) {
    candidates.push_back(contender(campaign, id, terms, fit, std::move(ids)));
    candidates.back().log_evidence = evidence, candidates.back().allowed = allowed;
  };
  const auto add_set = [&](const Weighted& w, double allowed) {
    add(id.candidates[w.best_candidate].terms, id.candidates[w.best_candidate].fit, w.ids, w.log_evidence, allowed);
  };
  for (const Competitor& c : competitors) add_set(id.weights[c.weighted], c.allowed);
  if (candidates.size() < 2) {
    const Competitor& alone = competitors.front();
    if (const Weighted* next = next_standing(id, id.weights[alone.weighted]))
      add_set(*next, alone.allowed);
    else
      add({}, id.base, {}, id.base_log_evidence, alone.allowed);
  }
  const Contest contest(std::move(candidates), id.noise);
  Search search(contest);
  for (const OperatingCondition& at : grid(id.observations, limits)) search.ask(at);
  refine(search, limits);
  if (!search.best() || search.best()->second.runs > 50) return std::nullopt;
  const auto& [at, told] = *search.best();
  NextTest next{.at = at,
                .quantities = {},
                .beyond = beyond(id.observations, at),
                .separates = {contest.candidate(0).ids, contest.candidate(told.against).ids},
                .runs = static_cast<int>(told.runs),
                .distance = told.distance};
  for (const auto& [name, range] : limits) next.quantities.push_back(name);
  return next;
}

}  // namespace soilbin::compare
