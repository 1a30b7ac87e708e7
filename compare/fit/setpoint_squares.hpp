// Squares of residuals between setpoints and within them: what a model lacks, and the noise.
#pragma once

#include <Eigen/Dense>
#include <random>
#include <vector>

namespace soilbin::compare {

/// One channel's residuals, summed setpoint by setpoint.
class SetpointSquares {
 public:
  /// conditions: how many setpoints there may be.
  explicit SetpointSquares(int conditions);
  void add(int condition, double residual);

  double between() const;    ///< sum of n mean^2 over the setpoints
  double largest() const;    ///< the largest of these
  double within() const;     ///< sum of squares about the setpoints' means
  double setpoints() const;  ///< that have a value
  double reruns() const;     ///< values beyond each setpoint's first: the freedom of `within`

 private:
  struct Sums {
    double sum = 0.0, squares = 0.0, count = 0.0;
    double square_of_mean() const { return count > 0 ? sum * sum / count : 0.0; }
  };
  std::vector<Sums> sums_;
};

// Rearrangements of measured values that leave re-runs of one setpoint together.

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
