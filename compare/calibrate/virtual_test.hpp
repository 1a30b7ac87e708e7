// A virtual test: values of some contact parameters in, what a laboratory would measure out.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "compare/design/factor.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

/// A number that was measured on the real soil and that a virtual test should give.
struct Target {
  std::string name;        ///< "friction_angle"
  Estimate measured;       ///< [SI], not 0; the error is the measurement's
  std::string unit = "-";  ///< in which people read it
};

/// What to vary, what to reach, and how to find out.
struct VirtualTest {
  std::string identity;  ///< a text of all that its answers follow from, beside factors and seed; keys the store
  std::vector<Factor> factors;
  std::vector<Target> targets;
  /// An estimate of each target at these values of the factors [SI]. seed: of the packing; another one is a repetition.
  /// Throws NoSolution where the values have no answer (the sample doesn't settle, the plane never slides).
  std::function<std::vector<Estimate>(const Eigen::VectorXd& values, std::uint64_t seed)> run;
  /// Called once what the last run gave is kept, where it is set.
  std::function<void()> when_safe{};
};

/// Throws InputError where a test can't be calibrated: no factor or target, bounds out of order, a target of 0.
void check(const VirtualTest& test);

}  // namespace soilbin::compare
