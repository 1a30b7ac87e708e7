// What the levels of a balanced design do to a response: range analysis and analysis of variance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/design/orthogonal_array.hpp"

namespace soilbin::compare {

/// What one factor does, after range analysis.
struct FactorRange {
  std::vector<double> sums;   ///< K_i: sum of the responses at level i, in the response's unit
  std::vector<double> means;  ///< k_i = K_i / runs at that level
  double range = 0.0;         ///< R = largest k_i - smallest k_i
};

/// Factors in the design's order, and their order by falling R: the first matters most.
struct RangeAnalysis {
  std::vector<FactorRange> factors;
  std::vector<int> order;
};

/// Range analysis of a balanced design, as Zhou et al. calibrate with (section 3.2.1). responses: one a run. Throws
/// std::invalid_argument for another number of responses or a design that isn't balanced.
RangeAnalysis range_analysis(const LevelTable& design, const std::vector<double>& responses);

/// Where the error of an analysis of variance comes from.
enum class ErrorFrom {
  free_columns,    ///< what no factor of the design explains: noise and interactions together
  pooled_factors,  ///< no column is free: factors of the smallest sums of squares are taken for error, so that p-values
                   ///< of the others are too small
  known_noise,     ///< the runs' own standard errors; what no factor explains is then a row of its own. A factor's
                   ///< column also holds interactions of the others, so a small p may be theirs
};

struct VarianceRow {
  std::string source;
  double sum_of_squares = 0.0;
  int freedom = 0;
  double mean_square = 0.0;
  double f = 0.0;        ///< mean square over the error's; NaN for a pooled factor and the error itself
  double p_value = 1.0;  ///< of so large an F or a larger one by chance; NaN as F
  bool pooled = false;
};

/// Sums of squares of factors and of what is left add up to the total about the mean.
struct AnalysisOfVariance {
  std::vector<VarianceRow> factors;
  VarianceRow left;  ///< of free columns; freedom 0 where there are none. With known_noise it has an F of its own.
  double total = 0.0;
  ErrorFrom error_from = ErrorFrom::free_columns;
  double error_mean_square = 0.0;
  double error_freedom = 0.0;  ///< infinite for known_noise
};

/// Main effects of a balanced design: SS_j = sum over levels of (k_i - mean)^2 runs at the level, levels - 1 degrees of
/// freedom each (Montgomery, Design and Analysis of Experiments; p by the F distribution). noise_variance: the variance
/// of one run, where it is known; then F is a chi square over its freedom. Without it and without a free column, the
/// lower half of the factors (by sums of squares, at least one) is pooled. Throws as range_analysis.
AnalysisOfVariance analysis_of_variance(const LevelTable& design, const std::vector<std::string>& factors,
                                        const std::vector<double>& responses,
                                        std::optional<double> noise_variance = std::nullopt);

/// Where the error comes from, as a sentence.
std::string sentence(const AnalysisOfVariance& analysis);

}  // namespace soilbin::compare
