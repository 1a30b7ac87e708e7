// All differences between a model and a reference tested together: a chi-square test that allows for the uncertainty of
// the soil's values, which moves all conditions at once.
#pragma once

#include <optional>

#include "compare/discrepancy/side.hpp"

namespace soilbin::compare {

/// chi2 = d' (D + J S J')^-1 d over all channels and conditions: D, the reference's variances, with the correlation of
/// a measured run's channels; S, the covariance of the soil's values, independent but where the model comes from a fit;
/// J, the model's derivatives by them. The uncertainty of the soil moves all conditions together, which rows taken one
/// by one can't show. First order in the soil's values.
struct JointTest {
  std::size_t side = 0, reference = 0;
  std::size_t values = 0;
  double chi2 = 0.0;
  /// Degrees of freedom behind D, of the channel that has fewest; infinite where the errors are known.
  double freedom = std::numeric_limits<double>::infinity();
  /// Of chi2 where nothing differs: by chi square with `values` degrees of freedom where the errors are known, else by
  /// trace_tail: of a measurement with its channels, whose correlation is estimated too; of grains, whose channels
  /// stand each by itself, with one (by F, which errs high where the channels' errors err apart).
  double p_value = 1.0;
  double chi2_soil_exact = 0.0;   ///< the same with S = 0: what the soil's uncertainty explains is the rest
  std::vector<std::string> soil;  ///< values that were free to move
};

/// The test, or why there is none.
struct JointOutcome {
  std::optional<JointTest> test;
  std::string why_not;
};

/// No test where a value of the reference has no standard error, where its re-runs are too few for its channels, where
/// the model has no balance at some condition, or where there is no semi-empirical soil.
JointOutcome joint_test(const Side& reference, const Case& question, const ModelChoice& model);

/// Chance of a larger sum of squares over `values` numbers in `channels` channels whose covariance was estimated with
/// `freedom` degrees of freedom (Lawley and Hotelling's trace): by F, exactly for one channel, else by McKeon's
/// approximation (Biometrika 61, 1974), which takes freedom > channels + 3.
double trace_tail(double trace, double values, double channels, double freedom);

}  // namespace soilbin::compare
