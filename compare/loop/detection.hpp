// Is anything left over? Lack of fit against the noise, and residuals against every variable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/loop/bounded_fit.hpp"

namespace soilbin::compare {

/// Residual mean square over the noise's, as an F test (Draper and Smith, Applied Regression Analysis, ch. 2).
struct LackOfFit {
  double f = 0.0;
  double freedom = 0.0;        ///< of the residual
  double noise_freedom = 0.0;  ///< behind the noise estimate
  double p_value = 1.0;
};
LackOfFit lack_of_fit(const Fit& fit, const NoiseFloor& noise, Eigen::Index cells);

/// Does a channel's residual depend on a variable? Share of its variance that a parabola in the variable explains,
/// with its p-value from permutations of whole conditions.
struct Dependence {
  int channel = 0;
  std::string variable;
  double share = 0.0;
  double p_value = 1.0;
};
/// residual: whitened, a cell each. Deterministic for a seed.
std::vector<Dependence> dependences(const Observations& observations, const Eigen::VectorXd& residual, int permutations,
                                    std::uint64_t seed);

}  // namespace soilbin::compare
