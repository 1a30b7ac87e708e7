#include "compare/calibrate/calibration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/design/factor.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check(const CalibrationOptions& options, int design_runs) {
  if (!(options.near > 0 && options.within > 0)) throw InputError("tolerances of a calibration are above 0");
  if (!(options.probability > 0 && options.probability < 1))
    throw InputError("the probability that ends a calibration lies between 0 and 1");
  if (options.most_runs < design_runs)
    throw InputError(
        fmt::format("{} runs are less than the {} of the design {}", options.most_runs, design_runs, options.design));
  if (options.candidates < 1 || options.cloud < 2)
    throw InputError("a calibration needs at least one candidate and a cloud of at least two points");
}

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

/// What finished runs say about every point within the factors' bounds: surrogates of the targets, and how likely each
/// point meets them.
class LikelyPoints {
 public:
  /// One surrogate a target, of all runs with results. Throws NoSolution where these are too few.
  LikelyPoints(const VirtualTest& test, const std::vector<CalibrationRun>& runs, const CalibrationOptions& options)
      : test_(test), options_(options) {
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
      surrogates_.emplace_back(samples_of(test, good, t), SurrogateOptions{.seed = options.seed});
    const Eigen::MatrixXd points = latin_hypercube(options.cloud, static_cast<int>(test.factors.size()), options.seed);
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

  /// The point with the largest chance, of cloud and tried points; where no chance is above 1e-9, the one nearest to
  /// the targets by chi square. A point whose nearest run gave no result is not proposed.
  Candidate likeliest() const {
    const Candidate* fresh = nullptr;
    for (const Candidate& one : cloud_)
      if ((fresh == nullptr || likelier(one, *fresh)) && !is_nearest_to_a_failure(one)) fresh = &one;
    const Candidate tried = likeliest_tried();
    return fresh == nullptr || likelier(tried, *fresh) ? tried : *fresh;
  }

  /// The likeliest of the points that were run with a result.
  Candidate likeliest_tried() const { return *std::ranges::min_element(tried_, likelier); }

  /// At most `count` points whose predictions are near every target: the likeliest, then each time the one farthest
  /// from those taken, so that they differ as the paper's do.
  std::vector<Candidate> spread_out(double near, int count) const {
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

  /// At most `count` points that were run and are predicted near every target, the likeliest first.
  std::vector<Candidate> tried_near(double near, int count) const {
    std::vector<Candidate> close;
    for (const Candidate& candidate : tried_)
      if (is_near(candidate, near)) close.push_back(candidate);
    std::ranges::sort(close, likelier);
    if (static_cast<int>(close.size()) > count) close.resize(static_cast<std::size_t>(count));
    return close;
  }

  std::vector<LeaveOneOut> held_out() const {
    std::vector<LeaveOneOut> all;
    for (const Surrogate& surrogate : surrogates_) all.push_back(surrogate.mode().leave_one_out());
    return all;
  }

  std::vector<double> extra_sd() const {
    std::vector<double> all;
    for (const Surrogate& surrogate : surrogates_) all.push_back(surrogate.mode().hyperparameters().extra_sd);
    return all;
  }

  double smallest_chi_square() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : cloud_) least = std::min(least, candidate.chi_square);
    return least;
  }

  /// Mean, sd and correlations of the factors under weights exp(-chi^2/2) over the cloud, and what that tells beyond
  /// the flat prior: 1 - sd/(width/sqrt 12), at least 0.
  void weigh(Calibration& answer) const {
    const double least = smallest_chi_square();
    const auto factors = static_cast<Index>(test_.factors.size());
    double sum = 0.0;
    VectorXd mean = VectorXd::Zero(factors);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(factors, factors);  // of the unit cube's coordinates
    const auto over_cloud = [&](const auto& add) {
      for (const Candidate& candidate : cloud_)
        add(std::exp(-0.5 * (candidate.chi_square - least)), to_unit(test_.factors, candidate.values));
    };
    over_cloud([&](double weight, const VectorXd& at) { sum += weight, mean += weight * at; });
    mean /= sum;
    over_cloud(
        [&](double weight, const VectorXd& at) { covariance += weight / sum * (at - mean) * (at - mean).transpose(); });
    const VectorXd values = from_unit(test_.factors, mean), sd = covariance.diagonal().cwiseSqrt();
    for (Index j = 0; j < factors; ++j) {
      const Factor& factor = test_.factors[static_cast<std::size_t>(j)];
      answer.parameters.push_back({values[j], sd[j] * (factor.upper - factor.lower)});
      answer.learned.push_back(std::max(0.0, 1 - sd[j] * std::sqrt(12.0)));
    }
    const VectorXd inverse = sd.unaryExpr([](double one) { return one > 0 ? 1 / one : 0.0; });
    const Eigen::MatrixXd scaled = inverse.asDiagonal() * covariance * inverse.asDiagonal();
    answer.correlations =
        scaled.selfadjointView<Eigen::Lower>();  // alike to the bit where the product is so to rounding
    answer.correlations.diagonal().setOnes();
  }

