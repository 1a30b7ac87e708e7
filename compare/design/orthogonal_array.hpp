// Orthogonal arrays: few runs in which every pair of factors meets every pair of levels equally often.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace soilbin::compare {

/// A small finite field GF(q) as tables, from which the arrays are made. Its elements are 0 .. q - 1; 0 and 1 are what
/// they are called.
class GaloisField {
 public:
  /// q: a prime up to 31 (arithmetic modulo q), or 4 (polynomials over GF(2) modulo x^2 + x + 1; the element's bit k is
  /// the coefficient of x^k). Throws std::invalid_argument for any other.
  explicit GaloisField(int q);

  int size() const { return size_; }
  int sum(int a, int b) const { return sums_[a * size_ + b]; }
  int product(int a, int b) const { return products_[a * size_ + b]; }

 private:
  int size_;
  std::vector<int> sums_, products_;
};

/// Runs x factors of levels 0 .. levels - 1.
struct LevelTable {
  int levels = 0;
  std::vector<std::vector<int>> rows;

  int runs() const { return static_cast<int>(rows.size()); }
  int columns() const { return rows.empty() ? 0 : static_cast<int>(rows.front().size()); }
};

/// The array of q^2 runs, q + 1 factors and strength 2 over GF(q) (Bose 1938, Sankhya 3:323; Bush 1952, Ann. Math.
/// Stat. 23:426): run (a, b) has the levels a, b, and b + m a for m = 1 .. q - 1. q = 3, 4, 5 are Taguchi's L9(3^4),
/// L16(4^5) and L25(5^6), in his order of rows and columns. Throws std::invalid_argument where GaloisField does.
LevelTable orthogonal_array(int levels);

/// The arrays that have a name: "L9", "L16", "L25". Throws InputError with the nearest right name.
LevelTable named_array(const std::string& name);

/// The first `columns` columns; what is left out is free for the error. Throws InputError where there are too few.
LevelTable first_columns(const LevelTable& table, int columns);

/// Whether every pair of columns holds every pair of levels equally often (strength 2), and so every column every
/// level.
bool is_balanced(const LevelTable& table);

// What the levels of a balanced design do to a response: range analysis and analysis of variance.

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

}  // namespace soilbin::compare
