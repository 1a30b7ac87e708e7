// How much better one model predicts conditions that it was not fitted to than another.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "compare/fit/fitted_model.hpp"
#include "compare/fit/thread_pool.hpp"

namespace soilbin::compare {

struct Folds {
  int count = 0;
  std::vector<int> of_condition;
};

/// Blocks of conditions dealt to folds in turn, then shuffled; no more folds than blocks, for one that leaves none out
/// tests nothing.
Folds deal_folds(const Observations& observations, int folds, std::uint64_t seed);

/// Mean and standard error over blocks of conditions of what the cells of each add up to.
std::pair<double, double> over_blocks(const std::map<int, double>& sums);

/// Gain of one model over another in the ln density that they give to conditions left out, mean over blocks of them
/// (Observations::block; a condition each, but for re-runs without a label).
/// Densities include each model's own uncertainty, so that a bold extrapolation costs only what it claims to know.
struct PredictiveGain {
  double mean = 0.0;
  double std_error = 0.0;
  int conditions = 0;
};

/// The ln density that a model gives to the cells of a fold, fitted anew to the conditions of all other folds.
struct FoldDensity {
  std::vector<int> block;                      ///< of each cell: Observations::block of its condition
  std::optional<Eigen::VectorXd> log_density;  ///< of each cell; nothing where no fit carries every run
};
std::vector<FoldDensity> fold_densities(const FittedModel& model, std::uint64_t seed, const ThreadPool& pool = {});

/// The gain between two models of one data set, with one seed.
PredictiveGain predictive_gain(const std::vector<FoldDensity>& model, const std::vector<FoldDensity>& over);

}  // namespace soilbin::compare