 private:
  Candidate look_at(const VectorXd& values) const {
    Candidate candidate{values, {}, 0.0, 1.0, 0};
    for (std::size_t t = 0; t < surrogates_.size(); ++t) {
      const Estimate predicted = surrogates_[t].predict(to_unit(test_.factors, values));
      const Estimate& measured = test_.targets[t].measured;
      const double variance = std::pow(predicted.std_error, 2) + std::pow(measured.std_error, 2);
      const double off = predicted.value - measured.value;
      candidate.chi_square += off * off / std::max(variance, 1e-12 * measured.value * measured.value);
      const double tolerance = test_.targets[t].tolerance.value_or(options_.within * std::abs(measured.value));
      candidate.chance *= chance_within(predicted, measured.value, tolerance);
      candidate.predicted.push_back(predicted);
    }
    return candidate;
  }

  bool is_near(const Candidate& candidate, double near) const {
    for (std::size_t t = 0; t < test_.targets.size(); ++t) {
      const Target& target = test_.targets[t];
      const double most = target.tolerance ? 2 * *target.tolerance : near * std::abs(target.measured.value);
      if (std::abs(candidate.predicted[t].value - target.measured.value) > most) return false;
    }
    return true;
  }

  bool is_nearest_to_a_failure(const Candidate& candidate) const {
    const VectorXd at = to_unit(test_.factors, candidate.values);
    const auto distance = [&](const VectorXd& values) { return (to_unit(test_.factors, values) - at).norm(); };
    double failure = std::numeric_limits<double>::infinity(), result = failure;
    for (const VectorXd& values : failed_) failure = std::min(failure, distance(values));
    if (std::isinf(failure)) return false;
    for (const Candidate& one : tried_) result = std::min(result, distance(one.values));
    return failure < result;
  }

  const VirtualTest& test_;
  const CalibrationOptions& options_;
  std::vector<Surrogate> surrogates_;
  std::vector<Candidate> cloud_, tried_;
  std::vector<Eigen::VectorXd> failed_;  ///< values of runs without a result
};

/// The work of one calibration: runs as they are made, and what they teach.
class Work {
 public:
  Work(const VirtualTest& test, const CalibrationOptions& options, ExperimentStore& store)
      : test_(test), options_(options), store_(store) {}

  Calibration calibrate() {
    const LevelTable design = first_columns(named_array(options_.design), static_cast<int>(test_.factors.size()));
    check(options_, design.runs());
    run_design(design);
    if (test_.waits()) return {};
    analyse(design);
    run_candidates();
    refine();
    return test_.waits() ? Calibration{} : conclude();
  }

 private:
  bool may_run() const { return static_cast<int>(answer_.runs.size()) < options_.most_runs; }

  /// From the store, or made now and kept; whether there is one. A repetition at the same point takes the next seed.
  bool run(Stage stage, const VectorXd& values, double chance = 0.0) {
    std::uint64_t seed = options_.seed;
    double seconds = 0;
    for (const auto& [when, before] : answer_.runs) seed += before.values == values, seconds += before.seconds;
    const std::size_t done = answer_.runs.size();
    const std::string best = stage == Stage::refinement ? fmt::format(", best chance {:.0f} %", 100 * chance) : "";
    tell(options_.watch,
         fmt::format("{}: run {} of at most {}{}", stage_name(stage), done + 1, options_.most_runs, best), done,
         static_cast<std::size_t>(options_.most_runs), seconds);
    std::optional<Experiment> made = obtain(test_, {values, seed}, store_);
    if (made) answer_.runs.push_back({stage, std::move(*made)});
    return made.has_value();
  }

