#include "compare/calibrate/likely_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/design/gaussian_process.hpp"
#include "compare/design/space_filling.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double hopeless = 1e-9;  // a chance below which chi square is the better guide

/// Runs with results as samples of one target.
Samples samples_of(const VirtualTest& test, const std::vector<const Experiment*>& experiments, std::size_t target) {
  const Index n = static_cast<Index>(experiments.size()), d = static_cast<Index>(test.factors.size());
  Samples samples{Eigen::MatrixXd(n, d), VectorXd(n), VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const Experiment& experiment = *experiments[i];
    samples.x.row(i) = to_unit(test.factors, experiment.values);
    samples.y[i] = experiment.results[target].value;
    samples.variance[i] = std::pow(experiment.results[target].std_error, 2);
  }
  return samples;
}

bool likelier(const Candidate& a, const Candidate& b) {
  if (a.chance < hopeless && b.chance < hopeless) return a.chi_square < b.chi_square;
  return a.chance > b.chance;
}

}  // namespace

LikelyPoints::LikelyPoints(const VirtualTest& test, const std::vector<CalibrationRun>& runs, const Settings& settings)
    : test_(test), settings_(settings) {
  std::vector<const Experiment*> good;
  std::string failure;
  for (const CalibrationRun& run : runs)
    if (run.experiment.results.size() == test.targets.size())
      good.push_back(&run.experiment);
    else
      failure = run.experiment.error, failed_.push_back(run.experiment.values);
  if (good.size() < test.factors.size() + 2)
    throw NoSolution(fmt::format("{} of {} experiments gave a result, too few to learn from; the last failure: {}",
                                 good.size(), runs.size(), failure));
  for (std::size_t t = 0; t < test.targets.size(); ++t)
    surrogates_.emplace_back(samples_of(test, good, t), SurrogateOptions{.seed = settings.seed});
  const Eigen::MatrixXd points = latin_hypercube(settings.cloud, static_cast<int>(test.factors.size()), settings.seed);
  for (Index i = 0; i < points.rows(); ++i) cloud_.push_back(look_at(from_unit(test.factors, points.row(i))));
  for (const Experiment* experiment : good) {
    const auto same =
        std::ranges::find_if(tried_, [&](const Candidate& one) { return one.values == experiment->values; });
    if (same != tried_.end())
      ++same->runs;
    else
      tried_.push_back(look_at(experiment->values)), tried_.back().runs = 1;
  }
}

Candidate LikelyPoints::look_at(const VectorXd& values) const {
  Candidate candidate{values, {}, 0.0, 1.0, 0};
  for (std::size_t t = 0; t < surrogates_.size(); ++t) {
    const Estimate predicted = surrogates_[t].predict(to_unit(test_.factors, values));
    const Estimate& measured = test_.targets[t].measured;
    const double variance = std::pow(predicted.std_error, 2) + std::pow(measured.std_error, 2);
    const double off = predicted.value - measured.value;
    candidate.chi_square += off * off / std::max(variance, 1e-12 * measured.value * measured.value);
    candidate.chance *= chance_within(predicted, measured.value, settings_.within * std::abs(measured.value));
    candidate.predicted.push_back(predicted);
  }
  return candidate;
}

bool LikelyPoints::is_near(const Candidate& candidate, double near) const {
  for (std::size_t t = 0; t < test_.targets.size(); ++t) {
    const double target = test_.targets[t].measured.value;
    if (std::abs(candidate.predicted[t].value - target) > near * std::abs(target)) return false;
  }
  return true;
}

Candidate LikelyPoints::likeliest_tried() const { return *std::ranges::min_element(tried_, likelier); }

bool LikelyPoints::is_nearest_to_a_failure(const Candidate& candidate) const {
  const VectorXd at = to_unit(test_.factors, candidate.values);
  const auto distance = [&](const VectorXd& values) { return (to_unit(test_.factors, values) - at).norm(); };
  double failure = std::numeric_limits<double>::infinity(), result = failure;
  for (const VectorXd& values : failed_) failure = std::min(failure, distance(values));
  if (std::isinf(failure)) return false;
  for (const Candidate& one : tried_) result = std::min(result, distance(one.values));
  return failure < result;
}

Candidate LikelyPoints::likeliest() const {
  const Candidate* fresh = nullptr;
  for (const Candidate& one : cloud_)
    if ((fresh == nullptr || likelier(one, *fresh)) && !is_nearest_to_a_failure(one)) fresh = &one;
  const Candidate tried = likeliest_tried();
  return fresh == nullptr || likelier(tried, *fresh) ? tried : *fresh;
}

std::vector<Candidate> LikelyPoints::spread_out(double near, int count) const {
  std::vector<Candidate> left, taken;
  for (const Candidate& candidate : cloud_)
    if (is_near(candidate, near) && !is_nearest_to_a_failure(candidate)) left.push_back(candidate);
  std::ranges::sort(left, likelier);
  std::vector<double> distance(left.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(taken.size()) < count && taken.size() < left.size()) {
    const auto farthest = std::ranges::max_element(distance);  // the first, and likeliest, of equals
    taken.push_back(left[farthest - distance.begin()]);
    const VectorXd at = to_unit(test_.factors, taken.back().values);
    for (std::size_t i = 0; i < left.size(); ++i)
      distance[i] = std::min(distance[i], (to_unit(test_.factors, left[i].values) - at).norm());
  }
  return taken;
}

std::vector<Candidate> LikelyPoints::tried_near(double near, int count) const {
  std::vector<Candidate> close;
  for (const Candidate& candidate : tried_)
    if (is_near(candidate, near)) close.push_back(candidate);
  std::ranges::sort(close, likelier);
  if (static_cast<int>(close.size()) > count) close.resize(static_cast<std::size_t>(count));
  return close;
}

std::vector<LeaveOneOut> LikelyPoints::held_out() const {
  std::vector<LeaveOneOut> all;
  for (const Surrogate& surrogate : surrogates_) all.push_back(surrogate.mode().leave_one_out());
  return all;
}

std::vector<double> LikelyPoints::extra_sd() const {
  std::vector<double> all;
  for (const Surrogate& surrogate : surrogates_) all.push_back(surrogate.mode().hyperparameters().extra_sd);
  return all;
}

double LikelyPoints::smallest_chi_square() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : cloud_) least = std::min(least, candidate.chi_square);
  return least;
}

void LikelyPoints::weigh(std::vector<Estimate>& parameters, std::vector<double>& learned) const {
  const double least = smallest_chi_square();
  for (std::size_t j = 0; j < test_.factors.size(); ++j) {
    double sum = 0.0, first = 0.0, second = 0.0;
    for (const Candidate& candidate : cloud_) {
      const double weight = std::exp(-0.5 * (candidate.chi_square - least));
      const double value = candidate.values[j];
      sum += weight, first += weight * value, second += weight * value * value;
    }
    const double mean = first / sum, sd = std::sqrt(std::max(0.0, second / sum - mean * mean));
    const double flat = (test_.factors[j].upper - test_.factors[j].lower) / std::sqrt(12.0);
    parameters.push_back({mean, sd});
    learned.push_back(std::max(0.0, 1 - sd / flat));
  }
}

}  // namespace soilbin::compare
