// Is anything left over in what a model leaves? Lack of fit against the noise, re-runs, serial correlation, and
// residuals against every variable.
//
//   const ResidualTests left = test_residual(model, 1);
//   left.lack_of_fit.p_value, left.reruns.p_value, left.serial.p_value
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/fit/fitted_model.hpp"

namespace soilbin::compare {

/// Residual mean square over the noise's, as an F test (Draper and Smith, Applied Regression Analysis, ch. 2).
struct LackOfFit {
  double f = 0.0;
  double freedom = 0.0;        ///< of the residual
  double noise_freedom = 0.0;  ///< behind the noise estimate
  double p_value = 1.0;
};
LackOfFit lack_of_fit(const FittedModel& model);

/// Lack of fit against re-runs alone, channel by channel: the scatter of the setpoints' mean residuals over that within
/// setpoints (pure error; Draper and Smith, ch. 2), the setpoint farthest off left out, for it may be an outlier. It
/// needs no estimate of the noise but how it grows with the signal, so it also sees what no smooth function of the
/// conditions follows and would pass for noise.
struct RerunTest {
  double p_value = 1.0;  ///< least of the channels', times their number; 1 where no channel has re-runs enough
  double excess = 0.0;   ///< squares of setpoints' means beyond what the re-runs explain, in theirs, over the channels
};
RerunTest rerun_test(const FittedModel& model);

/// Do runs made one after the other err alike? Serial correlation of the residuals in the order of the runs: of each
/// channel, and of a gain that all forces of a run share. An amplifier that warms, a bed that dries, another operator.
/// It needs no estimate of the noise, which such changes raise.
struct SerialTest {
  double p_value = 1.0;        ///< least of the series', times their number; 1 where the order isn't known
  std::optional<int> channel;  ///< whose series reaches it (Channel); none: the gain that all forces share
};
/// By the correlations over 1, 2, .. L runs, L a twelfth of them, the nearer the heavier (Bartlett's weights), against
/// rearrangements of the runs. Deterministic for a seed.
SerialTest serial_test(const FittedModel& model, int permutations, std::uint64_t seed);

/// Does a channel's residual depend on a variable? Share of its variance that a parabola in the variable explains,
/// with its p-value from permutations that keep the re-runs of a setpoint together (SetpointPermutation): what they
/// share, the model's error at that setpoint above all, is seen once, however often it was run.
struct Dependence {
  int channel = 0;
  std::string variable;
  double share = 0.0;
  double p_value = 1.0;
  /// Least share of false findings, in expectation, among this and all that are surer: of all channels and variables of
  /// the table (Benjamini and Hochberg 1995, J. R. Stat. Soc. B 57:289).
  double false_discovery_rate = 1.0;
};
/// residual: whitened, a cell each. Deterministic for a seed.
std::vector<Dependence> dependences(const Observations& observations, const Eigen::VectorXd& residual, int permutations,
                                    std::uint64_t seed);

/// What a model leaves, against the noise and against re-runs.
struct ResidualTests {
  LackOfFit lack_of_fit;
  RerunTest reruns;
  SerialTest serial;
};
ResidualTests test_residual(const FittedModel& model, std::uint64_t seed);

}  // namespace soilbin::compare