  void run_design(const LevelTable& design) {
    const Eigen::MatrixXd points = unit_points(design);
    for (Index i = 0; i < points.rows(); ++i) run(Stage::design, from_unit(test_.factors, points.row(i)));
  }

  /// Range analysis and analysis of variance, where every run of the design has a result. The runs' own errors are the
  /// measure only where no column is free: a column also holds interactions of other factors, which they don't know of.
  void analyse(const LevelTable& design) {
    if (static_cast<int>(answer_.runs.size()) != design.runs()) return;
    for (const CalibrationRun& made : answer_.runs)
      if (made.experiment.results.empty()) return;
    std::vector<std::string> names;
    for (const Factor& factor : test_.factors) names.push_back(factor.name);
    for (std::size_t t = 0; t < test_.targets.size(); ++t) {
      std::vector<double> responses;
      double variance = 0.0;
      bool have_errors = design.columns() > design.levels;
      for (const CalibrationRun& made : answer_.runs) {
        const Estimate& result = made.experiment.results[t];
        responses.push_back(result.value);
        variance += result.std_error * result.std_error / design.runs();
        have_errors = have_errors && result.std_error > 0;
      }
      answer_.analyses.push_back(
          {range_analysis(design, responses),
           analysis_of_variance(design, names, responses, have_errors ? std::optional(variance) : std::nullopt)});
    }
  }

  LikelyPoints learn() const { return {test_, answer_.runs, options_}; }

  void run_candidates() {
    const LikelyPoints points = learn();
    std::vector<Candidate> spread = points.spread_out(options_.near, options_.candidates);
    const int left = options_.most_runs - static_cast<int>(answer_.runs.size());
    spread.resize(std::min(spread.size(), static_cast<std::size_t>(left)));
    for (const Candidate& one : spread) run(Stage::candidates, one.values, one.chance);
  }

  /// Runs the likeliest point until one that was run is likely enough, or there is none to be had.
  void refine() {
    while (may_run() && !test_.waits()) {
      const LikelyPoints points = learn();
      const Candidate likeliest = points.likeliest(), tried = points.likeliest_tried();
      if (tried.chance >= options_.probability || !run(Stage::refinement, likeliest.values, tried.chance)) return;
    }
  }

  Calibration conclude() {
    const LikelyPoints points = learn();
    answer_.candidates = points.tried_near(options_.near, options_.candidates);
    answer_.best = points.likeliest_tried();
    choose();
    answer_.reached = answer_.best.chance >= options_.probability;
    answer_.held_out = points.held_out();
    answer_.extra_sd = points.extra_sd();
    answer_.smallest_chi_square = points.smallest_chi_square();
    points.weigh(answer_);
    return std::move(answer_);
  }

  void choose() {
    if (!options_.decide || answer_.candidates.empty()) return;
    answer_.decision = options_.decide(answer_.candidates);
    if (answer_.decision->trials.size() != answer_.candidates.size())
      throw std::invalid_argument("whoever decides between candidates tries each");
    if (answer_.decision->decided()) answer_.best = answer_.candidates[answer_.decision->chosen];
  }

  const VirtualTest& test_;
  const CalibrationOptions& options_;
  ExperimentStore& store_;
  Calibration answer_;
};

}  // namespace

void check(const VirtualTest& test) {
  if (test.factors.empty() || test.targets.empty())
    throw InputError("a calibration needs at least one factor to vary and one target to reach");
  for (const Factor& factor : test.factors)
    if (!(factor.lower < factor.upper && std::isfinite(factor.lower) && std::isfinite(factor.upper)))
      throw InputError(fmt::format("factor '{}' goes from {} to {}: the lower bound must be below the upper one",
                                   factor.name, factor.lower, factor.upper));
  for (const Target& target : test.targets)
    if (!std::isfinite(target.measured.value) || !(target.measured.std_error >= 0) ||
        !(target.tolerance.value_or(std::abs(target.measured.value)) > 0))
      throw InputError(fmt::format("target '{}' is {} with error {}: tolerances are shares of it, so it can't be 0",
                                   target.name, target.measured.value, target.measured.std_error));
}

Calibration calibrate(const VirtualTest& test, const CalibrationOptions& options, ExperimentStore& store) {
  check(test);
  return Work(test, options, store).calibrate();
}

std::string stage_name(Stage stage) {
  constexpr const char* names[] = {"design", "candidates", "refinement"};
  return names[static_cast<std::size_t>(stage)];
}

}  // namespace soilbin::compare
