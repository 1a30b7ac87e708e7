// Rearrangements of measured values that leave re-runs of one setpoint together.
#pragma once

#include <Eigen/Dense>
#include <random>
#include <vector>

namespace soilbin::compare {

/// Draws rearrangements under which values have the same distribution where nothing but chance sets them: the values of
/// one setpoint change places among themselves, and as a whole with those of another setpoint that has as many. What
/// all re-runs of a setpoint share (its own model error, its bed) so counts once, not once a re-run (multi-level block
/// permutation: Winkler, Webster, Vidaurre, Nichols, Smith 2015, NeuroImage 123:253). A setpoint that has a number of
/// values like no other keeps its place.
class SetpointPermutation {
 public:
  /// setpoint: of each value.
  explicit SetpointPermutation(const std::vector<int>& setpoint);
  /// The values rearranged.
  Eigen::VectorXd operator()(const Eigen::VectorXd& values, std::mt19937_64& random) const;

 private:
  /// Setpoints that have as many values each.
  struct Alike {
    std::size_t size = 0;              ///< values of each
    std::vector<Eigen::Index> places;  ///< of their values, setpoint after setpoint
  };
  std::vector<Alike> groups_;
};

}  // namespace soilbin::compare
