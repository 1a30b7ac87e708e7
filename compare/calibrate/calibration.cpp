#include "compare/calibrate/calibration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"
#include "compare/calibrate/likely_points.hpp"
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

  /// From the store, or made now and kept. A repetition at the same point takes the next seed.
  void run(Stage stage, const VectorXd& values, double chance = 0.0) {
    std::uint64_t seed = options_.seed;
    double seconds = 0;
    for (const auto& [when, before] : answer_.runs) seed += before.values == values, seconds += before.seconds;
    const std::size_t done = answer_.runs.size();
    const std::string best = stage == Stage::refinement ? fmt::format(", best chance {:.0f} %", 100 * chance) : "";
    tell(options_.watch,
         fmt::format("{}: run {} of at most {}{}", stage_name(stage), done + 1, options_.most_runs, best), done,
         static_cast<std::size_t>(options_.most_runs), seconds);
    if (std::optional<Experiment> made = obtain(test_, {values, seed}, store_))
      answer_.runs.push_back({stage, std::move(*made)});
  }

  void run_design(const LevelTable& design) {
    const Eigen::MatrixXd points = unit_points(design);
    for (Index i = 0; i < points.rows(); ++i) run(Stage::design, from_unit(test_.factors, points.row(i)));
  }

  /// Range analysis and analysis of variance, where every run of the design has a result. The runs' own errors are the
  /// measure only where no column is free: a column also holds interactions of other factors, which they don't know of.
  void analyse(const LevelTable& design) {
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

  LikelyPoints learn() const {
    return LikelyPoints(test_, answer_.runs, {options_.within, options_.cloud, options_.seed});
  }

  void run_candidates() {
    const LikelyPoints points = learn();
    std::vector<Candidate> spread = points.spread_out(options_.near, options_.candidates);
    const int left = options_.most_runs - static_cast<int>(answer_.runs.size());
    spread.resize(std::min(spread.size(), static_cast<std::size_t>(left)));
    for (const Candidate& one : spread) run(Stage::candidates, one.values, one.chance);
  }

  /// Runs the likeliest point until one that was run is likely enough.
  void refine() {
    while (may_run() && !test_.waits()) {
      const LikelyPoints points = learn();
      const Candidate likeliest = points.likeliest(), tried = points.likeliest_tried();
      if (tried.chance >= options_.probability) return;
      run(Stage::refinement, likeliest.values, tried.chance);
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
    points.weigh(answer_.parameters, answer_.learned);
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
    if (!std::isfinite(target.measured.value) || target.measured.value == 0 || !(target.measured.std_error >= 0))
      throw InputError(fmt::format("target '{}' is {} with error {}: tolerances are shares of it, so it can't be 0",
                                   target.name, target.measured.value, target.measured.std_error));
}

Calibration calibrate(const VirtualTest& test, const CalibrationOptions& options, ExperimentStore& store) {
  check(test);
  return Work(test, options, store).calibrate();
}

std::string stage_name(Stage stage) {
  switch (stage) {
    case Stage::design:
      return "design";
    case Stage::candidates:
      return "candidates";
    case Stage::refinement:
      return "refinement";
  }
  return "";
}

}  // namespace soilbin::compare
